#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "engine/measure/measurement.h"
#include "engine/measure/species_totals.h"
#include "engine/measure/totals.h"
#include "tests/engine/measure/scenes.h"
#include "tests/support/dimensions.h"

namespace clatter::species_totals {

using namespace testing;

namespace {

constexpr std::size_t kSpecies = 3;  // of mixed_gas

bool close(double a, double b, double scale) {
  return std::fabs(a - b) <= 1e-12 * scale;
}

/// Walls along x and y, gravity, kicks, spins and a t_c.
template <int D>
Model<D> full_model() {
  return with_species(with_contact_time(kicked(everything<D>(), 0.17, 0.1), 0.01));
}

/// What each pair of species loses, from the velocities and spins before and after collisions, and
/// what the walls give each species.
template <int D>
class Witness : public Observer<D> {
 public:
  void on_collision(const PairCollision<D>& collision) override {
    const auto& [a, b] = collision.particles;
    const auto key = std::minmax(a.grain.species, b.grain.species);
    ++counts[key];
    if (collision.elasticised) {
      ++elasticised[key];
    } else {
      lost[key] += energy_before(a) + energy_before(b) - energy_after(a) - energy_after(b);
    }
  }
  void on_wall(const WallCollision<D>& collision) override {
    const ParticleChange<D>& hit = collision.particle;
    walls_in[hit.grain.species] += energy_after(hit) - energy_before(hit);
  }
  void on_kick(const Kick<D>& kick) override {
    bulk_in[kick.particle.grain.species] +=
        energy_after(kick.particle) - energy_before(kick.particle);
  }

  std::map<std::pair<std::uint32_t, std::uint32_t>, double> counts, elasticised, lost;
  std::array<double, kSpecies> walls_in{}, bulk_in{};

