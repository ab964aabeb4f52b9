#include "render/renderer.h"

#include <doctest/doctest.h>

#include "tests/render/picture.h"

namespace clatter {

namespace {

const OverlayText kText{"Vibrated box", "Watch the cold dense band form between the hot walls."};

Image draw(Renderer& renderer, const Gl& gl, const Snapshot& snapshot, const Camera& camera,
           Size size, const View& view) {
  const Canvas canvas(gl, size);
  canvas.bind();
  renderer.draw(snapshot, camera, size, view, kText);
  return canvas.read();
}

View view_with_field() {
  View view;
  view.field = Field::Density;
  return view;
}

}  // namespace

TEST_CASE("The overlay writes on every size of picture, and neither on the box nor at the edge") {
  const auto context = open_context(Backend::Osmesa);
  Renderer renderer(context->gl());
  for (Size size : {Size{1280, 720}, {1920, 1080}, {720, 720}, {640, 360}, {360, 640}}) {
    for (Vec2 box : {Vec2(20.0, 25.0), Vec2(60.0, 12.0), Vec2(20.0, 20.0)}) {
      CAPTURE(size.width);
      CAPTURE(box.x());
      Snapshot snapshot = driven_box();
      snapshot.box = box;
      snapshot.arrows = ArrowMap{Arrows::HeatFlux, box / 20.0, {{0.5 * box, {1.0, 0.0}}}};
      View view = view_with_field();
      view.arrows = Arrows::HeatFlux;
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

TEST_CASE("The same snapshot gives the same picture") {
  const auto context = open_context(Backend::Osmesa);
  const Snapshot snapshot = driven_box();
  const Size size{640, 360};
  const View view = view_with_field();
  Renderer first(context->gl()), second(context->gl());
  const Camera camera = first.fit(snapshot, size, view, kText);
  CHECK(difference(draw(first, context->gl(), snapshot, camera, size, view),
                   draw(second, context->gl(), snapshot, camera, size, view)) == 0);
}

TEST_CASE("A fixed range decides the colour, and the picture is opaque") {
  const auto context = open_context(Backend::Osmesa);
  Renderer renderer(context->gl());
  Snapshot snapshot;
  snapshot.box = {10.0, 10.0};
  snapshot.positions = {{5.0, 5.0}};
  snapshot.velocities = {{2.0, 0.0}};
  View view;
  view.overlay = false;
  view.range = {ColourRange::Given, {0.0, 2000.0}};
  const Image image = draw(renderer, context->gl(), snapshot, {{5.0, 5.0}, 10.0}, {100, 100}, view);
  CHECK(difference(pixel(image, 50, 50), Colour{0x47, 0x2d, 0x7b}) <= 1);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) REQUIRE(image.rgba[i] == 255);
}

TEST_CASE("A picture has room for a wall that swings out of the box") {
  const auto context = open_context(Backend::Osmesa);
  Renderer renderer(context->gl());
  Snapshot snapshot = driven_box();
  snapshot.walls[kRight] = Wall{.kind = WallKind::Sinusoidal, .stroke = 6.0, .frequency = 1.0};
  for (Size size : {Size{1280, 720}, {360, 640}}) {
    for (const bool overlay : {false, true}) {
      View view;
      view.overlay = overlay;
      const Camera camera = renderer.fit(snapshot, size, view, kText);
      const Projection projection{camera, size};
      const double face = projection.pixels({23.0, 0.0}).x();
      CHECK(projection.pixels({0.0, 0.0}).x() >= wall_thickness(size) - 0.5);
      CHECK(face + wall_thickness(size) <= size.width + 0.5);
      if (!overlay) continue;
      // No text where the wall comes.
      snapshot.wall_displacement[kRight] = -3.0;
      const Image with = draw(renderer, context->gl(), snapshot, camera, size, view);
      view.overlay = false;
      const Image without = draw(renderer, context->gl(), snapshot, camera, size, view);
      const Vec2 low = projection.pixels({0.0, 0.0}), high = projection.pixels({23.0, 25.0});
      int written = 0;
      for (int y = static_cast<int>(low.y()) + 1; y < high.y() - 1; ++y) {
        for (int x = static_cast<int>(low.x()) + 1; x < high.x() + wall_thickness(size) - 1; ++x) {
          const int down = size.height - 1 - y;
          written += !(pixel(with, x, down) == pixel(without, x, down));
        }
      }
      CHECK(written == 0);
    }
  }
}

TEST_CASE("Colour bars for which a small picture has no room stay out of the row of figures") {
  const auto context = open_context(Backend::Osmesa);
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

TEST_CASE("Spins are coloured by their sense") {
  const auto context = open_context(Backend::Osmesa);
  Renderer renderer(context->gl());
  Snapshot snapshot;
  snapshot.box = {10.0, 10.0};
  snapshot.positions = {{3.0, 5.0}, {5.0, 5.0}, {7.0, 5.0}};
  snapshot.velocities = {{9.0, 0.0}, {9.0, 0.0}, {9.0, 0.0}};
  snapshot.spins = {2.0, 0.0, -2.0};
  View view;
  view.overlay = false;
  view.colour_by = ColourBy::Spin;
  const Image image = draw(renderer, context->gl(), snapshot, {{5.0, 5.0}, 10.0}, {100, 100}, view);
  const Colour forward = pixel(image, 30, 50), still = pixel(image, 50, 50);
  const Colour backward = pixel(image, 70, 50);
  CHECK(forward.red > forward.blue + 80);
  CHECK(backward.blue > backward.red + 80);
  CHECK(difference(still, {still.red, still.red, still.red}) < 20);
  // Its legend is written.
  view.overlay = true;
  const Image with = draw(renderer, context->gl(), snapshot, {{5.0, 5.0}, 10.0}, {400, 400}, view);
  CHECK(
      difference(with, draw(renderer, context->gl(), snapshot, {{5.0, 5.0}, 10.0}, {400, 400}, [&] {
                   View v = view;
                   v.overlay = false;
                   return v;
                 }())) > 50);
}

namespace {

// The colour in the middle of a box that a field of one cell fills with `value`.
Colour field_colour(Renderer& renderer, const Gl& gl, const View& view, double value,
                    bool whole_window) {
  Snapshot snapshot;
  snapshot.box = {10.0, 10.0};
  snapshot.field = FieldMap{*view.field, {1, 1}, {value}, whole_window};
  return pixel(draw(renderer, gl, snapshot, {{5.0, 5.0}, 10.0}, {100, 100}, view), 50, 50);
}

View view_of(Field field) {
  View view;
  view.colour_by = ColourBy::None;
  view.field = field;
  view.overlay = false;
  return view;
}

}  // namespace

TEST_CASE("The colours of a heatmap follow, or are locked, or are given") {
  const auto context = open_context(Backend::Osmesa);
  const ColourMap map = colour_map(Palette::Viridis);
  View view = view_of(Field::Temperature);
  const auto colours = [&] {
    Renderer renderer(context->gl());
    std::vector<Colour> seen;
    seen.push_back(field_colour(renderer, context->gl(), view, 0.1, false));
    seen.push_back(field_colour(renderer, context->gl(), view, 1.0, true));
    seen.push_back(field_colour(renderer, context->gl(), view, 100.0, true));
    seen.push_back(field_colour(renderer, context->gl(), view, 0.5, true));
    return seen;
  };
  const Colour top = map.back(), middle = map[8];
  CHECK(colours() == std::vector{top, top, top, top});
  view.field_range = {ColourRange::Locked};
  CHECK(colours() == std::vector{top, top, top, middle});  // at 1, its first whole window
  view.field_range = {ColourRange::Given, {-1.0, 2.0}};
  CHECK(colours()[3] == middle);
}

TEST_CASE("Ranges that are fixed follow no more, but for those that are given") {
  const auto context = open_context(Backend::Osmesa);
  View view = view_of(Field::Temperature);
  Snapshot snapshot;
  snapshot.box = {10.0, 10.0};
  snapshot.field = FieldMap{*view.field, {1, 1}, {0.97}, true};
  const RangeEnds ends = range_ends(snapshot, view);
  CHECK(ends.field == 1.0);
  CHECK(ends.disks == 0.0);
  CHECK(ends.arrows == 0.0);
  Renderer renderer(context->gl());
  renderer.fix(ends);
  const Colour top = colour_map(Palette::Viridis).back(), middle = colour_map(Palette::Viridis)[8];
  CHECK(field_colour(renderer, context->gl(), view, 100.0, true) == top);
  CHECK(field_colour(renderer, context->gl(), view, 0.5, true) == middle);
  view.field_range = {ColourRange::Locked};
  CHECK(field_colour(renderer, context->gl(), view, 0.5, true) == middle);
  view.field_range = {ColourRange::Given, {0.0, 0.5}};
  CHECK(field_colour(renderer, context->gl(), view, 0.5, true) == top);
}

TEST_CASE("A locked range is found anew for another field") {
  const auto context = open_context(Backend::Osmesa);
  Renderer renderer(context->gl());
  View view = view_of(Field::Temperature);
  view.field_range = {ColourRange::Locked};
  field_colour(renderer, context->gl(), view, 100.0, true);
  view.field = Field::Density;
  CHECK(field_colour(renderer, context->gl(), view, 1.0, true) ==
        colour_map(Palette::Viridis).back());
}

TEST_CASE("Magnitudes have the palette, their bright end far from zero; signed fields have two") {
  const auto context = open_context(Backend::Osmesa);
  const auto colour = [&](Field field, double value) {
    Renderer renderer(context->gl());
    View view = view_of(field);
    view.field_palette = Palette::Inferno;
    return field_colour(renderer, context->gl(), view, value, true);
  };
  CHECK(colour(Field::Density, 1.0) == colour_map(Palette::Inferno).back());
  CHECK(colour(Field::StressXx, -1.0) == colour_map(Palette::Inferno).back());
  CHECK(colour(Field::Dissipation, -1.0) == colour_map(Palette::Inferno).back());
  for (const Field field : {Field::VelocityX, Field::StressXy, Field::HeatFluxY, Field::Spin}) {
    CHECK(colour(field, 1.0) == diverging_map().back());
    CHECK(colour(field, -1.0) == diverging_map().front());
  }
}

TEST_CASE("Arrows lie over the box as long as their legend says") {
  const auto context = open_context(Backend::Osmesa);
  Renderer renderer(context->gl());
  Snapshot snapshot;
  snapshot.box = {10.0, 10.0};
  snapshot.arrows = ArrowMap{Arrows::Velocity, {4.0, 4.0}, {{{5.0, 5.0}, {1.5, 0.0}}}};
  View view;
  view.overlay = false;
  const auto width_of_arrow = [&] {
    const Image image =
        draw(renderer, context->gl(), snapshot, {{5.0, 5.0}, 10.0}, {400, 400}, view);
    int width = 0;
    for (int x = 0; x < 400; ++x) width += difference(pixel(image, x, 200), kDarkTheme.text) < 100;
    return width;
  };
  CHECK(width_of_arrow() == 0);  // not asked for
  view.arrows = Arrows::Velocity;
  // The greatest value there is fills a cell of 160 pixels.
  CHECK(std::abs(width_of_arrow() - 160) <= 4);
}

TEST_CASE("A theme has its colours, and a background of one's own goes before them") {
  const auto context = open_context(Backend::Osmesa);
  Renderer renderer(context->gl());
  Snapshot snapshot;
  snapshot.box = {10.0, 10.0};
  snapshot.positions = {{5.0, 5.0}};
  snapshot.velocities = {{0.0, 0.0}};
  View view;
  view.colour_by = ColourBy::None;
  const auto drawn = [&] {
    return draw(renderer, context->gl(), snapshot, {{5.0, 5.0}, 20.0}, {400, 400}, view);
  };
  for (const auto& [name, colours] : {std::pair(Theme::Dark, kDarkTheme),
                                      {Theme::Light, kLightTheme},
                                      {Theme::Projector, kProjectorTheme}}) {
    view.theme = name;
    const Image image = drawn();
    CHECK(pixel(image, 399, 200) == colours.background);
    CHECK(pixel(image, 200, 200) == colours.disk);
    // Letters of the title.
    int letters = 0;
    for (int x = 0; x < 200; ++x) {
      for (int y = 0; y < 40; ++y) letters += difference(pixel(image, x, y), colours.text) < 60;
    }
    CHECK(letters > 20);
  }
  view.background = Rgb{1, 2, 3};
  CHECK(pixel(drawn(), 399, 200) == Colour{1, 2, 3});
}

TEST_CASE("A grid is drawn where it is asked for") {
  const auto context = open_context(Backend::Osmesa);
  Renderer renderer(context->gl());
  Snapshot snapshot;
  snapshot.box = {10.0, 10.0};
  View view;
  view.overlay = false;
  const Camera camera{{5.0, 5.0}, 20.0};
  const Image without = draw(renderer, context->gl(), snapshot, camera, {400, 400}, view);
  view.grid = true;
  CHECK(difference(without, draw(renderer, context->gl(), snapshot, camera, {400, 400}, view)) >
        20);
}

TEST_CASE("A picture of several samples a pixel looks like the one of one sample") {
  const auto context = open_context(Backend::Osmesa);
  View view = view_with_field();
  view.grid = true;
  view.arrows = Arrows::Velocity;
  Snapshot snapshot = driven_box();
  snapshot.walls[kLeft] = Wall{.kind = WallKind::Sinusoidal, .stroke = 1.0, .frequency = 1.0};
  snapshot.arrows = ArrowMap{Arrows::Velocity, {4.0, 4.0}, {{{5.0, 5.0}, {1.5, 1.0}}}};
  for (const Size size : {Size{1280, 720}, {500, 300}, {1080, 1920}}) {
    Renderer normal(context->gl());
    const Camera camera = normal.fit(snapshot, size, view, kText);
    const Image one = draw(normal, context->gl(), snapshot, camera, size, view);
    CHECK(structural_similarity(one, one) == 1.0);
    for (const int samples : {2, 4}) {
      CAPTURE(size.width);
      CAPTURE(samples);
      Renderer finer(context->gl(), samples);
      const Image many = draw(finer, context->gl(), snapshot, camera, size, view);
      CHECK(structural_similarity(one, many) >= 0.98);
      CHECK(difference(one, many) > 10);
      for (std::size_t i = 3; i < many.rgba.size(); i += 4) REQUIRE(many.rgba[i] == 255);
    }
  }
}

TEST_CASE("Blur, trails and marks look the same with several samples a pixel") {
  const auto context = open_context(Backend::Osmesa);
  const Size size{1280, 720};
  View view;
  Snapshot snapshot = driven_box();
  for (std::uint32_t i = 0; i < snapshot.positions.size(); ++i) {
    const Vec2 &r = snapshot.positions[i], &v = snapshot.velocities[i];
    snapshot.angles.push_back(0.1 * i);
    snapshot.flights.push_back({i, -1.0, 0.0, r - v, v, {0.0, 0.0}});
  }
  for (const bool blurred : {false, true}) {
    CAPTURE(blurred);
    snapshot.exposure = blurred ? 0.8 : 0.0;
    view.trails = blurred ? std::nullopt : std::optional(1.0);
    Renderer normal(context->gl()), finer(context->gl(), 4);
    const Camera camera = normal.fit(snapshot, size, view, kText);
    const Image one = draw(normal, context->gl(), snapshot, camera, size, view);
    const Image many = draw(finer, context->gl(), snapshot, camera, size, view);
    CHECK(structural_similarity(one, many) >= 0.98);
    CHECK(difference(one, many) > 10);
  }
}

namespace {

// A picture with its own colours laid over a background by its opacity, as programs do it.
Colour over(Colour picture, Colour background) {
  const auto channel = [&](int c, int b) {
    return static_cast<std::uint8_t>((c * picture.alpha + b * (255 - picture.alpha) + 127) / 255);
  };
  return {channel(picture.red, background.red), channel(picture.green, background.green),
          channel(picture.blue, background.blue)};
}

}  // namespace

TEST_CASE("A picture without a background has its own colours, and opacity where something is") {
  const auto context = open_context(Backend::Osmesa);
  Snapshot snapshot;
  snapshot.box = {10.0, 10.0};
  snapshot.walls.fill(Wall{});
  snapshot.positions = {{5.0, 5.0}};
  snapshot.velocities = {{0.0, 0.0}};
  View view;
  view.colour_by = ColourBy::None;
  view.overlay = false;
  const Camera camera{{5.0, 5.0}, 12.0};
  for (const int samples : {1, 2}) {
    Renderer renderer(context->gl(), samples, true);
    const Image image =
        with_own_colours(draw(renderer, context->gl(), snapshot, camera, {300, 300}, view));
    CHECK(pixel(image, 70, 70).alpha == 0);
    CHECK(pixel(image, 150, 150) == kDarkTheme.disk);
    // A disk's rim does not change its colour where it ends: no fringe of any background.
    double area = 0.0;
    for (int y = 100; y < 200; ++y) {
      for (int x = 100; x < 200; ++x) {
        const Colour seen = pixel(image, x, y);
        area += seen.alpha / 255.0;
        if (seen.alpha > 32 && seen.alpha < 224) CHECK(seen.red < kDarkTheme.disk.red - 60);
      }
    }
    CHECK(area == doctest::Approx(M_PI * 12.5 * 12.5).epsilon(0.003));
    // Laid over the background it is the picture with it, but for how edges are blended.
    Renderer opaque(context->gl(), samples);
    const Image whole = draw(opaque, context->gl(), snapshot, camera, {300, 300}, view);
    int off = 0;
    for (int y = 0; y < 300; ++y) {
      for (int x = 0; x < 300; ++x) {
        off = std::max(
            off, difference(over(pixel(image, x, y), kDarkTheme.background), pixel(whole, x, y)));
      }
    }
    CHECK(off < 30);
  }
}

TEST_CASE("Small disks, and trails, have their own colours without a background, too") {
  const auto context = open_context(Backend::Osmesa);
  Snapshot snapshot;
  snapshot.box = {10.0, 10.0};
  snapshot.walls.fill(Wall{});
  snapshot.positions = {{5.3, 5.0}};
  snapshot.velocities = {{4.0, 0.0}};
  snapshot.flights = {{0, -1.0, 0.0, {1.3, 5.0}, {4.0, 0.0}, {0.0, 0.0}}};
  View view;
  view.colour_by = ColourBy::None;
  view.overlay = false;
  // The colours seen left of `end`, but for faint ones, which are stored in few levels.
  const auto check = [&](Size size, int end, int samples) {
    CAPTURE(samples);
    Renderer renderer(context->gl(), samples, true);
    const Camera camera{{5.0, 5.0}, 9.0};
    const Image image =
        with_own_colours(draw(renderer, context->gl(), snapshot, camera, size, view));
    int seen = 0;
    for (int y = size.height / 4; y < 3 * size.height / 4; ++y) {
      for (int x = 0; x < end; ++x) {
        Colour colour = pixel(image, x, y);
        if (colour.alpha < 48) continue;
        colour.alpha = 255;
        CHECK(difference(colour, kDarkTheme.disk) <= 8);
        ++seen;
      }
    }
    CHECK(seen > 3);
  };
  check({18, 18}, 18, 1);  // a radius of one pixel
  snapshot.exposure = 0.5;
  check({18, 18}, 18, 1);
  snapshot.exposure = 0.0;
  view.trails = 1.0;
  for (const int samples : {1, 2}) check({180, 180}, 80, samples);
}

TEST_CASE("A card covers the picture with its title, and fades out") {
  const auto context = open_context(Backend::Osmesa);
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
  CHECK(card_opacity(3.0, 2.5) == doctest::Approx(0.5));
  CHECK(card_opacity(3.0, 3.0) == 0.0);
  CHECK(card_opacity(3.0, 9.0) == 0.0);
}

TEST_CASE("An empty box is drawn too") {
  const auto context = open_context(Backend::Osmesa);
  Renderer renderer(context->gl());
  Snapshot snapshot;
  snapshot.box = {10.0, 10.0};
  const Size size{320, 200};
  CHECK_NOTHROW(draw(renderer, context->gl(), snapshot, renderer.fit(snapshot, size, View{}, kText),
                     size, View{}));
}

}  // namespace clatter
