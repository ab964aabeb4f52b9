#include "engine/observables/structure_factor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstring>
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

// The factors exp(i n u x) of all n and of a block of particles. They come from products.
template <int D>
struct StructureFactor<D>::Factors {
  static constexpr std::size_t kBlock = 64;

  std::array<std::vector<double>, D> real, imaginary;  // [most + 1][block]

  explicit Factors(const IntVec<D>& most) {
    for (int axis = 0; axis < D; ++axis) {
      const std::size_t size = (static_cast<std::size_t>(most[axis]) + 1) * kBlock;
      real[axis].resize(size);
      imaginary[axis].resize(size);
    }
  }

  // Those of the first particles of a block. The others count nothing: theirs are 0.
  [[gnu::always_inline]] inline void set(const Vec<D>* positions, std::size_t count,
                                         const Vec<D>& shortest, const IntVec<D>& most) {
    for (int axis = 0; axis < D; ++axis) {
      double first_re[kBlock] = {}, first_im[kBlock] = {};
      double *re = real[axis].data(), *im = imaginary[axis].data();
      for (std::size_t k = 0; k < kBlock; ++k) {
        re[k] = k < count ? 1.0 : 0.0;
        im[k] = 0.0;
        if (k >= count) continue;
        const auto first = std::polar(1.0, shortest[axis] * positions[k][axis]);
        first_re[k] = first.real();
        first_im[k] = first.imag();
      }
      for (int n = 0; n < most[axis]; ++n, re += kBlock, im += kBlock) {
        for (std::size_t k = 0; k < kBlock; ++k) {
          re[kBlock + k] = re[k] * first_re[k] - im[k] * first_im[k];
          im[kBlock + k] = re[k] * first_im[k] + im[k] * first_re[k];
        }
      }
    }
  }

  // The sum of exp(i k.r) of the block.
  [[gnu::always_inline]] inline std::complex<double> sum(const IntVec<D>& vector) const {
    constexpr std::size_t kLanes = 4;
    using Lanes = double __attribute__((vector_size(8 * kLanes)));
    std::array<const double*, D> re, im;
    std::array<double, D> sign;
    for (int axis = 0; axis < D; ++axis) {
      const std::size_t place = static_cast<std::size_t>(std::abs(vector[axis])) * kBlock;
      re[axis] = real[axis].data() + place;
      im[axis] = imaginary[axis].data() + place;
      sign[axis] = vector[axis] < 0 ? -1.0 : 1.0;
    }
    Lanes sum_re{}, sum_im{};
    for (std::size_t k = 0; k < kBlock; k += kLanes) {
      Lanes a, b;
      std::memcpy(&a, re[0] + k, sizeof a);
      std::memcpy(&b, im[0] + k, sizeof b);
      b *= sign[0];
      for (int axis = 1; axis < D; ++axis) {
        Lanes c, d;
        std::memcpy(&c, re[axis] + k, sizeof c);
        std::memcpy(&d, im[axis] + k, sizeof d);
        d *= sign[axis];
        const Lanes product = a * c - b * d;
        b = a * d + b * c;
        a = product;
      }
      sum_re += a;
      sum_im += b;
    }
    return {(sum_re[0] + sum_re[1]) + (sum_re[2] + sum_re[3]),
            (sum_im[0] + sum_im[1]) + (sum_im[2] + sum_im[3])};
  }
};

// The block stays in the cache.
template <int D>
[[gnu::always_inline]] inline void StructureFactor<D>::add_density(
    const std::vector<Vec<D>>& positions, std::vector<std::complex<double>>& density) const {
  const Vec<D> shortest = unit();
  Factors factors(most_);
  for (std::size_t begin = 0; begin < positions.size(); begin += Factors::kBlock) {
    factors.set(&positions[begin], std::min(Factors::kBlock, positions.size() - begin), shortest,
                most_);
    std::size_t index = 0;
    for (const Shell& shell : shells_) {
      for (const IntVec<D>& vector : shell.vectors) density[index++] += factors.sum(vector);
    }
  }
}

#if defined(__x86_64__)
template <int D>
[[gnu::target("avx2")]] void StructureFactor<D>::add_density_avx2(
    const std::vector<Vec<D>>& positions, std::vector<std::complex<double>>& density) const {
  add_density(positions, density);
}
#endif

// The sum of exp(i k.r) for each wave vector. Wider vectors have equal results.
template <int D>
std::vector<std::complex<double>> StructureFactor<D>::density_of(
    const std::vector<Vec<D>>& positions) const {
  std::size_t vectors = 0;
  for (const Shell& shell : shells_) vectors += shell.vectors.size();
  std::vector<std::complex<double>> density(vectors, 0.0);
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    add_density_avx2(positions, density);
    return density;
  }
#endif
  add_density(positions, density);
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