 private:
  static double energy(const Grain& grain, const Vec<D>& v, const Spin<D>& spin) {
    return 0.5 * grain.mass * v.squaredNorm() +
           0.5 * grain.inertia * grain.mass * grain.radius * grain.radius * spin.squaredNorm();
  }
  static double energy_before(const ParticleChange<D>& p) {
    return energy(p.grain, p.velocity, p.spin);
  }
  static double energy_after(const ParticleChange<D>& p) {
    return energy(p.grain, p.velocity_after(), p.spin + p.gain.spin);
  }
};

}  // namespace

TEST_CASE_TEMPLATE("Species totals: their sums are the totals", Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const Model<D> model = full_model<D>();
  Simulation<D> simulation(model, mixed_gas(everything<D>(), 24, 91, 2.0));
  Totals<D> totals(simulation);
  SpeciesTotals<D> species(simulation);
  simulation.add_observer(totals);
  simulation.add_observer(species);
  for (int k = 1; k <= 12; ++k) {
    simulation.run_until(2.5 * k);
    const WindowTotals<D> all = totals.close_window();
    const SpeciesTotalsWindow<D> parts = species.close_window();
    REQUIRE(parts.species.size() == kSpecies);
    REQUIRE(parts.pairs.size() == 6);
    CHECK(parts.duration == all.duration);
    Vec<D> temperature = Vec<D>::Zero();
    double spin = 0.0, walls = 0.0, kicks = 0.0;
    for (std::size_t s = 0; s < kSpecies; ++s) {
      const double share = 1.0 / 3.0;
      temperature += share * parts.species[s].temperature;
      spin += share * parts.species[s].spin_temperature;
      walls += parts.species[s].walls_in;
      kicks += parts.species[s].bulk_in;
    }
    double collisions = 0.0, elasticised = 0.0, dissipated = 0.0;
    for (const PairWindow& pair : parts.pairs) {
      collisions += pair.collisions;
      elasticised += pair.elasticised;
      dissipated += pair.dissipated;
    }
    const double turnover = all.dissipated + std::fabs(all.walls_in) + std::fabs(all.bulk_in);
    for (int axis = 0; axis < D; ++axis) {
      CHECK(close(temperature[axis], all.temperature[axis], all.temperature[axis]));
    }
    CHECK(close(spin, all.spin_temperature, all.spin_temperature));
    CHECK(close(walls, all.walls_in, turnover));
    CHECK(close(kicks, all.bulk_in, turnover));
    CHECK(close(dissipated, all.dissipated, turnover));
    CHECK(collisions == all.collisions);
    CHECK(elasticised == all.elasticised);
    CHECK(dissipated > 0.0);
  }
}

TEST_CASE_TEMPLATE("Species totals: every booking goes to its species and its pair", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  const Model<D> model = full_model<D>();
  Simulation<D> simulation(model, mixed_gas(everything<D>(), 24, 92, 2.0));
  SpeciesTotals<D> species(simulation);
  Witness<D> witness;
  simulation.add_observer(species);
  simulation.add_observer(witness);
  simulation.run_until(30.0);
  const SpeciesTotalsWindow<D> window = species.close_window();
  double turnover = 0.0;
  for (const auto& [key, lost] : witness.lost) turnover += lost;
  for (std::uint32_t a = 0; a < kSpecies; ++a) {
    CHECK(std::fabs(window.species[a].walls_in - witness.walls_in[a]) < 1e-10 * turnover);
    CHECK(std::fabs(window.species[a].bulk_in - witness.bulk_in[a]) < 1e-10 * turnover);
    for (std::uint32_t b = a; b < kSpecies; ++b) {
      const PairWindow& pair = window.pairs[pair_index(b, a)];
      REQUIRE(witness.counts[{a, b}] > 10.0);
      CHECK(pair.collisions == witness.counts[{a, b}]);
      CHECK(pair.elasticised == witness.elasticised[{a, b}]);
      CHECK(std::fabs(pair.dissipated - witness.lost[{a, b}]) < 1e-10 * turnover);
    }
  }
}

namespace {

/// Times of all events of a run.
class Times : public EventTimes {
 public:
  void on_kick(const Kick<2>& kick) override { EventTimes::on_wall({kick.time, 0, {}}); }
};

/// Means of m v_k^2 and r_k of each species from `begin` to `end`: of the states of a run without
/// observers, at the two points between successive events at which cubic polynomials have their
/// exact mean (Gauss).
struct BruteForce {
  std::array<Vec2, kSpecies> squares{}, positions{};
  std::array<double, kSpecies> counts{};

  BruteForce(Simulation<2>& simulation, const std::vector<double>& events, double begin,
             double end) {
    squares.fill(Vec2::Zero());
    positions.fill(Vec2::Zero());
    double time = begin;
    const auto add = [&](double until) {
      const double half = 0.5 * (until - time), middle = time + half;
      for (const double place : {-1.0 / std::sqrt(3.0), 1.0 / std::sqrt(3.0)}) {
        simulation.run_until(middle + place * half);
        const State<2> state = simulation.state();
        counts.fill(0.0);
        for (std::size_t i = 0; i < state.positions.size(); ++i) {
          const Grain& grain = state.grains[i];
          counts[grain.species] += 1.0;
          squares[grain.species] += half * grain.mass * state.velocities[i].cwiseAbs2();
          positions[grain.species] += half * state.positions[i];
        }
      }
      time = until;
    };
    for (const double event : events) {
      if (event > begin && event < end) add(event);
    }
    add(end);
    for (std::size_t s = 0; s < kSpecies; ++s) {
      squares[s] /= counts[s] * (end - begin);
      positions[s] /= counts[s] * (end - begin);
    }
  }
};

}  // namespace

TEST_CASE("Species totals: temperatures and mean positions are exact time averages") {
  Scene scene = rough_mixture(24);
  scene.gravity = Vec2(0.3, -0.7);
  scene.bulk_drive = BulkDrive{.interval = 0.7, .kick_speed = 0.2};
  scene.contact_time = 0.01;
  const std::vector<double> ends = {0.4, 12.0, 90.0};
  const auto simulation = run_of(scene, 17, true);
  SpeciesTotals<2> species(*simulation);
  Times times;
  simulation->add_observer(species);
  simulation->add_observer(times);
  std::vector<SpeciesTotalsWindow<2>> windows;
  for (const double end : ends) {
    simulation->run_until(end);
    windows.push_back(species.close_window());
  }
  REQUIRE(times.base_moves >= 1);
  const auto again = run_of(scene, 17, true);
  double begin = 0.0;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    CAPTURE(k);
    const BruteForce expected(*again, times.times, begin, ends[k]);
    for (std::size_t s = 0; s < kSpecies; ++s) {
      CAPTURE(s);
      const SpeciesWindow<2>& one = windows[k].species[s];
      CHECK((one.temperature - expected.squares[s]).norm() < 1e-8 * one.temperature.norm());
      CHECK((one.position - expected.positions[s]).norm() < 1e-8 * one.position.norm());
    }
    begin = ends[k];
  }
}

