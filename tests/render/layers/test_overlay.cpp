#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "render/layers/overlay.h"
#include "tests/render/picture.h"

namespace clatter {

TEST_CASE("Overlay: it writes on pictures of any size, but not on the box or at the edge") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  for (Size size : {Size{1280, 720}, {1920, 1080}, {720, 720}, {640, 360}, {360, 640}}) {
    for (Vec2 box : {Vec2(20.0, 25.0), Vec2(60.0, 12.0), Vec2(20.0, 20.0)}) {
      CAPTURE(size.width);
      CAPTURE(box.x());
      Snapshot snapshot = driven_box();
      snapshot.box = box;
      snapshot.arrows = ArrowMap{Quantity::HeatFlux, box / 20.0, {{0.5 * box, Vec2(1.0, 0.0)}}};
      View view = view_with_field();
      view.arrows = Quantity::HeatFlux;
      const Camera camera = renderer.fit(snapshot, size, view, kText);
      const Image with = draw(renderer, context->gl(), snapshot, camera, size, view);
      view.overlay = false;
      const Image without = draw(renderer, context->gl(), snapshot, camera, size, view);

      const Projection projection{camera, size};
      // The box with its walls.
      const Vec2 wall = Vec2::Constant(wall_thickness(size));
      const Vec2 low = projection.pixels({0.0, 0.0}) - wall, high = projection.pixels(box) + wall;
      int written = 0, on_box = 0, at_edge = 0;
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          if (pixel(with, x, y) == pixel(without, x, y)) continue;
          ++written;
          const int up = size.height - 1 - y;
          on_box += x > low.x() && x < high.x() && up > low.y() && up < high.y();
          at_edge += std::min({x, y, size.width - 1 - x, size.height - 1 - y}) < 4;
        }
      }
      CHECK(written > 1000);
      CHECK(on_box == 0);
      CHECK(at_edge == 0);
    }
  }
}

TEST_CASE("Overlay: a heading above the box is as wide as the picture, one beside it is a column") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  const Size size{1280, 720};
  struct Heading {
    int begin, end;          // alone in the upper half beside the box
    double box_begin, room;  // left edge of the box, and from its right edge to the picture's
  };
  const auto heading_of = [&](Vec2 box) {
    Snapshot snapshot = driven_box();
    snapshot.box = box;
    View view;
    view.colour_by = ColourBy::None;
    const Camera camera = renderer.fit(snapshot, size, view, kText);
    const Image with = draw(renderer, context->gl(), snapshot, camera, size, view);
    view.overlay = false;
    const Image without = draw(renderer, context->gl(), snapshot, camera, size, view);
    int begin = size.width, end = 0;
    for (int y = 0; y < size.height / 2; ++y) {
      for (int x = 0; x < size.width; ++x) {
        if (pixel(with, x, y) == pixel(without, x, y)) continue;
        begin = std::min(begin, x);
        end = std::max(end, x);
      }
    }
    const Projection projection{camera, size};
    return Heading{begin, end, projection.pixels(Vec2(0.0, 0.0)).x(),
                   size.width - projection.pixels(box).x()};
  };
  constexpr int kUnit = 18;  // height of a line of text
  const Heading above = heading_of({60.0, 12.0});
  CHECK(above.begin < 2 * kUnit);
  CHECK(above.end > 20 * kUnit);
  // A column and its box are in the middle together.
  const Heading beside = heading_of({20.0, 25.0});
  CHECK(beside.end - beside.begin < 16 * kUnit);
  CHECK(beside.end - beside.begin > 11 * kUnit);
  CHECK(beside.end < beside.box_begin - kUnit);
  CHECK(beside.begin > 5 * kUnit);
  CHECK(beside.begin == doctest::Approx(beside.room - wall_thickness(size)).epsilon(0.06));
}

