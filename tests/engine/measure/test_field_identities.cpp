#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/measure/fields.h"
#include "tests/engine/measure/scenes.h"
#include "tests/engine/measure/sums.h"

// The first-moment identities of chapter 4 tie the stress, heat flux and dissipation that are
// reported to the states of the particles at a window's two ends, so that no sign, factor or wall
// branch can be wrong in one and not show. Along each walled axis k
//   [sum r_k v_l] = Dt int (rho V_k V_l - sigma_kl) dA + sum_walls r_w,k dp_l + sources
//   [sum r_k E]   = Dt int (q + E V - sigma.V)_k dA + sum_coll (dE_1 + dE_2)/2 (r_1 + r_2)_k
//                   + sum_walls r_w,k dE + sources
// and [sum E] = Dt int zeta dA + walls + sources.

using namespace clatter;
using namespace clatter::testing;

namespace {

/// A sum and the sum of its terms' sizes.
struct Booked {
  double sum = 0.0;
  double sizes = 0.0;

  void add(double term) {
    sum += term;
    sizes += std::fabs(term);
  }
};

/// What walls, kicks and gravity add to the moments, from velocities and not from
/// ParticleChange::energy.
class Sources : public Observer<2> {
 public:
  explicit Sources(const Simulation<2>& simulation)
      : simulation_(simulation), begin_(simulation.base_time()) {}

  Booked momentum[2][2];    ///< [k][l] of sum r_k v_l
  Booked energy_moment[2];  ///< of sum r_k E
  Booked energy;            ///< of sum E, without what collisions of particles dissipate

  void on_collision(const PairCollision<2>& c) override {
    for (const ParticleChange<2>& particle : c.particles) fall(particle.before, c.time);
    const double gained = energy_gain(c.particles[0]) + energy_gain(c.particles[1]);
    const Vec2 ends = 2.0 * c.particles[0].position - c.separation;
    for (int k = 0; k < 2; ++k) energy_moment[k].add(0.5 * gained * ends[k]);
  }

  void on_wall(const WallCollision<2>& c) override {
    fall(c.particle.before, c.time);
    // The wall's face, where it is now.
    const double inset = simulation_.wall(c.side).displacement;
    const int axis = c.side / 2;
    Vec2 contact = c.particle.position;
    contact[axis] = c.side % 2 ? simulation_.model().box[axis] - inset : inset;
    add(c.particle, contact);
  }

  void on_kick(const Kick<2>& kick) override {
    fall(kick.particle.before, kick.time);
    add(kick.particle, kick.particle.position);
  }

  void on_base_moved(double shift) override { begin_ -= shift; }

  void close() {
    for (const Particle<2>& particle : simulation_.particles())
      fall(particle.flight, simulation_.base_time());
  }

 private:
  double energy_gain(const ParticleChange<2>& particle) const {
    const double inertia = 0.25 * simulation_.model().inertia;
    const Vec2 after = particle.velocity + particle.gain.momentum;
    const double w = particle.spin[0], w_after = w + particle.gain.spin[0];
    return 0.5 * (after.squaredNorm() - particle.velocity.squaredNorm()) +
           0.5 * inertia * (w_after * w_after - w * w);
  }

  void add(const ParticleChange<2>& particle, const Vec2& place) {
    const double gained = energy_gain(particle);
    energy.add(gained);
    for (int k = 0; k < 2; ++k) {
      energy_moment[k].add(place[k] * gained);
      for (int l = 0; l < 2; ++l) momentum[k][l].add(place[k] * particle.gain.momentum[l]);
    }
  }

  // Gravity along a flight, by Gauss quadrature with two points: exact for cubics.
  void fall(const Flight<2>& flight, double end) {
    const Vec2& gravity = simulation_.model().gravity;
    const double begin = std::max(begin_, flight.time);
    if (!(end > begin) || gravity.isZero(0.0)) return;
    for (const double node : {-1.0 / std::sqrt(3.0), 1.0 / std::sqrt(3.0)}) {
      const double time = 0.5 * (begin + end) + 0.5 * node * (end - begin);
      const double weight = 0.5 * (end - begin);
      const Vec2 r = flight.at(time, gravity);
      const double power = gravity.dot(flight.velocity_at(time, gravity));
      energy.add(weight * power);
      for (int k = 0; k < 2; ++k) {
        energy_moment[k].add(weight * r[k] * power);
        for (int l = 0; l < 2; ++l) momentum[k][l].add(weight * r[k] * gravity[l]);
      }
    }
  }

