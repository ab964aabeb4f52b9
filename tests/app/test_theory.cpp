// The theory in a result, compared with independent evaluations of kinetic theory.

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/results/theory_json.h"

namespace clatter {

using nlohmann::json;
using std::numbers::pi;

namespace {

// All numbers are different.
constexpr double kCount = 60.0, kLength = 13.0, kHeight = 11.0, kStart = 1.3;

Scene scene_of(double restitution) {
  Scene scene;
  scene.box = Vec2(kLength, kHeight);
  scene.particles.count = static_cast<int>(kCount);
  scene.particles.restitution = restitution;
  scene.particles.start.temperature = kStart;
  return scene;
}

Scene walled_scene(double restitution, double wall_restitution, double drive_speed) {
  Scene scene = scene_of(restitution);
  scene.walls[kLeft] = scene.walls[kRight] =
      Wall{.kind = WallKind::Driven, .restitution = wall_restitution, .drive_speed = drive_speed};
  return scene;
}

void check_numbers(const json& actual, const json& expected) {
  CHECK(actual.size() == expected.size());
  for (const auto& [key, value] : expected.items()) {
    CAPTURE(key);
    REQUIRE(actual.contains(key));
    CHECK(actual.at(key).get<double>() == doctest::Approx(value.get<double>()).epsilon(1e-12));
  }
}

// Common terms of the formulas.
const double kPhi = kCount * pi / (4.0 * kLength * kHeight);
const double kChi = (1.0 - 7.0 * kPhi / 16.0) / std::pow(1.0 - kPhi, 2.0);    // (theory 6.1)
const double kPsi = std::sqrt(2.0) * kChi * kCount / kHeight;                 // (theory 7.5)
const double kKappa = (1.0 + 2.0 * kPhi * kChi) * kLength / (kLength - 1.0);  // of the wall layer

double enskog_rate(double temperature) {
  return 2.0 * std::sqrt(pi * temperature) * kChi * kCount / (kLength * kHeight);
}

}  // namespace

TEST_CASE("Theory: a driven gas has the temperatures of (7.10), (7.11) and (7.14)") {
  const double alpha = 0.85, alpha_w = 0.95, v_dr = 1.7;
  const double epsilon = 1.0 - alpha * alpha, at_walls = 2.0 / pi * (1.0 - alpha_w * alpha_w);
  const double loss = epsilon * kPsi + at_walls,
               loss_corrected = epsilon * kPsi / kKappa + at_walls;
  const double simple = std::pow(2.0 / pi, 1.5) *
                        (alpha_w + std::sqrt(alpha_w * alpha_w + pi * pi / 4.0 * loss)) / loss;
  const auto refined = [&](double loss) {
    return (alpha_w + std::sqrt(alpha_w * alpha_w + 2.0 * loss)) / (std::sqrt(2.0 * pi) * loss);
  };
  check_numbers(theory_json(walled_scene(alpha, alpha_w, v_dr)),
                {{"chi", kChi},
                 {"psi", kPsi},
                 {"epsilon_effective", epsilon + at_walls / kPsi},
                 {"temperature_simple", std::pow(simple * v_dr, 2.0)},
                 {"temperature_refined", std::pow(refined(loss) * v_dr, 2.0)},
                 {"temperature_corrected", std::pow(refined(loss_corrected) * v_dr, 2.0)}});
}

TEST_CASE("Theory: without a drive a gas between walls cools or diverges by (7.15)") {
  for (const double alpha_w : {0.95, 1.08}) {
    const double alpha = 0.995, epsilon = 1.0 - alpha * alpha;
    const double at_walls = 2.0 / pi * (1.0 - alpha_w * alpha_w);
    const double rate =
        std::sqrt(pi * kStart / 2.0) / (2.0 * kLength) * (epsilon * kPsi + kKappa * at_walls);
    json expected = {{"chi", kChi},
                     {"psi", kPsi},
                     {"epsilon_effective", epsilon + at_walls / kPsi},
                     {"haff_rate", rate}};
    if (alpha_w > 1.0) expected["divergence_time"] = 1.0 / std::fabs(rate);
    check_numbers(theory_json(walled_scene(alpha, alpha_w, 0.0)), expected);
  }
}

TEST_CASE("Theory: unequal walls have no theory") {
  const auto has_psi = [](auto change) {
    Scene scene = walled_scene(0.85, 0.95, 1.7);
    change(scene);
    return theory_json(scene).contains("psi");
  };
  CHECK(has_psi([](Scene&) {}));
  CHECK_FALSE(has_psi([](Scene& scene) { scene.walls[kRight]->restitution = 0.9; }));
  CHECK_FALSE(has_psi([](Scene& scene) { scene.walls[kLeft]->drive_speed = 1.6; }));
  CHECK_FALSE(has_psi([](Scene& scene) {
    scene.walls[kBottom] = scene.walls[kTop] = Wall{.kind = WallKind::Static};
  }));
  CHECK_FALSE(has_psi([](Scene& scene) {
    scene.walls = {};
    scene.walls[kBottom] = scene.walls[kTop] = Wall{.kind = WallKind::Driven, .drive_speed = 1.7};
  }));
}

TEST_CASE("Theory: a smooth gas in a periodic box cools by Haff's law") {
  const double alpha = 0.85;
  check_numbers(theory_json(scene_of(alpha)),
                {{"chi", kChi},
                 {"compressibility", 1.0 + (1.0 + alpha) * kPhi * kChi},
                 {"haff_rate", (1.0 - alpha * alpha) * enskog_rate(kStart) / 4.0}});
}

TEST_CASE("Theory: rough gases have the ratio of their temperatures, and kicked ones both") {
  const double alpha = 0.85, beta = 0.35, q = 0.45;
  const double eta = q * (1.0 + beta) / (2.0 * (1.0 + q));
  const double A = (1.0 - alpha * alpha) / 2.0 + eta * (1.0 - eta), B = eta * eta / q;
  const double C = eta / q * (1.0 - eta / q);
  Scene scene = scene_of(alpha);
  scene.particles.inertia = q;
  scene.particles.roughness = {.friction = std::numeric_limits<double>::infinity(),
                               .tangential_restitution = beta};
  json expected = {
      {"chi", kChi},
      {"compressibility", 1.0 + (1.0 + alpha) * kPhi * kChi},
      {"temperature_ratio",
       (A - 2.0 * C + std::sqrt(std::pow(A - 2.0 * C, 2.0) + 8.0 * B * B)) / (2.0 * B)}};
  check_numbers(theory_json(scene), expected);

  const double interval = 0.07, kick = 0.3;
  scene.bulk_drive = BulkDrive{.interval = interval, .kick_speed = kick};
  const double power = kick * kick * (1.0 - 1.0 / kCount) / interval;
  expected["bulk_drive_power"] = power;
  expected["temperature_driven"] =
      std::pow(power / (enskog_rate(1.0) * (A - B * B / C)), 2.0 / 3.0);
  expected["temperature_ratio"] = eta / (1.0 - eta / q);
  check_numbers(theory_json(scene), expected);

  // With kicks of spins, no formula applies.
  scene.bulk_drive->kick_spin = 0.1;
  expected.erase("temperature_driven");
  expected.erase("temperature_ratio");
  check_numbers(theory_json(scene), expected);
}

}  // namespace clatter
