#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "render/contrast_maps.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

constexpr Size kVolumeSize{240, 180};
constexpr double kExtinction = 0.3;

/// A box of 4 x 4 x 4 without particles, with a field of equal cells.
Snapshot box_with(double value, std::vector<int> cells = {3, 4, 5}) {
  Snapshot snapshot;
  snapshot.box = Vec3(4.0, 4.0, 4.0);
  snapshot.positions.resize(3, 0);
  snapshot.velocities.resize(3, 0);
  const auto count = static_cast<std::size_t>(cells[0] * cells[1] * cells[2]);
  snapshot.field = FieldMap{Quantity::Density, std::move(cells), std::vector<double>(count, value)};
  return snapshot;
}

View volume_view() {
  View view;
  view.colour_by = ColourBy::None;
  view.field = Quantity::Density;
  view.field_range = {ColourRange::Given, {0.0, 1.0}};
  view.background = Rgb{0, 0, 0};
  view.overlay = false;
  view.volume = kExtinction;
  return view;
}

/// 40 pixels a unit at the centre of the box, which is at the centre of the picture.
Camera camera_from(double azimuth, double elevation, double view_angle = 0.0) {
  return {{2.0, 2.0},
          6.0,
          {.z = 2.0, .azimuth = azimuth, .elevation = elevation, .view_angle = view_angle}};
}

Image draw_volume(const Snapshot& snapshot, const Camera& camera, const View& view, int samples = 1,
                  bool transparent = false) {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl(), samples, transparent);
  return draw(renderer, context->gl(), snapshot, camera, kVolumeSize, view);
}

/// sRGB of linear light (IEC 61966-2-1).
std::uint8_t srgb(double light) {
  const double c = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * c));
}

/// Light of `above` with an opacity over light of `below`.
Colour blend(Colour above, double opacity, Colour below = {0, 0, 0}) {
  const auto channel = [&](std::uint8_t a, std::uint8_t b) {
    return srgb(opacity * linear_light(a) + (1.0 - opacity) * linear_light(b));
  };
  return {channel(above.red, below.red), channel(above.green, below.green),
          channel(above.blue, below.blue)};
}

double opacity_of(double depth) {
  return 1.0 - std::exp(-depth);
}

// The map of the default palette on black, and its colours at half the range and at its end.
const ColourMap kMap = field_map(FieldPalette::Blue, {0, 0, 0});
const Colour kMiddle = kMap[8], kEnd = kMap.back();

}  // namespace

TEST_CASE("Volume layer: a uniform field has the opacity 1 - exp(-k L) of each ray") {
  const Snapshot half = box_with(0.5), full = box_with(1.0), beyond = box_with(7.0);
  const View view = volume_view();
  // A pixel beside the centre, seen along z: L = 4. At half the range k is half as large.
  const Camera front = camera_from(0.0, 0.0);
  CHECK(difference(pixel(draw_volume(half, front, view), 130, 85),
                   blend(kMiddle, opacity_of(0.5 * kExtinction * 4.0))) <= 1);
  CHECK(difference(pixel(draw_volume(full, front, view), 130, 85),
                   blend(kEnd, opacity_of(kExtinction * 4.0))) <= 1);
  CHECK(difference(pixel(draw_volume(beyond, front, view), 130, 85),
                   blend(kEnd, opacity_of(kExtinction * 4.0))) <= 1);
  // Along the diagonal of a square, at a distance x of it: L = 4 sqrt(2) - 2 x.
  const double diagonal = 4.0 * std::sqrt(2.0) - 2.0 * (20.5 / 40.0);
  CHECK(difference(pixel(draw_volume(full, camera_from(45.0, 0.0), view), 140, 85),
                   blend(kEnd, opacity_of(kExtinction * diagonal))) <= 1);
  // In a perspective the ray is inclined: the viewer is 3 in front of the centre.
  const double inclined = 4.0 * std::hypot(3.0, 45.5 / 40.0, 45.5 / 40.0) / 3.0;
  CHECK(difference(pixel(draw_volume(full, camera_from(0.0, 0.0, 90.0), view), 74, 135),
                   blend(kEnd, opacity_of(kExtinction * inclined))) <= 1);
  // From a viewer in the box at z = 2 + 0.5/tan(45 deg), less the nearest 2 % of the distance.
  const Camera inside{{2.0, 2.0}, 1.0, {.z = 2.0, .view_angle = 90.0}};
  CHECK(difference(pixel(draw_volume(full, inside, view), 120, 90),
                   blend(kEnd, opacity_of(kExtinction * (2.0 + 0.98 * 0.5)))) <= 1);
  // A ray along an edge of cells: the centre of the pixel is at the centre of the box.
  const Camera shifted{{2.0 + 1.0 / 64.0, 2.0 + 1.0 / 64.0}, 7.5, {.z = 2.0}};  // 32 pixels a unit
  CHECK(difference(pixel(draw_volume(box_with(1.0, {4, 4, 4}), shifted, view), 119, 90),
                   blend(kEnd, opacity_of(kExtinction * 4.0))) <= 1);
  // Outside of the box there is nothing.
  CHECK(pixel(draw_volume(full, front, view), 30, 90) == Colour{0, 0, 0});
}

