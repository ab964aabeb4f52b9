// The plots beside the gas in films.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/plots/plot_recorder.h"
#include "engine/live/watched_run.h"
#include "engine/scene/scene_file.h"
#include "render/charts/plot_strip.h"
#include "render/context/context.h"
#include "render/output/cells.h"
#include "tests/app/film_scene.h"
#include "tests/render/picture.h"

namespace clatter {

namespace {

// Not 1, so that a sample of another speed has another spacing.
constexpr double kSpeed = 0.5;

// A rough gas between different walls, whose laws change at t = 3. Windows of the profile are 0.25
// long.
Scene changing_gas() {
  return parse_scene(R"(
box.size = [13.0, 11.0]
particles = { count = 60, restitution = 0.85, friction = 0.4 }
walls.left = { kind = "driven", drive_speed = 1.7 }
walls.right = { kind = "static" }
walls.bottom = { kind = "static" }
walls.top = { kind = "thermal", temperature = 2.0 }
gravity.acceleration = [0.0, -0.3]
measure.profile_axis = "y"
view = { window = 2.0, plots = ["temperature", "energy", "velocities", "temperature_profile"] }
[[change]]
time = 3.0
set.particles.restitution = 0.7
)",
                     "changing.toml");
}

std::vector<LivePlot> plots_of_film(const Scene& scene, PlottedGas gas) {
  std::vector<LivePlot> plots;
  for (const FilmPlot which : scene.view.plots) {
    const auto plot = film_plot(which, {gas}, kDarkTheme);
    REQUIRE(plot);
    plots.push_back(*plot);
  }
  return plots;
}

// `rounding`: relative to the largest value of a curve.
void check_same(const std::vector<LivePlot>& plots, const std::vector<LivePlot>& others,
                double rounding) {
  REQUIRE(plots.size() == others.size());
  for (std::size_t k = 0; k < plots.size(); ++k) {
    CAPTURE(plots[k].title);
    REQUIRE(plots[k].curves.size() == others[k].curves.size());
    CHECK(plots[k].x_label == others[k].x_label);
    for (std::size_t c = 0; c < plots[k].curves.size(); ++c) {
      const Curve &curve = plots[k].curves[c], &other = others[k].curves[c];
      CAPTURE(curve.name);
      CHECK(curve.name == other.name);
      CHECK_FALSE(curve.points.empty());
      REQUIRE(curve.points.size() == other.points.size());
      double most = 0.0, difference = 0.0;
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const Vec2 here = curve.points[i], there = other.points[i];
        CHECK(std::fabs(here.x() - there.x()) <= rounding * std::fabs(there.x()));
        most = std::max(most, std::fabs(there.y()));
        difference = std::max(difference, std::fabs(here.y() - there.y()));
      }
      CHECK(difference <= rounding * most);
      CHECK(curve.errors == other.errors);
      CHECK(plots[k].span == others[k].span);
    }
  }
}

// A run with the plots of its scene.
struct RecordedRun {
  explicit RecordedRun(const Scene& scene) : scene(scene), run(scene, 1) { record(""); }
  RecordedRun(const Scene& scene, const RunState<2>& state, const std::string& plots)
      : scene(scene), run(scene, 1, state) {
    record(plots);
  }

  void until(double time) {
    CHECK(recorder->run_until(time, [this](double end) { return run.run_until(end); }));
  }
  std::vector<LivePlot> plots() { return plots_of_film(scene, recorder->gas()); }

  Scene scene;
  ScheduledRun<2> run;
  std::unique_ptr<PlotRecorder<2>> recorder;

 private:
  void record(const std::string& saved) {
    const FilmPlots film{scene.view.plots, scene.measure.profile_axis, kSpeed};
    recorder = std::make_unique<PlotRecorder<2>>(run, film, saved);
  }
};

}  // namespace