  const Simulation<2>& simulation_;
  double begin_;
};

/// The moments of the particles as they are.
struct State2 {
  Eigen::Matrix2d momentum = Eigen::Matrix2d::Zero();  ///< sum r_k v_l
  Vec2 energy_moment = Vec2::Zero();                   ///< sum r_k E
  double energy = 0.0;

  explicit State2(const Simulation<2>& simulation) {
    const State<2> state = simulation.state();
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      const double w = state.spins.empty() ? 0.0 : state.spins[i][0];
      const double e =
          0.5 * state.velocities[i].squaredNorm() + 0.125 * simulation.model().inertia * w * w;
      momentum += state.positions[i] * state.velocities[i].transpose();
      energy_moment += state.positions[i] * e;
      energy += e;
    }
  }
};

/// Of the fields as they are reported, cell by cell.
struct Reported {
  Booked momentum[2][2];
  Booked energy_moment[2];
  Booked dissipation;
};

Reported reported(const CellIntegrals<2>& integrals, const CellSums& sums, bool spins) {
  Reported result;
  const double area = integrals.grid().cell_measure();
  const double measure = sums.time * area;
  for (std::size_t i = 0; i < integrals.grid().size(); ++i) {
    const auto cell = averages_of(integrals.layout(), sums, i, area);
    const auto value = [&](Field field) {
      const double number = field_value(field, cell);
      return std::isnan(number) ? 0.0 : number;
    };
    const double density = value(Quantity::Density);
    const Vec2 V(value(Field(Quantity::Velocity, 0)), value(Field(Quantity::Velocity, 1)));
    // What rough particles and thermal walls pass on is askew: xy and yx differ, and only xy is
    // reported.
    const double xy = value(Field(Quantity::Stress, 0, 1));
    const double yx = xy + cell.transfer[0][1] - cell.transfer[1][0];
    const Eigen::Matrix2d sigma{{value(Field(Quantity::Stress, 0, 0)), xy},
                                {yx, value(Field(Quantity::Stress, 1, 1))}};
    const Vec2 q(value(Field(Quantity::HeatFlux, 0)), value(Field(Quantity::HeatFlux, 1)));
    const double E = density * (value(Quantity::Temperature) + 0.5 * V.squaredNorm() +
                                (spins ? 0.5 * value(Quantity::SpinTemperature) : 0.0));
    const Vec2 flux = q + E * V - sigma * V;
    for (int k = 0; k < 2; ++k) {
      result.energy_moment[k].add(measure * flux[k]);
      for (int l = 0; l < 2; ++l) {
        result.momentum[k][l].add(measure * (density * V[k] * V[l] - sigma(k, l)));
      }
    }
    result.dissipation.add(measure * value(Quantity::Dissipation));
  }
  return result;
}

double residual(double change, std::initializer_list<Booked> terms) {
  double sum = change, sizes = std::fabs(change);
  for (const Booked& term : terms) {
    sum -= term.sum;
    sizes += term.sizes;
  }
  return sizes > 0.0 ? std::fabs(sum) / sizes : 0.0;
}

