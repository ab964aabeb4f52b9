#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/live/collision_lookahead.h"
#include "engine/live/live_profile.h"
#include "engine/live/played_stretch.h"
#include "engine/measure/profile.h"
#include "engine/observables/observable.h"
#include "engine/picture/snapshot.h"
#include "engine/run/tally.h"

namespace clatter {

/// Estimate of the error due to t_c: the elasticised share of dissipation and collisions.
struct ContactTimeError {
  double undissipated = 0.0;  ///< energy saved by t_c / energy dissipated between particles
  double elasticised = 0.0;   ///< elasticised share of the collisions between particles
};

/// A message of the engine's thread: the selected gas at one time, and the state of its run.
struct Frame {
  std::size_t gas = 0;   ///< number of the gas
  std::uint64_t id = 0;  ///< of the gas, which keeps it; a copy is another gas
  /// Frames of the other gases at this time, in order of their numbers. They have what concerns one
  /// gas, `run` and `speed`.
  std::vector<Frame> others = {};
  std::uint64_t run = 0;      ///< number of runs opened; 0: none, and all else is undefined
  std::uint64_t handled = 0;  ///< number of commands done or refused
  Snapshot snapshot;
  double head = 0.0;          ///< latest simulation time that the run has reached
  std::vector<double> stops;  ///< times up to `head` at which the run stopped by itself
  std::uint64_t futures = 0;  ///< number of times that another future began
  std::optional<std::array<double, 2>> loop;  ///< the repeated stretch of time; absent: none
  double forked_at = 0.0;                     ///< simulation time at which the last one began
  /// Beginning and end of the future that can be exchanged with the present one; absent: none.
  std::optional<std::array<double, 2>> other_future;
  std::size_t record_bytes = 0;  ///< memory of the states that the run keeps
  Tally tally;
  std::shared_ptr<const Scene> scene;  ///< with the laws of this time, and all changes up to `head`
                                       ///< and planned
  std::shared_ptr<const Scene>
      started;                     ///< at the run's start; its start state may exist in no file
  std::optional<Profile> profile;  ///< since its request, the last change of laws or the last jump
                                   ///< in time; absent: not requested
  std::optional<ResidualProfile> residuals;  ///< as for `profile`
  /// Tables of the scene's observables since the start or the last change of laws; nullptr: the
  /// scene has none, or profiles are not requested.
  std::shared_ptr<const std::vector<ResultTable>> observables;
  std::optional<ParticleCollision> last_collision;  ///< of the picked particle, since it was picked
  std::optional<ParticleCollision> next_collision;  ///< of the picked particle, if found
  /// The last stretches played under Listen, at most kMostStretches, in order.
  std::vector<std::shared_ptr<const PlayedStretch>> played;
  std::optional<double> opening;  ///< completed part of the scene being opened, 0..1; absent: none
  /// Simulation time to which the opened gas goes at once, Open::at; absent: it is there.
  std::optional<double> bound_for;
  std::uint64_t seed = 1;
  bool plays = false;
  bool backwards = false;          ///< whether it plays backwards
  double speed = 1.0;              ///< requested simulation time per second
  double held = 1.0;               ///< share of the speed that the engine reaches, at most 1
  double events_per_second = 0.0;  ///< collisions per second of real time
  std::optional<ContactTimeError> contact_time_error;  ///< since laws last changed; absent: no t_c,
                                                       ///< or nothing dissipated
  double ledger_residual = 0.0;  ///< see Totals; since the start or the last jump in time
  double deepest_overlap = 0.0;  ///< see RunChecks
  std::optional<std::uint64_t> state_hash;               ///< if the run is halted
  std::optional<std::array<std::uint32_t, 2>> partners;  ///< of the collision of StepCollision
  std::string stop;            ///< why the run stopped by itself; empty: it did not
  std::string message;         ///< last message: a refused command, or why the run stopped
  std::uint64_t messages = 0;  ///< number of messages so far
};

/// The frames of all gases, in order of their numbers. They belong to `frame`.
std::vector<const Frame*> frames_of(const Frame& frame);

}  // namespace clatter
