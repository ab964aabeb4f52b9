#include <doctest/doctest.h>

#include <cmath>

#include "render/layers/field_layer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

constexpr Size kFieldSize{60, 40};
constexpr Colour kGap = {0xff, 0x00, 0x00};

// The field over a picture of 60x40 pixels.
Image draw(const Gl& gl, const Vec2& box, std::vector<int> cells, std::vector<double> values,
           FieldStyle style, bool periodic = true) {
  Snapshot snapshot;
  snapshot.box = box;
  if (!periodic) {
    for (Side side : {kLeft, kRight, kBottom, kTop}) snapshot.walls[side] = Wall{};
  }
  snapshot.field = FieldMap{Quantity::Density, std::move(cells), std::move(values)};
  const Canvas canvas = blank_canvas(gl, kFieldSize);
  const Projection projection{{0.5 * box, box.x()}, kFieldSize};
  FieldLayer(gl).draw(snapshot, projection, {colour_map(Palette::Inferno)}, style,
                      style == FieldStyle::Cells ? kGap : Colour{0, 0, 0, 0});
  return canvas.read();
}

}  // namespace

TEST_CASE("Field layer: each cell has its colour up to its edges, and a gap is hatched") {
  const auto context = open_context(Backend::Auto);
  const std::vector<double> values = {0.0, 0.2, 0.4, 0.6, std::nan(""), 1.0};
  const ColourScale scale{colour_map(Palette::Inferno)};
  const Image image = draw(context->gl(), {3.0, 2.0}, {3, 2}, values, FieldStyle::Cells);
  int hatched = 0, bare = 0;
  for (int y = 0; y < kFieldSize.height; ++y) {
    for (int x = 0; x < kFieldSize.width; ++x) {
      const double value = values[3 * (1 - y / 20) + x / 20];
      if (!std::isnan(value)) REQUIRE(pixel(image, x, y) == scale(value));
      // The gap, without its border.
      if (!std::isnan(value) || x < 21 || x > 38 || y < 1 || y > 18) continue;
      bare += pixel(image, x, y) == kDarkTheme.background;
      hatched += difference(pixel(image, x, y), kGap) < 80;
    }
  }
  CHECK(bare > 50);
  CHECK(hatched > 20);
}

TEST_CASE("Field layer: a smooth field has no steps") {
  const auto context = open_context(Backend::Auto);
  std::vector<double> values;
  for (int i = 0; i < 24; ++i) values.push_back(i * 7 % 24 / 24.0);  // a cell is 10 pixels wide
  const auto largest_step = [&](FieldStyle style) {
    const Image image = draw(context->gl(), {6.0, 4.0}, {6, 4}, values, style);
    int largest = 0;
    for (int x = 1; x < kFieldSize.width; ++x) {
      largest = std::max(largest, difference(pixel(image, x, 20), pixel(image, x - 1, 20)));
    }
    return largest;
  };
  CHECK(largest_step(FieldStyle::Cells) > 40);
  CHECK(largest_step(FieldStyle::Smooth) <= 8);
}

TEST_CASE("Field layer: a smooth field fades to the ground where it has no values") {
  const auto context = open_context(Backend::Auto);
  std::vector<double> values(60, std::nan(""));
  for (std::size_t row = 0; row < 6; ++row) values[10 * row] = values[10 * row + 1] = 1.0;
  const Image image = draw(context->gl(), {10.0, 6.0}, {10, 6}, values, FieldStyle::Smooth, false);
  const Colour full = colour_map(Palette::Inferno).back();
  CHECK(difference(pixel(image, 1, 20), full) < 60);
  for (int x = 1; x < kFieldSize.width; ++x) {
    CHECK(pixel(image, x, 20).red <= pixel(image, x - 1, 20).red);
  }
  for (int x = 36; x < kFieldSize.width; ++x) REQUIRE(pixel(image, x, 20) == kDarkTheme.background);
}

TEST_CASE("Field layer: a smooth field continues beyond a periodic border only") {
  const auto context = open_context(Backend::Auto);
  std::vector<double> values(24, 0.0);
  for (std::size_t row = 0; row < 4; ++row) values[6 * row] = 1.0;
  for (const bool periodic : {false, true}) {
    const Image image =
        draw(context->gl(), {6.0, 4.0}, {6, 4}, values, FieldStyle::Smooth, periodic);
    CHECK((pixel(image, kFieldSize.width - 1, 20).red > 60) == periodic);
  }
}

}  // namespace clatter
