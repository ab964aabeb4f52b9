#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/measure/fields.h"
#include "tests/engine/measure/scenes.h"
#include "tests/engine/measure/sums.h"
#include "tests/engine/support/gas.h"
#include "tests/support/dimensions.h"

// The first-moment identities (theory 9.6, 9.7) connect the reported stress, heat flux and
// dissipation with the states of the particles at the two ends of a window. A wrong sign, factor or
// wall branch in one of them violates an identity. Along each walled axis k
//   [sum m r_k v_l] = Dt int (rho_m V_k V_l - sigma_kl) dA + sum_walls r_w,k dp_l + sources
//   [sum r_k E]   = Dt int (q + E V - sigma.V)_k dA + sum_coll (dE_1 + dE_2)/2 (r_1 + r_2)_k
//                   + sum_walls r_w,k dE + sources
// and [sum E] = Dt int zeta dA + walls + sources.

using namespace clatter;
using namespace clatter::testing;

namespace {

/// A sum, and the sum of the magnitudes of its terms.
struct Booked {
  double sum = 0.0;
  double sizes = 0.0;

  void add(double term) {
    sum += term;
    sizes += std::fabs(term);
  }
};

/// Energy of a spin.
template <class AnySpin>
double spin_energy(const Grain& grain, const AnySpin& spin) {
  const double diameter = 2.0 * grain.radius;
  return 0.125 * grain.inertia * grain.mass * diameter * diameter * spin.squaredNorm();
}

/// Contributions of walls, kicks and gravity to the moments, from velocities and not from
/// ParticleChange::energy.
template <int D>
class Sources : public Observer<D> {
 public:
  explicit Sources(const Simulation<D>& simulation)
      : simulation_(simulation), begin_(simulation.base_time()) {}

  Booked momentum[D][D];    ///< [k][l] of sum m r_k v_l
  Booked energy_moment[D];  ///< of sum r_k E
  Booked energy;            ///< of sum E, without the dissipation in collisions of particles

  void on_collision(const PairCollision<D>& c) override {
    for (const ParticleChange<D>& particle : c.particles)
      fall(particle.grain, particle.before, c.time);
    const double gained = energy_gain(c.particles[0]) + energy_gain(c.particles[1]);
    const Vec<D> ends = 2.0 * c.particles[0].position - c.separation;
    for (int k = 0; k < D; ++k) energy_moment[k].add(0.5 * gained * ends[k]);
  }

  void on_wall(const WallCollision<D>& c) override {
    fall(c.particle.grain, c.particle.before, c.time);
    // The present position of the wall's face.
    const double inset = simulation_.wall(c.side).displacement;
    const int axis = c.side / 2;
    Vec<D> contact = c.particle.position;
    contact[axis] = c.side % 2 ? simulation_.model().box[axis] - inset : inset;
    add(c.particle, contact);
  }

  void on_kick(const Kick<D>& kick) override {
    fall(kick.particle.grain, kick.particle.before, kick.time);
    add(kick.particle, kick.particle.position);
  }

  void on_base_moved(double shift) override { begin_ -= shift; }

  void close() {
    for (std::uint32_t i = 0; i < simulation_.particles().size(); ++i) {
      fall(simulation_.grain(i), simulation_.particles()[i].flight, simulation_.base_time());
    }
  }

 private:
  double energy_gain(const ParticleChange<D>& particle) const {
    const double m = particle.grain.mass;
    const Vec<D> after = particle.velocity + particle.gain.momentum / m;
    const Spin<D> w = particle.spin + particle.gain.spin;
    return 0.5 * m * (after.squaredNorm() - particle.velocity.squaredNorm()) +
           spin_energy(particle.grain, w) - spin_energy(particle.grain, particle.spin);
  }

  void add(const ParticleChange<D>& particle, const Vec<D>& place) {
    const double gained = energy_gain(particle);
    energy.add(gained);
    for (int k = 0; k < D; ++k) {
      energy_moment[k].add(place[k] * gained);
      for (int l = 0; l < D; ++l) momentum[k][l].add(place[k] * particle.gain.momentum[l]);
    }
  }

