#include "engine/physics/mixture_theory.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "engine/physics/theory.h"

namespace clatter {

using std::numbers::pi;

namespace {

double power_of(double base, int power) {
  return power == 2 ? base * base : power == 3 ? base * base * base : std::pow(base, power);
}

// S_D, the full solid angle.
double solid_angle(int dimension) {
  return dimension == 2 ? 2.0 * pi : 4.0 * pi;
}

double reduced_mass(const MixtureComponent& a, const MixtureComponent& b) {
  return a.mass * b.mass / (a.mass + b.mass);
}

// The moment of inertia in units of a^2/4.
double spin_mass(const MixtureComponent& component) {
  return component.inertia * component.mass;
}

// Variance of a component of the relative velocity.
double relative_variance(const MixtureComponent& a, double first, const MixtureComponent& b,
                         double second) {
  return first / a.mass + second / b.mass;
}

// Mean changes of the energies of the first partner in a collision.
struct EnergyGains {
  double translation = 0.0, spin = 0.0;
};

// (theory 12.14): T and R of both partners.
EnergyGains energy_gains(const MixtureComponent& a, const MixtureComponent& b,
                         const MixtureContact& law, int dimension, const std::array<double, 2>& T,
                         const std::array<double, 2>& R) {
  const double mu = reduced_mass(a, b), variance = relative_variance(a, T[0], b, T[1]);
  const double normal = 1.0 + law.restitution;
  const double k = mu * (1.0 / spin_mass(a) + 1.0 / spin_mass(b));
  const double h = mu * (1.0 + law.tangential_restitution) / (1.0 + k);
  const double width = variance + R[0] / spin_mass(a) + R[1] / spin_mass(b);
  const double tangents = dimension - 1;
  EnergyGains gains;
  gains.translation = normal * mu * (normal * mu / a.mass * variance - 2.0 * T[0] / a.mass) +
                      tangents * h / a.mass * (0.5 * h * width - T[0]);
  gains.spin = tangents * h / spin_mass(a) * (0.5 * h * width - R[0]);
  return gains;
}

// Follows dy/dt = slope(y) to rest by implicit steps of growing length. Returns whether it came to
// rest, within rounding of `rate`, the largest rate of the system.
bool relax(Eigen::VectorXd& y, double rate,
           const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& slope) {
  constexpr int kMostSteps = 400;
  constexpr double kRest = 1e-11, kDifference = 1e-6, kLongestStep = 0.5;
  double step = 0.1 / rate;
  Eigen::VectorXd f = slope(y);
  for (int k = 0; k < kMostSteps; ++k) {
    if (!f.allFinite()) return false;
    if (f.cwiseAbs().maxCoeff() <= kRest * rate) return true;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(y.size(), y.size()) / step;
    for (Eigen::Index column = 0; column < y.size(); ++column) {
      Eigen::VectorXd above = y, below = y;
      above[column] += kDifference;
      below[column] -= kDifference;
      matrix.col(column) -= (slope(above) - slope(below)) / (2.0 * kDifference);
    }
    const Eigen::VectorXd change = matrix.partialPivLu().solve(f);
    const double size = change.cwiseAbs().maxCoeff();
    if (!(size <= kLongestStep)) {
      step *= 0.3;
      if (!(step * rate > 1e-12)) return false;
      continue;
    }
    y += change;
    f = slope(y);
    step *= 3.0;
  }
  return false;
}

}  // namespace

double MixtureGas::count() const {
  double sum = 0.0;
  for (const MixtureComponent& one : components) sum += one.count;
  return sum;
}

double MixtureGas::count_of(std::size_t number) const {
  double sum = 0.0;
  for (const MixtureComponent& one : components) sum += one.species == number ? one.count : 0.0;
  return sum;
}

double MixtureGas::mass() const {
  double sum = 0.0;
  for (const MixtureComponent& one : components) sum += one.count * one.mass;
  return sum;
}

double MixtureGas::moment(int power) const {
  double sum = 0.0;
  for (const MixtureComponent& one : components) sum += one.count * std::pow(one.diameter, power);
  return sum / count();
}

double MixtureGas::packing_fraction() const {
  return clatter::packing_fraction(dimension, count() * moment(dimension) / volume);
}

double MixtureGas::mean(const std::vector<double>& of_components) const {
  double sum = 0.0;
  for (std::size_t s = 0; s < components.size(); ++s) {
    sum += components[s].count * of_components[s];
  }
  return sum / count();
}

double MixtureGas::mean_of(std::size_t number, const std::vector<double>& of_components) const {
  double sum = 0.0;
  for (std::size_t s = 0; s < components.size(); ++s) {
    if (components[s].species == number) sum += components[s].count * of_components[s];
  }
  return sum / count_of(number);
}

MixtureTemperatures MixtureGas::equal(double temperature) const {
  return {std::vector<double>(components.size(), temperature),
          std::vector<double>(components.size(), 0.0)};
}

const MixtureContact& MixtureGas::contact(const MixtureComponent& first,
                                          const MixtureComponent& second) const {
  return contacts[first.species * species + second.species];
}

double MixtureGas::partners(const MixtureComponent& first, const MixtureComponent& second) const {
  if (first.species != second.species) return second.count;
  return second.count * std::max(0.0, 1.0 - 1.0 / count_of(first.species));
}

bool MixtureGas::spins(std::size_t component) const {
  const MixtureComponent& one = components[component];
  return std::ranges::any_of(components, [&](const MixtureComponent& other) {
    return contact(one, other).tangential_restitution > -1.0 && partners(one, other) > 0.0;
  });
}

double MixtureGas::contact_correlation(double first, double second) const {
  const double phi = packing_fraction(), free = 1.0 - phi;
  const double harmonic = 2.0 * first * second / (first + second);
  const double size = harmonic * moment(dimension - 1) / moment(dimension);
  if (dimension == 2) return 1.0 / free + 9.0 / 16.0 * phi / (free * free) * size;
  return 1.0 / free + 1.5 * phi / (free * free) * size +
         0.5 * phi * phi / power_of(free, 3) * size * size;
}

double MixtureGas::compressibility() const {
  const double phi = packing_fraction(), free = 1.0 - phi;
  if (dimension == 2) {
    const double share = power_of(moment(1), 2) / moment(2);
    return (1.0 - share) / free + share * (1.0 + phi * phi / 8.0) / (free * free);
  }
  return 1.0 / free + 3.0 * phi / (free * free) * moment(1) * moment(2) / moment(3) +
         phi * phi * (3.0 - phi) / power_of(free, 3) * power_of(moment(2), 3) /
             power_of(moment(3), 2);
}

double MixtureGas::compressibility(const MixtureTemperatures& temperatures) const {
  const std::vector<double>& T = temperatures.translational;
  double sum = 0.0;
  for (std::size_t s = 0; s < components.size(); ++s) {
    for (std::size_t t = 0; t < components.size(); ++t) {
      const MixtureComponent &a = components[s], &b = components[t];
      const double size = power_of(0.5 * (a.diameter + b.diameter), dimension);
      sum += a.count * b.count * contact_correlation(a.diameter, b.diameter) * size *
             reduced_mass(a, b) * relative_variance(a, T[s], b, T[t]) *
             (1.0 + contact(a, b).restitution) / 2.0;
    }
  }
  const double of_all = count() * mean(T);
  return 1.0 + solid_angle(dimension) / (2.0 * dimension) * sum / (volume * of_all);
}

double MixtureGas::rate_factor(std::size_t component, std::size_t other) const {
  const MixtureComponent &a = components[component], &b = components[other];
  const double distance = 0.5 * (a.diameter + b.diameter);
  return solid_angle(dimension) * power_of(distance, dimension) / distance *
         contact_correlation(a.diameter, b.diameter) * partners(a, b) / volume /
         std::sqrt(2.0 * pi);
}

std::vector<double> MixtureGas::rate_factors() const {
  std::vector<double> factors;
  for (std::size_t s = 0; s < components.size(); ++s) {
    for (std::size_t t = 0; t < components.size(); ++t) factors.push_back(rate_factor(s, t));
  }
  return factors;
}

double MixtureGas::collision_rate(std::size_t component, std::size_t other,
                                  const MixtureTemperatures& temperatures) const {
  const std::vector<double>& T = temperatures.translational;
  return rate_factor(component, other) *
         std::sqrt(
             relative_variance(components[component], T[component], components[other], T[other]));
}

double MixtureGas::pair_rate(std::size_t first, std::size_t second,
                             const MixtureTemperatures& temperatures) const {
  double sum = 0.0;
  for (std::size_t s = 0; s < components.size(); ++s) {
    if (components[s].species != first) continue;
    for (std::size_t t = 0; t < components.size(); ++t) {
      if (components[t].species != second) continue;
      sum += components[s].count * collision_rate(s, t, temperatures);
    }
  }
  return first == second ? 0.5 * sum : sum;
}

double MixtureGas::friction(std::size_t component, const MixtureTemperatures& temperatures) const {
  const MixtureComponent& one = components[component];
  double damping = 0.0;
  for (std::size_t t = 0; t < components.size(); ++t) {
    const double share = reduced_mass(one, components[t]) / one.mass;
    damping += 2.0 * (1.0 + contact(one, components[t]).restitution) / dimension * share *
               collision_rate(component, t, temperatures);
  }
  return damping * mass() / (mass() - one.mass);
}

MixtureTemperatures MixtureGas::changes(const MixtureTemperatures& temperatures) const {
  return changes(temperatures, rate_factors());
}

MixtureTemperatures MixtureGas::changes(const MixtureTemperatures& temperatures,
                                        const std::vector<double>& rate_factors) const {
  const std::vector<double>&T = temperatures.translational, &R = temperatures.rotational;
  MixtureTemperatures changes = equal(0.0);
  for (std::size_t s = 0; s < components.size(); ++s) {
    for (std::size_t t = 0; t < components.size(); ++t) {
      const EnergyGains gains =
          energy_gains(components[s], components[t], contact(components[s], components[t]),
                       dimension, {T[s], T[t]}, {R[s], R[t]});
      const double rate = rate_factors[s * components.size() + t] *
                          std::sqrt(relative_variance(components[s], T[s], components[t], T[t]));
      changes.translational[s] += 2.0 / dimension * rate * gains.translation;
      changes.rotational[s] += 2.0 / (2 * dimension - 3) * rate * gains.spin;
    }
  }
  return changes;
}

namespace {

// Logarithms of temperatures as one vector: those of all components, then the rotational ones of
// those that spin.
struct Unknowns {
  std::vector<std::size_t> spinning;  // components