TEST_CASE("Film plots: their values are those of the window at the same times") {
  const Scene scene = changing_gas();
  RecordedRun film(scene);
  film.until(6.02);

  const auto window = watched_run(scene, 1);
  window->show_profile(Profiled::Fields, Axis::Y);
  History history;
  Frame frame;
  frame.run = 1;
  frame.speed = kSpeed;
  for (int sample = 1; sample <= 120; ++sample) {
    window->run_until(sample * kSpeed / History::kPerSecond, kNoLimit, kNoLimit);
    window->fill(frame, false);
    history.add(frame);
  }
  window->run_until(6.02, kNoLimit, kNoLimit);
  window->fill(frame, false);
  // The window closes its sums at further times.
  check_same(film.plots(), plots_of_film(scene, {&history, &frame, ""}), 1e-12);
  CHECK(history.samples().size() == 120);
}

// The same gas with plots of its displacements and velocity correlations.
static Scene diffusing_gas() {
  Scene scene = changing_gas();
  scene.measure.observables = {ObservableKind::Collisions, ObservableKind::MeanSquaredDisplacement,
                               ObservableKind::VelocityAutocorrelation};
  scene.measure.mean_squared_displacement = {.interval = 0.07, .longest = 0.7, .lags = 5};
  scene.measure.velocity_autocorrelation = {.interval = 0.07, .longest = 0.7, .lags = 4};
  scene.view.plots = {FilmPlot::MeanSquaredDisplacement, FilmPlot::VelocityAutocorrelation};
  return scene;
}

TEST_CASE("Film plots: displacements and velocity correlations are those of the window") {
  const Scene scene = diffusing_gas();
  RecordedRun film(scene);
  film.until(2.6);
  const auto window = watched_run(scene, 1);
  window->show_profile(Profiled::Fields, Axis::Y);
  window->run_until(2.6, kNoLimit, kNoLimit);
  Frame frame;
  frame.run = 1;
  window->fill(frame, true);
  const History history;
  check_same(film.plots(), plots_of_film(scene, {&history, &frame, ""}), 0.0);

  // Flights are straight between collisions, so short displacements are those of free flight.
  const LivePlot moved = film.plots().at(0), velocities = film.plots().at(1);
  CHECK(moved.curves.at(0).name == "total");
  CHECK(velocities.curves.at(0).name == "mean");
  const Vec2 first = moved.curves[0].points.at(1), zero = velocities.curves[0].points.at(0);
  CHECK(first.x() == doctest::Approx(0.07));
  CHECK(zero.x() == 0.0);
  CHECK(first.y() == doctest::Approx(2.0 * zero.y() * 0.07 * 0.07).epsilon(0.1));

  // Two gases: a curve for each.
  const PlottedGas one = film.recorder->gas();
  const auto compared =
      film_plot(FilmPlot::MeanSquaredDisplacement,
                {{one.history, one.frame, "A"}, {one.history, one.frame, "B"}}, kDarkTheme);
  REQUIRE(compared);
  REQUIRE(compared->curves.size() == 2);
  CHECK(compared->curves[1].name == "B");
  CHECK(compared->curves[1].points == moved.curves[0].points);
}

TEST_CASE("Film plots: they do not change the run, and continue from a checkpoint to the bit") {
  Scene scene;
  SUBCASE("profiles") {
    scene = changing_gas();
  }
  SUBCASE("observables") {
    scene = diffusing_gas();
  }
  RecordedRun whole(scene), begun(scene);
  whole.until(8.0);
  ScheduledRun<2> plain(scene, 1);
  plain.run_until(8.0);
  CHECK(whole.run.simulation().state_hash() == plain.simulation().state_hash());

  // Between two samples, and after the change.
  for (const double time : {1.13, 4.27}) {
    CAPTURE(time);
    begun.until(time);
    RecordedRun resumed(scene, begun.run.simulation().save(), begun.recorder->save());
    check_same(resumed.plots(), begun.plots(), 0.0);
    resumed.until(8.0);
    check_same(resumed.plots(), whole.plots(), 0.0);
  }
}

TEST_CASE("Film plots: other laws or another axis restart the samples") {
  Scene scene = changing_gas();
  scene.changes.clear();
  RecordedRun begun(scene);
  begun.until(4.0);
  const auto check_restarts = [&](const Scene& other) {
    RecordedRun resumed(other, begun.run.simulation().save(), begun.recorder->save());
    CHECK(resumed.recorder->gas().history->samples().empty());
    resumed.until(4.52);
    CHECK(resumed.recorder->gas().history->samples().size() == 10);
    CHECK(resumed.plots().size() == other.view.plots.size());
  };
  Scene other = scene;
  other.particles.roughness.friction = 0.1;
  check_restarts(other);
  other = scene;
  other.measure.profile_axis = Axis::X;
  check_restarts(other);
  other = scene;
  other.view.plots = {FilmPlot::Temperature};
  check_restarts(other);
  other = diffusing_gas();
  other.changes.clear();
  check_restarts(other);
}

