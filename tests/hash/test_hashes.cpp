// The state hashes of scenes after thousands of collisions. They are equal for every compiler,
// optimisation level, processor and C library. After an intended change of results, replace them by
// the hashes that the failing tests print.

#include <doctest/doctest.h>

#include <algorithm>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <set>
#include <string>
#include <string_view>

#include "engine/dimension.h"
#include "engine/dynamics/simulation.h"
#include "engine/embedded_file.h"
#include "engine/initial/start_state.h"
#include "engine/scene/scene_file.h"

using namespace clatter;

namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::uint64_t kCollisions = 8000;

struct GalleryHash {
  std::string_view name;
  std::uint64_t hash;
};

// Every scene of the gallery.
constexpr GalleryHash kGallery[] = {
    {"barometer.toml", 0x6a2395a17e31fee7},
    {"collapse.toml", 0x4bf763996dd1b7ee},
    {"conduction.toml", 0x6ec3c4ab107498dd},
    {"bow_shock.toml", 0x8c73401d1cc22e83},
    {"brazil_nut.toml", 0x4bd106645d9b32ec},
    {"brownian.toml", 0x3fe1764d231e4e06},
    {"cooling.toml", 0x002cb0c2ab369464},
    {"cradle.toml", 0x0d76ddcebd38d99e},
    {"demon.toml", 0x7faa9c6d10922cd3},
    {"dense.toml", 0xa8462d63d5bf47fa},
    {"equilibrium.toml", 0x2f6ceb84347bc73e},
    {"galton.toml", 0x00695b714abb3e5e},
    {"heating_walls.toml", 0x940f2efa3bae110f},
    {"mixed_atmosphere.toml", 0x6d5c4499cbcd2fe3},
    {"polydisperse.toml", 0xd881bace5d26dfe0},
    {"rough_cooling.toml", 0x668b837c3859e598},
    {"rough_driven.toml", 0xdc18b4f8fcead24e},
    {"shaker.toml", 0x96b5507643a1d9a1},
    {"spheres_cooling.toml", 0x5ba90370b9f0013e},
    {"spheres_leidenfrost.toml", 0x6fef7731f3481d13},
    {"spheres_rain.toml", 0x5c4e329e272ae706},
    {"spheres_rough.toml", 0xb95c305d7392409d},
    {"spheres_vibrated.toml", 0xd726d2453464c7e9},
    {"two_temperatures.toml", 0xbb154a53cb90151d},
    {"vibrated.toml", 0x893fff2f2673d6a9},
    {"lid.toml", 0x690ca7d04ad6547a},
    {"osmosis.toml", 0xa62db13793b71c3a},
    {"piston.toml", 0xe9150f3eea8978a0},
    {"echo.toml", 0x5f471677f6f32384},
    {"doorkeeper.toml", 0x4e8c858b5150f229},
    {"ratchet.toml", 0xffefa658a9924cd4},
    {"couette.toml", 0x212952d3a5108f01},
    {"shear.toml", 0x34eda9a74d1543d0},
};

struct SceneHash {
  const char* what;
  std::uint64_t hash;
  const char* scene;
};

