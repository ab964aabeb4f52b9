// The times of the frames of a film.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "app/film/frame_times.h"
#include "render/output/image.h"
#include "tests/app/film_scene.h"

namespace clatter {

namespace {

// Slow motion around t = 12, and a faster end.
FrameTimes paced(double from) {
  return {
      from, 2.0, 25.0, 800, {{10.0, 1.0}, {11.5, 0.05}, {12.5, 0.05}, {14.0, 1.0}, {15.0, 3.0}}};
}

// The factor of paced(), by another way.
double factor_at(double time) {
  if (time < 10.0) return 1.0;
  // Between two keys the square is linear.
  const auto between = [&](double from, double to, double low, double high) {
    const double share = (time - from) / (to - from);
    return std::sqrt(low * low + share * (high * high - low * low));
  };
  if (time < 11.5) return between(10.0, 11.5, 1.0, 0.05);
  if (time < 12.5) return 0.05;
  if (time < 14.0) return between(12.5, 14.0, 0.05, 1.0);
  return time < 15.0 ? between(14.0, 15.0, 1.0, 3.0) : 3.0;
}

// Seconds of film between two times by the midpoint rule, whose relative error is below 1e-6 here.
double integrated(double from, double to) {
  constexpr int kSteps = 2'000'000;
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    sum += 1.0 / factor_at(from + (to - from) * (k + 0.5) / kSteps);
  }
  return sum * (to - from) / kSteps / 2.0;
}

}  // namespace

TEST_CASE("Frame times: without a pace, frames are at equal distances") {
  const FrameTimes times{3.0, 2.0, 25.0, 50, {}};
  CHECK(times.of(0) == 3.0);
  CHECK(times.of(10) == 3.0 + 10 * (2.0 / 25.0));
  CHECK(times.last() == times.of(49));
  CHECK(times.seconds_at(5.0) == 1.0);
  CHECK(times.speed_at(5.0) == 2.0);
  CHECK(times.largest_speed() == 2.0);
}

TEST_CASE("Frame times: the seconds of film are the integral over the pace") {
  for (const double from : {0.0, 10.4, 12.0, 14.5, 20.0}) {
    CAPTURE(from);
    const FrameTimes times = paced(from);
    CHECK(times.seconds_at(from) == 0.0);
    for (const double to : {10.7, 11.5, 12.2, 13.0, 14.9, 15.0, 22.0}) {
      if (to <= from) continue;
      CAPTURE(to);
      CHECK(times.seconds_at(to) == doctest::Approx(integrated(from, to)).epsilon(1e-5));
    }
  }
}

TEST_CASE("Frame times: each frame is a frame's length after the one before") {
  for (const double from : {0.0, 10.4, 12.0, 14.5, 20.0}) {
    CAPTURE(from);
    const FrameTimes times = paced(from);
    CHECK(times.of(0) == from);
    double before = from;
    for (long frame = 1; frame < times.count; ++frame) {
      const double time = times.of(frame);
      CHECK(time > before);
      CHECK(times.seconds_at(time) == doctest::Approx(frame / times.fps).epsilon(1e-12));
      before = time;
    }
    CHECK(before > 15.0);
  }
}

TEST_CASE("Frame times: the largest and the smallest factors give finite times in order") {
  // At these times the square of the factor as 1e12 + slope (t - 15.4) rounds to -1.2e-4.
  const FrameTimes times{
      0.0, 1.0, 1e3, 4000, {{15.4, 1e6}, {16.1, 1e-6}, {17.0, 1e-6}, {18.0, 1e6}}};
  double before = 0.0;
  for (const double time : {0.5, 15.4, 15.9, 16.1, 17.0, 17.5, 18.0, 1e9}) {
    CAPTURE(time);
    const double seconds = times.seconds_at(time);
    CHECK(std::isfinite(seconds));
    CHECK(seconds >= before);
    // The speed multiplies the rounding error of the seconds.
    const double rounding =
        4.0 * std::numeric_limits<double>::epsilon() * (seconds * times.speed_at(time) + time);
    CHECK(std::fabs(times.time_after(seconds) - time) <= rounding);
    before = seconds;
  }
  for (long frame = 1; frame < times.count; ++frame) CHECK(times.of(frame) >= times.of(frame - 1));
}