TEST_CASE(
    "Overlay: colour bars for which a small picture has no room stay out of the row of figures") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  const Size size{320, 240};
  constexpr int kRow = 28;  // height of figures and scale, with their distance from the edge
  Snapshot snapshot = driven_box();
  View view = view_with_field();
  const Camera camera = renderer.fit(snapshot, size, view, kText);
  const Image two = draw(renderer, context->gl(), snapshot, camera, size, view);
  view.field.reset();
  snapshot.field.reset();
  const Image one = draw(renderer, context->gl(), snapshot, camera, size, view);
  const auto row = one.rgba.end() - 4L * size.width * kRow;
  CHECK(std::equal(row, one.rgba.end(), two.rgba.end() - 4L * size.width * kRow));
  CHECK(std::any_of(row, one.rgba.end(), [&](unsigned char c) { return c > 128 && c < 255; }));
}

TEST_CASE("Overlay: a card covers the picture with its title, and fades out") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  const Snapshot snapshot = driven_box();
  for (const Size size : {Size{1280, 720}, {360, 640}}) {
    const Camera camera = renderer.fit(snapshot, size, View{}, kText);
    const auto letters = [&](double card) {
      const Canvas canvas(context->gl(), size);
      canvas.bind();
      OverlayText text = kText;
      text.card = card;
      renderer.draw(snapshot, camera, size, View{}, text);
      const Image image = canvas.read();
      int count = 0, beyond = 0;
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          const bool letter = difference(pixel(image, x, y), kDarkTheme.text) < 30;
          const bool middle = std::abs(2 * y - size.height) < size.height / 2;
          (middle ? count : beyond) += letter;
        }
      }
      return std::pair(count, beyond);
    };
    CHECK(letters(1.0).first > letters(0.0).first + 200);
    CHECK(letters(1.0).second < letters(0.0).second);
  }
  CHECK(card_opacity(3.0, 0.0) == 1.0);
  CHECK(card_opacity(3.0, 2.5) == 1.0);
  CHECK(card_opacity(3.0, 2.75) == doctest::Approx(0.5));
  CHECK(card_opacity(0.2, 0.0) == 1.0);
  CHECK(card_opacity(3.0, 3.0) == 0.0);
  CHECK(card_opacity(3.0, 9.0) == 0.0);
}

TEST_CASE("Overlay: a card has its title in large letters above its caption, which is broken") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  const Size size{640, 360};
  const Canvas canvas(context->gl(), size);
  canvas.bind();
  // Letters without descenders: rows without ink separate the lines.
  OverlayText text{"Hot", ""};
  for (int k = 0; k < 20; ++k) text.caption += "tether ";
  text.card = 1.0;
  renderer.draw(driven_box(), {{10.0, 12.5}, 40.0}, size, View{}, text);
  const Image image = canvas.read();
  struct Line {
    int top, bottom, left, right;
  };
  std::vector<Line> lines;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (difference(pixel(image, x, y), kDarkTheme.background) < 60) continue;
      if (lines.empty() || y > lines.back().bottom + 1) lines.push_back({y, y, x, x});
      lines.back().bottom = y;
      lines.back().left = std::min(lines.back().left, x);
      lines.back().right = std::max(lines.back().right, x);
    }
  }
  REQUIRE(lines.size() >= 3);
  const auto height = [&](std::size_t k) { return lines[k].bottom - lines[k].top; };
  CHECK(height(0) > 1.3 * height(1));
  CHECK(lines[0].right - lines[0].left < size.width / 4);
  CHECK(lines[1].right - lines[1].left > size.width / 2);
  for (const Line& line : lines) {
    CHECK(line.left >= size.width / 10);
    CHECK(line.right <= size.width * 9 / 10);
  }
}

TEST_CASE("Overlay: nothing shows through a card") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  const Size size{640, 360};
  OverlayText text = kText;
  text.card = 1.0;
  const auto card_over = [&](const Snapshot& snapshot, const Camera& camera) {
    const Canvas canvas(context->gl(), size);
    canvas.bind();
    renderer.draw(snapshot, camera, size, View{}, text);
    return canvas.read();
  };
  Snapshot empty;
  empty.box = Vec2(20.0, 25.0);
  const Camera camera{{10.0, 12.5}, 40.0};
  CHECK(difference(card_over(driven_box(), camera), card_over(empty, camera)) == 0);
}

