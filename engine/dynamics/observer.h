#pragma once

#include <array>
#include <cstdint>

#include "engine/laws/model.h"
#include "engine/physics/collision.h"
#include "engine/physics/flight.h"
#include "engine/physics/grain.h"
#include "engine/physics/spin.h"
#include "engine/vec.h"

namespace clatter {

/// State of one particle before an event, and its gain in the event. In a sheared box velocities
/// and energies are without the flow.
template <int D>
struct ParticleChange {
  std::uint32_t particle = 0;
  Grain grain;                       ///< what the particle is
  Flight<D> before;                  ///< flight that ends here
  Vec<D> position = Vec<D>::Zero();  ///< centre, in the flight's frame
  Vec<D> velocity = Vec<D>::Zero();  ///< just before
  Spin<D> spin = Spin<D>::Zero();    ///< just before; 0 without spins
  Impulse<D> gain;                   ///< of momentum and of spin

  /// Velocity just after.
  Vec<D> velocity_after() const { return velocity + gain.momentum / grain.mass; }
  /// Gain in kinetic energy, of motion and of spin, without the rounding of a difference of two
  /// squares.
  [[gnu::always_inline]] double energy() const {
    return 0.5 * gain.momentum.dot(gain.momentum / grain.mass + 2.0 * velocity) +
           0.5 * grain.moment_of_inertia() * gain.spin.dot(gain.spin + 2.0 * spin);
  }
};

/// A collision of two particles, the lower number first.
template <int D>
struct PairCollision {
  double time = 0.0;  ///< on the moving base
  std::array<ParticleChange<D>, 2> particles;
  Vec<D> separation = Vec<D>::Zero();  ///< r_0 - r_1 of the periodic images in contact
  bool elasticised = false;            ///< whether the TC model made the collision elastic
  double undissipated = 0.0;           ///< energy that the TC model saved from dissipation
  double shear_rate = 0.0;             ///< of a sheared box, whose flow differs at the two centres

  /// Velocity of the first particle relative to the second, just before.
  Vec<D> approach() const {
    Vec<D> approach = particles[0].velocity - particles[1].velocity;
    approach[0] += shear_rate * separation[1];
    return approach;
  }
  /// Gain in kinetic energy of both, in one frame: minus the energy that the collision dissipates.
  double energy() const {
    return particles[0].energy() + particles[1].energy() +
           shear_rate * separation[1] * particles[0].gain.momentum[0];
  }
};

/// A collision of a particle with a wall of the box, a fixture or the free piston.
template <int D>
struct WallCollision {
  static constexpr int kNoSide = -1;                       ///< in place of a Side: no wall
  static constexpr std::uint32_t kOfPiston = 0xffffffffu;  ///< in place of a fixture: the piston

  double time = 0.0;  ///< on the moving base
  int side = 0;       ///< the Side; kNoSide for a fixture or the piston
  ParticleChange<D> particle;
  Vec<D> normal = Vec<D>::Zero();  ///< unit vector from the wall to the particle
  std::uint32_t fixture = 0;       ///< number of the fixture in the model, or kOfPiston
  Vec<D> point = Vec<D>::Zero();   ///< of a fixture that is touched, at its place in the scene

  bool at_centre = false;  ///< whether the centre is at the contact, as in a valve

  /// Whether it is with a wall of the box.
  bool at_wall() const { return side != kNoSide; }
  /// Whether it is with the free piston.
  bool at_piston() const { return !at_wall() && fixture == kOfPiston; }
  /// From the point of contact to the centre of the particle.
  Vec<D> branch() const {
    return at_centre ? Vec<D>(Vec<D>::Zero()) : Vec<D>(particle.grain.radius * normal);
  }
};

/// A new flight of the free piston: after a hit, at a wall, or because its laws change or all
/// velocities are reversed.
struct PistonChange {
  /// Why the flight before has ended.
  enum class Cause { Particle, Wall, Laws };

  double time = 0.0;              ///< on the moving base
  Cause cause = Cause::Particle;  ///< of the change
  PistonFlight before;            ///< flight that ends here
  PistonFlight after;             ///< flight that begins here
};

/// Cause of a kick. A puff is a nudge of the particles that enter. A reversal is a nudge of all.
enum class KickCause {
  BulkDrive,
  Nudge,
  Passage,  ///< a new flight without any change, because the particle has passed a valve
};

/// A kick of one particle: a sudden change of its motion without a partner. Bulk driving kicks all
/// particles at the same time, and a nudge kicks some; each kick is reported in turn.
template <int D>
struct Kick {
  double time = 0.0;  ///< on the moving base
  ParticleChange<D> particle;
  KickCause cause = KickCause::BulkDrive;
};

/// Receives the events of a run and cannot change the run. A particle's flights follow each other
/// without gaps, so integrals along them are exact.
template <int D>
class Observer {
 public:
  virtual ~Observer() = default;
  /// Two particles have collided. The simulation still holds their flights before the collision.
  virtual void on_collision(const PairCollision<D>&) {}
  /// A particle has hit a wall or a fixture. The simulation still holds its flight before the hit.
  virtual void on_wall(const WallCollision<D>&) {}
  /// A particle has been kicked. The simulation still holds its flight before the kick.
  virtual void on_kick(const Kick<D>&) {}
  /// The free piston has begun a new flight. A hit is reported before, as on_wall().
  virtual void on_piston(const PistonChange&) {}
  /// All times on the moving base have become smaller by `shift`.
  virtual void on_base_moved(double /*shift*/) {}
  /// The laws are about to become `next`, or particles are about to enter under the same laws. The
  /// simulation still has the present laws, particles and flights. If keeps_flights() is false for
  /// the two laws, all flights end now.
  virtual void before_laws(const Model<D>& /*next*/) {}
  /// The simulation has the next laws and particles.
  virtual void on_laws() {}
};

}  // namespace clatter
