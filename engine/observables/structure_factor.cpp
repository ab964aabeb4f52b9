#include "engine/observables/structure_factor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace clatter {

namespace {

constexpr double kPi = std::numbers::pi;

// Directions that are evenly spread over the circle or the sphere (spherical Fibonacci lattice).
template <int D>
Vec<D> direction(int number, int count) {
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  if constexpr (D == 2) {
    const double angle = kPi * (number + 0.5) / count;
    return {std::cos(angle), std::sin(angle)};
  } else {
    const double height = 1.0 - (2.0 * number + 1.0) / count;
    const double radius = std::sqrt(1.0 - height * height);
    return {radius * std::cos(golden * number), radius * std::sin(golden * number), height};
  }
}

}  // namespace

// The shortest wave vector along each periodic axis.
template <int D>
Vec<D> StructureFactor<D>::unit() const {
  const Model<D>& model = simulation_.model();
  Vec<D> unit = Vec<D>::Zero();
  for (int axis = 0; axis < D; ++axis) {
    if (model.periodic(axis)) unit[axis] = 2.0 * kPi / model.box[axis];
  }
  return unit;
}

template <int D>
StructureFactor<D>::StructureFactor(const Simulation<D>& simulation,
                                    const StructureFactorSettings& settings)
    : simulation_(simulation), groups_(simulation) {
  const double width = settings.range / settings.bins;
  for (int bin = 0; bin < settings.bins; ++bin) {
    add_shell(bin * width, (bin + 1) * width, settings.vectors);
  }
}

// The lattice vectors next to evenly spread points of the shell, up to `most` of them.
template <int D>
void StructureFactor<D>::add_shell(double low, double high, int most) {
  constexpr int kTries = 8;  // points per vector
  const Vec<D> shortest = unit();
  Shell shell;
  for (int number = 0; number < kTries * most; ++number) {
    // Consecutive points are at different places of the shell.
    const int spread = number % kTries * most + number / kTries;
    const double length = low + (high - low) * (number % 3 + 0.5) / 3.0;
    const Vec<D> point = length * direction<D>(spread, kTries * most);
    IntVec<D> vector = IntVec<D>::Zero();
    for (int axis = 0; axis < D; ++axis) {
      if (shortest[axis] > 0.0) {
        vector[axis] = static_cast<int>(std::round(point[axis] / shortest[axis]));
      }
    }
    const double wave_number = vector.template cast<double>().cwiseProduct(shortest).norm();
    if (!(wave_number > 0.0 && wave_number >= low && wave_number < high)) continue;
    const bool known = std::ranges::any_of(shell.vectors, [&](const IntVec<D>& other) {
      return other == vector || other == IntVec<D>(-vector);
    });
    if (known) continue;
    shell.vectors.push_back(vector);
    shell.wave_number += wave_number;
    most_ = most_.cwiseMax(vector.cwiseAbs());
    if (static_cast<int>(shell.vectors.size()) == most) break;
  }
  if (shell.vectors.empty()) return;
  shell.wave_number /= static_cast<double>(shell.vectors.size());
  shells_.push_back(std::move(shell));
}

