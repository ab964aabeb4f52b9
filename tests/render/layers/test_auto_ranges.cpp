#include <doctest/doctest.h>

#include <cmath>

#include "render/contrast_maps.h"
#include "render/layers/auto_ranges.h"
#include "render/layers/renderer.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

// The central colour of a box with a field of one cell with this `value`.
Colour field_colour(Renderer& renderer, const Gl& gl, const View& view, double value,
                    bool whole_window, AutoRanges& ranges) {
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 10.0);
  snapshot.field = FieldMap{*view.field, {1, 1}, {value}, whole_window};
  constexpr Size kSize{100, 100};
  const Canvas canvas(gl, kSize);
  canvas.bind();
  renderer.draw(snapshot, {{5.0, 5.0}, 10.0}, kSize, view, {}, ranges.legends(snapshot, view));
  return pixel(canvas.read(), 50, 50);
}

View view_of(Field field) {
  View view;
  view.colour_by = ColourBy::None;
  view.field = field;
  view.overlay = false;
  return view;
}

}  // namespace

TEST_CASE("Automatic ranges: the colours of a heatmap follow, or are locked, or are given") {
  const auto context = open_context(Backend::Auto);
  const ColourMap map = field_map(FieldPalette::Blue, kDarkTheme.background);
  View view = view_of(Quantity::Temperature);
  const auto colours = [&] {
    Renderer renderer(context->gl());
    AutoRanges ranges;
    std::vector<Colour> seen;
    seen.push_back(field_colour(renderer, context->gl(), view, 0.1, false, ranges));
    seen.push_back(field_colour(renderer, context->gl(), view, 1.0, true, ranges));
    seen.push_back(field_colour(renderer, context->gl(), view, 100.0, true, ranges));
    seen.push_back(field_colour(renderer, context->gl(), view, 0.5, true, ranges));
    return seen;
  };
  const Colour top = map.back(), middle = map[8];
  CHECK(colours() == std::vector{top, top, top, top});
  view.field_range = {ColourRange::Locked};
  CHECK(colours() == std::vector{top, top, top, middle});  // at 1, the first complete window
  view.field_range = {ColourRange::Given, {-1.0, 2.0}};
  CHECK(colours()[3] == middle);
}

TEST_CASE(
    "Automatic ranges: a heatmap without any value, as before the first average, is not drawn") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  const View view = view_of(Quantity::Density);
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 10.0);
  const auto drawn = [&](double first, double second) {
    snapshot.field = FieldMap{Quantity::Density, {2, 1}, {first, second}};
    return draw(renderer, context->gl(), snapshot, {{5.0, 5.0}, 10.0}, {100, 100}, view);
  };
  const Image none = drawn(std::nan(""), std::nan(""));
  for (int x = 5; x < 95; ++x) REQUIRE(pixel(none, x, 50) == kDarkTheme.background);
  CHECK(difference(none, drawn(1.0, std::nan(""))) > 20);
}

TEST_CASE("Automatic ranges: fixed ones stop following, but given ones still hold") {
  const auto context = open_context(Backend::Auto);
  View view = view_of(Quantity::Temperature);
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 10.0);
  snapshot.field = FieldMap{*view.field, {1, 1}, {0.97}, true};
  const RangeEnds extents = extents_of(snapshot, view);
  CHECK(extents.field == 0.97);
  CHECK(extents.disks == 0.0);
  CHECK(extents.arrows == 0.0);
  Renderer renderer(context->gl());
  AutoRanges ranges;
  ranges.fix({.field = 1.0});
  const ColourMap map = field_map(FieldPalette::Blue, kDarkTheme.background);
  const Colour top = map.back(), middle = map[8];
  CHECK(field_colour(renderer, context->gl(), view, 100.0, true, ranges) == top);
  CHECK(field_colour(renderer, context->gl(), view, 0.5, true, ranges) == middle);
  view.field_range = {ColourRange::Locked};
  CHECK(field_colour(renderer, context->gl(), view, 0.5, true, ranges) == middle);
  view.field_range = {ColourRange::Given, {0.0, 0.5}};
  CHECK(field_colour(renderer, context->gl(), view, 0.5, true, ranges) == top);
  // Each range has its own end. Without an end it is 1.
  view.field_range = {};
  CHECK(AutoRanges().legends(snapshot, view).field->range == "auto");
  ranges.fix({.disks = 8.0, .field = 2.0, .arrows = 8.0});
  CHECK(ranges.legends(snapshot, view).field->range == "auto");
  view.field_range = {ColourRange::Locked};
  CHECK(ranges.legends(snapshot, view).field->range == "locked");
  CHECK(field_colour(renderer, context->gl(), view, 1.0, true, ranges) == middle);
  ranges.fix({});
  CHECK(field_colour(renderer, context->gl(), view, 0.5, true, ranges) == middle);
}

