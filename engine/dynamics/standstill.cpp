#include "engine/dynamics/standstill.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/scene/scene.h"

namespace clatter {

static std::string rounded(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

static std::string partner_name(std::uint32_t partner) {
  if (partner < kWall) return "disk " + std::to_string(partner);
  return std::string("the ") + kSideNames[partner - kWall] + " wall";
}

// Walls with restitution > 1 heat without bound: disks have become so fast that in what used to be
// the time between collisions they would cross the box a thousand times.
template <int D>
static bool diverges(const Model<D>& model, const Watchdog& watchdog, double temperature) {
  const bool heats = std::ranges::any_of(
      model.walls, [](const auto& wall) { return wall && wall->restitution > 1.0; });
  const double flight = std::sqrt(temperature) * watchdog.mean_collision_time();
  return heats && flight > 1e3 * model.box.maxCoeff();
}

// Long against the rounding of times, short against the mean collision time; a run that has a t_c
// already needs a longer one.
template <int D>
static double helpful_contact_time(const Model<D>& model, const Watchdog& watchdog) {
  constexpr double kShare = 1e-3;  // of the mean collision time
  return std::max(kShare * watchdog.mean_collision_time(), 10.0 * model.contact_time.value_or(0.0));
}

PhysicalStop divergence(double time, double temperature) {
  return PhysicalStop("the temperature diverges at t = " + rounded(time) + ", having reached " +
                      rounded(temperature) +
                      "; walls with restitution > 1 give more than the gas loses");
}

// Whether a partner is a wall that emits disks without any speed, which no t_c changes.
template <int D>
static bool is_cold_wall(const Model<D>& model, std::uint32_t partner) {
  return partner >= kWall && model.walls[partner - kWall]->kind == WallKind::Thermal;
}

template <int D>
PhysicalStop standstill(const Model<D>& model, const Watchdog& watchdog, double time,
                        double temperature) {
  if (diverges<D>(model, watchdog, temperature)) return divergence(time, temperature);
  const auto [disk, partner] = watchdog.busiest_pair();
  const std::string what = "time stands still at t = " + rounded(time) + ": disk " +
                           std::to_string(disk) + " and " + partner_name(partner) +
                           " collide without end";
  if (is_cold_wall<D>(model, partner)) {
    return PhysicalStop(what + "; a wall of temperature 0 lets no disk go, give it some");
  }
  const double helpful = helpful_contact_time<D>(model, watchdog);
  if (helpful == 0.0) {
    return PhysicalStop(what + " since the start; a collapse.contact_time would carry on");
  }
  const std::string contact_time = rounded(helpful);
  return PhysicalStop(what + " (inelastic collapse, or rest); collapse.contact_time = " +
                          contact_time + " or more would carry on",
                      "collapse.contact_time=" + contact_time);
}

template PhysicalStop standstill<2>(const Model<2>&, const Watchdog&, double, double);

}  // namespace clatter