namespace {

constexpr Size kEnlarged{1280, 720};

// The differences of all pixels between a bright and a dark heatmap below the same overlay.
std::vector<int> seen_through_overlay(const Camera& camera, const Vec2& box) {
  const auto context = open_context(Backend::Auto);
  View view = view_with_field();
  view.range = {ColourRange::Given, {0.0, 4.0}};
  view.field_range = {ColourRange::Given, {0.0, 1.0}};
  const auto drawn = [&](double density) {
    Renderer renderer(context->gl());
    Snapshot snapshot = driven_box();
    snapshot.box = box;
    snapshot.positions.resize(2, 0);
    snapshot.velocities.resize(2, 0);
    snapshot.field = FieldMap{Quantity::Density, {1, 1}, {density}};
    return draw(renderer, context->gl(), snapshot, camera, kEnlarged, view);
  };
  const Image dark = drawn(0.0), bright = drawn(1.0);
  std::vector<int> seen;
  for (int y = 0; y < kEnlarged.height; ++y) {
    for (int x = 0; x < kEnlarged.width; ++x) {
      seen.push_back(difference(pixel(dark, x, y), pixel(bright, x, y)));
    }
  }
  return seen;
}

}  // namespace

TEST_CASE("Overlay: over the enlarged box texts are on a plate, and colour bars are opaque") {
  const auto seen = seen_through_overlay({{10.0, 12.5}, 10.0}, Vec2(20.0, 25.0));
  const auto at = [&](int x, int y) { return seen[y * kEnlarged.width + x]; };
  const int contrast = at(640, 360);
  CHECK(contrast > 50);
  CHECK(at(640, 715) == contrast);
  const auto count = [&](int left, int right, int top, int bottom, int most) {
    int found = 0;
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) found += at(x, y) <= most;
    }
    return found;
  };
  constexpr int kUnit = 18;  // height of a line of text
  const int same = count(0, 1280, 0, 720, 0), on_plate = count(0, 1280, 0, 720, contrast / 4);
  // The two bars are at the right.
  CHECK(count(1100, 1280, 0, 720, 0) > 2 * 13 * 13 * kUnit);
  // Two lines of heading, and two legends that are higher than wide.
  CHECK(on_plate > same + 2 * 20 * kUnit * kUnit);
  // Three figures in the lower left corner, and nothing above the scale bar.
  CHECK(count(0, 10 * kUnit, 720 - 6 * kUnit, 720, contrast / 4) > 6 * 4 * kUnit * kUnit);
  CHECK(count(0, 1000, 200, 500, contrast / 4) == 0);
}

TEST_CASE("Overlay: a colour bar that the enlarged box covers in part is opaque") {
  // The box is a band of 160 rows in the middle. The legends are taller, and centred on it. The
  // lower bar begins in the band and ends below it. Heatmaps below coloured disks are translucent.
  const auto seen = seen_through_overlay({{30.0, 1.875}, 30.0}, Vec2(60.0, 3.75));
  int opaque = 0;
  for (int y = 424; y < 438; ++y) {
    CHECK(seen[y * kEnlarged.width + 640] > 50);
    for (int x = 1100; x < kEnlarged.width; ++x) opaque += seen[y * kEnlarged.width + x] == 0;
  }
  CHECK(opaque > 10 * 13);
}

TEST_CASE("Overlay: over a box of spheres texts are on a plate, and beside it they are not") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl(), 1, true);
  const Size size{1280, 720};
  Snapshot snapshot;
  snapshot.box = Vec3(10.0, 10.0, 10.0);
  snapshot.positions = snapshot.velocities = Vectors::Zero(3, 0);
  // Number of pixels with the opacity of a plate, 0.8, at the right where the legend is.
  const auto plate = [&](const Camera& camera) {
    const Image image = draw(renderer, context->gl(), snapshot, camera, size, View{});
    int count = 0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = size.height; x < size.width; ++x) {
        count += std::abs(pixel(image, x, y).alpha - 204) <= 1;
      }
    }
    return count;
  };
  constexpr int kUnit = 18;  // height of a line of text
  CHECK(plate(renderer.fit(snapshot, size, View{}, kText)) < 100);
  // The viewer is in the box, and some corners are behind.
  CHECK(plate({{5.0, 5.0}, 4.0, {.z = 5.0, .view_angle = 90.0}}) > 6 * kUnit * kUnit);
}