// The sum of exp(-i k.r) for each wave vector. The factors exp(i n u x) of all n and of a block of
// particles come from products. The block stays in the cache.
template <int D>
std::vector<std::complex<double>> StructureFactor<D>::density_of(
    const std::vector<Vec<D>>& positions) const {
  constexpr std::size_t kBlock = 64;
  using Factor = std::complex<double>;
  const Vec<D> shortest = unit();
  std::array<std::vector<Factor>, D> factors;  // [most + 1][block]
  for (int axis = 0; axis < D; ++axis) {
    factors[axis].resize((static_cast<std::size_t>(most_[axis]) + 1) * kBlock);
  }
  std::size_t vectors = 0;
  for (const Shell& shell : shells_) vectors += shell.vectors.size();
  std::vector<Factor> density(vectors, 0.0);
  for (std::size_t begin = 0; begin < positions.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, positions.size() - begin);
    for (int axis = 0; axis < D; ++axis) {
      for (std::size_t k = 0; k < count; ++k) {
        const Factor first = std::polar(1.0, shortest[axis] * positions[begin + k][axis]);
        Factor power = 1.0;
        for (int n = 0; n <= most_[axis]; ++n) {
          factors[axis][static_cast<std::size_t>(n) * kBlock + k] = power;
          power = {power.real() * first.real() - power.imag() * first.imag(),
                   power.real() * first.imag() + power.imag() * first.real()};
        }
      }
    }
    std::size_t index = 0;
    for (const Shell& shell : shells_) {
      for (const IntVec<D>& vector : shell.vectors) {
        double real = 0.0, imaginary = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
          double re = 1.0, im = 0.0;
          for (int axis = 0; axis < D; ++axis) {
            const auto n = static_cast<std::size_t>(std::abs(vector[axis]));
            const Factor factor = factors[axis][n * kBlock + k];
            const double sine = vector[axis] < 0 ? -factor.imag() : factor.imag();
            const double product = re * factor.real() - im * sine;
            im = re * sine + im * factor.real();
            re = product;
          }
          real += re;
          imaginary += im;
        }
        density[index++] += Factor(real, imaginary);
      }
    }
  }
  return density;
}

// Adds the products of two densities to the shells from a place on, times a factor.
template <int D>
void StructureFactor<D>::add_products(const std::vector<std::complex<double>>& first,
                                      const std::vector<std::complex<double>>& second,
                                      double factor, std::size_t place) {
  std::size_t index = 0;
  for (std::size_t shell = 0; shell < shells_.size(); ++shell) {
    for (std::size_t k = 0; k < shells_[shell].vectors.size(); ++k, ++index) {
      const std::complex<double>&a = first[index], &b = second[index];
      sums_.values[place + shell] += factor * (a.real() * b.real() + a.imag() * b.imag());
    }
  }
}

template <int D>
void StructureFactor<D>::sample() {
  const std::vector<Vec<D>> positions = simulation_.positions();
  if (positions.empty()) return;
  const double per_particle = 1.0 / static_cast<double>(positions.size());
  sums_.values[0] += 1.0;
  const std::vector<std::complex<double>> density = density_of(positions);
  add_products(density, density, per_particle, 1);
  if (groups_.count() == 1) return;
  std::vector<std::vector<std::complex<double>>> densities;
  for (std::size_t group = 1; group < groups_.count(); ++group) {
    std::vector<Vec<D>> own;
    groups_.for_each(group, [&](std::size_t i) { own.push_back(positions[i]); });
    densities.push_back(density_of(own));
  }
  std::size_t place = 1;
  for (std::size_t t = 0; t < densities.size(); ++t) {
    for (std::size_t s = 0; s <= t; ++s) {
      place += shells_.size();
      const double factor = std::sqrt(groups_.per_particle(1 + s) * groups_.per_particle(1 + t));
      add_products(densities[s], densities[t], factor, place);
    }
  }
}

template <int D>
ObservableResult StructureFactor<D>::result(const ObservableParts& parts) const {
  ResultTable table{"structure_factor", {{"k", "1/a", {}}, {"vectors", "1", {}}, {"S", "1", {}}}};
  for (std::size_t shell = 0; shell < shells_.size(); ++shell) {
    const auto vectors = static_cast<double>(shells_[shell].vectors.size());
    table.columns[0].values.push_back(shells_[shell].wave_number);
    table.columns[1].values.push_back(vectors);
    append(table.columns[2], ratio_of(parts.coarse, 1 + shell, 0, vectors));
  }
  std::size_t place = 1;
  for (std::size_t t = 1; t < groups_.count(); ++t) {
    for (std::size_t s = 1; s <= t; ++s) {
      place += shells_.size();
      const std::string name = 'S' + groups_.suffix(s) + '+' + groups_.suffix(t).substr(1);
      TableColumn& column = table.columns.emplace_back(TableColumn{name, "1", {}});
      for (std::size_t shell = 0; shell < shells_.size(); ++shell) {
        const auto vectors = static_cast<double>(shells_[shell].vectors.size());
        append(column, ratio_of(parts.coarse, place + shell, 0, vectors));
      }
    }
  }
  return {{std::move(table)}, {}};
}

template class StructureFactor<2>;
template class StructureFactor<3>;

}  // namespace clatter
