#include "engine/physics/atmosphere.h"

#include <algorithm>
#include <cmath>

#include "engine/physics/theory.h"

namespace clatter {

namespace {

constexpr int kHalvings = 60;

// The pressure over the temperature (theory 6.3).
double pressure(double density, int dimension) {
  return density * compressibility(packing_fraction(dimension, density), 1.0, dimension);
}

// The logarithm of the density at a pressure over the temperature.
double log_density(double pressure_by_temperature, int dimension) {
  double high = std::log(std::min(pressure_by_temperature, 1.0 / packing_fraction(dimension, 1.0)));
  double low = high - 40.0;
  for (int step = 0; step < kHalvings; ++step) {
    const double middle = 0.5 * (low + high);
    (pressure(std::exp(middle), dimension) > pressure_by_temperature ? high : low) = middle;
  }
  return low;
}

// Heights and densities from the pressure over the temperature at the lowest centres to that at
// the highest. Between equal steps of ln rho the density is exponential.
std::vector<Vec2> column(double lowest, double highest, double slope, int dimension) {
  constexpr int kSteps = 100;
  const double from = log_density(lowest, dimension), to = log_density(highest, dimension);
  std::vector<Vec2> places = {{0.5, std::exp(from)}};
  for (int k = 1; k <= kSteps; ++k) {
    const double below = places.back().y(), here = std::exp(std::lerp(from, to, 1.0 * k / kSteps));
    const double fall = pressure(below, dimension) - pressure(here, dimension);
    const double logarithm = std::log(below / here);
    const double mean = logarithm > 1e-6 ? (below - here) / logarithm : below;
    places.emplace_back(places.back().x() + fall / (slope * mean), here);
  }
  return places;
}

}  // namespace

std::vector<Vec2> Atmosphere::profile() const {
  const double slope = gravity / temperature;
  const double weight = slope * count / floor;
  // The pressure at the highest centres decides the height.
  double low = std::log(weight) - 300.0, high = std::log(weight) + 30.0;
  std::vector<Vec2> places;
  for (int step = 0; step < 40; ++step) {
    const double middle = 0.5 * (low + high), top = std::exp(middle);
    places = column(top + weight, top, slope, dimension);
    (places.back().x() > height - 0.5 ? low : high) = middle;
  }
  return places;
}

}  // namespace clatter