TEST_CASE("Automatic ranges: another field locks one of its own") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  AutoRanges ranges;
  View view = view_of(Quantity::Temperature);
  view.field_range = {ColourRange::Locked};
  field_colour(renderer, context->gl(), view, 100.0, true, ranges);
  view.field = Quantity::Density;
  CHECK(field_colour(renderer, context->gl(), view, 1.0, true, ranges) ==
        field_map(FieldPalette::Blue, kDarkTheme.background).back());
}

TEST_CASE(
    "Automatic ranges: magnitudes have the palette, its end far from zero; signed fields have two "
    "ends") {
  const auto context = open_context(Backend::Auto);
  const auto colour = [&](Field field, double value) {
    Renderer renderer(context->gl());
    AutoRanges ranges;
    View view = view_of(field);
    view.field_palette = FieldPalette::Inferno;
    return field_colour(renderer, context->gl(), view, value, true, ranges);
  };
  const Colour end = field_map(FieldPalette::Inferno, kDarkTheme.background).back();
  CHECK(colour(Quantity::Density, 1.0) == end);
  CHECK(colour(Field(Quantity::Stress, 0, 0), -1.0) == end);
  CHECK(colour(Quantity::Dissipation, -1.0) == end);
  const ColourMap signs = signed_field_map(kDarkTheme.background);
  for (const Field field : {Field(Quantity::Velocity, 0), Field(Quantity::Stress, 0, 1),
                            Field(Quantity::HeatFlux, 1), Field(Quantity::Spin)}) {
    CHECK(colour(field, 1.0) == signs.back());
    CHECK(colour(field, -1.0) == signs.front());
  }
}

TEST_CASE("Automatic ranges: several gases have one range, up to the largest of their values") {
  View view = view_of(Quantity::Temperature);
  view.arrows = Quantity::Velocity;
  view.colour_by = ColourBy::Speed;
  Snapshot slow;
  slow.box = Vec2(10.0, 10.0);
  slow.positions = Vectors::Constant(2, 1, 5.0);
  slow.velocities = Vectors::Constant(2, 1, 0.1);
  slow.field = FieldMap{*view.field, {1, 1}, {0.5}, true};
  slow.arrows = ArrowMap{.cell = Vec2(2.0, 2.0), .arrows = {{Vec2(5.0, 5.0), Vec2(0.1, 0.0)}}};
  Snapshot fast = slow;
  fast.velocities *= 100.0;
  fast.field->values = {50.0};
  fast.arrows->arrows[0].value *= 10.0;
  for (const auto& gases : {std::vector<const Snapshot*>{&slow, &fast}, {&fast, &slow}}) {
    const Legends both = AutoRanges().legends(gases, view);
    const Legends alone = AutoRanges().legends(fast, view);
    CHECK(both.disks->scale.high == alone.disks->scale.high);
    CHECK(both.field->scale.high == alone.field->scale.high);
    CHECK(both.arrows->pixels == alone.arrows->pixels);
  }
  CHECK(AutoRanges().legends(slow, view).field->scale.high < 1.0);
}

TEST_CASE("Automatic ranges: colours of species have a legend of species instead of a bar") {
  Snapshot snapshot = driven_box();
  View view;
  view.colour_by = ColourBy::Species;
  CHECK_FALSE(AutoRanges().legends(snapshot, view).species);
  snapshot.species = {species_of("small"), species_of("large", 2.0, Rgb{9, 8, 7})};
  const Legends legends = AutoRanges().legends(snapshot, view);
  CHECK_FALSE(legends.disks);
  REQUIRE(legends.species);
  CHECK(legends.species->species == snapshot.species);
  CHECK(legends.species->colours[1] == Colour{9, 8, 7});
  CHECK(extents_of(snapshot, view).disks == 0.0);
  view.colour_by = ColourBy::Speed;
  CHECK_FALSE(AutoRanges().legends(snapshot, view).species);
}

}  // namespace clatter
