#include "engine/dynamics/run_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "engine/dynamics/boundary.h"
#include "engine/dynamics/event_loop.h"
#include "engine/physics/fraction.h"

namespace clatter {

template <int D>
RunState<D> first_state(const Model<D>& model, State<D> state, double start_time) {
  RunState<D> saved;
  saved.gravity = model.gravity;
  saved.wall_motions = wall_motions<D>(model);
  saved.shear_rate = model.shear_rate;
  saved.base = {start_time, 0.0};
  saved.kick_interval = model.kick_interval();
  saved.kick_origin = start_time;
  saved.until_base_moves = std::max<std::uint64_t>(kMinEventsPerBase, state.positions.size());
  saved.flights.reserve(state.positions.size());
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    saved.flights.push_back({state.positions[i], state.velocities[i], 0.0, 0});
    saved.start_speed = std::max(saved.start_speed, state.velocities[i].norm());
  }
  if (model.free_piston) {
    const FreePiston& piston = *model.free_piston;
    const PistonState start = state.piston.value_or(PistonState{piston.position, piston.speed});
    saved.free_piston = {start.place, piston.pinned ? 0.0 : start.velocity, piston.acceleration(),
                         0.0};
  }
  saved.grains = std::move(state.grains);
  saved.spins = std::move(state.spins);
  state = {};  // frees the memory before the simulation allocates its own
  return saved;
}

// A clock with its base at the time of the state.
template <int D>
static Clock clock_at(const RunState<D>& saved) {
  Clock clock(saved.base);
  clock.advance(saved.now);
  return clock;
}

// Rest is a motion of frequency 0.
template <int D>
std::array<double, 2 * D> phase_shifts(const Model<D>& model, const RunState<D>& saved) {
  const std::array<WallMotion, 2 * D> motions = wall_motions<D>(model);
  std::array<double, 2 * D> shifts = saved.phase_shifts;
  const Clock now = clock_at(saved);
  for (int side = 0; side < 2 * D; ++side) {
    const double before = saved.wall_motions[side].frequency, after = motions[side].frequency;
    if (!model.walls[side] || !model.walls[side]->moves()) {
      shifts[side] = 0.0;
    } else if (before != after) {
      shifts[side] = fraction(shifts[side] + now.periods(before, 0.0) - now.periods(after, 0.0));
    }
  }
  return shifts;
}

// The offset continues at the present one. Rest is a rate of 0.
template <int D>
double shear_phase(const Model<D>& model, const RunState<D>& saved) {
  const auto per_length = [&](const std::optional<double>& rate) {
    return rate.value_or(0.0) * model.box[1] / model.box[0];
  };
  const double before = per_length(saved.shear_rate), after = per_length(model.shear_rate);
  if (before == after) return saved.shear_phase;
  const Clock now = clock_at(saved);
  return fraction(saved.shear_phase + now.periods(before, 0.0) - now.periods(after, 0.0));
}

// Just after the beginning of a period a wall is at its rest position, whatever its stroke.
template <int D>
PhysicalStop overlap_at_start(const Model<D>& model, const RunState<D>& saved, double overlap) {
  constexpr double kJustAfter = 1e-4;  // periods
  const std::string deepest = fmt::format("by {:.3g} diameters", overlap);
  const Clock now = clock_at(saved);
  const double time = now.absolute(0.0);
  std::string changed, remedy = "make a smaller change";
  for (int side = 0; side < 2 * D; ++side) {
    const WallMotion& before = saved.wall_motions[side];
    const WallMotion after = wall_motions<D>(model)[side];
    if (before == after) continue;
    changed += std::string(changed.empty() ? "" : ", ") + "walls." + kSideNames[side];
    if (before.frequency == 0.0 || before.phase != after.phase) continue;
    const double phase = now.periods(before.frequency, before.phase + saved.phase_shifts[side]);
    remedy +=
        fmt::format(", or change walls.{} without a ramp at its rest position, as at t = {:.9g}",
                    kSideNames[side], time + (1.0 + kJustAfter - phase) / before.frequency);
  }
  if (!changed.empty()) {
    return PhysicalStop(
        fmt::format("the change of {} at t = {:.9g} moves a wall into a particle, {}; {}", changed,
                    time, deepest, remedy));
  }
  return PhysicalStop("particles overlap each other or a wall at the start, the deepest " +
                      deepest + "; move them apart");
}

template <int D>
PhysicalStop fixture_in_particle(const Model<D>& model, std::size_t fixture, std::uint32_t particle,
                                 double time) {
  return PhysicalStop(fmt::format(
      "the change at t = {:.9g} puts {} where particle {} is; choose another place or time", time,
      model.fixtures[fixture].name, particle));
}

// Peculiar velocities stay when the shear rate changes.
template <int D>
Flight<D> flight_from_now(const Flight<D>& flight, const Model<D>& model, const RunState<D>& former,
                          double now) {
  Flight<D> next{flight.at(now, former.gravity), flight.velocity_at(now, former.gravity), now,
                 flight.number};
  const double faster = model.shear_rate.value_or(0.0) - former.shear_rate.value_or(0.0);
  if (faster != 0.0) next.v[0] += faster * (next.r[1] - 0.5 * model.box[1]);
  return next;
}

template <int D>
void restart_changed_flights(const Model<D>& model, RunState<D>& saved) {
  if (keeps_flights<D>(saved, model)) return;
  for (Flight<D>& flight : saved.flights) {
    flight = flight_from_now<D>(flight, model, saved, saved.now);
  }
}

template RunState<2> first_state(const Model<2>&, State<2>, double);
template RunState<3> first_state(const Model<3>&, State<3>, double);
template std::array<double, 4> phase_shifts(const Model<2>&, const RunState<2>&);
template std::array<double, 6> phase_shifts(const Model<3>&, const RunState<3>&);
template double shear_phase(const Model<2>&, const RunState<2>&);
template double shear_phase(const Model<3>&, const RunState<3>&);
template Flight<2> flight_from_now(const Flight<2>&, const Model<2>&, const RunState<2>&, double);
template Flight<3> flight_from_now(const Flight<3>&, const Model<3>&, const RunState<3>&, double);
template void restart_changed_flights(const Model<2>&, RunState<2>&);
template void restart_changed_flights(const Model<3>&, RunState<3>&);
template PhysicalStop fixture_in_particle(const Model<2>&, std::size_t, std::uint32_t, double);
template PhysicalStop fixture_in_particle(const Model<3>&, std::size_t, std::uint32_t, double);
template PhysicalStop overlap_at_start(const Model<2>&, const RunState<2>&, double);
template PhysicalStop overlap_at_start(const Model<3>&, const RunState<3>&, double);

}  // namespace clatter