  // Gravity during a flight, by two-point Gauss quadrature: exact for cubics.
  void fall(const Grain& grain, const Flight<D>& flight, double end) {
    const Vec<D>& gravity = simulation_.model().gravity;
    const double begin = std::max(begin_, flight.time);
    if (!(end > begin) || gravity.isZero(0.0)) return;
    for (const double node : {-1.0 / std::sqrt(3.0), 1.0 / std::sqrt(3.0)}) {
      const double time = 0.5 * (begin + end) + 0.5 * node * (end - begin);
      const double weight = 0.5 * grain.mass * (end - begin);
      const Vec<D> r = flight.at(time, gravity);
      const double power = gravity.dot(flight.velocity_at(time, gravity));
      energy.add(weight * power);
      for (int k = 0; k < D; ++k) {
        energy_moment[k].add(weight * r[k] * power);
        for (int l = 0; l < D; ++l) momentum[k][l].add(weight * r[k] * gravity[l]);
      }
    }
  }

  const Simulation<D>& simulation_;
  double begin_;
};

/// The present moments of the particles.
template <int D>
struct Moments {
  Eigen::Matrix<double, D, D> momentum = Eigen::Matrix<double, D, D>::Zero();  ///< sum m r_k v_l
  Vec<D> energy_moment = Vec<D>::Zero();                                       ///< sum r_k E
  double energy = 0.0;

  explicit Moments(const Simulation<D>& simulation) {
    const State<D> state = simulation.state();
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
      const Grain& grain = simulation.grain(static_cast<std::uint32_t>(i));
      const double spun = state.spins.empty() ? 0.0 : spin_energy(grain, state.spins[i]);
      const double e = 0.5 * grain.mass * state.velocities[i].squaredNorm() + spun;
      momentum += grain.mass * state.positions[i] * state.velocities[i].transpose();
      energy_moment += state.positions[i] * e;
      energy += e;
    }
  }
};

/// The moments from the reported fields, cell by cell.
template <int D>
struct Reported {
  Booked momentum[D][D];
  Booked energy_moment[D];
  Booked dissipation;
};