  Eigen::VectorXd of(const MixtureTemperatures& temperatures) const {
    const std::size_t count = temperatures.translational.size();
    Eigen::VectorXd numbers(static_cast<Eigen::Index>(count + spinning.size()));
    Eigen::Index place = 0;
    for (const double T : temperatures.translational) numbers[place++] = T;
    for (const std::size_t s : spinning) numbers[place++] = temperatures.rotational[s];
    return numbers;
  }

  MixtureTemperatures temperatures(const Eigen::VectorXd& y) const {
    const auto count = static_cast<std::size_t>(y.size()) - spinning.size();
    MixtureTemperatures result{std::vector<double>(count), std::vector<double>(count, 0.0)};
    Eigen::Index place = 0;
    for (double& T : result.translational) T = std::exp(y[place++]);
    for (const std::size_t s : spinning) result.rotational[s] = std::exp(y[place++]);
    return result;
  }
};

// The largest number of collisions of a particle per time.
double largest_rate(const MixtureGas& gas, const MixtureTemperatures& temperatures) {
  double largest = 0.0;
  for (std::size_t s = 0; s < gas.components.size(); ++s) {
    double rate = 0.0;
    for (std::size_t t = 0; t < gas.components.size(); ++t) {
      rate += gas.collision_rate(s, t, temperatures);
    }
    largest = std::max(largest, rate);
  }
  return largest;
}

}  // namespace

// The temperatures relax at constant T, in units in which T is 1.
std::optional<MixtureCooling> MixtureGas::cooling() const {
  Unknowns unknowns;
  for (std::size_t s = 0; s < components.size(); ++s) {
    if (spins(s)) unknowns.spinning.push_back(s);
  }
  const auto at_unit_mean = [&](const Eigen::VectorXd& y) {
    MixtureTemperatures temperatures = unknowns.temperatures(y);
    const double T = mean(temperatures.translational);
    for (double& one : temperatures.translational) one /= T;
    for (double& one : temperatures.rotational) one /= T;
    return temperatures;
  };
  const std::vector<double> factors = rate_factors();
  const auto slope = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
    const MixtureTemperatures temperatures = at_unit_mean(y);
    const MixtureTemperatures change = changes(temperatures, factors);
    const Eigen::VectorXd relative = unknowns.of(change).cwiseQuotient(unknowns.of(temperatures));
    return relative.array() - mean(change.translational);
  };
  const auto size = static_cast<Eigen::Index>(components.size() + unknowns.spinning.size());
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size);
  if (!relax(y, largest_rate(*this, equal(1.0)), slope)) return std::nullopt;
  const MixtureTemperatures ratios = at_unit_mean(y);
  return MixtureCooling{ratios, mean(changes(ratios).translational)};
}

