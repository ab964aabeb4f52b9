// The theory in a result, compared with independent evaluations of kinetic theory.

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

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

namespace {

Scene mixture_of(double restitution) {
  Scene scene = scene_of(restitution);
  scene.box = Vec2(30.0, 20.0);
  scene.particles.count = 150;
  scene.species.resize(2);
  scene.species[0].name = "small";
  scene.species[0].count = 100;
  scene.species[1].name = "large";
  scene.species[1].count = 50;
  scene.species[1].diameter = 2.0;
  for (auto& walls : scene.species_walls) walls.resize(2);
  return scene;
}

/// The number of an item of a list of a theory, by its name or names.
double item_in(const json& theory, const char* list, const json& about, const char* key) {
  for (const json& one : theory.at(list)) {
    if (one.at(one.contains("name") ? "name" : "species") == about) return one.at(key);
  }
  throw std::out_of_range(key);
}

const json kBothSpecies = {"small", "large"};

}  // namespace

TEST_CASE("Theory: an elastic mixture has Z, collision rates and temperatures") {
  const Scene scene = mixture_of(1.0);
  const json theory = theory_json(scene);
  const double phi = pi * 300.0 / 4.0 / 600.0, free = 1.0 - phi, T = kStart * 150.0 / 149.0;
  const auto chi = [&](double h) {
    return 1.0 / free + 9.0 / 16.0 * phi / (free * free) * h * 2 / 3;
  };
  const double xi = 8.0 / 9.0;  // (4/3)^2 / 2
  CHECK(theory.at("compressibility").get<double>() ==
        doctest::Approx((1.0 - xi) / free + xi * (1.0 + phi * phi / 8.0) / (free * free)));
  CHECK(item_in(theory, "pairs", kBothSpecies, "chi") ==
        doctest::Approx(chi(4.0 / 3.0)).epsilon(1e-12));
  CHECK(item_in(theory, "pairs", {"large", "large"}, "chi") ==
        doctest::Approx(chi(2.0)).epsilon(1e-12));
  CHECK(item_in(theory, "pairs", kBothSpecies, "collision_rate") ==
        doctest::Approx(100.0 * std::sqrt(2.0 * pi) * 1.5 * chi(4.0 / 3.0) * 50.0 / 600.0 *
                        std::sqrt(T * 1.25)));
  CHECK(item_in(theory, "pairs", {"small", "small"}, "collision_rate") ==
        doctest::Approx(99.0 / 2.0 * std::sqrt(2.0 * pi) * chi(1.0) * 100.0 / 600.0 *
                        std::sqrt(T * 2.0)));
  CHECK(item_in(theory, "species", "large", "temperature") ==
        doctest::Approx(T * (1.0 - 4.0 / 300.0)).epsilon(1e-12));
  CHECK_FALSE(theory.contains("chi"));
  CHECK_FALSE(theory.contains("haff_rate"));
  // Collisions per particle at one temperature.
  const double all = item_in(theory, "pairs", {"small", "small"}, "collision_rate") +
                     item_in(theory, "pairs", kBothSpecies, "collision_rate") +
                     item_in(theory, "pairs", {"large", "large"}, "collision_rate");
  CHECK(collision_rate(scene, T) == doctest::Approx(2.0 * all / 150.0).epsilon(1e-12));
}

// A collision with a small disk takes 2/5 of the relative velocity of a large one, and one with a
// large disk its whole: 2 (1 + alpha)/D times the share of the reduced mass.
TEST_CASE("Theory: an elastic mixture has the friction and the diffusion of a particle") {
  const json theory = theory_json(mixture_of(1.0));
  const double with_small = item_in(theory, "pairs", kBothSpecies, "collision_rate") / 50.0;
  const double with_large =
      2.0 * item_in(theory, "pairs", {"large", "large"}, "collision_rate") / 50.0;
  const double friction = 300.0 / 296.0 * (0.4 * with_small + with_large);
  CHECK(item_in(theory, "species", "large", "friction") == doctest::Approx(friction));
  CHECK(item_in(theory, "species", "large", "diffusion") ==
        doctest::Approx(item_in(theory, "species", "large", "temperature") / (4.0 * friction)));
}