TEST_CASE("Measurement: the results of species add up to those of the gas") {
  const auto simulation = run_of(everything_in_motion(30), 18, true);
  Measure measure;
  measure.burn_in = 3.0;
  measure.duration = 40.0;
  Measurement<2> measurement(*simulation, measure, 43.0);
  CHECK(measurement.means().species.size() == kSpecies);  // before the averages start
  CHECK(measurement.means().pairs.size() == 6);
  simulation->run_until(43.0);
  const Measured result = measurement.result();
  REQUIRE(result.species.size() == kSpecies);
  REQUIRE(result.pairs.size() == 6);
  double temperature = 0.0, spin = 0.0, walls = 0.0, kicks = 0.0, collisions = 0.0, lost = 0.0;
  double elasticised = 0.0;
  for (const SpeciesMeans& species : result.species) {
    const double share = static_cast<double>(species.count) / 30.0;
    CHECK(species.count == 10);
    temperature += share * species.temperature->mean;
    spin += share * species.spin_temperature->mean;
    walls += species.walls_in->mean;
    kicks += species.bulk_in->mean;
    REQUIRE(species.mean_position[0]);
    CHECK(species.mean_position[0]->mean > 0.5);
    CHECK(species.mean_position[0]->mean < 8.5);
    REQUIRE(species.elasticised_share);
  }
  for (const PairMeans& pair : result.pairs) {
    collisions += pair.collision_rate.mean;
    lost += pair.dissipated.mean;
    for (const SpeciesMeans& species : result.species) {
      const double times = (pair.species[0] == species.name) + (pair.species[1] == species.name);
      elasticised += times * pair.collision_rate.mean * *species.elasticised_share;
    }
  }
  CHECK(temperature == doctest::Approx(result.temperature.mean).epsilon(1e-12));
  CHECK(spin == doctest::Approx(result.spin_temperature->mean).epsilon(1e-12));
  CHECK(std::fabs(walls - result.walls_in->mean) < 1e-12 * lost);
  CHECK(kicks == doctest::Approx(result.bulk_in->mean).epsilon(1e-10));
  CHECK(lost == doctest::Approx(result.dissipated.mean).epsilon(1e-12));
  CHECK(collisions == doctest::Approx(15.0 * result.collision_rate.mean).epsilon(1e-12));
  // Each species has its share of the partners of elasticised collisions.
  CHECK(elasticised ==
        doctest::Approx(2.0 * static_cast<double>(result.elasticised) / 40.0).epsilon(1e-9));
}

TEST_CASE("Measurement: particles that are alike have no results of species") {
  const auto simulation = run_of(rough_mixture(20), 19, false);
  Measure measure;
  measure.burn_in = 0.0;
  Measurement<2> measurement(*simulation, measure, 5.0);
  simulation->run_until(5.0);
  const Measured result = measurement.result();
  CHECK(result.species.empty());
  CHECK(result.pairs.empty());
}

}  // namespace clatter::species_totals
