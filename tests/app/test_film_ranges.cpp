// The colour ranges of films.

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "app/film/film_ranges.h"
#include "tests/support/shell.h"

namespace clatter {

namespace {

// A gas that cools to a hundredth of its temperature within the film of 50 frames.
const std::string kCooling =
    "clatter render cooling.toml --quiet --no-overlay --size 120x90 --fps 5 --speed 4 ";
const std::string kCoolingFilm = kCooling + "--to 40 ";

void write_cooling(const Shell& shell) {
  shell.write("cooling.toml",
              "title = \"Cooling\"\nbox.size = [20, 15]\n"
              "particles = { count = 100, restitution = 0.7 }\n"
              "view = { window = 2.0 }\n");
}

// The round number of which the range of speeds [0, number] gives the picture. 0: there is none.
double range_of(const Shell& shell, const std::string& frame, double time) {
  for (const double end : {0.08, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0}) {
    const std::string line =
        kCooling + "--overwrite --to " + std::to_string(time) + " --out still.png ";
    REQUIRE(shell.run(line + "--set 'view.range=[0," + std::to_string(end) + "]'").code == 0);
    const std::string pixels = "ffmpeg -v error -f framemd5 - -i ";
    const std::string shown = shell.run(pixels + frame).out;
    REQUIRE(!shown.empty());
    if (shell.run(pixels + "still.png").out == shown) return end;
  }
  return 0.0;
}

}  // namespace

TEST_CASE("Film ranges: gases share the extents of their common quantities, each of its own kind") {
  std::vector<View> views(2);
  const auto shared = [&] {
    std::vector<std::array<double, 3>> numbers;
    for (const RangeEnds& ends : shared_extents({{1.0, 20.0, 300.0}, {4.0, 10.0, 200.0}}, views)) {
      numbers.push_back({ends.disks, ends.field, ends.arrows});
    }
    return numbers;
  };
  using Extents = std::vector<std::array<double, 3>>;
  CHECK(shared() == Extents{{4.0, 20.0, 300.0}, {4.0, 20.0, 300.0}});
  views[1].colour_by = ColourBy::VelocityX;
  CHECK(shared() == Extents{{1.0, 20.0, 300.0}, {4.0, 20.0, 300.0}});
  views[0].field = Quantity::Density;
  CHECK(shared() == Extents{{1.0, 20.0, 300.0}, {4.0, 10.0, 300.0}});
  views[1].arrows = Quantity::HeatFlux;
  CHECK(shared() == Extents{{1.0, 20.0, 300.0}, {4.0, 10.0, 200.0}});
}

TEST_CASE("Film ranges: the end moves to the next round number by a factor of 2 in half a second") {
  constexpr double kFps = 10.0;  // five steps in half a second
  View view;
  FilmRanges ranges = first_ranges({.disks = 1.9, .field = 7.0, .arrows = 0.3});
  CHECK(ranges.shown.disks == 2.0);
  CHECK(ranges.shown.field == 8.0);
  CHECK(ranges.shown.arrows == doctest::Approx(0.3));
  for (int frame = 1; frame <= 5; ++frame) {
    ranges = moved(ranges, {.disks = 0.45, .field = 16.5, .arrows = 9.0}, view, kFps);
    CAPTURE(frame);
    CHECK(ranges.shown.disks == doctest::Approx(2.0 * std::pow(0.5, frame / 5.0)));
    CHECK(ranges.shown.field == doctest::Approx(8.0 * std::pow(2.0, frame / 5.0)));
    CHECK(ranges.shown.arrows == doctest::Approx(0.3));
  }
  for (int frame = 6; frame <= 10; ++frame) {
    ranges = moved(ranges, {.disks = 0.45, .field = 16.5}, view, kFps);
  }
  CHECK(ranges.shown.disks == 0.5);
  CHECK(ranges.shown.field == 20.0);
  // Extents of 0.5 to 1.05 of the end keep it, and 0 is no data.
  for (const double extent : {0.26, 0.52, 0.0}) {
    CHECK(moved(ranges, {.disks = extent}, view, kFps).shown.disks == 0.5);
  }
  view.range = {ColourRange::Locked};
  CHECK(moved(ranges, {.disks = 9.0, .field = 9.0}, view, kFps).shown.disks == 0.5);
  view.field_range = {ColourRange::Locked};
  CHECK(moved(ranges, {.disks = 9.0, .field = 90.0}, view, kFps).shown.field == 20.0);
}

TEST_CASE("Film ranges: the first values choose the end at once") {
  const FilmRanges none = first_ranges({});
  CHECK(none.shown.field == 0.0);
  CHECK(moved(none, {.field = 100.0}, View{}, 25.0).shown.field == 100.0);
}

TEST_CASE("Film ranges: a heatmap before the end of its window does not move its range") {
  View view;
  view.field = Quantity::Temperature;
  Snapshot snapshot;
  snapshot.box = Vec2(10.0, 10.0);
  snapshot.field = FieldMap{*view.field, {1, 1}, {4.0}, false};
  CHECK(settled_extents(snapshot, view).field == 0.0);
  snapshot.field->whole_window = true;
  CHECK(settled_extents(snapshot, view).field == 4.0);
}

TEST_CASE("Film ranges: the colours of a film of a cooling gas follow it, unless they are locked") {
  const Shell shell;
  write_cooling(shell);
  REQUIRE(shell.run(kCoolingFilm + "--out auto").code == 0);
  REQUIRE(shell.run(kCoolingFilm + "--set 'view.range=\"locked\"' --out locked").code == 0);
  const std::string first = "/frame_000000.png", last = "/frame_000049.png";
  const double begin = range_of(shell, "auto" + first, 0.0);
  const double end = range_of(shell, "auto" + last, 39.2);
  CHECK(begin >= 1.5);
  CHECK(end > 0.0);
  CHECK(end <= 0.3 * begin);
  CHECK(range_of(shell, "locked" + first, 0.0) == begin);
  CHECK(range_of(shell, "locked" + last, 39.2) == begin);
}

}  // namespace clatter
