#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "engine/initial/gaussian_velocities.h"
#include "engine/initial/growth.h"
#include "engine/initial/start_state.h"
#include "engine/measure/totals.h"
#include "engine/physics/theory.h"
#include "tests/engine/support/gas.h"
#include "tests/engine/support/models.h"
#include "tests/engine/support/rooms.h"
#include "tests/support/scenes.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

template <int D>
std::vector<Vec<D>> grown(const Room<D>& room, int count, std::uint64_t seed,
                          const StopRequest& pause = {}) {
  Random random(seed, Stream::Placement, 0, 0);
  Growth<D> growth(room, count, random);
  while (!growth.advance(pause)) {
  }
  return growth.take();
}

/// A periodic room in which so many particles have this packing fraction.
template <int D>
Room<D> room_for(int count, double fraction) {
  const double volume = packing_fraction(D, 1.0) * count / fraction;
  return {Vec<D>::Constant(std::pow(volume, 1.0 / D))};
}

template <int D>
void check_apart(const Room<D>& room, int count) {
  CAPTURE(room.box[0]);
  CAPTURE(room.box[1]);
  const auto places = grown(room, count, 61);
  REQUIRE(static_cast<int>(places.size()) == count);
  CHECK(least_distance(room, places) >= room.diameter);
  CHECK(all_inside(room, places));
}

template <int D>
void check_all_walls(const Vec<D>& box, const std::vector<double>& fractions) {
  for (const auto& walled : all_walls<D>()) {
    for (const double fraction : fractions) {
      CAPTURE(walled[0]);
      CAPTURE(walled[D - 1]);
      CAPTURE(fraction);
      const Room<D> room{box, walled};
      const double fits = fraction / packing_fraction(D, 1.0 / box.prod());
      check_apart(room, static_cast<int>(fits));
    }
  }
}

/// p/(n T) of an elastic gas over the time of one collision a particle, after as long a time.
template <int D>
double pressure_ratio(double fraction) {
  constexpr int kCount = 20'000;
  const Room<D> room = room_for<D>(kCount, fraction);
  Model<D> model;
  model.box = room.box;
  Simulation<D> gas(model, {grown(room, kCount, 62), gaussian_velocities<D>(kCount, 1.0, 63)});
  const double time = 1.0 / enskog_rate(fraction, 1.0, D);
  gas.run_until(time);
  Totals<D> totals(gas);
  const Observation<D> observation(gas, totals);
  gas.run_until(2.0 * time);
  const WindowTotals<D> window = totals.close_window();
  return 1.0 + window.virial / (window.duration * D * kCount);
}

}  // namespace

TEST_CASE("Growth: no two particles overlap, and all centres are in the room") {
  check_all_walls<2>({40.0, 31.0}, {0.05, 0.3, 0.54, 0.7});
  check_all_walls<3>({15.0, 11.0, 13.0}, {0.05, 0.2, 0.37, 0.5});
}

TEST_CASE("Growth: no two particles overlap in a narrow room") {
  for (double edge = 1.3; edge < 4.2; edge += 0.2) {
    for (const bool walled : {false, true}) {
      Room<2> flat{{300.0, edge}, {false, walled}};
      check_apart(flat, static_cast<int>(0.4 * flat.box.prod()));
      Room<3> pipe{{60.0, edge, edge}, {true, walled, walled}};
      check_apart(pipe, static_cast<int>(0.2 * pipe.box.prod()));
    }
  }
}

TEST_CASE("Growth: many particles find places in long narrow rooms") {
  check_apart(Room<2>{{20'000.0, 2.0}, {false, true}}, 15'000);
  check_apart(Room<3>{{4000.0, 3.0, 3.0}, {false, true, true}}, 10'000);
  check_apart(Room<3>{{4000.0, 3.0, 3.0}}, 20'000);
}

TEST_CASE("Growth: disks in a channel as wide as they are") {
  check_apart(Room<2>{{300.0, 1.0}, {false, true}}, 100);
}

TEST_CASE("Growth: a few particles in a large room take no memory for its volume") {
  check_apart(Room<2>{{1e6, 1e6}}, 100);
  check_apart(Room<3>{{1e5, 1e5, 1e5}}, 100);
}

TEST_CASE("Growth: the pauses do not change the places, another seed does") {
  const Room<2> room = room_for<2>(2000, 0.5);
  int questions = 0;
  const auto paused = grown(room, 2000, 64, StopRequest([&] { return ++questions % 3 != 0; }));
  CHECK(questions > 10);
  CHECK(paused == grown(room, 2000, 64));
  CHECK(paused != grown(room, 2000, 65));
}

TEST_CASE("Growth: particles without room get no places") {
  CHECK(grown(room_for<2>(500, 0.95), 500, 66).empty());
  CHECK(grown(room_for<3>(500, 0.8), 500, 66).empty());
}

// The pressure over 10,000 collisions scatters by a percent, and 100,000 particles had 0.966 to
// 1.008 times that of equilibrium. The theory is that of Henderson and of Carnahan and Starling, by
// hand.
TEST_CASE("Growth: the pressure after one collision a particle is that of a gas in equilibrium") {
  CHECK(pressure_ratio<2>(0.3) == doctest::Approx(2.0638).epsilon(0.07));
  CHECK(pressure_ratio<2>(0.5) == doctest::Approx(4.125).epsilon(0.07));
  CHECK(pressure_ratio<3>(0.2) == doctest::Approx(2.40625).epsilon(0.07));
  CHECK(pressure_ratio<3>(0.35) == doctest::Approx(5.2057).epsilon(0.07));
}

// The structure factor of long waves is the variance over the mean of the number in a large
// volume: (1 - phi)^3 / (1 + phi + 3/8 phi^2 - phi^3/8) = 0.0792 at 0.5, by hand. The squares of
// 140 amplitudes are exponential, so their mean has an error of 8.5 percent. Their waves are longer
// than 50 diameters. Points without correlation have 1, and insertion of the smaller particles 0.2.
TEST_CASE("Growth: the numbers in large volumes vary as those of a gas in equilibrium") {
  constexpr int kCount = 20'000;
  const Room<2> room = room_for<2>(kCount, 0.5);
  double sum = 0.0;
  int waves = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto places = grown(room, kCount, seed);
    for (int m = 0; m <= 3; ++m) {
      for (int n = m > 0 ? -3 : 1; n <= 3; ++n) {
        if (m * m + n * n > 9) continue;
        std::complex<double> amplitude = 0.0;
        for (const Vec2& r : places) {
          const double phase = 2.0 * std::numbers::pi * (m * r.x() + n * r.y()) / room.box.x();
          amplitude += std::polar(1.0, phase);
        }
        sum += std::norm(amplitude) / kCount;
        ++waves;
      }
    }
  }
  REQUIRE(waves == 140);
  CHECK(sum / waves == doctest::Approx(0.0792).epsilon(5 * 0.085));
}

TEST_CASE("Growth: 20,000 particles grow, and fewer are inserted") {
  const auto places = [](int count, Layout layout) {
    Scene scene = gas(200.0, 200.0, count, 1.0);
    scene.particles.start.layout = layout;
    return start_state<2>(scene, 67).positions;
  };
  CHECK(places(20'000, Layout::Random) != places(20'000, Layout::Insertion));
  CHECK(places(19'999, Layout::Random) == places(19'999, Layout::Insertion));
}
