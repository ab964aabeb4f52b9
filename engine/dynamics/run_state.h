#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "engine/dynamics/clock.h"
#include "engine/dynamics/watchdog.h"
#include "engine/laws/acts.h"
#include "engine/physics/flight.h"
#include "engine/physics/grain.h"
#include "engine/physics/spin.h"
#include "engine/physics/wall_motion.h"

namespace clatter {

/// A number of events that no run reaches.
inline constexpr std::uint64_t kNoLimit = ~std::uint64_t{0};

/// Number of events of each kind since the start.
struct EventCounts {
  std::uint64_t pair_collisions = 0;
  std::uint64_t wall_collisions = 0;
  std::uint64_t kicks = 0;             ///< of bulk driving, each of all particles
  std::uint64_t nudges = 0;            ///< of the scene's changes, and reversals
  std::uint64_t strokes = 0;           ///< of the piston, by the scene's changes
  std::uint64_t puffs = 0;             ///< of the scene's changes
  std::uint64_t law_changes = 0;       ///< of the scene's changes that are no acts; steps of ramps
  std::uint64_t elasticised = 0;       ///< pair collisions that the TC model made elastic
  std::uint64_t elasticised_wall = 0;  ///< collisions with walls that the TC model made elastic
  /// Exits of particles from their cells or, with NeighbourLists, from their regions; passages of
  /// valves; and hits of the free piston on walls, and its moves to another zone.
  std::uint64_t cell_crossings = 0;
  std::uint64_t stale = 0;  ///< predictions whose partner collided with another particle before

  /// Collisions with particles and with walls.
  std::uint64_t collisions() const { return pair_collisions + wall_collisions; }
  /// Steps of the scene's changes, see Schedule.
  std::uint64_t changes() const { return nudges + strokes + puffs + law_changes; }
  /// All events that the loop processes.
  std::uint64_t steps() const { return collisions() + kicks + cell_crossings + stale; }
};

/// Extremes of the checks that a run makes at every event.
struct RunChecks {
  /// Deepest overlap at contact of two particles, or of a particle and a wall, as a share of the
  /// diameter.
  double deepest_overlap = 0.0;
  /// Largest time by which an event was earlier than the event processed before it. It is 0 except
  /// for rounding: a move of the base may exchange simultaneous events.
  double clock_steps_back = 0.0;
};

/// State of a run between two events. With the model it determines the future of the run. A run may
/// also continue from it under other laws.
template <int D>
struct RunState {
  Vec<D> gravity = Vec<D>::Zero();  ///< of the flights
  /// Motions of the walls during the flights, as their laws describe them.
  std::array<WallMotion, 2 * D> wall_motions;
  /// Added to the phases of these motions, in periods: the result of changes of frequency.
  std::array<double, 2 * D> phase_shifts = {};
  std::optional<double> shear_rate;  ///< of the flights; absent: the box is not sheared
  /// Added to the offset of a sheared box, in lengths of the box: the result of changes of the
  /// rate.
  double shear_phase = 0.0;
  std::optional<PistonStroke> piston;   ///< its last stroke, at simulation times; absent: none yet
  std::optional<PistonFlight> free_piston;  ///< absent: none
  LongTime base;                            ///< simulation time of the moving base
  double now = 0.0;                     ///< on the base
  std::vector<Flight<D>> flights;       ///< [N] in original order
  std::vector<Grain> grains;            ///< [N], or empty: all are Model::grain()
  std::vector<Spin<D>> spins;           ///< [N], or empty: all 0
  std::vector<double> last_collisions;  ///< [N] times on the base, or empty: none yet
  std::vector<Vec<D>> remainders;       ///< [N] exact positions - flights.r, or empty: all 0
  std::uint64_t until_base_moves = 0;   ///< physical events left
  double mean_collision_time = 0.0;     ///< of a particle, see Watchdog; 0: not known
  std::optional<WatchdogState> watchdog;  ///< absent: it begins anew, as under other laws
  /// Of the fastest particle at the start, or after a nudge or puff, or of a stroke of the piston.
  double start_speed = 0.0;
  double kick_interval = 0.0;  ///< of bulk driving; 0: none
  double kick_origin = 0.0;    ///< simulation time from which kicks are counted
  std::uint64_t kicks_since_origin = 0;
  std::uint32_t era = 0;  ///< see ParticleStates
  EventCounts counts;
  RunChecks checks;
};

/// Whether a run can have this state: numbers are finite, lists have the same length, no flight
/// begins later than now, and no kick is overdue.
template <int D>
bool makes_sense(const RunState<D>& state);

/// A run of disks or of spheres.
using AnyRunState = std::variant<RunState<2>, RunState<3>>;

// The functions below list the members that checkpoints keep, see engine/checkpoint/archive.h.

/// Visits the counts that the run determines, in order. The others depend on cells and tiles.
template <class Archive>
void visit(Archive& io, EventCounts& counts) {
  auto& [pair_collisions, wall_collisions, kicks, nudges, strokes, puffs, law_changes, elasticised,
         elasticised_wall, cell_crossings, stale] = counts;
  io(pair_collisions, wall_collisions, kicks, nudges, strokes, puffs, law_changes, elasticised,
     elasticised_wall);
}

/// Visits all members, in order.
template <class Archive>
void visit(Archive& io, RunChecks& checks) {
  auto& [deepest_overlap, clock_steps_back] = checks;
  io(deepest_overlap, clock_steps_back);
}

/// Visits both parts, so that nothing is rounded.
template <class Archive>
void visit(Archive& io, LongTime& time) {
  auto& [high, low] = time;
  io(high, low);
}

/// Visits all members, in order. The path is stored as a flag: whether it is a saw-tooth.
template <class Archive>
void visit(Archive& io, WallMotion& motion) {
  auto& [path, stroke, frequency, phase] = motion;
  bool ramps = path == WallPath::Sawtooth;
  io(ramps, stroke, frequency, phase);
  path = ramps ? WallPath::Sawtooth : WallPath::Sinusoidal;
}

/// Visits all members, in order.
template <class Archive>
void visit(Archive& io, PistonStroke& stroke) {
  auto& [from, to, start, end] = stroke;
  io(from, to, start, end);
}

/// Visits all members, in order.
template <class Archive>
void visit(Archive& io, PistonFlight& flight) {
  auto& [place, velocity, acceleration, time] = flight;
  io(place, velocity, acceleration, time);
}

/// Visits all members, in order.
template <class Archive, int D>
void visit(Archive& io, Flight<D>& flight) {
  auto& [r, v, time, number] = flight;
  io(r, v, time, number);
}

/// Visits all members, in order.
template <class Archive>
void visit(Archive& io, Grain& grain) {
  auto& [radius, mass, inertia, species] = grain;
  io(radius, mass, inertia, species);
}

/// Visits all members, in order, and requires that the state makes sense.
template <class Archive, int D>
void visit(Archive& io, RunState<D>& state) {
  auto& [gravity, wall_motions, phase_shifts, shear_rate, shear_phase, piston, free_piston, base,
         now, flights, grains, spins, last_collisions, remainders, until_base_moves,
         mean_collision_time, watchdog, start_speed, kick_interval, kick_origin, kicks_since_origin,
         era, counts, checks] = state;
  io(gravity, wall_motions, phase_shifts, shear_rate, shear_phase, piston, free_piston, base, now,
     flights, grains, spins, last_collisions, remainders, until_base_moves, mean_collision_time,
     watchdog, start_speed, kick_interval, kick_origin, kicks_since_origin, era, counts, checks);
  io.require(makes_sense(state));
}

}  // namespace clatter