TEST_CASE("Theory: mixtures that cool have ratios, and kicked ones temperatures") {
  Scene scene = mixture_of(0.9);
  const json cooling = theory_json(scene);
  const double small = item_in(cooling, "species", "small", "temperature_ratio");
  const double large = item_in(cooling, "species", "large", "temperature_ratio");
  CHECK(large > small);
  CHECK((2.0 * small + large) / 3.0 == doctest::Approx(1.0).epsilon(1e-12));
  CHECK(cooling.at("haff_rate").get<double>() > 0.0);
  CHECK_FALSE(cooling.at("pairs")[0].contains("collision_rate"));

  scene.bulk_drive = BulkDrive{.interval = 0.1, .kick_speed = 0.3, .law = KickLaw::Energy};
  const json driven = theory_json(scene);
  const double T = (2.0 * item_in(driven, "species", "small", "temperature") +
                    item_in(driven, "species", "large", "temperature")) /
                   3.0;
  CHECK(driven.at("temperature_driven").get<double>() == doctest::Approx(T).epsilon(1e-12));
  // The gas gets N_s H_s, and loses it in collisions.
  const double power = 100.0 * item_in(driven, "species", "small", "bulk_drive_power") +
                       50.0 * item_in(driven, "species", "large", "bulk_drive_power");
  CHECK(power ==
        doctest::Approx(0.09 / 0.1 * (100.0 * (1.0 - 1.0 / 300.0) + 50.0 * (1.0 - 4.0 / 300.0))));
}

TEST_CASE("Theory: equal species have the values of one species") {
  Scene scene = mixture_of(0.8);
  scene.species[1].diameter = 1.0;
  Scene one = scene;
  one.species.clear();
  const json two = theory_json(scene), alone = theory_json(one);
  const double partners = 149.0 / 150.0;  // a particle does not meet itself
  CHECK(two.at("compressibility").get<double>() ==
        doctest::Approx(alone.at("compressibility").get<double>()).epsilon(1e-9));
  CHECK(two.at("haff_rate").get<double>() ==
        doctest::Approx(partners * alone.at("haff_rate").get<double>()).epsilon(1e-9));
  scene.bulk_drive = one.bulk_drive = BulkDrive{.interval = 0.1, .kick_speed = 0.3};
  CHECK(theory_json(scene).at("temperature_driven").get<double>() ==
        doctest::Approx(std::pow(partners, -2.0 / 3.0) *
                        theory_json(one).at("temperature_driven").get<double>())
            .epsilon(1e-9));
  CHECK(collision_rate(scene, 1.7) ==
        doctest::Approx(partners * collision_rate(one, 1.7)).epsilon(1e-12));
}

TEST_CASE("Theory: pairs that lack particles have no influence") {
  Scene scene = mixture_of(1.0);
  scene.species[1].count = 1;
  scene.pairs = {{{"large", "large"}, 0.5}};
  CHECK_FALSE(cools_freely(scene));
  CHECK(theory_json(scene).contains("species"));
  CHECK_FALSE(theory_json(scene).contains("haff_rate"));
  scene.species[1].count = 2;
  CHECK(cools_freely(scene));
  scene.species[1].count = 0;
  scene.pairs = {{{"small", "large"}, 0.5}};
  CHECK_FALSE(cools_freely(scene));
}

TEST_CASE("Theory: species that stay smooth have no spin temperature") {
  Scene scene = mixture_of(0.9);
  Roughness rough;
  rough.friction = std::numeric_limits<double>::infinity();
  rough.tangential_restitution = 0.3;
  scene.pairs = {{{"large", "large"}, 0.9, rough}};
  const auto spins_of = [&](const char* key) {
    std::vector<bool> found;
    const json theory = theory_json(scene);
    for (const json& one : theory.at("species")) found.push_back(one.contains(key));
    return found;
  };
  CHECK(spins_of("spin_temperature_ratio") == std::vector{false, true});
  scene.bulk_drive = BulkDrive{.interval = 0.1, .kick_speed = 0.3};
  CHECK(spins_of("spin_temperature") == std::vector{false, true});
}

TEST_CASE("Theory: a result of a mixture lacks the keys of the theory of equal particles") {
  Scene scene = mixture_of(0.9);
  CHECK(haff_rate(scene) == std::nullopt);
  CHECK(cools_freely(scene));
  scene.particles.restitution = 1.0;
  CHECK_FALSE(cools_freely(scene));
  scene.pairs = {{{"small", "large"}, 0.5}};
  CHECK(cools_freely(scene));
  scene.walls[kLeft] = scene.walls[kRight] = Wall{.kind = WallKind::Driven, .drive_speed = 1.0};
  CHECK_FALSE(vibrated_gas(scene));
  const json walled = theory_json(scene);
  CHECK(walled.size() == 1);
  CHECK(walled.at("pairs").size() == 3);
  scene.walls = {};
  scene.walls[kBottom] = scene.walls[kTop] = Wall{.kind = WallKind::Thermal};
  scene.gravity = Vec2(0.0, -1.0);
  scene.pairs.clear();
  CHECK_FALSE(atmosphere(scene));
}

}  // namespace clatter
