// The plots of the tables of observables.

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "app/plots/table_plots.h"
#include "app/view/plots_panel.h"
#include "engine/scene/scene_file.h"
#include "tests/app/plot_checks.h"

namespace clatter {

/// The plots of a table of a gas without species.
static std::vector<LivePlot> plots_of_table(const ResultTable& table, const ThemeColours& theme) {
  return table_plots(table, Scene(), History(), theme);
}

TEST_CASE("Plots: a histogram with logarithmic bins is over their middles") {
  const ResultTable table = {"wall_hits.left.incoming",
                             {{"low", "a/t", {1.0, 2.0, 8.0}},
                              {"high", "a/t", {2.0, 8.0, 64.0}},
                              {"density", "1/(a/t)", {1.0, 0.5, 1e-3}, {0.1, 0.2, NAN}}}};
  const std::vector<LivePlot> plots = plots_of_table(table, kDarkTheme);
  REQUIRE(plots.size() == 1);
  CHECK(plots[0].title == "wall hits, left, incoming");
  check_axes(plots[0], "value in a/t", "1/(a/t)", true, true);
  REQUIRE(plots[0].curves.size() == 1);
  const Curve& curve = plots[0].curves[0];
  CHECK(curve.name == "density");
  CHECK(curve.colour == kDarkTheme.text);
  CHECK(curve.points == std::vector<Vec2>{{1.5, 1.0}, {5.0, 0.5}, {36.0, 1e-3}});
  CHECK(curve.errors == std::vector<double>{0.1, 0.2, 0.0});
}

TEST_CASE("Plots: a table has a plot for each unit, with the colours of the axes") {
  // Lags of growing spacing; a value that is missing has no point.
  const ResultTable table = {"mean_squared_displacement",
                             {{"time", "t", {0.0, 0.2, 3.0, 30.0}},
                              {"total", "a^2", {1.0, NAN, 3.0, 400.0}, {0.1, 0.1, 0.1, 0.1}},
                              {"y", "a^2", {0.5, 0.5, 0.5, 0.5}, {0.1, 0.1, 0.1, 0.1}},
                              {"drift_x", "a", {-1.0, 0.0, 1.0, 2.0}, {0.1, 0.1, 0.1, 0.1}}}};
  const std::vector<LivePlot> plots = plots_of_table(table, kLightTheme);
  REQUIRE(plots.size() == 2);
  check_axes(plots[0], "time in t", "a²", true, true);
  check_axes(plots[1], "time in t", "a", true, false);
  CHECK(curve_of(plots[0], "total").points ==
        std::vector<Vec2>{{0.0, 1.0}, {3.0, 3.0}, {30.0, 400.0}});
  CHECK(curve_of(plots[0], "total").colour == kLightTheme.text);
  CHECK(curve_of(plots[0], "y").colour == Colour{86, 180, 233});
  CHECK(curve_of(plots[1], "drift x").colour == Colour{230, 159, 0});
}

TEST_CASE("Plots: a logarithmic axis leaves out values with large errors") {
  ResultTable table = {"wall_power.total",
                       {{"low", "1", {-1.0, 0.0, 1.0}},
                        {"high", "1", {0.0, 1.0, 2.0}},
                        {"density", "1", {1.0, 3e-3, 4e-3}, {0.1, 2e-3, 1e-3}}}};
  using Points = std::vector<Vec2>;
  CHECK(plots_of_table(table, kDarkTheme)[0].curves[0].points == Points{{-0.5, 1.0}, {1.5, 4e-3}});
  table.columns[2].values[0] = 0.1;
  CHECK(plots_of_table(table, kDarkTheme)[0].curves[0].points.size() == 3);
}

TEST_CASE("Plots: exact columns are plotted only where a table has no estimates") {
  ResultTable table = {
      "structure_factor",
      {{"k", "1/a", {1.0, 2.0}}, {"vectors", "1", {4.0, 8.0}}, {"S", "1", {0.2, 0.3}, {0.1, 0.1}}}};
  CHECK(plots_of_table(table, kDarkTheme)[0].curves.size() == 1);
  table.columns[2].standard_errors.clear();
  CHECK(plots_of_table(table, kDarkTheme)[0].curves.size() == 2);
}

TEST_CASE("Plots: slabs have a curve each, the first and the last with names") {
  const ResultTable table = {"radial_distribution_profile",
                             {{"y_low", "a", {0.5, 0.5, 2.5, 2.5, 4.5, 4.5}},
                              {"y_high", "a", {2.5, 2.5, 4.5, 4.5, 6.5, 6.5}},
                              {"r", "a", {1.1, 1.3, 1.1, 1.3, 1.1, 1.3}},
                              {"g", "1", {2.0, 1.0, 3.0, 1.5, 4.0, 1.8}, {1, 2, 3, 4, 5, 6}}}};
  const std::vector<LivePlot> plots = plots_of_table(table, kDarkTheme);
  REQUIRE(plots.size() == 1);
  check_axes(plots[0], "r in a", "g", false, false);
  REQUIRE(plots[0].curves.size() == 3);
  CHECK(curve_of(plots[0], "y = 0.5 to 2.5").points == std::vector<Vec2>{{1.1, 2.0}, {1.3, 1.0}});
  CHECK(plots[0].curves[1].name.empty());
  CHECK(plots[0].curves[1].errors == std::vector<double>{3.0, 4.0});
  CHECK(curve_of(plots[0], "y = 4.5 to 6.5").points == std::vector<Vec2>{{1.1, 4.0}, {1.3, 1.8}});
  CHECK_FALSE(plots[0].curves[0].colour == plots[0].curves[2].colour);
}

/// A gas of light disks with a heavy one.
static const char* const kTwoSpecies = R"(box.size = [30, 30]
[particles]
[[species]]
name = "light"
count = 100
colour = "#010203"
[[species]]
name = "heavy"
count = 1
diameter = 2
colour = "#040506"
)";

