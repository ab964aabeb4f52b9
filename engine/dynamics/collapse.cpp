#include "engine/dynamics/collapse.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/laws/wall.h"
#include "engine/physics/pair_contact.h"

namespace clatter {

static std::string rounded(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

template <int D>
static const Fixture<D>& fixture_of(const Model<D>& model, std::uint32_t piece) {
  for (const Fixture<D>& fixture : model.fixtures) {
    const auto count = static_cast<std::uint32_t>(fixture.pieces.size());
    if (piece < count) return fixture;
    piece -= count;
  }
  const Fixture<D>* owner = &model.fixtures.front();  // of a valve, which come last
  for (; piece >= owner->valves.size(); ++owner) {
    piece -= static_cast<std::uint32_t>(owner->valves.size());
  }
  return *owner;
}

template <int D>
static std::string partner_name(const Model<D>& model, std::uint32_t partner) {
  if (partner < kPiece) return "particle " + std::to_string(partner);
  if (partner == kPiston) return "the piston";
  if (partner < kWall) return fixture_of(model, partner - kPiece).name;
  return std::string("the ") + kSideNames[partner - kWall] + " wall";
}

template <int D>
static bool gains(const Model<D>& model) {
  bool gains = false;
  model.for_walls([&](const Wall& wall) { gains = gains || wall.restitution > 1.0; });
  return gains;
}

// Whether walls with restitution > 1 heat the gas without bound. The criterion: within the mean
// collision time known so far, a particle would cross the box a thousand times.
template <int D>
static bool diverges(const Model<D>& model, const Watchdog& watchdog, double speed) {
  const double flight = speed / std::sqrt(D) * watchdog.mean_collision_time();
  return gains(model) && flight > 1e3 * model.box.maxCoeff();
}

// A t_c that resolves a collapse: long against the rounding of times, short against the mean
// collision time. It is at least ten times a t_c that the run already has.
template <int D>
static double helpful_contact_time(const Model<D>& model, const Watchdog& watchdog) {
  constexpr double kShare = 1e-3;  // of the mean collision time
  return std::max(kShare * watchdog.mean_collision_time(), 10.0 * model.contact_time.value_or(0.0));
}

// Greatest speed that a wall's drive or motion gives to a particle at rest. Exact for driven walls
// and the saw-tooth, approximate for sinusoidal and sliding walls.
template <int D>
static double drive_of(const Model<D>& model) {
  double drive = 0.0;
  model.for_walls([&](const Wall& wall) {
    drive = std::max(
        {drive, wall.drive_speed, 2.0 * wall.stroke * wall.frequency, wall.surface<D>().norm()});
  });
  return drive;
}

// Thermal speed of the hottest wall that emits.
template <int D>
static double emission_of(const Model<D>& model) {
  double temperature = 0.0;
  model.for_walls([&](const Wall& wall) {
    if (wall.kind == WallKind::Thermal) temperature = std::max(temperature, wall.temperature);
  });
  return std::sqrt(temperature);
}

// Speed that particles reach without walls: the larger of a fall across the box and a kick.
template <int D>
static double free_speed(const Model<D>& model) {
  double fall = 2.0 * model.gravity.cwiseAbs().dot(model.box);
  double speed = model.bulk_drive ? model.bulk_drive->kick_speed : 0.0;
  if (model.free_piston) {
    fall += 2.0 * std::fabs(model.free_piston->acceleration()) * model.box[model.free_piston->axis];
    speed = std::max(speed, std::fabs(model.free_piston->speed));
  }
  return std::max(std::sqrt(fall), speed);
}

template <int D>
double usual_speed(const Model<D>& model, double start_speed) {
  return std::max({drive_of(model), start_speed, free_speed(model)});
}

// Walls with restitution > 1 multiply speeds: beyond 1e60, products of speeds would soon overflow.
// Walls that only add speed, faster than it is lost, make speeds grow as exp(t). The number of
// collisions grows alike, and one more e-folding beyond kMaxGrowth costs a million of them. Losses
// could balance walls at such speeds only if they were a millionth of the energy of a particle.
//
// In a gas that a piston compresses to close packing, speeds grow as the inverse of the room of a
// particle, and the number of collisions grows alike, also if t_c ends the losses. The limit is
// lower, so that the run stops after some 10^4 collisions of each particle. Without close packing a
// thousandfold speed needs a millionth of the area of a gas of disks.
template <int D>
double fastest_speed(const Model<D>& model, double start_speed, bool piston) {
  constexpr double kFastest = 1e60;
  constexpr double kMaxGrowth = 1e6, kMaxCompressed = 1e3;
  if (gains(model)) return kFastest;
  const double usual = usual_speed(model, start_speed);
  const double heated =
      drive_of(model) > 0.0 ? kMaxGrowth * std::max(usual, emission_of(model)) : kNever;
  const double compressed = piston ? kMaxCompressed * std::max(usual, emission_of(model)) : kNever;
  return std::min(heated, compressed);
}

static PhysicalStop no_room(double time, double temperature) {
  return PhysicalStop("the piston leaves the particles no room at t = " + rounded(time) +
                      ", where the temperature has reached " + rounded(temperature) +
                      "; let it stop at a larger position");
}

template <int D>
PhysicalStop divergence(const Model<D>& model, double time, const Heat& heat, bool compressed) {
  if (compressed && !gains(model)) return no_room(time, heat.temperature);
  return PhysicalStop("the temperature diverges at t = " + rounded(time) + ", having reached " +
                      rounded(heat.temperature) + ", a speed of " + rounded(heat.speed) +
                      (gains(model) ? ": walls with restitution > 1 add more energy than the gas "
                                      "loses; lower this restitution"
                                    : ": walls add more energy than collisions take; lower a "
                                      "restitution of particles or walls"));
}

template <int D>
PhysicalStop crowding(const Model<D>& model, const Watchdog& watchdog, double time) {
  const auto [particle, partner] = watchdog.busiest_pair();
  return PhysicalStop("particle " + std::to_string(particle) + " and " +
                      partner_name<D>(model, partner) +
                      " have no room between them at t = " + rounded(time) +
                      ", and collide without end; enlarge the box, or remove particles");
}

template <int D>
static const Wall* thermal_wall(const Model<D>& model, std::uint32_t partner) {
  if (partner < kPiece || partner == kPiston) return nullptr;
  const Wall& law =
      partner >= kWall ? *model.walls[partner - kWall] : fixture_of(model, partner - kPiece).law;
  return law.kind == WallKind::Thermal ? &law : nullptr;
}

template <int D>
PhysicalStop standstill(const Model<D>& model, const Watchdog& watchdog, double time,
                        const Heat& heat, bool compressed) {
  if (diverges<D>(model, watchdog, heat.speed)) {
    return divergence<D>(model, time, heat, compressed);
  }
  const auto [particle, partner] = watchdog.busiest_pair();
  const std::string what = "time does not advance beyond t = " + rounded(time) + ": particle " +
                           std::to_string(particle) + " and " + partner_name<D>(model, partner) +
                           " collide without end";
  // A thermal wall ignores t_c.
  if (const Wall* wall = thermal_wall<D>(model, partner)) {
    return PhysicalStop(what + ", because the wall emits at temperature " +
                        rounded(wall->temperature) + "; raise this temperature");
  }
  const double helpful = helpful_contact_time<D>(model, watchdog);
  if (helpful == 0.0) {
    return PhysicalStop(what + " since the start; set collapse.contact_time");
  }
  if (compressed) {
    return PhysicalStop(
        what +
        ", while the piston compresses the gas (inelastic collapse, or no room); "
        "let the piston stop at a larger position, or set collapse.contact_time to " +
        rounded(helpful) + " or more");
  }
  const std::string contact_time = rounded(helpful);
  return PhysicalStop(what + " (inelastic collapse, or rest); set collapse.contact_time to " +
                          contact_time + " or more",
                      "collapse.contact_time=" + contact_time);
}

template double usual_speed<2>(const Model<2>&, double);
template double usual_speed<3>(const Model<3>&, double);
template double fastest_speed<2>(const Model<2>&, double, bool);
template double fastest_speed<3>(const Model<3>&, double, bool);
template PhysicalStop divergence<2>(const Model<2>&, double, const Heat&, bool);
template PhysicalStop divergence<3>(const Model<3>&, double, const Heat&, bool);
template PhysicalStop crowding<2>(const Model<2>&, const Watchdog&, double);
template PhysicalStop crowding<3>(const Model<3>&, const Watchdog&, double);
template PhysicalStop standstill<2>(const Model<2>&, const Watchdog&, double, const Heat&, bool);
template PhysicalStop standstill<3>(const Model<3>&, const Watchdog&, double, const Heat&, bool);

}  // namespace clatter