TEST_CASE(
    "Overlay: a caption fades in and out, unless it is there from the beginning or to the end") {
  constexpr double kSpeed = 4.0;  // half a second is 2
  const Caption caption{"v^2", 10.0, 20.0};
  CHECK(caption_opacity(caption, 10.0, kSpeed) == 0.0);
  CHECK(caption_opacity(caption, 11.0, kSpeed) == 0.5);
  CHECK(caption_opacity(caption, 12.0, kSpeed) == 1.0);
  CHECK(caption_opacity(caption, 18.0, kSpeed) == 1.0);
  CHECK(caption_opacity(caption, 19.5, kSpeed) == 0.25);
  CHECK(caption_opacity(caption, 20.0, kSpeed) == 0.0);
  CHECK(caption_opacity(caption, 30.0, kSpeed) == 0.0);
  CHECK(caption_opacity({"v^2", {}, 20.0}, 0.0, kSpeed) == 1.0);
  CHECK(caption_opacity({"v^2", {}, 20.0}, 19.0, kSpeed) == 0.5);
  CHECK(caption_opacity({"v^2", 10.0, {}}, 1e9, kSpeed) == 1.0);
  // A short caption is visible for a third of its time.
  CHECK(caption_opacity({"v^2", 10.0, 13.0}, 11.0, kSpeed) == 1.0);
  CHECK(caption_opacity({"v^2", 10.0, 13.0}, 10.5, kSpeed) == 0.5);
}

TEST_CASE("Overlay: the captions of a time are over the lower part of the gas, on plates") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  Snapshot snapshot = driven_box();
  View view;
  view.captions = {{"T_x = m⟨v_x^2⟩", 0.0, 20.0}, {"Below.\nIn two lines.", {}, {}}};
  for (const Size size : {Size{1280, 720}, {640, 360}, {360, 640}}) {
    CAPTURE(size.width);
    const Camera camera = renderer.fit(snapshot, size, view, kText);
    View plain = view;
    plain.captions.clear();
    // Number of changed pixels, and their first and last row as shares of the height.
    const auto changed = [&](double time) {
      snapshot.time = time;
      const Image with = draw(renderer, context->gl(), snapshot, camera, size, view);
      const Image without = draw(renderer, context->gl(), snapshot, camera, size, plain);
      std::vector<double> rows;
      for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
          if (!(pixel(with, x, y) == pixel(without, x, y))) rows.push_back(1.0 * y / size.height);
        }
      }
      return rows;
    };
    const auto both = changed(5.0), second = changed(30.0);
    REQUIRE(second.size() > 500);
    CHECK(both.size() > second.size() + 300);
    CHECK(both.front() > 0.5);
    CHECK(both.front() < second.front());
    CHECK(both.back() == second.back());
    CHECK(second.back() < 0.97);
  }
}

