#include "engine/dynamics/collision_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/physics/contact.h"
#include "engine/physics/random.h"
#include "engine/physics/walls.h"

namespace clatter {

template <int D>
PairOutcome<D> pair_outcome(const ContactLaw& law, const Partners& partners, const Vec<D>& x,
                            const Vec<D>& v, const Spin<D>& surface, bool elastic) {
  if (!elastic) return {rough_impulse<D>(x, v, surface, law, partners)};
  return {{collision_impulse<D>(x, v, 1.0, partners)},
          true,
          dissipated_energy<D>(x, v, surface, law, partners)};
}

template <int D>
static Departure<D> emitted(const Model<D>& model, const Wall& spec, const Vec<D>& normal,
                            const WallState& wall, const Arrival<D>& arrival) {
  const Grain& grain = arrival.grain;
  Random random(model.seed, Stream::ThermalWall, arrival.particle, arrival.flight);
  const double uniform = random.uniform();
  std::array<double, D - 1> normals;
  for (double& normal : normals) normal = random.normal();
  Departure<D> departure;
  departure.velocity = emit<D>(normal, spec.temperature / grain.mass, uniform, normals.data());
  departure.velocity += wall.velocity * normal + spec.surface<D>();
  if (model.spins) {
    std::array<double, Spin<D>::SizeAtCompileTime> spin_normals;
    for (double& normal : spin_normals) normal = random.normal();
    departure.spin = emit_spin<D>(spec.temperature, grain, spin_normals.data());
  }
  return departure;
}

// Least speed at which a particle leaves a wall under the TC model. A particle at rest on the wall,
// or at a wall with restitution 0, has no normal velocity to reflect: its contact would repeat at
// one time without end. With this speed it stays away for half of t_c, or for half of an inverse
// angular frequency of a sinusoidal wall if that is shorter.
template <int D>
static double least_rebound(const Model<D>& model, const Wall& spec, const Vec<D>& normal,
                            const WallState& wall, double approach) {
  const double rounding = kApproachRounding * (approach + 2.0 * std::fabs(wall.velocity));
  if (spec.restitution > 0.0 && approach > rounding) return 0.0;
  const double pressing = wall.acceleration - normal.dot(model.gravity);
  double away = 0.5 * *model.contact_time;
  if (spec.kind == WallKind::Sinusoidal && spec.frequency > 0.0) {
    away = std::min(away, 0.5 / (2.0 * std::numbers::pi * spec.frequency));
  }
  return std::max(0.0, 0.5 * pressing * away);
}

template <int D>
Departure<D> wall_outcome(const Model<D>& model, const Wall& spec, const Vec<D>& normal,
                          const WallState& wall, const Arrival<D>& arrival, bool elastic) {
  if (spec.kind == WallKind::Thermal) {
    return emitted<D>(model, spec, normal, wall, arrival);
  }
  ContactLaw law = PairLaw{spec.restitution, spec.roughness}.contact();
  if (elastic) law = {.restitution = std::max(law.restitution, 1.0)};
  Departure<D> departure;
  departure.velocity =
      spec.moves()
          ? reflect_moving<D>(arrival.velocity, normal, law.restitution, wall.velocity)
          : reflect<D>(arrival.velocity, normal, law.restitution, spec.drive_speed, wall.velocity);
  if (elastic) {
    const double approach = std::fabs(arrival.velocity.dot(normal) - wall.velocity);
    const double least = wall.velocity + least_rebound<D>(model, spec, normal, wall, approach);
    const double away = departure.velocity.dot(normal);
    if (away < least) departure.velocity = with_normal<D>(departure.velocity, normal, least);
  }
  const MotionChange<D> friction =
      wall_friction<D>(arrival.velocity - spec.surface<D>(), departure.velocity, arrival.spin,
                       normal, law, arrival.grain);
  departure.velocity += friction.velocity;
  departure.spin = arrival.spin + friction.spin;
  return departure;
}

// The piston is rigid: along its surface the wall rule holds, with the impulse of the piston's
// mass.
template <int D>
PistonOutcome<D> piston_outcome(const Model<D>& model, double side, double velocity,
                                const Arrival<D>& arrival, bool elastic) {
  const FreePiston& piston = *model.free_piston;
  const Wall& spec = piston.law_for(arrival.grain.species);
  ContactLaw law = PairLaw{spec.restitution, spec.roughness}.contact();
  if (elastic) law = {.restitution = std::max(law.restitution, 1.0)};
  const Vec<D> normal = side * Vec<D>::Unit(piston.axis);
  const double mass = arrival.grain.mass;
  const double reduced = piston.pinned ? mass : mass / (1.0 + mass / piston.mass);
  const double approach = std::max(0.0, side * velocity - arrival.velocity.dot(normal));
  double away = law.restitution * approach;
  if (elastic) {
    const WallState state{.velocity = side * velocity,
                          .acceleration = side * piston.acceleration()};
    away = std::max(away, least_rebound<D>(model, spec, normal, state, approach));
  }
  const double impulse = approach > 0.0 || elastic ? reduced * (approach + away) : 0.0;
  PistonOutcome<D> outcome;
  outcome.momentum = side * impulse;
  outcome.departure.velocity = arrival.velocity + (impulse / mass) * normal;
  const MotionChange<D> friction = wall_friction<D>(arrival.velocity, outcome.departure.velocity,
                                                    arrival.spin, normal, law, arrival.grain);
  outcome.departure.velocity += friction.velocity;
  outcome.departure.spin = arrival.spin + friction.spin;
  return outcome;
}

template PairOutcome<2> pair_outcome<2>(const ContactLaw&, const Partners&, const Vec<2>&,
                                        const Vec<2>&, const Spin<2>&, bool);
template PairOutcome<3> pair_outcome<3>(const ContactLaw&, const Partners&, const Vec<3>&,
                                        const Vec<3>&, const Spin<3>&, bool);
template Departure<2> wall_outcome<2>(const Model<2>&, const Wall&, const Vec<2>&, const WallState&,
                                      const Arrival<2>&, bool);
template Departure<3> wall_outcome<3>(const Model<3>&, const Wall&, const Vec<3>&, const WallState&,
                                      const Arrival<3>&, bool);

template PistonOutcome<2> piston_outcome(const Model<2>&, double, double, const Arrival<2>&, bool);
template PistonOutcome<3> piston_outcome(const Model<3>&, double, double, const Arrival<3>&, bool);

}  // namespace clatter
