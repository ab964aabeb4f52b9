#include "engine/physics/mixing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace clatter {

// -c ln c
static double entropy_term(double share) {
  return share > 0.0 ? -share * std::log(share) : 0.0;
}

// The expectation of -c ln c for the share c of `marked` particles among `drawn` ones of `all`: the
// mean over the hypergeometric distribution. Its weights follow from that of the likeliest number.
static double expected_entropy_term(double drawn, double marked, double all) {
  const double least = std::max(0.0, drawn + marked - all);
  const double most = std::min(drawn, marked);
  const double likeliest =
      std::clamp(std::floor((drawn + 1.0) * (marked + 1.0) / (all + 2.0)), least, most);
  constexpr double kNegligible = 1e-18;
  double weights = 1.0;
  double sum = entropy_term(likeliest / drawn);
  const auto add = [&](double number, double weight) {
    weights += weight;
    sum += weight * entropy_term(number / drawn);
  };
  double weight = 1.0;
  for (double k = likeliest; k < most && weight > kNegligible; ++k) {
    weight *= (marked - k) * (drawn - k) / ((k + 1.0) * (all - marked - drawn + k + 1.0));
    add(k + 1.0, weight);
  }
  weight = 1.0;
  for (double k = likeliest; k > least && weight > kNegligible; --k) {
    weight *= k * (all - marked - drawn + k) / ((marked - k + 1.0) * (drawn - k + 1.0));
    add(k - 1.0, weight);
  }
  return sum / weights;
}

Mixing mixing_of(std::span<const std::uint32_t> numbers, std::size_t species) {
  std::vector<double> of_species(species);
  std::map<std::uint64_t, double> cells_of_number;  // how many cells have this number of particles
  for (std::size_t cell = 0; cell < numbers.size(); cell += species) {
    std::uint64_t particles = 0;
    for (std::size_t s = 0; s < species; ++s) {
      particles += numbers[cell + s];
      of_species[s] += numbers[cell + s];
    }
    if (particles > 0) cells_of_number[particles] += 1.0;
  }
  double all = 0.0;
  for (const double number : of_species) all += number;
  double separate_variance = 0.0;  // S_0
  double separate_entropy = 0.0;
  for (const double number : of_species) {
    separate_variance += number / all * (1.0 - number / all);
    separate_entropy += entropy_term(number / all);
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (!(separate_variance > 0.0)) return {kNone, kNone, kNone};

  double variance = 0.0;
  double entropy = 0.0;
  for (std::size_t cell = 0; cell < numbers.size(); cell += species) {
    double particles = 0.0;
    for (std::size_t s = 0; s < species; ++s) particles += numbers[cell + s];
    if (particles == 0.0) continue;
    for (std::size_t s = 0; s < species; ++s) {
      const double share = numbers[cell + s] / particles;
      const double excess = share - of_species[s] / all;
      variance += particles / all * excess * excess;
      entropy += particles / all * entropy_term(share);
    }
  }
  double occupied = 0.0;
  double random_entropy = 0.0;
  for (const auto& [particles, cells] : cells_of_number) {
    occupied += cells;
    const auto drawn = static_cast<double>(particles);
    for (const double number : of_species) {
      random_entropy += cells * drawn / all * expected_entropy_term(drawn, number, all);
    }
  }
  if (occupied == all) return {kNone, kNone, kNone};
  const double random_variance = separate_variance * (occupied - 1.0) / (all - 1.0);  // S_R
  return {(separate_variance - variance) / (separate_variance - random_variance),
          entropy / separate_entropy, random_entropy / separate_entropy};
}

}  // namespace clatter
