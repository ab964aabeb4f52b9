#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "app/sweep/studies.h"
#include "engine/physics/theory.h"
#include "tests/support/messages.h"

namespace clatter {

using testing::refusal_of;

namespace {

std::string text_of(const SweepPoint& point, const std::string& key) {
  const auto setting = std::ranges::find(point, key, &Override::key);
  REQUIRE(setting != point.end());
  return setting->value;
}

double number_of(const SweepPoint& point, const std::string& key) {
  return std::stod(text_of(point, key));
}

// The gas of a point of the temperature study. [20, 25] is a box of disks, [20, 8, 8] of spheres.
VibratedGas gas_of(const SweepPoint& point, int dimension) {
  const std::string size = text_of(point, "box.size");
  const std::size_t comma = size.find(',');
  const double side = std::stod(size.substr(comma + 1));
  if (dimension == 3) CHECK(std::stod(size.substr(size.find(',', comma + 1) + 1)) == side);
  return {.count = number_of(point, "particles.count"),
          .length = std::stod(size.substr(1)),
          .wall_size = dimension == 2 ? side : side * side,
          .restitution = number_of(point, "particles.restitution"),
          .drive_speed = 1.0,
          .dimension = dimension};
}

}  // namespace

TEST_CASE("Studies: all points are valid scenes") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    for (const auto& [study, points] :
         {std::pair(temperature_study(dimension), 35), std::pair(rough_study(dimension), 39),
          std::pair(mixture_study(dimension), 14), std::pair(demon_study(dimension), 39),
          std::pair(shear_study(dimension), 18)}) {
      CAPTURE(study.sweep);
      Sweep sweep;
      CHECK(refusal_of([&] {
              sweep = read_sweep(study.sweep, "study.toml");
              check_entries(sweep, find_scene(sweep.scene), study.sweep, "study.toml");
            }) == "");
      CHECK(sweep.points().size() == static_cast<std::size_t>(points));
    }
  }
}

TEST_CASE("Studies: dissipation spans three decades, and each point starts at its temperature") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const Sweep sweep = read_sweep(temperature_study(dimension).sweep, "study.toml");
    double least = 1e9, most = 0.0;
    std::set<std::string> seen;
    for (const SweepPoint& point : sweep.points()) {
      CAPTURE(settings_text(point));
      const VibratedGas gas = gas_of(point, dimension);
      const double dissipation = gas.epsilon_effective() * gas.psi();
      least = std::min(least, dissipation);
      most = std::max(most, dissipation);
      // The drive speed of the gas above is that of the scene.
      std::vector<Override> settings = sweep.set;
      settings.insert(settings.end(), point.begin(), point.end());
      const Scene scene = parse_scene(find_scene(sweep.scene), settings);
      CHECK(scene.dimension() == dimension);
      CHECK(scene.walls[0].value().drive_speed == gas.drive_speed);
      CHECK(number_of(point, "particles.start.temperature") ==
            doctest::Approx(gas.temperature_corrected()).epsilon(1e-5));
      // A small deviation decays by dT/dt = f(T), here of the refined theory. The times are those
      // of the point: samples every two decay times, a burn-in of 20 and a duration of 1000 at
      // least.
      const double start = gas.temperature_corrected(), step = 1e-3 * start;
      const double rate = (gas.temperature_change_refined(start - step) -
                           gas.temperature_change_refined(start + step)) /
                          (2.0 * step);
      CHECK(number_of(point, "measure.series_interval") * rate ==
            doctest::Approx(2.0).epsilon(1e-3));
      CHECK(number_of(point, "measure.burn_in") * rate > 19.9);
      CHECK(number_of(point, "measure.duration") * rate > 1000.0);
      seen.insert(text_of(point, "particles.restitution") + text_of(point, "box.size") +
                  text_of(point, "particles.count"));
    }
    CHECK(most > 1000.0 * least);
    CHECK(seen.size() == 35);
  }
}

}  // namespace clatter
