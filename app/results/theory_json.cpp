#include "app/results/theory_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/results/mixture_theory_json.h"
#include "engine/physics/shear_theory.h"

namespace clatter {

using Json = nlohmann::ordered_json;

// Whether something stands in the box, for which the theories of a plain box do not hold.
static bool is_divided(const Scene& scene) {
  return scene.piston || scene.has_fixtures();
}

std::optional<VibratedGas> vibrated_gas(const Scene& scene) {
  const auto &left = scene.walls[kLeft], &right = scene.walls[kRight];
  const auto vibrates = [](const std::optional<Wall>& wall) {
    return wall && (wall->kind == WallKind::Driven || wall->kind == WallKind::Static);
  };
  const bool alike = vibrates(left) && vibrates(right) && left->restitution == right->restitution &&
                     left->drive_speed == right->drive_speed;
  const bool falls = scene.gravity && scene.gravity->norm() > 0.0;
  const bool open = scene.periodic(1) && (scene.dimension() == 2 || scene.periodic(2));
  if (!alike || !open || is_divided(scene) || scene.particles.count == 0 || scene.spins() ||
      falls || scene.bulk_drive || !scene.species.empty()) {
    return std::nullopt;
  }
  return VibratedGas{static_cast<double>(scene.particles.count),
                     scene.box.x(),
                     scene.box.tail(scene.dimension() - 1).prod(),
                     scene.particles.restitution,
                     left->restitution,
                     left->drive_speed,
                     scene.dimension()};
}

std::optional<Atmosphere> atmosphere(const Scene& scene) {
  const Particles& particles = scene.particles;
  if (!scene.gravity || is_divided(scene) || particles.restitution != 1.0 || particles.count == 0 ||
      scene.spins() || scene.bulk_drive || !scene.species.empty()) {
    return std::nullopt;
  }
  Eigen::Index axis = 0;
  const double gravity = scene.gravity->cwiseAbs().maxCoeff(&axis);
  const bool down = (*scene.gravity)[axis] < 0.0;
  const auto& floor = scene.walls[static_cast<std::size_t>(2 * axis + (down ? 0 : 1))];
  const bool straight = gravity > 0.0 && scene.gravity->norm() == gravity;
  if (!straight || !floor || floor->kind != WallKind::Thermal) return std::nullopt;
  const bool at_rest = std::ranges::all_of(scene.walls, [&](const std::optional<Wall>& wall) {
    if (!wall) return true;
    if (wall->kind == WallKind::Thermal) return wall->temperature == floor->temperature;
    return wall->kind == WallKind::Static && wall->restitution == 1.0;
  });
  if (!at_rest) return std::nullopt;
  return Atmosphere{static_cast<double>(particles.count),
                    scene.box.prod() / scene.box[axis],
                    scene.box[axis],
                    gravity,
                    floor->temperature,
                    scene.dimension()};
}

std::optional<TwoCompartments> two_compartments(const Scene& scene) {
  const Particles& particles = scene.particles;
  const auto is = [&](Side side, WallKind kind) {
    return scene.walls[side] && scene.walls[side]->kind == kind;
  };
  const bool walled = is(kLeft, WallKind::Static) && is(kRight, WallKind::Static) &&
                      is(kTop, WallKind::Static) && is(kBottom, WallKind::Driven);
  const bool alone = scene.partitions.size() == 1 && scene.obstacles.empty() && !scene.bulk_drive &&
                     scene.species.empty() && !scene.spins();
  if (scene.dimension() != 2 || !walled || !alone || !scene.gravity || particles.count == 0 ||
      particles.restitution == 1.0) {
    return std::nullopt;
  }
  const Wall& floor = *scene.walls[kBottom];
  const Partition& wall = scene.partitions.front();
  const double gravity = -scene.gravity->y(), width = 0.5 * scene.box.x();
  const bool falls = gravity > 0.0 && scene.gravity->x() == 0.0;
  const bool halves = wall.present && wall.axis == Axis::X && wall.position == width;
  const bool open =
      wall.holes.size() == 1 && !wall.holes[0].valve && wall.holes[0].to[0] == scene.box.y();
  if (!falls || !halves || !open || !(floor.drive_speed > 0.0) || floor.restitution > 1.0) {
    return std::nullopt;
  }
  return TwoCompartments{static_cast<double>(particles.count),
                         width,
                         particles.restitution,
                         floor.drive_speed,
                         floor.restitution,
                         gravity,
                         wall.holes[0].from[0]};
}

// (theory 7.5-7.16)
static void add_vibrated(Json& json, const VibratedGas& gas, double start_temperature) {
  json["psi"] = gas.psi();
  json["epsilon_effective"] = gas.epsilon_effective();
  // Without a drive the gas cools by Haff's law, or its temperature diverges at a finite time
  // (theory 7.15).
  if (gas.drive_speed == 0.0) {
    const double rate = gas.haff_rate_corrected(start_temperature);
    json["haff_rate"] = rate;
    if (rate < 0.0) json["divergence_time"] = divergence_time(rate);
    return;
  }
  const auto add = [&](const char* name, double temperature) {
    if (std::isfinite(temperature)) json[name] = temperature;
  };
  add("temperature_simple", gas.temperature_simple());
  add("temperature_refined", gas.temperature_refined());
  add("temperature_corrected", gas.temperature_corrected());
}

// Whether the system is invariant under translations.
static bool is_homogeneous_gas(const Scene& scene) {
  const bool walled =
      std::ranges::any_of(scene.walls, [](const auto& wall) { return wall.has_value(); });
  return !walled && !is_divided(scene) && scene.particles.count > 1 && !scene.gravity &&
         !scene.shear_rate;
}

bool cools_freely(const Scene& scene) {
  return is_homogeneous_gas(scene) && !scene.bulk_drive && dissipates(scene);
}

std::optional<double> haff_rate(const Scene& scene) {
  const bool mixture = !scene.species.empty();
  if (!is_homogeneous_gas(scene) || scene.spins() || scene.bulk_drive || mixture) {
    return std::nullopt;
  }
  return haff_rate_periodic(scene.packing_fraction(), scene.particles.restitution,
                            scene.particles.start.temperature, scene.dimension());
}

// Smooth particles, and rough particles with unlimited friction, so that beta is constant.
static void add_homogeneous(Json& json, const Scene& scene) {
  const Particles& particles = scene.particles;
  const double phi = scene.packing_fraction();
  const int dimension = scene.dimension();
  json["compressibility"] = compressibility(phi, particles.restitution, dimension);
  const bool rough = scene.spins();
  const bool constant_beta = !rough || std::isinf(particles.roughness.friction_in_force());
  const double beta = rough ? particles.roughness.tangential_restitution_in_force() : -1.0;
  const RoughGas gas{particles.restitution, beta, particles.inertia, dimension};
  if (!scene.bulk_drive) {
    if (const auto rate = haff_rate(scene)) {
      json["haff_rate"] = *rate;
    } else if (constant_beta) {
      json["temperature_ratio"] = gas.cooling_ratio();
    }
    return;
  }
  const BulkDrive& drive = *scene.bulk_drive;
  const double power =
      bulk_drive_power(particles.count, drive.kick_speed, drive.interval, dimension);
  json["bulk_drive_power"] = power;
  if (!constant_beta || !(power > 0.0) || drive.kick_spin > 0.0) return;
  const double temperature = gas.driven_temperature(phi, power);
  if (!std::isfinite(temperature)) return;  // no dissipation
  json["temperature_driven"] = temperature;
  if (rough) json["temperature_ratio"] = gas.driven_ratio();
}

double collision_rate(const Scene& scene, double temperature) {
  if (scene.species.empty()) {
    return enskog_rate(scene.packing_fraction(), temperature, scene.dimension());
  }
  const MixtureGas gas = mixture_gas(scene);
  const MixtureTemperatures temperatures = gas.equal(temperature);
  double sum = 0.0;
  for (std::size_t s = 0; s < gas.components.size(); ++s) {
    for (std::size_t t = 0; t < gas.components.size(); ++t) {
      sum += gas.components[s].count * gas.collision_rate(s, t, temperatures);
    }
  }
  return gas.components.empty() ? 0.0 : sum / gas.count();
}

std::optional<SteadyShear> steady_shear(const Scene& scene) {
  const double alpha = scene.particles.restitution, rate = scene.shear_rate.value_or(0.0);
  const bool walled =
      std::ranges::any_of(scene.walls, [](const auto& wall) { return wall.has_value(); });
  if (rate == 0.0 || walled || !scene.species.empty() || scene.particles.count < 2)
    return std::nullopt;
  if (scene.spins() || scene.bulk_drive || !(alpha > 0.0 && alpha < 1.0)) return std::nullopt;
  const double phi = scene.packing_fraction();
  return SteadyShear{grad_shear(phi, alpha, rate, scene.dimension()),
                     enskog_shear_temperature(phi, alpha, rate, scene.dimension())};
}

static void add_shear(Json& json, const Scene& scene, const SteadyShear& shear) {
  const double phi = scene.packing_fraction(), rate = *scene.shear_rate;
  const auto& [grad, dense] = shear;
  const double pressure = phi / packing_fraction(scene.dimension(), 1.0) * grad.temperature;
  json["temperature_grad"] = grad.temperature;
  json["temperature_enskog"] = dense;
  json["viscosity_grad"] = -grad.stress_yx * pressure / rate;
  json["viscosity_enskog"] = enskog_viscosity(phi, dense, scene.dimension());
  json["stress_xx_grad"] = -grad.stress_xx * pressure;
  json["stress_yy_grad"] = -grad.stress_yy * pressure;
  json["stress_yx_grad"] = -grad.stress_yx * pressure;
}

Json theory_json(const Scene& scene) {
  if (!scene.species.empty()) return mixture_theory_json(scene);
  Json json{{"chi", contact_correlation(scene.packing_fraction(), scene.dimension())}};
  if (const auto gas = vibrated_gas(scene)) {
    add_vibrated(json, *gas, scene.particles.start.temperature);
  }
  if (is_homogeneous_gas(scene)) add_homogeneous(json, scene);
  if (const auto shear = steady_shear(scene)) add_shear(json, scene, *shear);
  if (const auto gas = two_compartments(scene)) json["imbalance"] = 2.0 * gas->fuller_share() - 1.0;
  return json;
}

}  // namespace clatter