// The unit of temperature is that at which collisions at equal temperatures dissipate the heating.
std::optional<MixtureTemperatures> MixtureGas::driven(const MixtureTemperatures& heating) const {
  Unknowns unknowns;
  for (std::size_t s = 0; s < components.size(); ++s) {
    if (spins(s)) unknowns.spinning.push_back(s);
  }
  const double loss = -mean(changes(equal(1.0)).translational);
  const double gain = mean(heating.translational) + mean(heating.rotational);
  if (!(loss > 0.0) || !(gain > 0.0)) return std::nullopt;
  const double unit = std::pow(gain / loss, 2.0 / 3.0);
  const std::vector<double> factors = rate_factors();
  const auto slope = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
    const MixtureTemperatures temperatures = unknowns.temperatures(y);
    return (unknowns.of(changes(temperatures, factors)) + unknowns.of(heating))
        .cwiseQuotient(unknowns.of(temperatures));
  };
  const auto size = static_cast<Eigen::Index>(components.size() + unknowns.spinning.size());
  Eigen::VectorXd y = Eigen::VectorXd::Constant(size, std::log(unit));
  if (!relax(y, largest_rate(*this, equal(unit)), slope)) return std::nullopt;
  return unknowns.temperatures(y);
}

std::vector<double> MixtureGas::kick_powers(const std::vector<double>& kick_speeds,
                                            double interval) const {
  const double all = mass();
  double shared = 0.0;
  for (std::size_t s = 0; s < components.size(); ++s) {
    shared += components[s].count * power_of(components[s].mass * kick_speeds[s], 2);
  }
  std::vector<double> powers;
  for (std::size_t s = 0; s < components.size(); ++s) {
    const double m = components[s].mass, kick = kick_speeds[s] * kick_speeds[s];
    powers.push_back(0.5 * dimension / interval *
                     (m * kick - 2.0 * m * m * kick / all + m / (all * all) * shared));
  }
  return powers;
}

std::vector<double> MixtureGas::elastic_temperatures(double temperature) const {
  const double all = mass(), particles = count();
  std::vector<double> temperatures;
  for (const MixtureComponent& one : components) {
    temperatures.push_back(temperature * (1.0 - one.mass / all) * particles / (particles - 1.0));
  }
  return temperatures;
}

}  // namespace clatter
