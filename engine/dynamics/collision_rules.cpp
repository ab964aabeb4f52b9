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
static Departure<D> emitted(const Model<D>& model, int side, const WallState& wall,
                            const Arrival<D>& arrival) {
  const Grain& grain = arrival.grain;
  const double temperature = model.wall(side, grain.species).temperature;
  Random random(model.seed, Stream::ThermalWall, arrival.particle, arrival.flight);
  const double uniform = random.uniform();
  std::array<double, D - 1> normals;
  for (double& normal : normals) normal = random.normal();
  Departure<D> departure;
  departure.velocity = emit<D>(side / 2, Boundary<D>::inward(side), temperature / grain.mass,
                               uniform, normals.data());
  departure.velocity[side / 2] += Boundary<D>::inward(side) * wall.velocity;
  if (model.spins) {
    std::array<double, Spin<D>::SizeAtCompileTime> spin_normals;
    for (double& normal : spin_normals) normal = random.normal();
    departure.spin = emit_spin<D>(temperature, grain, spin_normals.data());
  }
  return departure;
}

// Least speed at which a particle leaves a wall under the TC model. A particle at rest on the wall,
// or at a wall with restitution 0, has no normal velocity to reflect: its contact would repeat at
// one time without end. With this speed it stays away for half of t_c, or for half of an inverse
// angular frequency of a sinusoidal wall if that is shorter.
template <int D>
static double least_rebound(const Model<D>& model, int side, const Wall& spec,
                            const WallState& wall, double approach) {
  const double rounding = kApproachRounding * (approach + 2.0 * std::fabs(wall.velocity));
  if (spec.restitution > 0.0 && approach > rounding) return 0.0;
  const double pressing = wall.acceleration - Boundary<D>::inward(side) * model.gravity[side / 2];
  double away = 0.5 * *model.contact_time;
  if (spec.kind == WallKind::Sinusoidal && spec.frequency > 0.0) {
    away = std::min(away, 0.5 / (2.0 * std::numbers::pi * spec.frequency));
  }
  return std::max(0.0, 0.5 * pressing * away);
}

template <int D>
Departure<D> wall_outcome(const Model<D>& model, int side, const WallState& wall,
                          const Arrival<D>& arrival, bool elastic) {
  const Wall& spec = model.wall(side, arrival.grain.species);
  if (spec.kind == WallKind::Thermal) return emitted<D>(model, side, wall, arrival);
  const int axis = side / 2;
  const double inward = Boundary<D>::inward(side);
  ContactLaw law = PairLaw{spec.restitution, spec.roughness}.contact();
  if (elastic) law = {.restitution = std::max(law.restitution, 1.0)};
  Departure<D> departure;
  departure.velocity = spec.moves() ? reflect_moving<D>(arrival.velocity, axis, inward,
                                                        law.restitution, wall.velocity)
                                    : reflect<D>(arrival.velocity, axis, inward, law.restitution,
                                                 spec.drive_speed, wall.velocity);
  if (elastic) {
    const double approach = std::fabs(inward * arrival.velocity[axis] - wall.velocity);
    const double least = wall.velocity + least_rebound<D>(model, side, spec, wall, approach);
    departure.velocity[axis] = inward * std::max(inward * departure.velocity[axis], least);
  }
  const MotionChange<D> friction = wall_friction<D>(arrival.velocity, departure.velocity,
                                                    arrival.spin, axis, inward, law, arrival.grain);
  departure.velocity += friction.velocity;
  departure.spin = arrival.spin + friction.spin;
  return departure;
}

template PairOutcome<2> pair_outcome<2>(const ContactLaw&, const Partners&, const Vec<2>&,
                                        const Vec<2>&, const Spin<2>&, bool);
template PairOutcome<3> pair_outcome<3>(const ContactLaw&, const Partners&, const Vec<3>&,
                                        const Vec<3>&, const Spin<3>&, bool);
template Departure<2> wall_outcome<2>(const Model<2>&, int, const WallState&, const Arrival<2>&,
                                      bool);
template Departure<3> wall_outcome<3>(const Model<3>&, int, const WallState&, const Arrival<3>&,
                                      bool);

}  // namespace clatter
