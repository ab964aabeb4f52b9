// The plots of the species of a mixture.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/plots/species_plots.h"
#include "app/results/mixture_theory_json.h"
#include "engine/live/watched_run.h"
#include "engine/scene/scene_file.h"
#include "tests/app/plot_checks.h"

namespace clatter::species_plots {

namespace {

// Kicks of the energy law, so that there is a theory.
constexpr const char* kKicked = R"(
box.size = [30, 20]
particles.restitution = 0.9
species = [{ name = "light", count = 100 }, { name = "heavy", count = 40, mass = 8.0 }]
bulk_drive = { interval = 0.1, kick_speed = 0.2, law = "energy" }
view.window = 0.5
)";

// Frames of a run, at equal times.
struct Watched {
  Watched(const Scene& scene, int frames) : run(watched_run(scene, 3)) {
    run->show_profile(Profiled::Fields, Axis::X);
    for (int k = 1; k <= frames; ++k) {
      run->run_until(0.5 * k, kNoLimit, kNoLimit);
      frame.run = 1;
      run->fill(frame, false);
      history.add(frame);
    }
  }

  LivePlot plot(const std::string& title) const {
    for (const LivePlot& plot : plots_of(history, frame, 0, kDarkTheme)) {
      if (plot.title == title) return plot;
    }
    FAIL("no plot " << title);
    return {};
  }

  std::unique_ptr<WatchedRun> run;
  Frame frame;
  History history;
};

}  // namespace

TEST_CASE("Species plots: the temperatures of a frame have the mean T, and theory is dashed") {
  const Scene scene = parse_scene(kKicked, "");
  const Watched gas(scene, 9);
  const LivePlot plot = gas.plot("Temperatures of species");
  check_axes(plot, "time t", "m a²/t²", false, false);
  const double light = curve_of(plot, "light").points.back().y();
  const double heavy = curve_of(plot, "heavy").points.back().y();
  CHECK((100.0 * light + 40.0 * heavy) / 140.0 ==
        doctest::Approx(gas.frame.snapshot.temperature).epsilon(1e-12));
  CHECK(plot.curves[0].points.size() == 9);
  const auto theory = mixture_theory_json(scene).at("species");
  REQUIRE(plot.curves.size() == 4);
  for (const std::size_t s : {0, 1}) {
    const Curve& predicted = plot.curves[2 * s + 1];
    CHECK(predicted.dashed);
    CHECK(predicted.colour == plot.curves[2 * s].colour);
    CHECK(predicted.points.back().y() == theory[s].at("temperature").get<double>());
  }
}

TEST_CASE("Species plots: the theory of free cooling is a share of the present T") {
  Scene scene = parse_scene(kKicked, "");
  scene.bulk_drive.reset();
  const Watched gas(scene, 6);
  const LivePlot plot = gas.plot("Temperatures of species");
  check_axes(plot, "time t", "m a²/t²", true, true);
  const double ratio = mixture_theory_json(scene).at("species")[1].at("temperature_ratio");
  CHECK(plot.curves[3].points[4].y() ==
        doctest::Approx(ratio * curve_of(gas.plot("Temperature"), "T").points[4].y()));
}

TEST_CASE("Species plots: films have both plots, of two gases the last species of each") {
  const Watched gas(parse_scene(kKicked, ""), 3);
  const auto film = [&](FilmPlot which, std::size_t gases) {
    std::vector<PlottedGas> plotted;
    for (std::size_t k = 0; k < gases; ++k) {
      plotted.push_back({&gas.history, &gas.frame, "gas " + std::to_string(k)});
    }
    return film_plot(which, plotted, kDarkTheme);
  };
  CHECK(film(FilmPlot::Mixing, 1)->curves.size() == 4);
  CHECK(film(FilmPlot::SpeciesTemperature, 1)->curves[0].name == "light");
  const auto compared = film(FilmPlot::SpeciesTemperature, 2);
  REQUIRE(compared->curves.size() == 2);
  CHECK(compared->title == "Temperatures of species, heavy");
  CHECK(compared->curves[1].name == "gas 1");
  CHECK(compared->curves[1].points.back().y() ==
        curve_of(gas.plot("Temperatures of species"), "heavy").points.back().y());
}

TEST_CASE("Species plots: a profile has the density of each species") {
  const Watched gas(parse_scene(kKicked, ""), 12);
  const LivePlot plot = gas.plot("Profile");
  REQUIRE(plot.curves.size() == 3);
  double light = 0.0;
  for (std::size_t i = 0; i < plot.curves[0].points.size(); ++i) {
    CHECK(curve_of(plot, "light").points[i].y() + curve_of(plot, "heavy").points[i].y() ==
          doctest::Approx(plot.curves[0].points[i].y()).epsilon(1e-12));
    light += curve_of(plot, "light").points[i].y();
  }
  CHECK(light * 600.0 / static_cast<double>(plot.curves[0].points.size()) ==
        doctest::Approx(100.0).epsilon(1e-10));
}

// 40 particles in a box of 20 x 10 have two cells, one on the left and one on the right.
TEST_CASE("Species plots: mixing is 0 of separate species, and the expectation is dashed") {
  const auto scene = std::make_shared<Scene>(
      parse_scene("box.size = [20, 10]\nspecies = [{ name = 'a', count = 24 }, { name = 'b', "
                  "count = 16 }]\n",
                  ""));
  Frame frame;
  frame.run = 1;
  frame.scene = scene;
  frame.tally.temperature_integral = Vec2(1.0, 1.0);
  frame.snapshot.box = scene->box;
  frame.snapshot.velocities = Vectors::Ones(2, 40);
  frame.snapshot.positions = Vectors::Constant(2, 40, 5.0);
  frame.snapshot.grains.resize(40);
  for (int i = 24; i < 40; ++i) {
    frame.snapshot.positions(0, i) = 15.0;
    frame.snapshot.grains[static_cast<std::size_t>(i)].species = 1;
  }
  History history;
  for (const double time : {1.0, 2.0}) {
    frame.tally.time = frame.snapshot.time = frame.head = time;
    history.add(frame);
    frame.snapshot.positions.row(0).setConstant(5.0);
    frame.snapshot.positions.row(0).rightCols(20).setConstant(15.0);
    for (int i = 0; i < 40; ++i)
      frame.snapshot.grains[static_cast<std::size_t>(i)].species = i % 5 > 2;
  }
  const LivePlot plot = mixing_plot(history.samples(), kDarkTheme.text);
  check_axes(plot, "time t", "0 apart, 1 mixed", false, false);
  const std::vector<Vec2>& lacey = curve_of(plot, "Lacey").points;
  CHECK(lacey[0].y() == doctest::Approx(0.0));
  CHECK(lacey[1].y() == doctest::Approx(1.0 / (1.0 - 1.0 / 39.0)));  // equal shares in both cells
  CHECK(curve_of(plot, "entropy").points[0].y() == 0.0);
  CHECK(curve_of(plot, "entropy").points[1].y() == doctest::Approx(1.0));
  CHECK(curve_of(plot, "at random").points[1].y() == 1.0);
  CHECK(plot.curves[3].dashed);
  CHECK(plot.curves[3].points[1].y() < 1.0);
}

}  // namespace clatter::species_plots
