// Free flights, collisions and wall hits.

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "engine/observables/bins.h"
#include "engine/observables/free_flights.h"
#include "engine/physics/theory.h"
#include "tests/engine/observables/observed.h"
#include "tests/support/statistics.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

// Sum of density times width over the bins.
double total(const ResultTable& table) {
  const TableColumn low = column_of(table, "low"), high = column_of(table, "high");
  const TableColumn density = column_of(table, "density");
  double sum = 0.0;
  for (std::size_t bin = 0; bin < low.values.size(); ++bin) {
    sum += density.values[bin] * (high.values[bin] - low.values[bin]);
  }
  return sum;
}

// An elastic gas of 500 particles in equilibrium.
template <int D>
Scene elastic_gas() {
  const double side = D == 2 ? std::sqrt(500.0 * std::numbers::pi / (4.0 * 0.05))
                             : std::cbrt(500.0 * std::numbers::pi / 0.3);
  return gas(VecX::Constant(D, side), 500, 1.0);
}

// A gas between walls of unequal temperatures, with gravity.
Scene crooked_gas() {
  Scene scene = gas(9.0, 7.0, 15, 0.9);
  scene.particles.roughness = {.friction = 0.2, .tangential_restitution = 0.5};
  scene.walls[kLeft] = {.kind = WallKind::Thermal, .temperature = 0.5};
  scene.walls[kRight] = {.kind = WallKind::Thermal, .temperature = 4.0};
  wall_in(scene, 1, {.kind = WallKind::Driven, .restitution = 0.8, .drive_speed = 0.7});
  scene.gravity = Vec2(0.3, -0.5);
  scene.bulk_drive = BulkDrive{.interval = 0.9, .kick_speed = 0.1};
  return scene;
}

}  // namespace

TEST_CASE("Log bins: every number is between the edges of its bin") {
  for (double number = 1e-19; number < 4e9; number *= 1.0173) {
    CAPTURE(number);
    const std::size_t bin = LogBins::of(number);
    CHECK(LogBins::edge(bin) <= number);
    CHECK(number < LogBins::edge(bin + 1));
  }
  for (std::size_t bin = 0; bin < LogBins::kCount; ++bin) {
    REQUIRE(LogBins::of(LogBins::edge(bin)) == bin);
  }
  for (const double small : {0.0, 5e-324, 1e-300, 5e-20}) CHECK(LogBins::of(small) == 0);
  for (const double large : {4.3e9, 1e308, HUGE_VAL}) {
    CHECK(LogBins::of(large) == LogBins::kCount - 1);
  }
}

// Against the sum of many chords.
TEST_CASE("Free flights: the length of a parabola") {
  const auto by_chords = [](const Vec2& v, const Vec2& g, double duration) {
    constexpr int kChords = 20'000;
    double sum = 0.0;
    for (int k = 0; k < kChords; ++k) {
      const double middle = (k + 0.5) * duration / kChords;
      sum += (v + g * middle).norm() * duration / kChords;
    }
    return sum;
  };
  for (const Vec2& v : {Vec2(1.0, 2.0), Vec2(-0.3, 0.01), Vec2(0.0, 1.0), Vec2(0.0, 0.0)}) {
    for (const double g : {0.0, 1e-7, 1e-3, 0.5, 30.0}) {
      CAPTURE(v);
      CAPTURE(g);
      const Vec2 acceleration(0.0, -g);
      CHECK(arc_length<2>(v, acceleration, 3.0) ==
            doctest::Approx(by_chords(v, acceleration, 3.0)).epsilon(1e-8));
    }
  }
}

