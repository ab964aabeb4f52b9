#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "engine/scene/change_dimension.h"
#include "engine/scene/scene_file.h"

namespace clatter {

namespace {

using Keys = std::vector<std::string>;

// Spheres with all keys that disks do not have.
Scene deep_scene() {
  return parse_scene(R"(
[box]
size = [10.0, 8.0, 6.0]
[particles]
count = 90
friction = 0.5
[walls]
left = { kind = "driven", drive_speed = 1.0 }
right = { kind = "static" }
back = { kind = "thermal", temperature = 2.0 }
front = { kind = "static" }
[gravity]
acceleration = [0.1, -0.2, 0.3]
[measure]
fields = ["density", "temperature_z", "velocity"]
cells = [10, 8, 6]
profile_axis = "z"
observables = ["plane_current", "probe", "velocity_distribution", "radial_distribution_profile"]
plane_current = { axis = "z" }
probe = { lower = [1.0, 2.0, 3.0] }
velocity_distribution = { upper = [4.0, 4.0, 4.0] }
radial_distribution_profile = { axis = "z" }
[view]
colour_by = "depth"
field = "temperature_z"
azimuth = 70.0
slab = { axis = "y", from = 1.0, to = 3.0 }
slices = [{ axis = "x", position = 2.0 }]
volume = 0.5
camera = [{ time = 1.0, centre = [1.0, 2.0, 3.0] }]
[[change]]
time = 3.0
set = { "walls.back.temperature" = 1.0, "particles.restitution" = 0.8 }
[[change]]
time = 4.0
set = { "gravity.acceleration" = [0.0, 0.0, 1.0] }
)",
                     "deep.toml");
}

}  // namespace

TEST_CASE("Change of dimension: spheres become disks, without the keys of z") {
  const auto [disks, removed] = change_dimension(deep_scene(), 2);
  CHECK(removed == Keys{"walls.back", "walls.front", "gravity.acceleration along z",
                        "measure.profile_axis", "measure.plane_current.axis",
                        "measure.radial_distribution_profile.axis",
                        "region of measure.velocity_distribution", "region of measure.probe",
                        "measure.fields", "view.colour_by", "view.field", "view.slab",
                        "view.slices", "view.volume", "view.camera", "change"});
  // 90 disks fill 90 pi/6 / 480 = 0.0982 of an area of 720, in the ratio of 10 to 8.
  CHECK(disks.box == VecX(Vec2(30.0, 24.0)));
  CHECK(disks.particles.count == 90);
  CHECK(disks.particles.inertia == 0.5);
  CHECK(*disks.gravity == VecX(Vec2(0.1, -0.2)));
  CHECK(disks.walls[kLeft]->drive_speed == 1.0);
  CHECK(disks.measure.cells == std::vector<int>{10, 8});
  CHECK(disks.measure.fields.size() == 3);  // density and two components of the velocity
  REQUIRE(disks.changes.size() == 1);
  CHECK(disks.changes[0].set.size() == 1);
  // Its file can be read.
  CHECK(parse_scene(scene_to_toml(disks), "disks.toml").dimension() == 2);
}

TEST_CASE("Change of dimension: disks become spheres that fill the same share of the box") {
  Scene scene = load_scene("vibrated");
  scene.gravity = Vec2(0.0, -0.5);
  scene.view.opacity = 0.5;
  CHECK(change_dimension(scene, 3).removed.empty());
  scene.view.tiling = true;
  const auto [spheres, removed] = change_dimension(scene, 3);
  CHECK(removed == Keys{"view.tiling"});
  CHECK_FALSE(spheres.view.tiling);
  CHECK(spheres.view.opacity == 0.5);
  CHECK(spheres.particles.count == scene.particles.count);
  CHECK(spheres.box.y() == spheres.box.z());
  CHECK(spheres.box.x() / spheres.box.y() == doctest::Approx(20.0 / 25.0).epsilon(0.02));
  const double volume = spheres.particles.count * M_PI / 6.0;
  CHECK(volume / spheres.box.prod() == doctest::Approx(scene.packing_fraction()).epsilon(0.04));
  CHECK(*spheres.gravity == VecX(Vec<3>(0.0, -0.5, 0.0)));
  CHECK_FALSE(spheres.walls[kBack]);
  CHECK(spheres.particles.inertia == 0.4);
  CHECK(parse_scene(scene_to_toml(spheres), "spheres.toml").dimension() == 3);
}

TEST_CASE("Change of dimension: every scene of the gallery has one of spheres") {
  for (const EmbeddedFile& file : embedded_scenes()) {
    CAPTURE(file.name);
    const Scene scene = load_gallery_scene(file);
    const auto [spheres, removed] = change_dimension(scene, 5 - scene.dimension());
    CHECK(spheres.dimension() == 5 - scene.dimension());
    CHECK(spheres.particles.count == scene.particles.count);
    CHECK(spheres.packing_fraction() < kMostFilled + 0.02);
    CHECK(spheres.particles.start.layout != Layout::File);
  }
}

// The sides are rounded to tenths of the unit: 1 % of the fraction.
TEST_CASE("Change of dimension: a mixture fills the same share of the box") {
  const Scene disks = parse_scene(R"(box.size = [30, 20]
      species = [{ name = "a", count = 60 }, { name = "b", count = 20, diameter = 3.0 }])",
                                  "mixture.toml");
  const Scene spheres = change_dimension(disks, 3).scene;
  const double volumes = std::numbers::pi / 6.0 * (60.0 + 20.0 * 27.0);
  CHECK(disks.packing_fraction() == doctest::Approx(0.25 * std::numbers::pi * 240.0 / 600.0));
  CHECK(volumes / spheres.box.prod() == doctest::Approx(disks.packing_fraction()).epsilon(0.02));
  CHECK(spheres.species[1].mass_in(3) == 27.0);
  CHECK(change_dimension(spheres, 2).scene.species == disks.species);
}

}  // namespace clatter
