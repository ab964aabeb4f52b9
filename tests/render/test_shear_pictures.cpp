#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "render/drawn_region.h"
#include "render/layers/field_layer.h"
#include "render/layers/renderer.h"
#include "tests/render/optional_context.h"
#include "tests/render/picture.h"

// Pictures of a sheared box: images beyond the sheared edges are where they have slid to.

namespace clatter {

namespace {

// One disk at (3, 7.8) in a box of 10 x 8. The image above has slid by 2.5, so the image of the disk
// below the box is at (0.5, -0.2), and that above at (5.5, 15.8).
Snapshot one_disk() {
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 8.0);
  snapshot.slide = 4.0;
  snapshot.offset = 2.5;
  snapshot.diameter = 1.0;
  snapshot.positions = Vec2(3.0, 7.8);
  snapshot.velocities = Vec2(0.0, 1.0);
  return snapshot;
}

// Draws a snapshot on white. Calls look(at), where at(x, y) is the colour at a place of the box.
template <class Look>
void draw(Backend backend, const Snapshot& snapshot, View view, const Look& look) {
  constexpr Size kSize{640, 480};
  const auto context = open_context(backend);
  view.overlay = false;
  view.background = Rgb{255, 255, 255};
  Renderer renderer(context->gl(), 1);
  const Camera camera = renderer.fit(snapshot, kSize, view, {});
  const Projection projection{camera, kSize};
  const Canvas canvas(context->gl(), kSize);
  canvas.bind();
  renderer.draw(snapshot, camera, kSize, view, {});
  const Image image = canvas.read();
  look([&](double x, double y) {
    const Vec2 place = projection.pixels(Vec2(x, y));
    return pixel(image, static_cast<int>(place.x()),
                 image.size.height - 1 - static_cast<int>(place.y()));
  });
}

void check_disk(Backend backend) {
  draw(backend, one_disk(), {}, [](const auto& at) {
    const auto is_drawn = [&](double x, double y) {
      return difference(at(x, y), Colour{255, 255, 255}) > 20;
    };
    CHECK(is_drawn(3.0, 7.7));
    CHECK(is_drawn(0.5, 0.15));
    // Without the shear the image would be at (3, -0.2), and a slide the other way at (5.5, -0.2).
    CHECK_FALSE(is_drawn(3.0, 0.15));
    CHECK_FALSE(is_drawn(5.5, 0.15));
  });
}

// The density is 1 in the upper left quarter of the box. Its copy below the box lies between x = -2.5
// and 2.5.
void check_heatmap(Backend backend) {
  Snapshot snapshot = one_disk();
  snapshot.field = FieldMap{Quantity::Density, {2, 2}, {0.0, 0.0, 1.0, 0.0}};
  View view;
  view.field = Quantity::Density;
  view.field_style = FieldStyle::Cells;
  view.field_range = {ColourRange::Given, {0.0, 1.0}};
  view.opacity = 0.0;
  view.tiling = true;
  draw(backend, snapshot, view, [](const auto& at) {
    CHECK(difference(at(4.0, 7.0), at(6.0, 7.0)) > 50);
    CHECK(difference(at(1.0, -0.2), at(4.0, -0.2)) > 5);
    CHECK(difference(at(6.0, -0.2), at(4.0, -0.2)) <= 1);
    CHECK(difference(at(9.0, -0.2), at(1.0, -0.2)) <= 1);
  });
}

}  // namespace

// Smoothing over the border would mix cells that are not neighbours.
TEST_CASE("Shear pictures: the ends of a heatmap along y are no neighbours") {
  Snapshot snapshot = one_disk();
  snapshot.field = FieldMap{Quantity::Density, {2, 2}, {0.0, 0.0, 1.0, 0.0}};
  CHECK(plane_of(snapshot).periodic == std::array{true, false});
  snapshot.slide = snapshot.offset = 0.0;
  CHECK(plane_of(snapshot).periodic == std::array{true, true});
}

TEST_CASE("Shear pictures: OSMesa draws images below where they have slid to") {
  if (!open_or_skip(Backend::Osmesa)) return;
  check_disk(Backend::Osmesa);
  check_heatmap(Backend::Osmesa);
}

TEST_CASE("Shear pictures: EGL draws images below where they have slid to") {
  if (!open_or_skip(Backend::Egl)) return;
  check_disk(Backend::Egl);
  check_heatmap(Backend::Egl);
}

// A sphere at (0.3, 7.8, 0.2) at an edge of a box of 10 x 8 x 6, whose image above has slid by 2.5: the
// images that reach into the box by hand.
TEST_CASE("Shear pictures: images of a sphere at an edge of the box") {
  Snapshot snapshot;
  snapshot.box = Vec3(10.0, 8.0, 6.0);
  snapshot.slide = 4.0;
  snapshot.offset = 2.5;
  std::vector<Vec3> images;
  visit_images(snapshot, Vec3(0.3, 7.8, 0.2), 0.5,
               [&](const Vec3& image) { images.push_back(image); });
  const std::vector<Vec3> expected = {{0.3, 7.8, 0.2},  {0.3, 7.8, 6.2},  {10.3, 7.8, 0.2},
                                      {10.3, 7.8, 6.2}, {7.8, -0.2, 0.2}, {7.8, -0.2, 6.2}};
  CHECK(images.size() == expected.size());
  for (const Vec3& place : expected) {
    CAPTURE(place.transpose());
    CHECK(std::ranges::any_of(images, [&](const Vec3& i) { return i.isApprox(place, 1e-12); }));
  }
}

}  // namespace clatter