// A particle between elastic walls and a mirror image of it: every path is known.
TEST_CASE("Free flights: paths are counted from collision to collision, around walls") {
  // Two disks bounce head-on in the middle, and then off the walls: they meet every
  // 2 (4.5 - 0.5 - 0.5) = 7 time units at speed 1.
  Scene scene = gas(9.0, 5.0, 2, 1.0);
  wall_in(scene, 0, {});
  wall_in(scene, 1, {});
  Model<2> model = model_of<2>(scene, 1);
  Simulation<2> simulation(model, {{{2.5, 2.5}, {6.5, 2.5}}, {{1.0, 0.0}, {-1.0, 0.0}}});
  Measure measure;
  measure.burn_in = 0.0;
  measure.observables = {ObservableKind::FreeFlights};
  constexpr double kEnd = 1000.0;
  Measurement<2> measurement(simulation, measure, kEnd);
  simulation.run_until(kEnd);
  const Measured measured = measurement.result();
  CHECK(mean_of(measured, "free_flights.mean_time").mean == doctest::Approx(7.0).epsilon(1e-12));
  CHECK(mean_of(measured, "free_flights.mean_path").mean == doctest::Approx(7.0).epsilon(1e-12));
  for (const char* name : {"free_flights.time", "free_flights.path"}) {
    const ResultTable table = table_of(measured, name);
    REQUIRE(column_of(table, "low").values.size() == 1);
    CHECK(column_of(table, "low").values[0] <= 7.0);
    CHECK(column_of(table, "high").values[0] > 7.0);
    CHECK(total(table) == doctest::Approx(1.0).epsilon(1e-12));
  }
}

// The mean free path of a dilute gas is 1/(sqrt(2) rho S_1 chi), with the cross section S_1 = 2 of
// disks and pi of spheres; the mean free time is 1/omega_E (Chapman & Cowling 1970, section 5.21,
// with chi). Sample: 10^5 flights. Relative standard errors below 0.5 %.
TEST_CASE_TEMPLATE("Free flights: means of a dilute gas are those of kinetic theory", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  const Scene scene = elastic_gas<D>();
  const Measured measured = observed<D>(scene, {}, ObservableKind::FreeFlights, 1500.0, 4);
  const double phi = scene.packing_fraction();
  const double cross_section = D == 2 ? 2.0 : std::numbers::pi;
  const double path = 1.0 / (std::sqrt(2.0) * 500.0 / scene.box.prod() * cross_section *
                             contact_correlation(phi, D));
  const Estimate mean_path = mean_of(measured, "free_flights.mean_path");
  const Estimate mean_time = mean_of(measured, "free_flights.mean_time");
  CHECK(mean_path.standard_error < 0.005 * mean_path.mean);
  CHECK(errors_off(mean_path, path) < 5.0);
  CHECK(errors_off(mean_time, 1.0 / enskog_rate(phi, 1.0, D)) < 5.0);
  CHECK(total(table_of(measured, "free_flights.time")) == doctest::Approx(1.0));
  CHECK(total(table_of(measured, "free_flights.path")) == doctest::Approx(1.0));
}

// The impact parameter b of independent particles is uniform in disks and has the density 2 b in
// spheres. The mean normal speed at impact is sqrt(pi T/m), because its flux-weighted density is
// g exp(-g^2/4)/2 at T = 1. The tangential speed is the length of a Gaussian of variance 2 in D - 1
// dimensions: 2/sqrt(pi) and sqrt(pi). T is corrected for the conserved momentum. Bins of b hold
// above 1000 collisions; chi^2 over 50 bins.
TEST_CASE_TEMPLATE("Collisions: impact parameters and speeds of an elastic gas", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  const Measured measured =
      observed<D>(elastic_gas<D>(), {}, ObservableKind::Collisions, D == 2 ? 1000.0 : 800.0, 5);
  const auto count = static_cast<double>(measured.pair_collisions);
  const ResultTable table = table_of(measured, "collisions.impact_parameter");
  const TableColumn density = column_of(table, "density");
  std::vector<double> found, expected;
  for (int bin = 0; bin < 50; ++bin) {
    const double low = bin / 50.0, high = (bin + 1) / 50.0;
    found.push_back(density.values[static_cast<std::size_t>(bin)] * count / 50.0);
    expected.push_back(count * (D == 2 ? high - low : high * high - low * low));
    CHECK(column_of(table, "low").values[static_cast<std::size_t>(bin)] == doctest::Approx(low));
    CHECK(column_of(table, "high").values[static_cast<std::size_t>(bin)] == doctest::Approx(high));
  }
  CHECK(count > 5e4);
  CHECK(counts_p(found, expected) > kMinProbability);
  CHECK(errors_off(mean_of(measured, "collisions.mean_impact_parameter"), D == 2 ? 0.5 : 2.0 / 3) <
        5.0);
  CHECK(errors_off(mean_of(measured, "collisions.mean_normal_speed"), std::sqrt(std::numbers::pi)) <
        5.0);
  CHECK(errors_off(mean_of(measured, "collisions.mean_tangential_speed"),
                   D == 2 ? 2.0 / std::sqrt(std::numbers::pi) : std::sqrt(std::numbers::pi)) < 5.0);
  CHECK_THROWS(mean_of(measured, "collisions.mean_energy_loss"));
  CHECK_THROWS(mean_of(measured, "collisions.sliding_share"));
}