TEST_CASE("Frame times: the speed follows the pace") {
  const FrameTimes times = paced(0.0);
  for (const double time : {0.0, 5.0, 10.0, 10.6, 11.5, 12.0, 13.3, 14.2, 15.0, 99.0}) {
    CAPTURE(time);
    CHECK(times.speed_at(time) == doctest::Approx(2.0 * factor_at(time)).epsilon(1e-12));
  }
  CHECK(times.largest_speed() == 6.0);
}

TEST_CASE("Frame times: a constant factor of 0.5 is half the speed, for pictures and sound") {
  const Shell shell;
  write_film_scene(shell, ", captions = [{ text = \"fades\", from = 1.0, to = 1.6 }]");
  const auto film = [&](const std::string& flags) {
    const Outcome outcome = shell.run(
        "rm -rf frames; clatter render scene.toml --quiet --size 160x120 --fps 10 --from 1 --to 2 "
        "--shutter 0.5 --sound --out frames " +
        flags);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    return shell
        .run("md5sum frames/sound.wav; ffmpeg -v error -i frames/frame_%06d.png -f framemd5 -")
        .out;
  };
  const std::string half = film("--speed 0.5");
  CHECK(std::ranges::count(half, '\n') > 20);
  CHECK(film("--speed 1 --set 'view.pace=[{time=0.0,factor=0.5}]'") == half);
  // A faster stretch that the film does not reach changes nothing.
  CHECK(film("--speed 1 --set "
             "'view.pace=[{time=0.0,factor=0.5},{time=9.0,factor=0.5},{time=10.0,factor=4.0}]'") ==
        half);
  CHECK(film("--speed 1") != half);
}

TEST_CASE("Frame times: captions fade for half a second of film at its speed") {
  const Shell shell;
  write_film_scene(shell, ", captions = [{ text = \"fades\", from = 1.0 }]");
  const auto picture = [&](const std::string& flags) {
    REQUIRE(shell
                .run("clatter render scene.toml --quiet --size 160x120 --from 1.2 --out a.png "
                     "--overwrite " +
                     flags)
                .code == 0);
    return shell.run("ffmpeg -v error -i a.png -f md5 -").out;
  };
  // At the speeds 0.1 and 0.2 the caption is complete after 0.05 and 0.1 time units.
  const std::string complete = picture("--speed 0.1");
  CHECK(picture("--speed 0.2") == complete);
  CHECK(picture("--speed 10") != complete);
  CHECK(picture("--speed 10 --set 'view.pace=[{time=0.0,factor=0.01}]'") == complete);
}

TEST_CASE("Frame times: a film has the frames of its pace, and refuses times out of order") {
  const Shell shell;
  write_film_scene(shell);
  const std::string line =
      "clatter render scene.toml --quiet --size 64x48 --fps 10 --speed 1 --out frames --set ";
  // From t = 1 on half as fast: 10 frames, then 20.
  REQUIRE(shell.run(line + "'view.pace=[{time=1.0,factor=1.0},{time=1.000001,factor=0.5}]' --to 2")
              .code == 0);
  CHECK(shell.run("ls frames | wc -l").out == "30\n");
  const auto time_of = [&](const std::string& frame) {
    return std::stod(
        *png_text(shell.path("frames/frame_0000" + frame + ".png"), "Simulation time"));
  };
  CHECK(time_of("05") == doctest::Approx(0.5).epsilon(1e-5));
  CHECK(time_of("12") == doctest::Approx(1.1).epsilon(1e-5));
  CHECK(time_of("29") == doctest::Approx(1.95).epsilon(1e-5));
  check_refused(shell, line + "'view.pace=[{time=3.0,factor=1.0},{time=2.0,factor=0.5}]' --to 2",
                {"view.pace", "the time 2 comes after 3"});
  check_refused(shell, line + "'view.pace=[{time=3.0,factor=0.0}]' --to 2", {"view.pace.factor"});
}

}  // namespace clatter