void check_identities(const Scene& scene, std::uint64_t seed) {
  constexpr double kResidual = 1e-10;
  const auto simulation = simulation_of(scene, seed);
  simulation->run_until(2.345);
  CellIntegrals<2> integrals(*simulation, {7, 5}, full_layout(scene.spins()));
  Sources sources(*simulation);
  simulation->add_observer(integrals);
  simulation->add_observer(sources);
  const State2 before(*simulation);
  simulation->run_until(22.3);
  const State2 after(*simulation);
  sources.close();
  const Reported fields = reported(integrals, integrals.close_window(), scene.spins());
  REQUIRE(simulation->counts().pair_collisions > 200);
  double worst = residual(after.energy - before.energy, {fields.dissipation, sources.energy});
  CHECK(worst < kResidual);
  for (int k = 0; k < 2; ++k) {
    if (scene.periodic(k)) continue;
    for (int l = 0; l < 2; ++l) {
      CAPTURE(k);
      CAPTURE(l);
      const double off = residual(after.momentum(k, l) - before.momentum(k, l),
                                  {fields.momentum[k][l], sources.momentum[k][l]});
      CHECK(off < kResidual);
      worst = std::max(worst, off);
    }
    const double off = residual(after.energy_moment[k] - before.energy_moment[k],
                                {fields.energy_moment[k], sources.energy_moment[k]});
    CAPTURE(k);
    CHECK(off < kResidual);
    worst = std::max(worst, off);
  }
  MESSAGE("largest residual ", worst);
}

/// Walls all round.
Scene boxed(const Wall& along_x, const Wall& along_y) {
  Scene scene = gas(9.0, 7.0, 25, 0.85);
  wall_in(scene, 0, along_x);
  wall_in(scene, 1, along_y);
  return scene;
}

Scene with_spins(Scene scene) {
  scene.particles.roughness = {.friction = 0.4, .tangential_restitution = 0.6};
  scene.particles.start.spin_temperature = 0.8;
  for (auto& wall : scene.walls) {
    if (wall && wall->kind != WallKind::Thermal) wall->roughness.friction = 0.5;
  }
  return scene;
}

const Wall kDriven = {.kind = WallKind::Driven, .restitution = 0.9, .drive_speed = 1.2};
const Wall kLossy = {.kind = WallKind::Static, .restitution = 0.8};
const Wall kThermal = {.kind = WallKind::Thermal, .temperature = 1.5};
const Wall kSawtooth = {.kind = WallKind::Sawtooth, .stroke = 0.4, .frequency = 1.7, .phase = 0.2};
const Wall kSinusoidal = {
    .kind = WallKind::Sinusoidal, .restitution = 0.95, .stroke = 0.6, .frequency = 0.9};

}  // namespace

TEST_CASE("First moments: they agree for smooth particles between driven and lossy walls") {
  check_identities(boxed(kDriven, kLossy), 81);
}

TEST_CASE("First moments: they agree where an axis is periodic and the other walled") {
  Scene scene = gas(9.0, 6.0, 25, 0.85);
  wall_in(scene, 0, kDriven);
  check_identities(scene, 82);
  scene = gas(9.0, 6.0, 25, 0.85);
  wall_in(scene, 1, kDriven);
  check_identities(with_spins(scene), 83);
}

TEST_CASE("First moments: they agree for rough particles and walls") {
  check_identities(with_spins(boxed(kDriven, kLossy)), 84);
}

TEST_CASE("First moments: they agree under gravity") {
  Scene scene = boxed(kLossy, kDriven);
  scene.gravity = Vec2(0.3, -0.8);
  check_identities(scene, 85);
}

TEST_CASE("First moments: they agree with bulk driving") {
  Scene scene = boxed(kLossy, kLossy);
  scene.bulk_drive = {.interval = 0.13, .kick_speed = 0.3};
  check_identities(scene, 86);
  scene.bulk_drive->kick_spin = 0.5;
  check_identities(with_spins(scene), 87);
}

TEST_CASE("First moments: they agree with thermal walls") {
  check_identities(boxed(kThermal, kThermal), 88);
  check_identities(with_spins(boxed(kThermal, kDriven)), 89);
}

TEST_CASE("First moments: they agree with saw-tooth and sinusoidal walls") {
  check_identities(boxed(kSawtooth, kSinusoidal), 90);
  check_identities(boxed(kSinusoidal, kSawtooth), 91);
}

TEST_CASE("First moments: they agree with everything at once") {
  Scene scene = with_spins(boxed(kSawtooth, kSinusoidal));
  scene.walls[kRight] = kThermal;
  scene.walls[kTop] = kDriven;
  scene.gravity = Vec2(-0.2, -0.5);
  scene.bulk_drive = {.interval = 0.31, .kick_speed = 0.2, .kick_spin = 0.2};
  scene.contact_time = 0.01;
  check_identities(scene, 92);
}