TEST_CASE("Collisions: the energy losses add up to the dissipation") {
  const Measured measured = observed<2>(crooked_gas(), {}, ObservableKind::Collisions, 300.0, 6);
  const auto count = static_cast<double>(measured.pair_collisions);
  CHECK(count > 1000.0);
  CHECK(mean_of(measured, "collisions.mean_energy_loss").mean * count ==
        doctest::Approx(measured.dissipated.mean * measured.duration).epsilon(1e-12));
  const ResultTable losses = table_of(measured, "collisions.energy_loss");
  const TableColumn low = column_of(losses, "low"), high = column_of(losses, "high");
  const TableColumn density = column_of(losses, "density");
  double least = 0.0, most = 0.0;
  for (std::size_t bin = 0; bin < low.values.size(); ++bin) {
    const double share = density.values[bin] * (high.values[bin] - low.values[bin]);
    least += share * low.values[bin];
    most += share * high.values[bin];
  }
  CHECK(least < measured.dissipated.mean * measured.duration / count);
  CHECK(most > measured.dissipated.mean * measured.duration / count);
  const double sliding = mean_of(measured, "collisions.sliding_share").mean;
  CHECK(sliding > 0.2);
  CHECK(sliding < 0.9);
}

// Contacts with slip at the Coulomb limit. The tangential impulse of sticking contacts does not
// depend on friction, so a large friction leaves only sticking ones.
TEST_CASE("Collisions: all contacts slide at low friction, and none at high friction") {
  const auto share = [](double friction) {
    Scene scene = crooked_gas();
    scene.particles.roughness.friction = friction;
    return mean_of(observed<2>(scene, {}, ObservableKind::Collisions, 50.0, 6),
                   "collisions.sliding_share")
        .mean;
  };
  CHECK(share(1e-6) > 0.999);
  CHECK(share(1e-9) > 0.999);
  CHECK(share(1e6) == 0.0);
}

// The exchange of motion and spin changes each energy, and their sum by rounding only.
TEST_CASE("Collisions: perfectly rough elastic particles lose no energy") {
  Scene scene = gas(9.0, 7.0, 15, 1.0);
  scene.particles.roughness = {.friction = std::numeric_limits<double>::infinity(),
                               .tangential_restitution = 1.0};
  const Measured measured = observed<2>(scene, {}, ObservableKind::Collisions, 50.0, 6);
  CHECK(measured.pair_collisions > 100);
  CHECK_THROWS(table_of(measured, "collisions.energy_loss"));
  CHECK_THROWS(mean_of(measured, "collisions.mean_energy_loss"));
}

