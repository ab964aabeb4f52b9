#include "engine/dynamics/run_state.h"

#include <algorithm>
#include <cmath>

namespace clatter {

template <int D>
static bool is_flight(const Flight<D>& flight, double now, const Vec<D>& gravity) {
  // Larger than any box and any speed of a scene.
  constexpr double kFar = 1e15, kFast = 1e150;
  return flight.r.cwiseAbs().maxCoeff() < kFar && flight.v.cwiseAbs().maxCoeff() < kFast &&
         flight.time <= now && flight.at(now, gravity).cwiseAbs().maxCoeff() < kFar &&
         flight.velocity_at(now, gravity).cwiseAbs().maxCoeff() < kFast;
}

static bool is_motion(const WallMotion& motion) {
  return motion.stroke >= 0.0 && motion.frequency >= 0.0 &&
         std::isfinite(motion.stroke * motion.frequency + motion.phase);
}

static bool is_grain(const Grain& grain) {
  const double least = std::min({grain.radius, grain.mass, grain.inertia});
  return least > 0.0 && std::isfinite(grain.radius + grain.mass + grain.inertia);
}

static bool is_stroke(const PistonStroke& stroke) {
  return stroke.from >= 0.0 && stroke.to >= 0.0 && stroke.end > stroke.start &&
         std::isfinite(stroke.from + stroke.to + stroke.start + stroke.end + stroke.velocity());
}

static bool is_piston_flight(const PistonFlight& flight, double now) {
  return flight.time <= now && std::isfinite(flight.place + flight.velocity + flight.acceleration +
                                             flight.at(now) + flight.velocity_at(now));
}

template <int D>
bool makes_sense(const RunState<D>& state) {
  const std::size_t count = state.flights.size();
  const auto fits = [&](const auto& list) { return list.empty() || list.size() == count; };
  const double time = state.base.high + state.base.low + state.now;
  const double kicked =
      state.kick_origin + static_cast<double>(state.kicks_since_origin) * state.kick_interval;
  const double numbers = time + state.gravity.sum() + state.mean_collision_time +
                         state.start_speed + kicked + state.shear_rate.value_or(0.0) +
                         state.shear_phase + state.checks.deepest_overlap +
                         state.checks.clock_steps_back;
  constexpr std::uint64_t kLongestBase = std::uint64_t{1} << 40;
  constexpr double kLate = 1e-6;  // of the time
  const auto is_finite = [](const auto& vector) { return vector.allFinite(); };
  return std::isfinite(numbers) && state.now >= 0.0 && state.mean_collision_time >= 0.0 &&
         state.start_speed >= 0.0 && state.kick_interval >= 0.0 &&
         state.until_base_moves <= kLongestBase &&
         (state.kick_interval == 0.0 || kicked + state.kick_interval >= time * (1.0 - kLate)) &&
         fits(state.grains) && fits(state.spins) && fits(state.last_collisions) &&
         fits(state.remainders) && std::ranges::all_of(state.wall_motions, is_motion) &&
         (!state.piston || is_stroke(*state.piston)) &&
         (!state.free_piston || is_piston_flight(*state.free_piston, state.now)) &&
         std::ranges::all_of(state.phase_shifts, [](double s) { return std::isfinite(s); }) &&
         std::ranges::all_of(
             state.flights,
             [&](const Flight<D>& f) { return is_flight<D>(f, state.now, state.gravity); }) &&
         std::ranges::all_of(state.grains, is_grain) &&
         std::ranges::all_of(state.spins, is_finite) &&
         std::ranges::all_of(state.remainders, is_finite) &&
         std::ranges::all_of(state.last_collisions, [&](double t) { return t <= state.now; });
}

template bool makes_sense<2>(const RunState<2>&);
template bool makes_sense<3>(const RunState<3>&);

}  // namespace clatter