TEST_CASE("Overlay: a view may hide each part, and the others stay at their places") {
  constexpr Size kSize{1280, 720};
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  Snapshot snapshot = driven_box();
  View view = view_with_field();
  view.captions = {{"Over the gas", {}, {}}};
  const std::vector<OverlayPart> all = {
      OverlayPart::Title,       OverlayPart::Caption,    OverlayPart::Time,
      OverlayPart::Temperature, OverlayPart::Collisions, OverlayPart::ColourBars,
      OverlayPart::ScaleBar,    OverlayPart::Captions,   OverlayPart::Walls};
  const Camera camera = renderer.fit(snapshot, kSize, view, kText);
  const auto drawn = [&](const View& shown) {
    return draw(renderer, context->gl(), snapshot, camera, kSize, shown);
  };
  View plain = view;
  plain.overlay = false;
  const Image empty = drawn(plain);
  const auto only = [&](OverlayPart part) {
    View shown = view;
    shown.overlay_hides = all;
    std::erase(shown.overlay_hides, part);
    return drawn(shown);
  };
  // The rectangle of the pixels that differ, as shares of the picture from its upper left corner.
  struct Area {
    double left = 1.0, right = 0.0, top = 1.0, bottom = 0.0;
  };
  const auto changed = [&](const Image& picture) {
    Area area;
    for (int y = 0; y < kSize.height; ++y) {
      for (int x = 0; x < kSize.width; ++x) {
        if (pixel(picture, x, y) == pixel(empty, x, y)) continue;
        area.left = std::min(area.left, 1.0 * x / kSize.width);
        area.right = std::max(area.right, 1.0 * x / kSize.width);
        area.top = std::min(area.top, 1.0 * y / kSize.height);
        area.bottom = std::max(area.bottom, 1.0 * y / kSize.height);
      }
    }
    return area;
  };
  const Area title = changed(only(OverlayPart::Title)),
             caption = changed(only(OverlayPart::Caption));
  CHECK(title.right < 0.4);
  CHECK(title.bottom < 0.2);
  CHECK(caption.right < 0.4);
  CHECK(caption.bottom < 0.3);
  const Area bars = changed(only(OverlayPart::ColourBars));
  CHECK(bars.left > 0.6);
  const Area captions = changed(only(OverlayPart::Captions));
  CHECK(captions.top > 0.6);
  CHECK(captions.left > 0.4);
  CHECK(captions.right < 0.75);
  const Area scale = changed(only(OverlayPart::ScaleBar));
  CHECK(scale.right < 0.4);
  CHECK(scale.top > 0.7);

  const Area walls = changed(only(OverlayPart::Walls));
  CHECK(walls.right < 0.4);
  CHECK(walls.top > 0.7);

  // Each figure follows its own value.
  Snapshot later = snapshot;
  const auto follows = [&](OverlayPart part) {
    const Image before = only(part);
    std::swap(snapshot, later);
    const Image after = only(part);
    std::swap(snapshot, later);
    CHECK(changed(before).top > 0.7);
    return difference(before, after) > 0;
  };
  const auto followers = [&] {
    return std::array{follows(OverlayPart::Time), follows(OverlayPart::Temperature),
                      follows(OverlayPart::Collisions)};
  };
  later.temperature = 0.5;
  CHECK(followers() == std::array{false, true, false});
  later = snapshot;
  later.collisions = 7;
  CHECK(followers() == std::array{false, false, true});
  later = snapshot;
  later.time = 99.0;
  CHECK(followers() == std::array{true, false, false});

  // Another kind of wall needs one more line.
  snapshot.walls[kLeft]->kind = WallKind::Static;
  CHECK(changed(only(OverlayPart::Walls)).top < walls.top);
  snapshot = later;

  View none = view;
  none.overlay_hides = all;
  CHECK(difference(drawn(none), empty) == 0);
  // In a high picture the box is larger without the scales beside it.
  constexpr Size kHigh{360, 640};
  CHECK(renderer.fit(snapshot, kHigh, none, kText).width <
        renderer.fit(snapshot, kHigh, view, kText).width);
}

TEST_CASE("Overlay: the legend of species stands beside the box, in their colours") {
  const auto context = open_context(Backend::Auto);
  Renderer renderer(context->gl());
  const Size size{640, 480};
  Snapshot snapshot = driven_box();
  constexpr Rgb kOne{250, 40, 30}, kOther{30, 60, 250};
  snapshot.species = {species_of("one", 1.0, kOne), species_of("other", 1.0, kOther)};
  snapshot.grains.assign(snapshot.count(), {});
  View view = view_with_field();
  view.colour_by = ColourBy::Species;
  const Camera camera = renderer.fit(snapshot, size, view, kText);
  const Image image = draw(renderer, context->gl(), snapshot, camera, size, view);
  const double right = Projection{camera, size}.pixels(snapshot.box).x() + wall_thickness(size);
  const auto pixels_of = [&](Rgb colour) {
    int count = 0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = static_cast<int>(right) + 1; x < size.width; ++x) {
        count += pixel(image, x, y) == Colour{colour.red, colour.green, colour.blue};
      }
    }
    return count;
  };
  // Disks with a diameter of 1.6 lines of text of 12 pixels, less their edges.
  for (const Rgb colour : {kOne, kOther}) {
    CHECK(pixels_of(colour) > 180);
    CHECK(pixels_of(colour) < 290);
  }
}

}  // namespace clatter