// With the friction gamma the velocity correlation is D gamma exp(-gamma t), and the squared
// displacement its double integral: 4 D (t - (1 - exp(-gamma t))/gamma).
TEST_CASE("Plots: a species has its colour, and theory beside its diffusion") {
  const auto scene = std::make_shared<const Scene>(parse_scene(kTwoSpecies, "s.toml"));
  History history;
  history.predict(scene);
  const SpeciesTheory& theory = history.species_theory();
  const double friction = theory.frictions[1], diffusion = theory.diffusions[1];
  REQUIRE(diffusion * friction == doctest::Approx(theory.temperatures[1] / 4.0));
  const ResultTable table = {"mean_squared_displacement",
                             {{"time", "t", {0.0, 0.5, 1.0}},
                              {"total", "a^2", {0.0, 2.0, 4.0}},
                              {"total_light", "a^2", {0.0, 3.0, 5.0}},
                              {"x_light", "a^2", {0.0, 1.0, 2.0}},
                              {"total_heavy", "a^2", {0.0, 2.2, 6.8}}}};
  const LivePlot plot = table_plots(table, *scene, history, kDarkTheme).at(0);
  REQUIRE(plot.curves.size() == 5);  // none along the axes of a species
  CHECK(curve_of(plot, "total").colour == kDarkTheme.text);
  CHECK(curve_of(plot, "total light").colour == Colour{1, 2, 3});
  const Curve& einstein = curve_of(plot, "heavy, theory");
  CHECK(einstein.dashed);
  CHECK(einstein.colour == Colour{4, 5, 6});
  CHECK(einstein.points[0].y() == 0.0);
  CHECK(einstein.points[1].y() ==
        doctest::Approx(4.0 * diffusion * (0.5 - (1.0 - std::exp(-0.5 * friction)) / friction)));
  const ResultTable velocities = {
      "velocity_autocorrelation",
      {{"time", "t", {0.0, 1.0}}, {"mean_heavy", "a^2/t^2", {6.0, 1.0}}}};
  const LivePlot decay = table_plots(velocities, *scene, history, kDarkTheme).at(0);
  const Curve& expected = curve_of(decay, "heavy, theory");
  CHECK(expected.points[0].y() == doctest::Approx(diffusion * friction));
  CHECK(expected.points[1].y() == doctest::Approx(diffusion * friction * std::exp(-friction)));
}

TEST_CASE("Plots: columns belong to the species with the longest name at their end") {
  Scene scene = parse_scene(kTwoSpecies, "s.toml");
  scene.species[0].name = "x";
  scene.species[1].name = "heavy_x";
  const ResultTable table = {"mean_squared_displacement",
                             {{"time", "t", {0.0, 0.5}},
                              {"drift_x", "a", {0.0, 2.0}},
                              {"total_x", "a^2", {0.0, 3.0}},
                              {"total_heavy_x", "a^2", {0.0, 2.2}}}};
  const std::vector<LivePlot> plots = table_plots(table, scene, History(), kDarkTheme);
  CHECK(curve_of(plots.at(0), "drift x").colour == Colour{230, 159, 0});
  CHECK(curve_of(plots.at(1), "total x").colour == Colour{1, 2, 3});
  CHECK(curve_of(plots.at(1), "total heavy x").colour == Colour{4, 5, 6});
  const ResultTable velocities = {
      "velocity_distribution",
      {{"low", "1", {-1.0, 0.0}}, {"high", "1", {0.0, 1.0}}, {"y_heavy_x", "1", {0.5, 0.5}}}};
  CHECK(curve_of(table_plots(velocities, scene, History(), kDarkTheme).at(0), "y heavy x").colour ==
        Colour{4, 5, 6});
}

TEST_CASE("Plots: the copied numbers of a plot are its curves, a table each") {
  const Colour colour{};
  LivePlot plot{"Title", "x in a", false, false, {}, "unit"};
  plot.curves = {{"one", colour, {{1.0, 2.0}, {3.0, 4.0}}, false, false, {0.5, 0.25}},
                 {"", colour, {{5.0, 6.0}}}};
  CHECK(csv_of(plot) == "x in a,one,standard error\n1,2,0.5\n3,4,0.25\n\nx in a,Title\n5,6\n\n");
}

}  // namespace clatter
