#include <doctest/doctest.h>

#include "render/charts/plot.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

const ThemeColours kTheme = kLightTheme;

// Mean position of the pixels with the colour of the points, and their number. Positions are shares
// of the picture from the upper left corner.
struct Mark {
  Vec2 place{0.0, 0.0};
  int pixels = 0;
};

Mark mark_of(const Image& image) {
  Mark mark;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      if (pixel(image, x, y) != kTheme.driven_wall) continue;
      mark.place += Vec2(x, y);
      ++mark.pixels;
    }
  }
  mark.place /= std::max(1, mark.pixels);
  return {mark.place.cwiseQuotient(Vec2(image.size.width, image.size.height)), mark.pixels};
}

Image plotted(const Gl& gl, const std::vector<PlotPanel>& panels) {
  return plot_image(gl, {"Title", "Caption", "x", "y", panels}, {1200, 800}, kTheme);
}

PlotPanel two_points(bool first_hollow, bool second_hollow) {
  return {"", {{1.0, 1.0, "", first_hollow}, {100.0, 100.0, "", second_hollow}}};
}

}  // namespace

TEST_CASE("Plot: points of a plot stand where their values are, and hollow ones are rings") {
  const auto context = open_context(Backend::Auto);
  const Gl& gl = context->gl();
  const Mark low = mark_of(plotted(gl, {two_points(false, true)}));
  const Mark high = mark_of(plotted(gl, {two_points(true, false)}));
  CHECK(low.place.x() < high.place.x());
  CHECK(low.place.y() > high.place.y());
  const Mark both = mark_of(plotted(gl, {two_points(false, false)}));
  CHECK(low.pixels > 50);
  CHECK(both.pixels > 1.3 * low.pixels);
}

TEST_CASE("Plot: a plot has panels of the same axes, and none where there is nothing") {
  const auto context = open_context(Backend::Auto);
  const Gl& gl = context->gl();
  const PlotPanel point{"", {{1.0, 1.0, "", false}}}, far{"", {{1e3, 1.0, "", false}}};
  // The point of the left panel is at its left side, because the axes extend to the point of the
  // right panel.
  const Mark beside_far = mark_of(plotted(gl, {point, far}));
  const Mark beside_same = mark_of(plotted(gl, {point, point}));
  CHECK(beside_far.pixels == doctest::Approx(beside_same.pixels).epsilon(0.1));
  CHECK(beside_far.place.x() == doctest::Approx(beside_same.place.x()).epsilon(0.05));
  CHECK(mark_of(plotted(gl, {})).pixels == 0);
  CHECK(mark_of(plotted(gl, {{"", {{1.0, 0.0, "", false}}}})).pixels > 50);
}

TEST_CASE("Plot: values along x stand apart over any number of decades") {
  const auto context = open_context(Backend::Auto);
  const auto place = [&](double x) {
    const PlotPanel panel{"",
                          {{x, 1.0, "", false}, {1e7, 100.0, "", true}, {1.0, 100.0, "", true}}};
    return mark_of(plotted(context->gl(), {panel})).place.x();
  };
  CHECK(place(10.0) > place(1.0) + 0.01);
}

TEST_CASE("Plot: a point apart has no line, and a label keeps off a line") {
  const auto context = open_context(Backend::Auto);
  const auto drawn = [&](const std::string& label, bool apart) {
    return plotted(
        context->gl(),
        {{"", {{1.0, 10.0, ""}, {100.0, 10.0, label, false, apart}, {10000.0, 10.0, ""}}}});
  };
  // The line is the row through the points.
  const auto on_line = [](const Image& image, int y) {
    int count = 0;
    for (int x = image.size.width / 4; x < 3 * image.size.width / 4; ++x) {
      const Colour seen = pixel(image, x, y);
      count += seen.red > seen.blue + 40;
    }
    return count;
  };
  const Image joined = drawn("", false), apart = drawn("", true), labelled = drawn("1234", false);
  int row = 0;
  for (int y = 0; y < joined.size.height; ++y) {
    if (on_line(joined, y) > on_line(joined, row)) row = y;
  }
  CHECK(on_line(joined, row) > 500);
  CHECK(on_line(apart, row) < 100);
  // The point in the middle has its label above.
  const auto written = [&](int y) {
    int count = 0;
    for (int x = 0; x < joined.size.width; ++x) {
      count += !(pixel(joined, x, y) == pixel(labelled, x, y));
    }
    return count;
  };
  CHECK(written(row) == 0);
  CHECK(written(row - 15) > 0);
}

TEST_CASE("Similarity: it is less the more two pictures differ, and survives another size") {
  const auto context = open_context(Backend::Auto);
  const Gl& gl = context->gl();
  const Image picture = plotted(gl, {two_points(false, true)});
  const Image other = plotted(gl, {two_points(true, false)});
  CHECK(structural_similarity(picture, picture) == doctest::Approx(1.0));
  const double near = structural_similarity(picture, other);
  CHECK(near < 0.9999);
  CHECK(near > 0.9);
  Image dark = picture;
  for (std::size_t k = 0; k < dark.rgba.size(); ++k) {
    if (k % 4 != 3) dark.rgba[k] = static_cast<unsigned char>(255 - dark.rgba[k]);
  }
  CHECK(structural_similarity(picture, dark) < 0.3);
  const Image half = resized(picture, {600, 400});
  CHECK(half.rgba.size() == 4 * 600 * 400);
  CHECK(structural_similarity(resized(half, picture.size), picture) > 0.8);
  CHECK(difference(resized(picture, picture.size), picture) == 0);
}

}  // namespace clatter