// Features without a scene in the gallery.
constexpr SceneHash kScenes[] = {
    {"thermal walls and spins", 0xd05c972192f3640c, R"(
        box.size = [16, 12]
        particles = { count = 80, restitution = 0.9, friction = 0.5, start.spin_temperature = 0.5 }
        walls.left = { kind = "thermal", temperature = 2.0 }
        walls.right = { kind = "thermal", temperature = 0.5 })"},
    {"rough driven and static walls", 0xd7a08920cf015d7e, R"(
        box.size = [16, 12]
        particles = { count = 80, restitution = 0.9, tangential_restitution = 0.5 }
        walls.left = { kind = "driven", drive_speed = 1.0, friction = 0.3 }
        walls.right = { kind = "static", restitution = 0.9, tangential_restitution = -0.5 })"},
    {"sinusoidal walls", 0x7579facda3a85183, R"(
        box.size = [16, 12]
        particles = { count = 80, restitution = 0.9 }
        walls.left = { kind = "sinusoidal", stroke = 0.5, frequency = 2.0, phase = 0.3 }
        walls.right = { kind = "sinusoidal", stroke = 2.0, frequency = 0.1, restitution = 0.8 })"},
    {"sinusoidal floor under gravity", 0x335e4ac960207d10, R"(
        box.size = [16, 20]
        particles = { count = 80, restitution = 0.95 }
        gravity.acceleration = [0.1, -1.0]
        walls.bottom = { kind = "sinusoidal", stroke = 1.0, frequency = 0.7, friction = 0.3 }
        walls.top.kind = "static")"},
    {"saw-tooth walls under gravity", 0x1f9dc5b9c7744889, R"(
        box.size = [16, 20]
        particles = { count = 80, restitution = 0.95 }
        gravity.acceleration = [0.0, -0.5]
        walls.bottom = { kind = "sawtooth", stroke = 0.5, frequency = 2.0, phase = 0.25 }
        walls.top = { kind = "sawtooth", stroke = 0.01, frequency = 50.0 })"},
    {"kicks of motion and spin", 0x1d96a85bb5982905, R"(
        box.size = [16, 12]
        particles = { count = 80, restitution = 0.8, friction = 0.4 }
        bulk_drive = { interval = 0.05, kick_speed = 0.1, kick_spin = 0.2 })"},
    {"all at once", 0x6664056c5cd8d7f0, R"(
        box.size = [16, 12]
        particles = { count = 80, restitution = 0.7, friction = 0.4, inertia = 0.4 }
        walls.left = { kind = "sinusoidal", stroke = 0.4, frequency = 1.0, phase = 0.125 }
        walls.right = { kind = "sawtooth", stroke = 0.3, frequency = 2.0, friction = 0.2 }
        walls.bottom = { kind = "driven", drive_speed = 1.0, restitution = 0.9 }
        walls.top = { kind = "thermal", temperature = 2.0 }
        gravity.acceleration = [0.25, -0.5]
        bulk_drive = { interval = 0.2, kick_speed = 0.1, kick_spin = 0.05 }
        collapse.contact_time = 1e-3)"},
    {"sparse start", 0xf6d395fb19d5121f, R"(
        box.size = [90, 80]
        particles.count = 80)"},
    {"grown start of disks", 0x4439ee4cb131bab6, R"(
        box.size = [200, 160]
        particles.count = 20000
        walls.left.kind = "static"
        walls.right.kind = "static")"},
    {"grown start of spheres", 0x66af67ffe9d5a04f, R"(
        box.size = [30, 35, 32]
        particles.count = 20000)"},
    {"melted start", 0x4d709eb2dc03a42a, R"(
        box.size = [16, 12]
        particles.area_fraction = 0.62)"},
    {"melted start between walls", 0xdee8c69bf6a613b1, R"(
        box.size = [16, 12]
        particles.area_fraction = 0.58
        walls.left.kind = "static"
        walls.right.kind = "static"
        walls.bottom.kind = "static"
        walls.top.kind = "static")"},
    {"lattice between walls", 0x196b2be6f7a20f70, R"(
        box.size = [16, 12]
        particles = { area_fraction = 0.5, start.layout = "lattice" }
        walls.left.kind = "static"
        walls.right.kind = "static")"},
    {"dense spheres, melted", 0xb071e9ae0ae0ca8b, R"(
        box.size = [8, 9, 10]
        particles = { volume_fraction = 0.56, restitution = 0.95, friction = 0.3 })"},
    {"dense spheres that fall on walls", 0x0f51cd7154bacaa0, R"(
        box.size = [7, 12, 8]
        particles = { volume_fraction = 0.4, restitution = 0.9 }
        gravity.acceleration = [0.1, -0.5, 0.2]
        collapse.contact_time = 1e-4
        walls.bottom = { kind = "sinusoidal", stroke = 0.5, frequency = 2.0 }
        walls.top = { kind = "static" }
        walls.back = { kind = "thermal", temperature = 2.0 }
        walls.front = { kind = "driven", drive_speed = 1.0 })"},
    {"rough spheres, kicked", 0x701831f2781f0b5d, R"(
        box.size = [12, 9, 10]
        particles = { count = 150, tangential_restitution = 0.5, friction = 0.2 }
        bulk_drive = { interval = 0.05, kick_speed = 0.1, kick_spin = 0.2 })"},
};

std::uint64_t hash_of(const Scene& scene) {
  return with_dimension(scene.dimension(), [&](auto dimension) {
    constexpr int D = dimension;
    Simulation<D> simulation(model_of<D>(scene, kSeed), start_state<D>(scene, kSeed));
    simulation.run_until(kNever, kCollisions);
    return simulation.state_hash();
  });
}

std::string digits(std::uint64_t hash) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%016" PRIx64, hash);
  return text;
}

void compare(std::string_view scene, std::uint64_t got, std::uint64_t wanted) {
  const std::string message =
      std::string(scene) + ": got " + digits(got) + ", wanted " + digits(wanted);
  CHECK_MESSAGE(got == wanted, message);
}

}  // namespace

TEST_CASE("Hashes: every scene of the gallery has its pinned hash") {
  std::set<std::string_view> scenes;
  for (const EmbeddedFile& file : embedded_scenes()) {
    scenes.insert(file.name);
    const std::uint64_t got = hash_of(load_gallery_scene(file));
    const auto row = std::ranges::find(kGallery, file.name, &GalleryHash::name);
    const std::string name(file.name);
    if (row == std::end(kGallery)) {
      FAIL_CHECK(name, ": got ", digits(got), ", but the table of hashes lacks the scene");
    } else {
      compare(name, got, row->hash);
    }
  }
  for (const GalleryHash& row : kGallery) {
    const std::string message = std::string(row.name) + " is no scene of the gallery";
    CHECK_MESSAGE(scenes.contains(row.name), message);
  }
}

TEST_CASE("Hashes: scenes with features outside the gallery have their pinned hashes") {
  for (const SceneHash& row : kScenes) {
    compare(row.what, hash_of(parse_scene(row.scene, row.what)), row.hash);
  }
}
