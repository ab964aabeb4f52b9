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

template <int D>
PhysicalStop standstill(const Model<D>& model, const Watchdog& watchdog, double time,
                        double temperature) {
  const std::string when = "time stands still at t = " + rounded(time);
  if (diverges<D>(model, watchdog, temperature)) {
    return PhysicalStop(when + ": the temperature diverges, having reached " +
                        rounded(temperature) +
                        "; walls with restitution > 1 give more than the gas loses");
  }
  const auto [disk, partner] = watchdog.busiest_pair();
  const std::string contact_time = rounded(helpful_contact_time<D>(model, watchdog));
  return PhysicalStop(when + ": inelastic collapse of disk " + std::to_string(disk) + " and " +
                          partner_name(partner) + "; collapse.contact_time = " + contact_time +
                          " or more would carry on",
                      "collapse.contact_time=" + contact_time);
}

template PhysicalStop standstill<2>(const Model<2>&, const Watchdog&, double, double);

}  // namespace clatter
