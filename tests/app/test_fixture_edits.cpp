// Fixtures that the mouse draws.

#include <doctest/doctest.h>

#include "app/view/fixture_edits.h"
#include "engine/scene/scene_file.h"

namespace clatter::fixture_edits {

namespace {

const char* const kWalled = R"(
box.size = [20, 10]
particles.count = 5
walls.left.kind = "static"
walls.right.kind = "static"
walls.bottom.kind = "static"
walls.top.kind = "static"
)";

// The scene as a file gives it back.
Scene saved(const Scene& scene) {
  return with_settings(parse_scene(kWalled, ""), fixture_settings(scene));
}

}  // namespace

TEST_CASE("Fixture edits: a ball is drawn, moved, resized and removed") {
  Scene scene = with_ball(parse_scene(kWalled, ""), {5.004, 4.0}, {5.004, 6.0});
  REQUIRE(scene.obstacles.size() == 1);
  CHECK(scene.obstacles[0].centre == Vec2(5.0, 4.0));
  CHECK(scene.obstacles[0].radius == 2.0);
  CHECK(saved(scene).obstacles == scene.obstacles);
  scene = with_ball(scene, {5.5, 4.0}, {8.5, 5.0});  // inside
  CHECK(scene.obstacles[0].centre == Vec2(8.0, 5.0));
  CHECK(scene.obstacles[0].radius == 2.0);
  scene = with_ball(scene, {9.9, 5.0}, {9.0, 5.0});  // at the rim
  CHECK(scene.obstacles[0].centre == Vec2(8.0, 5.0));
  CHECK(scene.obstacles[0].radius == 1.0);
  CHECK_FALSE(without_fixture_at(scene, {10.0, 5.0}));
  REQUIRE(without_fixture_at(scene, {8.5, 5.0}).has_value());
  CHECK(without_fixture_at(scene, {8.5, 5.0})->obstacles.empty());
  CHECK(saved(*without_fixture_at(scene, {8.5, 5.0})).obstacles.empty());
}

TEST_CASE("Fixture edits: a wall is drawn, gets a hole, moves and is removed") {
  Scene scene = with_wall(parse_scene(kWalled, ""), {7.0, 0.2}, {7.3, 6.0});
  REQUIRE(scene.partitions.size() == 1);
  CHECK(scene.partitions[0].axis == Axis::X);
  CHECK(scene.partitions[0].position == 7.0);
  // It is closed from the floor to the end of the line.
  CHECK(scene.partitions[0].holes == std::vector<Hole>{{{6.0}, {10.0}}});
  CHECK(saved(scene).partitions == scene.partitions);
  scene = with_wall(scene, {7.2, 2.0}, {7.1, 4.0});
  REQUIRE(scene.partitions[0].holes.size() == 2);
  CHECK(scene.partitions[0].holes[1] == Hole{{2.0}, {4.0}});
  scene = with_wall(scene, {7.2, 1.0}, {12.0, 1.1});
  CHECK(scene.partitions[0].position == 12.0);
  CHECK(scene.partitions.size() == 1);
  CHECK_FALSE(without_fixture_at(scene, {7.0, 5.0}));
  CHECK(without_fixture_at(scene, {12.3, 5.0})->partitions.empty());
  scene = with_wall(scene, {1.0, 8.0}, {19.9, 8.2});
  REQUIRE(scene.partitions.size() == 2);
  CHECK(scene.partitions[1].axis == Axis::Y);
  CHECK(scene.partitions[1].holes == std::vector<Hole>{{{0.0}, {1.0}}});
}

}  // namespace clatter::fixture_edits