TEST_CASE("Film plots: a name selects its quantity") {
  Scene scene = changing_gas();
  scene.view.plots = {FilmPlot::DensityProfile, FilmPlot::TemperatureProfile,
                      FilmPlot::StressProfile, FilmPlot::HeatFluxProfile};
  RecordedRun film(scene);
  film.until(5.0);
  std::vector<std::string> names;
  for (const LivePlot& plot : film.plots()) {
    CHECK(plot.x_label == "y in a");
    names.push_back(plot.curves.front().name);
  }
  CHECK(names == std::vector<std::string>{"density ρ", "temperature T", "stress σ", "heat flux q"});
  const auto dissipation =
      film_plot(FilmPlot::DissipationProfile, {film.recorder->gas()}, kDarkTheme);
  REQUIRE(dissipation);
  for (const Vec2& point : dissipation->curves.front().points) CHECK(point.y() <= 0.0);
  for (const auto& [which, title] : {std::pair(FilmPlot::Temperature, "Temperature"),
                                     {FilmPlot::Energy, "Energy per time"},
                                     {FilmPlot::Velocities, "Velocities"}}) {
    const auto plot = film_plot(which, {film.recorder->gas()}, kDarkTheme);
    REQUIRE(plot);
    CHECK(plot->title == title);
  }
}

TEST_CASE("Film plots: the strip is beside a wide picture and below a high one") {
  for (const Size whole : {Size{1280, 720}, Size{321, 321}, Size{240, 401}}) {
    CAPTURE(whole.width);
    const auto [gases, plots] = split_for_plots(whole);
    const bool beside = whole.width >= whole.height;
    CHECK(plots.left == (beside ? gases.size.width : 0));
    CHECK(plots.top == (beside ? 0 : gases.size.height));
    CHECK(plots.left + plots.size.width == whole.width);
    CHECK(plots.top + plots.size.height == whole.height);
    const double share =
        beside ? 1.0 * plots.size.width / whole.width : 1.0 * plots.size.height / whole.height;
    CHECK(share == doctest::Approx(0.3).epsilon(0.05));
  }
}

TEST_CASE("Film plots: curves are drawn where their axes say") {
  constexpr Colour kMarked = {0xff, 0x00, 0x00};
  // A line at 2 on an axis from 0 to 4.2, which has 5 % above the largest value.
  LivePlot plot{"Title", "x", false, false, {}, "unit"};
  plot.curves = {{"", kMarked, {{0.0, 2.0}, {1.0, 2.0}}},
                 {"", {0, 0, 0xff}, {{0.0, 0.0}, {1.0, 4.0}}}};
  const auto context = open_context(Backend::Auto);
  for (const bool transparent : {false, true}) {
    CAPTURE(transparent);
    PlotStrip strip(context->gl(), {300, 400}, {1000, 720}, transparent);
    const Image image = strip.draw({plot, std::nullopt}, kDarkTheme);
    REQUIRE(image.size == Size{300, 400});
    int low = 400, high = 0, left = 300, right = 0, marked = 0;
    for (int y = 0; y < 400; ++y) {
      for (int x = 0; x < 300; ++x) {
        const Colour colour = pixel(image, x, y);
        if (colour.red < 0xc0 || colour.green > 0x60) continue;
        ++marked;
        low = std::min(low, y), high = std::max(high, y);
        left = std::min(left, x), right = std::max(right, x);
      }
    }
    REQUIRE(marked > 0);
    // One line over the width of the axes, in the upper half: the second place is empty.
    CHECK(high - low <= 3);
    CHECK(left > 40);
    CHECK(right > 260);
    CHECK(high < 200);
    CHECK(pixel(image, 150, 300).alpha == (transparent ? 0 : 0xff));
  }
}