template <int D>
Reported<D> reported(const CellIntegrals<D>& integrals, const CellSums& sums, bool spins) {
  Reported<D> result;
  const double area = integrals.grid().cell_measure();
  const double measure = sums.time * area;
  for (std::size_t i = 0; i < integrals.grid().size(); ++i) {
    const auto cell = averages_of(integrals.layout(), sums, i, area);
    const auto value = [&](Field field) {
      const double number = field_value(field, cell);
      return std::isnan(number) ? 0.0 : number;
    };
    const double density = value(Quantity::Density);
    Vec<D> V, q;
    Eigen::Matrix<double, D, D> sigma;
    for (int k = 0; k < D; ++k) {
      V[k] = value(Field(Quantity::Velocity, k));
      q[k] = value(Field(Quantity::HeatFlux, k));
      sigma(k, k) = value(Field(Quantity::Stress, k, k));
      // The transfer by rough particles and thermal walls is asymmetric: xy and yx differ, and only
      // xy is reported.
      for (int l = k + 1; l < D; ++l) {
        sigma(k, l) = value(Field(Quantity::Stress, k, l));
        sigma(l, k) = sigma(k, l) + cell.transfer[k][l] - cell.transfer[l][k];
      }
    }
    const double spin_energy = spins ? 0.5 * kSpinSize<D> * value(Quantity::SpinTemperature) : 0.0;
    const double E = density * (0.5 * D * value(Quantity::Temperature) + spin_energy) +
                     0.5 * cell.mass_density * V.squaredNorm();
    const Vec<D> flux = q + E * V - sigma * V;
    for (int k = 0; k < D; ++k) {
      result.energy_moment[k].add(measure * flux[k]);
      for (int l = 0; l < D; ++l) {
        result.momentum[k][l].add(measure * (cell.mass_density * V[k] * V[l] - sigma(k, l)));
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

template <int D>
void check_identities(const Model<D>& model, const State<D>& start) {
  CAPTURE(D);
  constexpr double kResidual = 1e-10;
  Simulation<D> simulation(model, start);
  simulation.run_until(2.345);
  const std::vector<Field> all = all_fields(D);
  CellIntegrals<D> integrals(simulation, IntVec<3>(7, 5, 3).head<D>(),
                             moment_layout<D>(all, model.spins, simulation.is_mixture()));
  Sources<D> sources(simulation);
  simulation.add_observer(integrals);
  simulation.add_observer(sources);
  const Moments<D> before(simulation);
  simulation.run_until(22.3);
  const Moments<D> after(simulation);
  sources.close();
  const Reported<D> fields = reported(integrals, integrals.close_window(), model.spins);
  REQUIRE(simulation.counts().pair_collisions > 200);
  CHECK(residual(after.energy - before.energy, {fields.dissipation, sources.energy}) < kResidual);
  for (int k = 0; k < D; ++k) {
    if (model.periodic(k)) continue;
    CAPTURE(k);
    for (int l = 0; l < D; ++l) {
      CAPTURE(l);
      CHECK(residual(after.momentum(k, l) - before.momentum(k, l),
                     {fields.momentum[k][l], sources.momentum[k][l]}) < kResidual);
    }
    CHECK(residual(after.energy_moment[k] - before.energy_moment[k],
                   {fields.energy_moment[k], sources.energy_moment[k]}) < kResidual);
  }
}

// Particles that are alike, and a mixture of three species.
template <int D>
void check_identities(const Scene& scene, std::uint64_t seed) {
  const Model<D> model = model_of<D>(scene, seed);
  const State<D> start = start_state<D>(scene, seed);
  check_identities<D>(model, start);
  Model<D> mixture = with_species(model);
  mixture.contact_time = 0.01;  // one species may come to rest on a wall
  check_identities<D>(mixture, mixed(model, start, 1.5));
}

/// A periodic box.
template <int D>
Scene periodic() {
  Scene scene = default_scene(D);
  scene.box = Vec<3>(D == 2 ? 9.0 : 5.0, D == 2 ? 7.0 : 4.5, 4.0).head<D>();
  scene.particles.count = 25;
  scene.particles.restitution = 0.85;
  return scene;
}

/// Walls on all sides. The walls along z equal the walls along x.
template <int D>
Scene boxed(const Wall& along_x, const Wall& along_y) {
  Scene scene = periodic<D>();
  wall_in(scene, 0, along_x);
  wall_in(scene, 1, along_y);
  if (D == 3) wall_in(scene, 2, along_x);
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

const Wall kDrivenSide = {.kind = WallKind::Driven, .restitution = 0.9, .drive_speed = 1.2};
const Wall kLossySide = {.kind = WallKind::Static, .restitution = 0.8};
const Wall kThermalSide = {.kind = WallKind::Thermal, .temperature = 1.5};
const Wall kSawtoothSide = {
    .kind = WallKind::Sawtooth, .stroke = 0.4, .frequency = 1.7, .phase = 0.2};
const Wall kSinusoidalSide = {
    .kind = WallKind::Sinusoidal, .restitution = 0.95, .stroke = 0.6, .frequency = 0.9};

}  // namespace

TEST_CASE_TEMPLATE("First moments of the fields: smooth particles between driven and lossy walls",
                   Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  check_identities<D>(boxed<D>(kDrivenSide, kLossySide), 81);
}

TEST_CASE_TEMPLATE("First moments of the fields: periodic axes beside a walled one", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  for (int axis = 0; axis < D; ++axis) {
    Scene scene = periodic<D>();
    wall_in(scene, axis, kDrivenSide);
    check_identities<D>(scene, 82);
    check_identities<D>(with_spins(scene), 83);
  }
}

TEST_CASE_TEMPLATE("First moments of the fields: bulk driving", Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  Scene scene = boxed<D>(kLossySide, kLossySide);
  scene.bulk_drive = {.interval = 0.13, .kick_speed = 0.3};
  check_identities<D>(scene, 86);
}

TEST_CASE_TEMPLATE("First moments of the fields: walls that move, and thermal walls", Dimension,
                   Plane, Space) {
  constexpr int D = Dimension::value;
  check_identities<D>(boxed<D>(kThermalSide, kThermalSide), 88);
  check_identities<D>(boxed<D>(kSawtoothSide, kSinusoidalSide), 90);
  check_identities<D>(boxed<D>(kSinusoidalSide, kSawtoothSide), 91);
}

TEST_CASE_TEMPLATE("First moments of the fields: everything at once", Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  Scene scene = with_spins(boxed<D>(kSawtoothSide, kSinusoidalSide));
  scene.walls[kRight] = kThermalSide;
  scene.walls[kTop] = kDrivenSide;
  scene.gravity = Vec<3>(-0.2, -0.5, 0.3).head<D>();
  scene.bulk_drive = {.interval = 0.31, .kick_speed = 0.2, .kick_spin = 0.2};
  scene.contact_time = 0.01;
  check_identities<D>(scene, 92);
}
