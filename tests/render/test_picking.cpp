#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "render/picking.h"

namespace clatter {

namespace {

constexpr Size kPickingSize{800, 600};

// A box that is periodic along x, with spheres at random places; some overlap.
Snapshot some_spheres() {
  Snapshot snapshot;
  snapshot.box = Vec3(6.0, 5.0, 4.0);
  for (const Side side : {kBottom, kTop, kBack, kFront}) snapshot.walls[side] = Wall{};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  snapshot.positions.resize(3, 40);
  for (Eigen::Index i = 0; i < 40; ++i) {
    snapshot.positions.col(i) =
        Vec3(6.0 * share(random), 0.5 + 4.0 * share(random), 0.5 + 3.0 * share(random));
  }
  return snapshot;
}

// The sphere of a point by its nearest periodic image; -1: none.
int sphere_of(const Snapshot& snapshot, const Vec3& point) {
  for (Eigen::Index i = 0; i < snapshot.positions.cols(); ++i) {
    Vec3 away = point - snapshot.positions.col(i);
    away.x() -= 6.0 * std::round(away.x() / 6.0);
    if (away.norm() < 0.5) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

// Points every 1/500 of a diameter along the line of sight, from the viewer on.
TEST_CASE("Picking: the nearest image of a particle is across the periodic border only") {
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 8.0);
  snapshot.walls[kBottom] = snapshot.walls[kTop] = Wall{};
  CHECK(nearest_image(snapshot, Vec2(9.7, 0.6), Vec2(0.4, 7.4)) == Vec2(10.4, 7.4));
  CHECK(nearest_image(snapshot, Vec2(0.4, 7.4), Vec2(9.7, 0.6)).isApprox(Vec2(-0.3, 0.6)));
  CHECK(nearest_image(snapshot, Vec2(5.0, 4.0), Vec2(5.5, 3.0)) == Vec2(5.5, 3.0));
  CHECK(nearest_image(some_spheres(), Vec3(0.2, 1.0, 1.0), Vec3(5.8, 2.0, 3.0))
            .isApprox(Vec3(-0.2, 2.0, 3.0)));
}

TEST_CASE("Picking: the sphere in front is the first that a line of sight meets") {
  const Snapshot snapshot = some_spheres();
  const Slab slab{.axis = Axis::Z, .from = 0.8, .to = 2.6};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int hits = 0, hidden = 0;
  for (const double view_angle : {0.0, 40.0}) {
    const Camera camera{{3.0, 2.5}, 9.0, {2.0, 50.0, -25.0, view_angle, {0.02, -0.01}}};
    const Eye eye({camera, kPickingSize});
    for (const bool cut : {false, true}) {
      for (int k = 0; k < 100; ++k) {
        const Vec2 pixel(200.0 + 400.0 * share(random), 100.0 + 400.0 * share(random));
        const Vec2 place = (pixel - eye.origin()) / eye.scale();
        const Vec3 target = eye.world({place.x(), place.y(), 0.0});
        const Vec3 from = view_angle > 0.0 ? eye.world({0.0, 0.0, 1.0 / eye.inverse_distance()})
                                           : eye.world({place.x(), place.y(), 20.0});
        const Vec3 along = (target - from).normalized();
        int first = -1, all = 0;
        for (double s = 0.0; s < 40.0; s += 0.002) {
          const Vec3 point = from + s * along;
          if (point.x() < 0.0 || point.x() > 6.0) continue;
          if (cut && (point.z() < slab.from || point.z() > slab.to)) continue;
          const int sphere = sphere_of(snapshot, point);
          if (sphere < 0) continue;
          if (first < 0) first = sphere;
          all += sphere != first ? 1 : 0;
        }
        if (first < 0) continue;  // perhaps a faint part beyond the border
        ++hits;
        hidden += all > 0 ? 1 : 0;
        CAPTURE(pixel.x());
        CAPTURE(pixel.y());
        const auto picked =
            particle_at(snapshot, eye, pixel, cut ? std::optional(slab) : std::nullopt);
        REQUIRE(picked);
        CHECK(*picked == static_cast<std::size_t>(first));
      }
    }
  }
  CHECK(hits > 100);
  CHECK(hidden > 50);
}

TEST_CASE("Picking: a faint part beyond a periodic border is picked where nothing else is") {
  Snapshot snapshot;
  snapshot.box = Vec3(6.0, 6.0, 6.0);
  snapshot.positions = Vec3(0.2, 3.0, 3.0);
  const Eye eye({{{3.0, 3.0}, 8.0, {.z = 3.0}}, kPickingSize});  // 100 pixels a diameter, 3 at 400
  CHECK(particle_at(snapshot, eye, {400.0 - 320.0, 300.0}, {}) == 0u);
  CHECK(particle_at(snapshot, eye, {400.0 + 290.0, 300.0}, {}) == 0u);
  CHECK_FALSE(particle_at(snapshot, eye, {400.0 - 335.0, 300.0}, {}));
  CHECK_FALSE(particle_at(snapshot, eye, {400.0, 300.0}, {}));
}

TEST_CASE("Picking: a sphere behind a body is not picked, and one in front of it is") {
  for (const double view_angle : {0.0, 40.0}) {
    for (const bool ball : {true, false}) {
      Snapshot snapshot;
      snapshot.box = Vec3(6.0, 6.0, 6.0);
      for (auto& wall : snapshot.walls) wall = Wall{};
      Obstacle body;
      body.kind = ball ? ObstacleKind::Ball : ObstacleKind::Box;
      body.centre = Vec3(3.0, 3.0, 3.0);
      body.from = Vec3(2.0, 2.0, 2.0);
      body.to = Vec3(4.0, 4.0, 4.0);
      snapshot.obstacles = {body};
      const Eye eye({{{3.0, 3.0}, 8.0, {.z = 3.0, .view_angle = view_angle}}, kPickingSize});
      snapshot.positions = Vec3(3.0, 3.0, 1.0);
      CHECK_FALSE(particle_at(snapshot, eye, {400.0, 300.0}, {}));
      snapshot.positions = Vec3(3.0, 3.0, 5.0);
      CHECK(particle_at(snapshot, eye, {400.0, 300.0}, {}) == 0u);
      // A slab in front of the body cuts it away.
      snapshot.positions = Vec3(3.0, 3.0, 0.8);
      CHECK(particle_at(snapshot, eye, {400.0, 300.0}, Slab{Axis::Z, 0.0, 1.5}) == 0u);
    }
  }
}

TEST_CASE("Picking: nothing behind the viewer is picked, and a disk needs no depth") {
  Snapshot snapshot;
  snapshot.box = Vec3(6.0, 6.0, 60.0);
  for (auto& wall : snapshot.walls) wall = Wall{};
  snapshot.positions.resize(3, 2);
  snapshot.positions << 3.0, 3.0, 3.0, 3.0, 50.0, 10.0;
  // Half the width of 8 under 45 degrees: the viewer is 4 before z = 12.
  const Eye eye({{{3.0, 3.0}, 8.0, {.z = 12.0, .view_angle = 90.0}}, kPickingSize});
  CHECK(particle_at(snapshot, eye, {400.0, 300.0}, {}) == 1u);

  Snapshot disks;
  disks.box = Vec2(6.0, 6.0);
  disks.positions.resize(2, 2);
  disks.positions << 1.0, 4.0, 2.0, 5.0;
  const Eye above({{{3.0, 3.0}, 8.0}, kPickingSize});
  CHECK(particle_at(disks, above, {400.0 + 149.0, 300.0 + 200.0}, {}) == 1u);
  CHECK_FALSE(particle_at(disks, above, {400.0 + 151.0, 300.0 + 200.0}, {}));
}

TEST_CASE("Picking: of particles of different sizes each is picked inside its own radius") {
  Snapshot disks;
  disks.box = Vec2(12.0, 12.0);
  disks.diameter = 4.0;
  disks.positions = as_columns<2>({{4.0, 5.0}, {6.4, 5.0}});
  disks.grains = {{.radius = 2.0}, {.radius = 0.4, .species = 1}};
  const Eye above({{{4.0, 5.0}, 8.0}, kPickingSize});  // 100 pixels a unit, the first at 400, 300
  CHECK(particle_at(disks, above, {400.0 + 199.0, 300.0}, {}) == 0u);
  CHECK(particle_at(disks, above, {400.0 + 201.0, 300.0}, {}) == 1u);
  CHECK(particle_at(disks, above, {400.0 + 279.0, 300.0}, {}) == 1u);
  CHECK_FALSE(particle_at(disks, above, {400.0 + 281.0, 300.0}, {}));
  CHECK_FALSE(particle_at(disks, above, {400.0 + 240.0, 300.0 + 41.0}, {}));

  // A small sphere before a large one, seen along z.
  Snapshot spheres = disks;
  spheres.box = Vec3(12.0, 12.0, 12.0);
  spheres.positions = as_columns<3>({{4.0, 5.0, 6.0}, {4.5, 5.0, 9.0}});
  const Eye before({{{4.0, 5.0}, 8.0, {.z = 6.0}}, kPickingSize});
  CHECK(particle_at(spheres, before, {400.0 + 50.0 + 39.0, 300.0}, {}) == 1u);
  CHECK(particle_at(spheres, before, {400.0 + 50.0 + 41.0, 300.0}, {}) == 0u);
  CHECK(particle_at(spheres, before, {400.0 - 199.0, 300.0}, {}) == 0u);
  CHECK_FALSE(particle_at(spheres, before, {400.0 - 201.0, 300.0}, {}));
  spheres.positions(2, 1) = 3.0;  // behind
  CHECK(particle_at(spheres, before, {400.0 + 50.0, 300.0}, {}) == 0u);
  // Across a periodic border, only as far as its own radius.
  spheres.positions = as_columns<3>({{1.0, 5.0, 6.0}, {1.0, 9.0, 6.0}});
  const Eye border({{{0.0, 5.0}, 16.0, {.z = 6.0}}, kPickingSize});  // 50 pixels a unit
  CHECK(particle_at(spheres, border, {400.0 + 50.0 * 12.5, 300.0}, {}) == 0u);
  CHECK_FALSE(particle_at(spheres, border, {400.0 - 50.0 * 0.5, 300.0 + 50.0 * 4.0}, {}));
}

}  // namespace clatter