TEST_CASE("Film plots: each has its place in a strip, also below a high picture") {
  constexpr std::array<Colour, 4> kColours = {
      {{0xff, 0x00, 0x00}, {0x00, 0xff, 0x00}, {0x00, 0x00, 0xff}, {0xff, 0xff, 0x00}}};
  const auto context = open_context(Backend::Auto);
  for (const Size size : {Size{384, 720}, Size{720, 384}}) {
    CAPTURE(size.width);
    PlotStrip strip(context->gl(), size, {1280, 720}, false);
    for (std::size_t count = 1; count <= 4; ++count) {
      CAPTURE(count);
      std::vector<std::optional<LivePlot>> plots;
      for (std::size_t k = 0; k < count; ++k) {
        LivePlot plot{"Title", "x", false, false, {}, "unit"};
        plot.curves = {{"", kColours[k], {{0.0, 2.0}, {0.9, 2.0}, {1.0, 4.0}}}};
        plots.push_back(plot);
      }
      const Image image = strip.draw(plots, kDarkTheme);
      for (std::size_t k = 0; k < count; ++k) {
        CAPTURE(k);
        // The rectangle of the curve along the strip, in places of a plot.
        double low = 1e9, high = 0.0;
        int marked = 0;
        for (int y = 0; y < size.height; ++y) {
          for (int x = 0; x < size.width; ++x) {
            if (difference(pixel(image, x, y), kColours[k]) > 0x40) continue;
            const bool column = size.height > size.width;
            const double place = column ? 1.0 * y / size.height : 1.0 * x / size.width;
            low = std::min(low, place * static_cast<double>(count));
            high = std::max(high, place * static_cast<double>(count));
            ++marked;
          }
        }
        CHECK(marked > 30);
        CHECK(low >= static_cast<double>(k));
        CHECK(high <= static_cast<double>(k + 1));
      }
    }
  }
}

TEST_CASE("Film plots: compared gases have one axis, that of the first scene") {
  const Shell shell;
  const std::string scene =
      "box.size = [12.0, 12.0]\nparticles = { count = 50, restitution = 0.9 }\n"
      "view = { window = 1.0, plots = [\"density_profile\"] }\n";
  shell.write("a.toml", scene);
  shell.write("b.toml", scene + "measure.profile_axis = \"y\"\n");
  const std::string line = "clatter render a.toml --quiet --size 300x100 --to 3 --out ";
  REQUIRE(shell.run(line + "one.png --compare measure.profile_axis=y").code == 0);
  REQUIRE(shell.run(line + "two.png --compare measure.profile_axis=x").code == 0);
  const auto strip = [&](const std::string& file) {
    return shell.run("ffmpeg -v error -i " + file + " -vf format=rgba,crop=90:100:210:0 -f md5 -")
        .out;
  };
  CHECK(strip("one.png") == strip("two.png"));
  REQUIRE(shell
              .run(line + "three.png --set measure.profile_axis=y "
                          "--compare measure.profile_axis=x")
              .code == 0);
  CHECK(strip("three.png") != strip("one.png"));
}

TEST_CASE("Film plots: a film has them, and a scene has at most four") {
  const Shell shell;
  write_film_scene(shell, ", plots = [\"temperature\", \"energy\"]");
  const std::string line = "clatter render scene.toml --quiet --to 2 ";
  const Outcome drawn = shell.run(line + "--size 200x100 --out with.png");
  CAPTURE(drawn.err);
  REQUIRE(drawn.code == 0);
  REQUIRE(shell.run(line + "--set 'view.plots=[]' --size 140x100 --out without.png").code == 0);
  // The letters have another size in the smaller picture, so that only the middle is the same.
  CHECK(png_text(shell.path("with.png"), "State hash") ==
        png_text(shell.path("without.png"), "State hash"));
  const auto colours = [&](const std::string& file, const std::string& part) {
    return shell.run("ffmpeg -v error -i " + file + " -vf format=rgba,crop=" + part + " -f md5 -")
        .out;
  };
  CHECK(colours("with.png", "60:100:140:0") != colours("with.png", "60:100:80:0"));
  check_refused(shell,
                line +
                    "--out no.png --set 'view.plots=[\"temperature\", \"energy\", "
                    "\"velocities\", \"density_profile\", \"stress_profile\"]'",
                {"view.plots", "at most 4 plots"});
}

}  // namespace clatter