// Piled particles touch so gently that rounding makes some of them recede.
TEST_CASE("Collisions: the slowest contacts are in the lowest bins") {
  Scene scene = gas(9.0, 7.0, 15, 0.0);
  wall_in(scene, 1, {.kind = WallKind::Static, .restitution = 0.0});
  scene.gravity = Vec2(0.0, -1.0);
  scene.contact_time = 1e-9;
  Measure measure;
  measure.burn_in = 0.0;
  measure.observables = {ObservableKind::Collisions};
  const auto simulation = simulation_of<2>(scene, 6);
  Measurement<2> measurement(*simulation, measure, 0.01);
  simulation->run_until(4.0, 300'000);
  const ResultTable speeds = table_of(measurement.result(), "collisions.normal_speed");
  CHECK(column_of(speeds, "high").values.back() < 100.0);
}

// The speeds of particles that a thermal wall emits have the mean sqrt(pi T/2) (theory 4.5). The
// means over all walls add up to the power of the walls.
namespace {

// Collisions of two particles whose last collision was with each other.
class Recollisions : public Observer<2> {
 public:
  void on_collision(const PairCollision<2>& collision) override {
    const std::uint32_t first = collision.particles[0].particle;
    const std::uint32_t second = collision.particles[1].particle;
    ++count;
    // From the whole history: neither of the two has collided since their last collision.
    for (auto past = history_.rbegin(); past != history_.rend(); ++past) {
      const auto& [a, b] = *past;
      const bool both = (a == first && b == second) || (a == second && b == first);
      const bool either = a == first || a == second || b == first || b == second;
      if (both) ++repeated;
      if (either) break;
    }
    history_.emplace_back(first, second);
  }
  int count = 0, repeated = 0;

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> history_;
};

}  // namespace

TEST_CASE("Collisions: repeated collisions of a pair are counted") {
  const Scene scene = crooked_gas();
  const Measured measured = observed<2>(scene, {}, ObservableKind::Collisions, 200.0, 7);
  const auto simulation = simulation_of<2>(scene, 7);
  Recollisions recollisions;
  simulation->add_observer(recollisions);
  simulation->run_until(200.0);
  CHECK(recollisions.repeated > 20);
  CHECK(mean_of(measured, "collisions.recollision_share").mean ==
        doctest::Approx(static_cast<double>(recollisions.repeated) / recollisions.count)
            .epsilon(1e-12));
}

TEST_CASE("Wall hits: each wall has its own speeds and energy gains") {
  const Measured measured = observed<2>(crooked_gas(), {}, ObservableKind::WallHits, 2000.0, 7);
  const auto mean_speed = [&](const std::string& name) {
    const ResultTable table = table_of(measured, name);
    const TableColumn low = column_of(table, "low"), high = column_of(table, "high");
    const TableColumn density = column_of(table, "density");
    double sum = 0.0;
    for (std::size_t bin = 0; bin < low.values.size(); ++bin) {
      sum += density.values[bin] * 0.5 *
             (high.values[bin] * high.values[bin] - low.values[bin] * low.values[bin]);
    }
    return sum;
  };
  // Binning changes the mean by less than 1 %, the sample by 1 %.
  CHECK(mean_speed("wall_hits.left.outgoing") ==
        doctest::Approx(std::sqrt(std::numbers::pi * 0.5 / 2.0)).epsilon(0.04));
  CHECK(mean_speed("wall_hits.right.outgoing") ==
        doctest::Approx(std::sqrt(std::numbers::pi * 4.0 / 2.0)).epsilon(0.04));
  for (const std::string wall :
       {"wall_hits.left", "wall_hits.right", "wall_hits.bottom", "wall_hits.top"}) {
    CAPTURE(wall);
    CHECK(mean_speed(wall + ".incoming") ==
          doctest::Approx(mean_of(measured, wall + ".mean_incoming_speed").mean).epsilon(0.01));
  }
  // A driven wall returns alpha_w v + v_dr.
  for (const std::string wall : {"wall_hits.bottom", "wall_hits.top"}) {
    CHECK(mean_speed(wall + ".outgoing") ==
          doctest::Approx(0.8 * mean_of(measured, wall + ".mean_incoming_speed").mean + 0.7)
              .epsilon(0.02));
  }
  // The left wall is colder than the gas and the right wall hotter.
  CHECK(mean_of(measured, "wall_hits.left.mean_energy_gain").mean < 0.0);
  CHECK(mean_of(measured, "wall_hits.right.mean_energy_gain").mean > 0.0);
  // Momentum per hit is the sum of both speeds. This gives the hits, and these the power.
  double power = 0.0;
  for (const auto& [side, length] :
       {std::pair{kLeft, 7.0}, {kRight, 7.0}, {kBottom, 9.0}, {kTop, 9.0}}) {
    const std::string wall = std::string("wall_hits.") + kSideNames[side];
    const double hits = measured.pressure[side]->mean * length /
                        (mean_speed(wall + ".incoming") + mean_speed(wall + ".outgoing"));
    power += hits * mean_of(measured, wall + ".mean_energy_gain").mean;
  }
  CHECK(power == doctest::Approx(measured.walls_in->mean).epsilon(0.02));
  CHECK_THROWS(table_of(measured, "wall_hits.front.incoming"));
}