TEST_CASE("Volume layer: a slab cuts it") {
  View view = volume_view();
  view.slab = Slab{Axis::Z, 0.5, 2.0};
  const Image image = draw_volume(box_with(1.0), camera_from(0.0, 0.0), view);
  CHECK(difference(pixel(image, 130, 85), blend(kEnd, opacity_of(kExtinction * 1.5))) <= 1);
  view.slab = Slab{Axis::X, 2.0, 9.0};
  const Image right = draw_volume(box_with(1.0), camera_from(0.0, 0.0), view);
  CHECK(difference(pixel(right, 130, 85), blend(kEnd, opacity_of(kExtinction * 4.0))) <= 1);
  CHECK(pixel(right, 110, 85) == Colour{0, 0, 0});
}

TEST_CASE("Volume layer: a hot cell is at its place from every side") {
  // The cell x 2.67..4, y 0..1, z 0.8..1.6. Other cells are zero, or without a value.
  for (const double other : {0.0, std::nan("")}) {
    Snapshot snapshot = box_with(other);
    snapshot.field->values[2 + 3 * (0 + 4 * 1)] = 1.0;
    struct Side {
      double azimuth, elevation;
      Vec2 low, high;  // of the cell from the centre of the box, to the right and up
    };
    const double third = 4.0 / 3.0;
    for (const auto& [azimuth, elevation, low, high] :
         {Side{0.0, 0.0, {third - 0.667, -2.0}, {2.0, -1.0}},
          {180.0, 0.0, {-2.0, -2.0}, {0.667 - third, -1.0}},
          {90.0, 0.0, {0.4, -2.0}, {1.2, -1.0}},
          {0.0, 90.0, {third - 0.667, 0.4}, {2.0, 1.2}}}) {
      CAPTURE(azimuth);
      CAPTURE(elevation);
      const Image image = draw_volume(snapshot, camera_from(azimuth, elevation), volume_view());
      int wrong = 0;
      // Between the edges of the box, and not on a border of the cell.
      for (int y = 15; y < 165; y += 5) {
        for (int x = 45; x < 195; x += 5) {
          const Vec2 place((x + 0.5 - 120.0) / 40.0, (90.0 - y - 0.5) / 40.0);
          const bool lit =
              (place.array() > low.array()).all() && (place.array() < high.array()).all();
          wrong += (pixel(image, x, y).green > 20) != lit;
        }
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("Volume layer: it is in front of the sphere or slice where a ray ends") {
  Snapshot snapshot = box_with(1.0);
  snapshot.velocities = as_columns<3>({{1.0, 0.0, 0.0}});
  View view = volume_view(), without = view;
  without.field.reset();
  for (const double view_angle : {0.0, 40.0}) {
    CAPTURE(view_angle);
    const Camera front = camera_from(0.0, 0.0, view_angle);
    // Its foremost point is at z + 0.5.
    for (const double z : {3.5, 2.5, 0.5}) {
      CAPTURE(z);
      snapshot.positions = as_columns<3>({{2.0, 2.0, z}});
      const Colour sphere = pixel(draw_volume(snapshot, front, without), 120, 90);
      CHECK(sphere.green > 100);
      const double depth = kExtinction * (4.0 - z - 0.5);
      CHECK(difference(pixel(draw_volume(snapshot, front, view), 120, 90),
                       blend(kEnd, opacity_of(depth), sphere)) <= 1);
    }
    // A slice at z = 1, in a half of the box that is weaker than the half in front of it.
    Snapshot halves = box_with(1.0, {1, 1, 2});
    halves.field->values[0] = 0.5;
    View sliced = view;
    sliced.field_style = FieldStyle::Cells;
    sliced.slices = {{Axis::Z, 1.0}};
    CHECK(difference(pixel(draw_volume(halves, front, sliced), 120, 90),
                     blend(kEnd, opacity_of(kExtinction * 2.0),
                           blend(kMiddle, opacity_of(0.5 * kExtinction), kMiddle))) <= 1);
  }
}

TEST_CASE("Volume layer: a dense one hides spheres, and there are none outside of the box") {
  Snapshot snapshot = box_with(1.0);
  snapshot.positions = as_columns<3>({{4.0, 2.0, 1.0}});
  snapshot.velocities = as_columns<3>({{1.0, 0.0, 0.0}});
  View view = volume_view();
  view.volume = 20.0;
  const Image image = draw_volume(snapshot, camera_from(0.0, 0.0), view);
  CHECK(difference(pixel(image, 190, 90), kEnd) <= 1);
  CHECK(pixel(image, 205, 90) == Colour{0, 0, 0});
}

TEST_CASE("Volume layer: supersampling, motion blur and a missing background keep its light") {
  Snapshot snapshot = box_with(1.0);
  const Camera front = camera_from(0.0, 0.0);
  const double opacity = opacity_of(kExtinction * 4.0);
  const Colour expected = blend(kEnd, opacity);
  for (const double exposure : {0.0, 0.5}) {
    snapshot.exposure = exposure;
    for (const int samples : {1, 2}) {
      CAPTURE(exposure);
      CAPTURE(samples);
      CHECK(difference(pixel(draw_volume(snapshot, front, volume_view(), samples), 130, 85),
                       expected) <= 1);
      const Image clear =
          with_own_colours(draw_volume(snapshot, front, volume_view(), samples, true));
      Colour own = kEnd;
      own.alpha = static_cast<std::uint8_t>(std::lround(255.0 * opacity));
      CHECK(difference(pixel(clear, 130, 85), own) <= 2);
      CHECK(pixel(clear, 30, 85).alpha == 0);
    }
  }
}

}  // namespace clatter
