#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/measure/profile.h"
#include "engine/publish/collision_lookahead.h"
#include "engine/publish/live_profile.h"
#include "engine/publish/snapshot.h"

namespace clatter {

/// Sums since a run's start: the difference between two frames tells what happened between them,
/// however many frames were left out.
struct Tally {
  double time = 0.0;              ///< that the sums stand for
  VecX temperature_integral;      ///< of T_x, T_y and, of spheres, T_z over time
  double walls_in = 0.0;          ///< energy that the walls gave
  double bulk_in = 0.0;           ///< energy that kicks gave
  double gravity_in = 0.0;        ///< work of gravity
  double dissipated = 0.0;        ///< energy lost between particles, > 0
  double undissipated = 0.0;      ///< what they would have lost more without t_c
  std::uint64_t collisions = 0;   ///< of particles with particles
  std::uint64_t elasticised = 0;  ///< of these, by t_c
};

/// The error that t_c makes: what it took away, over what happened.
struct ContactTimeError {
  double undissipated = 0.0;  ///< share of the energy that collisions of particles dissipated
  double elasticised = 0.0;   ///< share of these collisions
};

/// What the engine's thread tells at one time: the gas, and how its run goes.
struct Frame {
  std::uint64_t run = 0;      ///< how many runs have been opened; 0: none yet, nothing else holds
  std::uint64_t handled = 0;  ///< how many commands have been done, or refused
  Snapshot snapshot;
  Tally tally;
  std::shared_ptr<const Scene> scene;  ///< with the laws in force, and all changes
  std::shared_ptr<const Scene>
      started;                     ///< as the run was started; a start state may be in no file
  std::optional<Profile> profile;  ///< since it was asked for, or laws, averages or trails changed;
                                   ///< absent: not asked for
  std::optional<ResidualProfile> residuals;         ///< likewise
  std::optional<ParticleCollision> last_collision;  ///< of the picked particle, since it was picked
  std::optional<ParticleCollision> next_collision;  ///< likewise, as far as it has been looked for
  std::uint64_t seed = 1;
  bool plays = false;
  double speed = 1.0;              ///< asked for, simulation time per second
  double held = 1.0;               ///< share of the speed that the engine holds, at most 1
  double events_per_second = 0.0;  ///< collisions, real time
  std::optional<ContactTimeError> contact_time_error;  ///< since laws last changed; absent: no t_c,
                                                       ///< or nothing dissipated
  double ledger_residual = 0.0;                        ///< see Totals, since then
  double deepest_overlap = 0.0;                        ///< see RunChecks
  std::optional<std::uint64_t> state_hash;             ///< where the run halts
  std::optional<std::array<std::uint32_t, 2>> partners;  ///< of a collision just stepped to
  std::string message;         ///< the last thing to tell: what was refused, why the run stopped
  std::uint64_t messages = 0;  ///< how many there were
};

}  // namespace clatter
