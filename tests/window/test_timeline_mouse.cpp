// The timeline of the window under the mouse, off screen.

#include <doctest/doctest.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/scene/scene_file.h"
#include "tests/window/offscreen_window.h"

namespace clatter {

namespace {

constexpr double kEnd = 10.0;  // of the run

// A window with a run that has ended, and a timeline of some 500 pixels.
class RunWindow {
 public:
  explicit RunWindow(const std::string& changes = "")
      : window(parse_scene("box.size = [8.0, 6.0]\nparticles = { count = 5 }\n"
                           "view.speed = 1000.0\n" +
                               changes,
                           "run"),
               900.0f, 600.0f, kEnd) {
    window.settle();
    REQUIRE(head() == kEnd);
    const auto [left, top, width, height] = window.place("timeline");
    left_ = left;
    right_ = left + width;
    line_ = top + 0.6f * height;
    marks_ = top + 0.1f * height;
  }

  double head() const { return window.logged("status")["head"]; }
  double time() const { return window.logged("status")["time"]; }
  // The pixel of a time. The mouse is on whole pixels.
  float place(double time) const {
    return std::floor(left_ + static_cast<float>(time / kEnd) * (right_ - left_));
  }
  double time_at(float place) const { return kEnd * (place - left_) / (right_ - left_); }
  void point_at(float place, bool on_marks = false) {
    ImGui::GetIO().MousePos = ImVec2(place, on_marks ? marks_ : line_);
    window.draw();
  }
  // Clicks the line at a place.
  void click(float place) {
    point_at(place);
    window.hold(true);
    window.hold(false);
  }
  // Drags from one place to another.
  void drag(float from, float to, bool on_marks = false) {
    point_at(from, on_marks);
    window.hold(true);
    point_at(to, on_marks);
    window.hold(false);
  }

  OffscreenWindow window;

 private:
  float left_, right_, line_, marks_;
};

const std::string kTwoChanges = R"(
[[change]]
time = 4.0
set = { "particles.restitution" = 0.8 }
[[change]]
time = 4.16
set = { "particles.restitution" = 0.7 }
)";

}  // namespace

TEST_CASE("Timeline: a click near a change or an end of the run jumps to it, exactly") {
  RunWindow run(kTwoChanges);
  const auto jumped = [&](float place) {
    run.click(place);
    run.window.settle();
    return run.time();
  };
  CHECK(jumped(run.place(4.0) - 4.0f) == 4.0);
  CHECK(jumped(run.place(4.16) + 3.0f) == 4.16);
  CHECK(jumped(run.place(4.16) - 3.0f) == 4.16);
  CHECK(jumped(run.place(4.0) + 2.0f) == 4.0);
  CHECK(jumped(run.place(0.0) + 4.0f) == 0.0);
  CHECK(jumped(run.place(kEnd) - 4.0f) == kEnd);
  for (const float place : {run.place(6.0), run.place(4.0) - 12.0f, run.place(kEnd) - 12.0f}) {
    CHECK(jumped(place) == doctest::Approx(run.time_at(place)).epsilon(1e-6));
  }
}

TEST_CASE("Timeline: the nearest of two marks is dragged, to a time with few digits") {
  for (const int mark : {0, 1}) {
    RunWindow run(kTwoChanges);
    // A pixel has 0.02 time units, so the digits end at tenths. Both marks are in reach.
    run.drag(mark == 0 ? run.place(4.0) + 2.0f : run.place(4.16) - 3.0f, run.place(7.03), true);
    run.window.settle();
    const auto moved = run.window.logged("move_change");
    CHECK(moved["number"] == mark);
    CHECK(moved["to"].get<double>() == doctest::Approx(7.0).epsilon(1e-12));
    // The runs differ from the former time.
    CHECK(run.head() == (mark == 0 ? 4.0 : 4.16));
  }
}

TEST_CASE("Timeline: a drag with Shift repeats the stretch, in either direction") {
  RunWindow run;
  const auto repeated = [&](double from, double to) {
    run.window.shift(true);
    run.drag(run.place(from), run.place(to));
    run.window.shift(false);
    const auto stretch = run.window.logged("repeat");
    return std::array<double, 2>{stretch["from"], stretch["to"]};
  };
  for (const auto& [from, to] : {std::array{2.0, 5.0}, std::array{8.0, 3.0}}) {
    const auto [low, high] = repeated(from, to);
    const double begin = run.time_at(run.place(from)), end = run.time_at(run.place(to));
    CHECK(low == doctest::Approx(std::min(begin, end)).epsilon(1e-6));
    CHECK(high == doctest::Approx(std::max(begin, end)).epsilon(1e-6));
  }
}

TEST_CASE("Timeline: after a click a gas continues in its direction") {
  for (const bool backwards : {true, false}) {
    CAPTURE(backwards);
    RunWindow run;
    run.click(run.place(5.0));
    run.window.settle();
    do {
      run.window.type('-');
      run.window.settle();
    } while (run.window.logged("speed")["speed"] > 0.1);
    const auto moves = [&] {
      const auto status = run.window.logged("status");
      return status["plays"] == true && status["backwards"] == backwards;
    };
    run.window.click(backwards ? "back" : "play");
    REQUIRE(run.window.comes_to(moves));
    run.click(run.place(6.0));
    const auto jumped = run.window.logged("jump")["command"];
    REQUIRE(run.window.comes_to(
        [&] { return moves() && run.window.logged("status")["handled"] > jumped; }));
    CHECK((run.time() < run.time_at(run.place(6.0))) == backwards);
    CHECK(run.time() == doctest::Approx(6.0).epsilon(0.1));
  }
}

}  // namespace clatter
