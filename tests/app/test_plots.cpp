// The plots of the window: curves with names and units, also without data.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "app/plots/plots.h"
#include "app/results/theory_json.h"
#include "app/view/table_plots.h"
#include "engine/error.h"
#include "engine/publish/watched_run.h"
#include "engine/scene/scene_file.h"
#include "render/layers/fonts.h"
#include "render/layers/gui_context.h"
#include "tests/support/drawn_text.h"

namespace clatter {

namespace {

void check_finite(const LivePlot& plot) {
  CAPTURE(plot.title);
  for (const PlotScale& scale : scales_of(plot)) {
    CHECK(std::isfinite(scale.low));
    CHECK(std::isfinite(scale.high));
    CHECK(scale.low < scale.high);
  }
}

// Runs as far as possible: a wall of temperature 0 keeps the disks.
void go_on(WatchedRun& run, double time) {
  try {
    run.run_until(time, kNoLimit, kNoLimit);
  } catch (const PhysicalStop&) {
  }
}

// A gas with driven walls, and two frames of it. The sums gain different numbers between the
// frames.
struct TwoFrames {
  TwoFrames() {
    scene->box = Vec2(13.0, 11.0);
    scene->particles.count = 60;
    scene->particles.restitution = 0.85;
    scene->walls[kLeft] = scene->walls[kRight] = Wall{.kind = WallKind::Driven, .drive_speed = 1.7};
    begin.run = end.run = 1;
    begin.scene = end.scene = scene;
    begin.tally = {.time = 2.0,
                   .temperature_integral = Vec2(1.0, 2.0),
                   .walls_in = 3.0,
                   .bulk_in = 4.0,
                   .gravity_in = 5.0,
                   .dissipated = 6.0};
    end.tally = {.time = 4.0,
                 .temperature_integral = Vec2(7.0, 12.0),
                 .walls_in = 17.0,
                 .bulk_in = 22.0,
                 .gravity_in = 25.0,
                 .dissipated = 30.0};
    begin.snapshot.time = 10.0;
    end.snapshot.time = 12.0;
    end.ledger_residual = -3e-15;
    end.deepest_overlap = 4e-13;
    // The standard deviation of each component is 2, from values with two signs, and from values
    // with one sign.
    end.snapshot.positions = Vectors::Zero(2, 4);
    end.snapshot.velocities.resize(2, 4);
    end.snapshot.velocities << 2.0, 2.0, 2.0, -2.0, 0.0, 0.0, 0.0, 4.0;
    for (const Frame& frame : {begin, end}) history.add(frame);
  }

  std::vector<LivePlot> plots(std::size_t profiled = 0) const {
    return plots_of(history, end, profiled, kDarkTheme);
  }
  LivePlot plot(const std::string& title, std::size_t profiled = 0) const {
    for (const LivePlot& plot : plots(profiled)) {
      if (plot.title == title) return plot;
    }
    FAIL("no plot " << title);
    return {};
  }

  std::shared_ptr<Scene> scene = std::make_shared<Scene>();
  Frame begin, end;
  History history;
};

void check_axes(const LivePlot& plot, const char* x, const char* y, bool log_x, bool log_y) {
  CHECK(plot.x_label == x);
  CHECK(plot.y_label == y);
  CHECK(plot.log_x == log_x);
  CHECK(plot.log_y == log_y);
}

const Curve& curve_of(const LivePlot& plot, const std::string& name) {
  for (const Curve& curve : plot.curves) {
    if (curve.name == name) return curve;
  }
  FAIL("no curve " << name);
  return plot.curves.front();
}

// The end point of a plot's curve.
void check_last(const LivePlot& plot, const std::string& name, double x, double y) {
  CAPTURE(name);
  const Vec2 last = curve_of(plot, name).points.back();
  CHECK(last.x() == doctest::Approx(x));
  CHECK(std::fabs(last.y() - y) <= 1e-12 * y);
}

}  // namespace

TEST_CASE("Plots: a look into the past adds no samples, another future removes the later ones") {
  TwoFrames run;
  run.begin.head = run.begin.snapshot.time;
  run.end.head = run.end.snapshot.time;
  Frame later = run.end;
  later.tally.time = 7.0;
  later.snapshot.time = later.head = run.end.snapshot.time + 3.0;
  for (const Frame& frame : {run.begin, run.end, later}) run.history.add(frame);
  const std::size_t samples = run.history.samples().size();
  Frame past = run.end;
  past.head = later.head;
  run.history.add(past);
  run.history.add(later);
  CHECK(run.history.samples().size() == samples);

  Frame fork = run.end;
  fork.futures = 1;
  fork.forked_at = fork.head;
  run.history.add(fork);
  CHECK(run.history.samples().size() == samples - 1);
  CHECK(run.history.samples().back().time < fork.forked_at);
  Frame after = later;
  after.futures = 1;
  after.forked_at = fork.forked_at;
  run.history.add(after);
  CHECK(run.history.samples().size() == samples);
}

TEST_CASE("Plots: a constant quantity looks constant, in spite of rounding errors") {
  const auto height = [](std::vector<Vec2> points, double span) {
    LivePlot plot{.title = "", .x_label = "", .curves = {{"", {}, std::move(points)}}};
    plot.span = span;
    const PlotScale y = scales_of(plot)[1];
    CHECK(y.low < y.high);
    return y.high - y.low;
  };
  // Relative to the value: the rounding errors of -5 are no more than 1e-6 of the axis.
  CHECK(height({{0.0, -5.0}, {1.0, -5.0 - 1e-13}, {2.0, -5.0 + 1e-13}}, 0.0) > 1e-7);
  // Relative to the given length, for values around zero.
  CHECK(height({{0.0, 0.0}, {1.0, 1e-13}, {2.0, -2e-13}}, 0.5) >= 0.5);
  CHECK(height({{0.0, 0.0}, {1.0, 1e-3}}, 1e-6) < 2e-3);

  // An elastic gas without drives: no energy is gained or lost.
  Scene elastic;
  elastic.particles.count = 50;
  elastic.particles.restitution = 1.0;
  const auto run = watched_run(elastic, 1);
  History history;
  Frame frame;
  frame.run = 1;
  for (double time = 1.0; time < 20.0; time += 1.0) {
    run->run_until(time, kNoLimit, kNoLimit);
    run->tell(frame, false);
    history.add(frame);
  }
  for (const LivePlot& plot : plots_of(history, frame, 0, theme_of(View{}))) {
    if (plot.title != "Energy per time") continue;
    const PlotScale y = scales_of(plot)[1];
    CHECK(y.high - y.low > 1e-5);
    CHECK(y.high - y.low < 1e-2);
  }
}

TEST_CASE("Plots: curves over time are gains since the previous frame, with their names") {
  const TwoFrames frames;
  const LivePlot temperature = frames.plot("Temperature");
  check_axes(temperature, "time t", "m a²/t²", false, false);
  check_last(temperature, "T_x", 11.0, 3.0);
  check_last(temperature, "T_y", 11.0, 5.0);
  check_last(temperature, "T", 11.0, 4.0);
  // The levels of the theory extend over the whole time.
  const nlohmann::json theory = theory_json(*frames.scene);
  for (const std::string name : {"simple", "refined", "corrected"}) {
    const Curve& curve = curve_of(temperature, name);
    CHECK(curve.dashed);
    REQUIRE(curve.points.size() == 2);
    CHECK(curve.points[0].x() == 9.0);
    for (const Vec2& point : curve.points) CHECK(point.y() == theory.at("temperature_" + name));
    CHECK(curve.points[1].x() == 11.0);
  }
  CHECK(temperature.curves.size() == 6);

  const LivePlot energy = frames.plot("Energy per time");
  check_axes(energy, "time t", "m a²/t³", false, false);
  check_last(energy, "in", 11.0, 7.0 + 9.0 + 10.0);
  check_last(energy, "dissipated", 11.0, 12.0);
  check_last(energy, "difference", 11.0, 14.0);
  CHECK(energy.curves.size() == 3);

  const LivePlot residuals = frames.plot("Residuals");
  check_axes(residuals, "time t", "relative", false, true);
  check_last(residuals, "energy", 11.0, 3e-15);
  check_last(residuals, "overlap", 11.0, 4e-13);
  CHECK(residuals.curves.size() == 2);
}

TEST_CASE("Plots: a sample has each gain under its own name, and the size of residuals") {
  const TwoFrames frames;
  REQUIRE(frames.history.samples().size() == 2);
  const Sample& sample = frames.history.samples()[1];
  CHECK(sample.time == 11.0);
  CHECK(sample.temperature == Vec2(3.0, 5.0));
  CHECK(sample.walls_in == 7.0);
  CHECK(sample.bulk_in == 9.0);
  CHECK(sample.gravity_in == 10.0);
  CHECK(sample.dissipated == 12.0);
  CHECK(sample.ledger_residual == 3e-15);
  CHECK(sample.deepest_overlap == 4e-13);
}

TEST_CASE("Plots: where samples become too many, two are joined to their mean or largest") {
  TwoFrames frames;
  History history;
  Frame frame = frames.begin;
  frame.speed = 0.0;
  // Sample k of these cumulative sums is k times the first.
  for (int k = 1; k <= 1201; ++k) {
    frame.tally.time = frame.snapshot.time = k;
    const double sum = 0.5 * k * (k + 1);
    frame.tally.temperature_integral = sum * Vec2(1.0, 2.0);
    frame.tally.walls_in = 3.0 * sum;
    frame.tally.bulk_in = 4.0 * sum;
    frame.tally.gravity_in = 5.0 * sum;
    frame.tally.dissipated = 6.0 * sum;
    // The larger residual is the first or the second of a pair.
    frame.ledger_residual = k % 2 ? 7.0 + k : k;
    frame.deepest_overlap = k % 2 ? k : 8.0 + k;
    history.add(frame);
  }
  REQUIRE(history.samples().size() == 600);
  const Sample& first = history.samples()[0];
  CHECK(first.time == 1.0);
  CHECK(first.temperature == Vec2(1.5, 3.0));
  CHECK(first.walls_in == 4.5);
  CHECK(first.bulk_in == 6.0);
  CHECK(first.gravity_in == 7.5);
  CHECK(first.dissipated == 9.0);
  CHECK(first.ledger_residual == 8.0);
  CHECK(first.deepest_overlap == 10.0);
}

TEST_CASE("Plots: another run begins with its own sums") {
  TwoFrames frames;
  Frame again = frames.begin;
  again.run = 2;
  frames.history.add(again);
  REQUIRE(frames.history.samples().size() == 1);
  // From time 0 to 2.
  CHECK(frames.history.samples()[0].temperature == Vec2(0.5, 1.0));
  CHECK(frames.history.samples()[0].walls_in == 1.5);
}

TEST_CASE("Plots: velocities stand over their standard deviation beside the Gaussian") {
  const TwoFrames frames;
  const LivePlot plot = frames.plot("Velocities");
  check_axes(plot, "v / standard deviation", "density", false, true);
  const auto density_at = [&](const char* name, double v) {
    double density = -1.0;
    for (const Vec2& point : curve_of(plot, name).points) {
      if (std::fabs(point.x() - v) <= 5.0 / 61.0) density = point.y();
    }
    return density;
  };
  const double width = 10.0 / 61.0;
  CHECK(density_at("v_x", 1.0) == doctest::Approx(0.75 / width));
  CHECK(density_at("v_x", -1.0) == doctest::Approx(0.25 / width));
  CHECK(density_at("v_x", 2.0) == 0.0);
  CHECK(density_at("v_y", 0.0) == doctest::Approx(0.75 / width));
  CHECK(density_at("v_y", 2.0) == doctest::Approx(0.25 / width));
  const Curve& gaussian = curve_of(plot, "Gaussian");
  CHECK(gaussian.dashed);
  CHECK(gaussian.points.front().x() == -4.0);
  for (const Vec2& point : gaussian.points) {
    CHECK(point.y() == doctest::Approx(std::exp(-0.5 * point.x() * point.x()) /
                                       std::sqrt(2.0 * std::numbers::pi)));
  }
}

TEST_CASE("Plots: Fig. 3.1 has the gas among the curves of theory, over 1/(eps psi)") {
  const TwoFrames frames;
  const LivePlot plot = frames.plot("Fig. 3.1");
  check_axes(plot, "1/(ε ψ)", "T/(m v_dr²)", true, true);
  const double psi = theory_json(*frames.scene).at("psi"), epsilon = 1.0 - 0.85 * 0.85;
  // The second half of two samples is the second sample.
  check_last(plot, "this gas", 1.0 / (epsilon * psi), 4.0 / (1.7 * 1.7));
  CHECK(curve_of(plot, "this gas").as_point);
  // At the left end of the curves disks lose all normal velocity: eps = 1.
  Scene sticky = *frames.scene;
  sticky.particles.restitution = 0.0;
  const nlohmann::json theory = theory_json(sticky);
  for (const std::string name : {"simple", "refined"}) {
    CAPTURE(name);
    const Curve& curve = curve_of(plot, name);
    CHECK(curve.dashed);
    CHECK(curve.points.front().x() == doctest::Approx(1.0 / psi));
    CHECK(curve.points.front().y() ==
          doctest::Approx(theory.at("temperature_" + name).get<double>() / (1.7 * 1.7)));
  }
}

TEST_CASE("Plots: each theory states its meaning") {
  const TwoFrames two;
  const LivePlot plot = two.plot("Temperature");
  for (const char* name : {"simple", "refined", "corrected"}) {
    CHECK_FALSE(curve_of(plot, name).help.empty());
  }
}

TEST_CASE("Plots: a profile has its field's name, unit, values and errors over the columns") {
  TwoFrames frames;
  Profile profile;
  profile.edges = {0.0, 2.0, 6.0};
  for (const Field field : profiled_fields(Axis::X)) {
    const double number = static_cast<double>(profile.fields.size());
    profile.fields.push_back(field);
    profile.values.push_back({{10.0 + number, 0.1 + number}, {20.0 + number, 0.2 + number}});
  }
  frames.end.profile = profile;
  const std::array<std::array<const char*, 3>, 5> told = {
      {{"density", "density ρ", "1/a²"},
       {"temperature", "temperature T", "m a²/t²"},
       {"stress xx", "stress σ", "m/t²"},
       {"heat flux x", "heat flux q", "m a/t³"},
       {"dissipation", "dissipation ζ", "m/t³"}}};
  for (std::size_t k = 0; k < told.size(); ++k) {
    CAPTURE(told[k][0]);
    const double number = static_cast<double>(k);
    CHECK(profile_names(Axis::X)[k] == told[k][0]);
    CHECK(profiled_by(k) == Profiled::Fields);
    const LivePlot plot = frames.plot("Profile", k);
    check_axes(plot, "x in a", told[k][2], false, false);
    REQUIRE(plot.curves.size() == 1);
    CHECK(plot.curves[0].name == told[k][1]);
    CHECK(plot.curves[0].points == std::vector<Vec2>{{1.0, 10.0 + number}, {4.0, 20.0 + number}});
    CHECK(plot.curves[0].errors == std::vector<double>{0.1 + number, 0.2 + number});
  }
  CHECK(profile_names(Axis::X)[told.size()] == "balance residuals");
  CHECK(profiled_by(told.size()) == Profiled::Balances);
}

TEST_CASE("Plots: the density of an atmosphere stands beside its law") {
  TwoFrames frames;
  *frames.scene = load_scene("barometer");
  Profile profile;
  profile.axis = Axis::Y;
  profile.edges = {0.0, 20.0, 40.0};
  profile.fields = {Quantity::Density, Quantity::Temperature};
  profile.values = {{{0.3, 0.01}, {0.1, 0.01}}, {{3.0, 0.1}, {3.0, 0.1}}};
  frames.end.profile = profile;
  const Curve law = curve_of(frames.plot("Profile"), "atmosphere");
  CHECK(law.dashed);
  CHECK_FALSE(law.help.empty());
  CHECK(law.points.front().x() == 0.5);
  CHECK(law.points.back().x() == doctest::Approx(39.5));
  // The pressures of floor and lid differ by the weight, N g/Lx = 200/30 (Henderson 1975).
  const auto pressure = [](double rho) {
    const double phi = 0.25 * std::numbers::pi * rho;
    return 3.0 * rho * (1.0 + phi * phi / 8.0) / std::pow(1.0 - phi, 2);
  };
  CHECK(pressure(law.points.front().y()) - pressure(law.points.back().y()) ==
        doctest::Approx(200.0 / 30.0));
  // Other fields and axes have no such law, and gases that lose energy neither.
  CHECK(frames.plot("Profile", 1).curves.size() == 1);
  frames.end.profile->axis = Axis::X;
  CHECK(frames.plot("Profile").curves.size() == 1);
  frames.end.profile->axis = Axis::Y;
  frames.scene->particles.restitution = 0.99;
  CHECK(frames.plot("Profile").curves.size() == 1);
}

TEST_CASE("Plots: a gas that cools has Haff's law on logarithmic axes") {
  TwoFrames frames;
  *frames.scene = load_scene("cooling");
  const double start = frames.scene->particles.start.temperature;
  const double rate = theory_json(*frames.scene).at("haff_rate");
  const LivePlot plot = frames.plot("Temperature");
  check_axes(plot, "time t", "m a²/t²", true, true);
  const Curve& haff = curve_of(plot, "Haff");
  CHECK(haff.dashed);
  CHECK(haff.points.front().x() == doctest::Approx(9.0));
  CHECK(haff.points.back().x() == doctest::Approx(11.0));
  for (const Vec2& point : haff.points) {
    CHECK(point.y() == doctest::Approx(start / std::pow(1.0 + rate * point.x(), 2)));
  }
  // Other laws since the start, or no losses: no such law.
  frames.scene->changes = {{.time = 1.0, .set = {{"particles.restitution", "0.9"}}}};
  CHECK_FALSE(frames.plot("Temperature").log_x);
  frames.scene->changes.clear();
  frames.scene->particles.restitution = 1.0;
  CHECK_FALSE(frames.plot("Temperature").log_x);
}

TEST_CASE("Plots: balance residuals stand under their equation's name, in magnitude") {
  TwoFrames frames;
  frames.end.residuals = ResidualProfile{
      2.0, Residuals{{{1e-16, -2e-16}, {3e-16, -4e-16}, {5e-16, -6e-16}, {7e-16, -8e-16}}}};
  const LivePlot plot = frames.plot("Balance");
  check_axes(plot, "x in a", "residual, relative", false, true);
  double size = 0.0;
  for (const char* name : {"mass", "momentum x", "momentum y", "energy"}) {
    CAPTURE(name);
    const std::vector<Vec2>& points = curve_of(plot, name).points;
    CHECK(points == std::vector<Vec2>{{1.0, points[0].y()}, {3.0, points[1].y()}});
    for (const Vec2& point : points) {
      size += 1e-16;
      CHECK(std::fabs(point.y() - size) < 1e-20);
    }
  }
}

TEST_CASE("Plots: a quantity has the same colour in all plots, one that all can tell apart") {
  TwoFrames frames;
  frames.end.residuals = ResidualProfile{2.0, Residuals{{{0.0}, {0.0}, {0.0}, {0.0}}}};
  // Okabe and Ito 2008.
  const Colour orange{230, 159, 0}, blue{86, 180, 233}, green{0, 158, 115}, red{213, 94, 0},
      purple{204, 121, 167}, plain = kDarkTheme.text;
  using Colours = std::vector<std::pair<std::string, Colour>>;
  const std::vector<std::pair<std::string, Colours>> expected = {
      {"Balance", {{"mass", green}, {"momentum x", orange}, {"momentum y", blue}, {"energy", red}}},
      {"Temperature",
       {{"T_x", orange},
        {"T_y", blue},
        {"T", plain},
        {"simple", red},
        {"refined", green},
        {"corrected", purple}}},
      {"Energy per time", {{"in", orange}, {"dissipated", blue}, {"difference", plain}}},
      {"Velocities", {{"v_x", orange}, {"v_y", blue}, {"Gaussian", plain}}},
      {"Fig. 3.1", {{"simple", red}, {"refined", green}, {"this gas", purple}}},
      {"Residuals", {{"energy", orange}, {"overlap", blue}}}};
  const std::vector<LivePlot> plots = frames.plots();
  REQUIRE(plots.size() == expected.size());
  for (std::size_t k = 0; k < plots.size(); ++k) {
    const auto& [title, colours] = expected[k];
    CHECK(plots[k].title == title);
    REQUIRE(plots[k].curves.size() == colours.size());
    for (std::size_t c = 0; c < colours.size(); ++c) {
      CHECK(plots[k].curves[c].name == colours[c].first);
      CHECK(plots[k].curves[c].colour == colours[c].second);
    }
  }
}

TEST_CASE("Plots: a histogram with logarithmic bins is over their middles") {
  const ResultTable table = {"wall_hits.left.incoming",
                             {{"low", "a/t", {1.0, 2.0, 8.0}},
                              {"high", "a/t", {2.0, 8.0, 64.0}},
                              {"density", "1/(a/t)", {1.0, 0.5, 1e-3}, {0.1, 0.2, NAN}}}};
  const std::vector<LivePlot> plots = table_plots(table, kDarkTheme);
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
                             {{"time", "t", {0.1, 0.2, 3.0, 30.0}},
                              {"total", "a^2", {1.0, NAN, 3.0, 400.0}, {0.1, 0.1, 0.1, 0.1}},
                              {"y", "a^2", {0.5, 0.5, 0.5, 0.5}, {0.1, 0.1, 0.1, 0.1}},
                              {"drift_x", "a", {-1.0, 0.0, 1.0, 2.0}, {0.1, 0.1, 0.1, 0.1}}}};
  const std::vector<LivePlot> plots = table_plots(table, kLightTheme);
  REQUIRE(plots.size() == 2);
  check_axes(plots[0], "time in t", "a²", true, true);
  check_axes(plots[1], "time in t", "a", true, false);
  CHECK(curve_of(plots[0], "total").points ==
        std::vector<Vec2>{{0.1, 1.0}, {3.0, 3.0}, {30.0, 400.0}});
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
  CHECK(table_plots(table, kDarkTheme)[0].curves[0].points == Points{{-0.5, 1.0}, {1.5, 4e-3}});
  table.columns[2].values[0] = 0.1;
  CHECK(table_plots(table, kDarkTheme)[0].curves[0].points.size() == 3);
}

TEST_CASE("Plots: exact columns are plotted only where a table has no estimates") {
  ResultTable table = {
      "structure_factor",
      {{"k", "1/a", {1.0, 2.0}}, {"vectors", "1", {4.0, 8.0}}, {"S", "1", {0.2, 0.3}, {0.1, 0.1}}}};
  CHECK(table_plots(table, kDarkTheme)[0].curves.size() == 1);
  table.columns[2].standard_errors.clear();
  CHECK(table_plots(table, kDarkTheme)[0].curves.size() == 2);
}

TEST_CASE("Plots: slabs have a curve each, the first and the last with names") {
  const ResultTable table = {"radial_distribution_profile",
                             {{"y_low", "a", {0.5, 0.5, 2.5, 2.5, 4.5, 4.5}},
                              {"y_high", "a", {2.5, 2.5, 4.5, 4.5, 6.5, 6.5}},
                              {"r", "a", {1.1, 1.3, 1.1, 1.3, 1.1, 1.3}},
                              {"g", "1", {2.0, 1.0, 3.0, 1.5, 4.0, 1.8}, {1, 2, 3, 4, 5, 6}}}};
  const std::vector<LivePlot> plots = table_plots(table, kDarkTheme);
  REQUIRE(plots.size() == 1);
  check_axes(plots[0], "r in a", "g", false, false);
  REQUIRE(plots[0].curves.size() == 3);
  CHECK(curve_of(plots[0], "y = 0.5 to 2.5").points == std::vector<Vec2>{{1.1, 2.0}, {1.3, 1.0}});
  CHECK(plots[0].curves[1].name.empty());
  CHECK(plots[0].curves[1].errors == std::vector<double>{3.0, 4.0});
  CHECK(curve_of(plots[0], "y = 4.5 to 6.5").points == std::vector<Vec2>{{1.1, 4.0}, {1.3, 1.8}});
  CHECK_FALSE(plots[0].curves[0].colour == plots[0].curves[2].colour);
}

TEST_CASE("Plots: the copied numbers of a plot are its curves, a table each") {
  const Colour colour{};
  LivePlot plot{"Title", "x in a", false, false, {}, "unit"};
  plot.curves = {{"one", colour, {{1.0, 2.0}, {3.0, 4.0}}, false, false, {0.5, 0.25}},
                 {"", colour, {{5.0, 6.0}}}};
  CHECK(csv_of(plot) == "x in a,one,standard error\n1,2,0.5\n3,4,0.25\n\nx in a,Title\n5,6\n\n");
}

TEST_CASE("Plots: axes contain their curves with a margin above, or go from decade to decade") {
  LivePlot plot{"", "", false, false, {{"", {}, {{-1.0, 2.0}, {3.0, 20.0}}}}, ""};
  auto [x, y] = scales_of(plot);
  CHECK(x.low == -1.0);
  CHECK(x.high == 3.0);
  CHECK(y.low == 0.0);
  CHECK(y.high == doctest::Approx(21.0));
  CHECK(x.share(0.0) == doctest::Approx(0.25));
  plot.log_y = true;
  plot.floor = 1e-3;
  plot.curves[0].points.emplace_back(9.0, 0.0);
  const auto [wide, logarithmic] = scales_of(plot);
  CHECK(wide.high == 9.0);
  CHECK(logarithmic.logarithmic);
  CHECK(logarithmic.low == doctest::Approx(-3.0));
  CHECK(logarithmic.place(0.0) == doctest::Approx(-3.0));
  CHECK(logarithmic.place(100.0) == doctest::Approx(2.0));
}

// Draws a plot without a window, and reads its texts.
class DrawnPlot {
 public:
  explicit DrawnPlot(const LivePlot& plot) {
    const CurrentContext current(context_.get());
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(400.0f, 400.0f);
    io.FontDefault = const_cast<ImFont*>(add_fonts(*io.Fonts, 14.0f).text);
    for (int picture = 0; picture < 2; ++picture) {
      ImGui::NewFrame();
      ImGui::SetNextWindowSize(io.DisplaySize);
      ImGui::Begin("plot", nullptr, ImGuiWindowFlags_NoTitleBar);
      draw_plot(plot, 250.0f);
      texts = testing::texts_in(*ImGui::GetWindowDrawList());
      for (const ImDrawVert& vertex : ImGui::GetWindowDrawList()->VtxBuffer) {
        if (vertex.col == packed(kMarked)) marks_.push_back(vertex.pos);
      }
      if (picture == 0) marks_.clear();
      ImGui::End();
      ImGui::EndFrame();
    }
  }

  // The centre of all marks of this colour, without the legend.
  Vec2 mark() const {
    ImVec2 low(1e9f, 1e9f), high(0.0f, 0.0f);
    for (const ImVec2& place : marks_) {
      if (place.y < legend()) continue;
      low = ImVec2(std::min(low.x, place.x), std::min(low.y, place.y));
      high = ImVec2(std::max(high.x, place.x), std::max(high.y, place.y));
    }
    return {0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
  }
  bool has(const std::string& text) const {
    return std::ranges::any_of(texts, [&](const auto& drawn) { return drawn.text == text; });
  }
  const testing::DrawnText& text(const std::string& text) const {
    for (const auto& drawn : texts) {
      if (drawn.text == text) return drawn;
    }
    FAIL("no text " << text);
    return texts.front();
  }

  static constexpr Colour kMarked = {0x12, 0x34, 0x56};
  std::vector<testing::DrawnText> texts;

 private:
  float legend() const { return text("mark").bottom + 4.0f; }

  GuiContext context_ = make_gui_context();
  std::vector<ImVec2> marks_;
};

TEST_CASE("Plots: numbers at the axes have the values of their positions") {
  LivePlot plot{"Title", "the x axis", false, false, {}, "unit of y"};
  plot.curves = {{"mark", DrawnPlot::kMarked, {{3.0, 50.0}}, false, true},
                 {"line", {1, 2, 3}, {{0.0, 0.0}, {4.0, 100.0}}}};
  const DrawnPlot drawn(plot);
  for (const char* text : {"Title", "unit of y", "mark", "line", "the x axis"}) {
    CAPTURE(text);
    CHECK(drawn.has(text));
  }
  // A mark at x = 3 and y = 50, at three quarters of the x axis.
  CHECK(drawn.mark().x() == doctest::Approx(drawn.text("3").middle_x()).epsilon(0.01));
  CHECK(drawn.mark().y() == doctest::Approx(drawn.text("50").middle_y()).epsilon(0.01));
  CHECK(drawn.text("1").middle_x() < drawn.text("3").middle_x());
  CHECK(drawn.text("100").middle_y() < drawn.text("50").middle_y());
  // The name of x is below its numbers. The numbers of y are to the left of the marks.
  CHECK(drawn.text("the x axis").top > drawn.text("3").bottom - 1.0f);
  CHECK(drawn.text("50").right < drawn.text("1").left);
  CHECK(drawn.text("Title").right < drawn.text("unit of y").left);
}

TEST_CASE("Plots: logarithmic axes have powers of ten where these are") {
  LivePlot plot{"Title", "x", true, true, {}, "y"};
  plot.curves = {{"mark", DrawnPlot::kMarked, {{100.0, 1e-2}}, false, true},
                 {"line", {1, 2, 3}, {{1.0, 1e-4}, {1e4, 1.0}}}};
  const DrawnPlot drawn(plot);
  CHECK(drawn.mark().x() == doctest::Approx(drawn.text("100").middle_x()).epsilon(0.01));
  CHECK(drawn.mark().y() == doctest::Approx(drawn.text("0.01").middle_y()).epsilon(0.01));
}

// Gravity along z: the spheres fall to the back wall.
TEST_CASE("Plots: spheres have curves along z, and profiles along each axis") {
  const auto run = watched_run(parse_scene(R"(
[box]
size = [6.0, 5.0, 8.0]
[particles]
count = 60
[walls]
back = { kind = "static" }
front = { kind = "static" }
[gravity]
acceleration = [0.0, 0.0, -1.0]
[view]
window = 2.0
)",
                                           "falling.toml"),
                               1);
  History history;
  Frame frame;
  frame.run = 1;
  const auto plots_after = [&](Profiled profiled, Axis axis, std::size_t name, double duration) {
    run->show_profile(profiled, axis);
    run->run_until(run->time() + duration, kNoLimit, kNoLimit);
    run->tell(frame, false);
    history.add(frame);
    return plots_of(history, frame, name, kDarkTheme);
  };
  const auto names_of = [](const LivePlot& plot) {
    std::vector<std::string> names;
    for (const Curve& curve : plot.curves) names.push_back(curve.name);
    return names;
  };
  using Names = std::vector<std::string>;
  CHECK(profile_names(Axis::Z)[2] == "stress zz");
  CHECK(profile_names(Axis::Z)[3] == "heat flux z");

  const auto plots = plots_after(Profiled::Fields, Axis::Z, 0, 40.0);
  CHECK(plots[0].x_label == "z in a");
  CHECK(plots[0].y_label == "1/a³");
  const std::vector<Vec2>& density = plots[0].curves[0].points;
  REQUIRE(density.size() == 8);
  double spheres = 0.0;
  for (const Vec2& point : density) spheres += point.y() * 6.0 * 5.0;
  CHECK(spheres == doctest::Approx(60.0));
  CHECK(density[1].y() > 2.0 * density[6].y());
  CHECK(names_of(plots[1]) == Names{"T_x", "T_y", "T_z", "T"});
  const auto last = [&](int curve) { return plots[1].curves[curve].points.back().y(); };
  CHECK(last(3) == doctest::Approx((last(0) + last(1) + last(2)) / 3.0));
  CHECK(names_of(plots[3]) == Names{"v_x", "v_y", "v_z", "Gaussian"});

  const auto across = plots_after(Profiled::Fields, Axis::Y, 0, 20.0);
  CHECK(across[0].x_label == "y in a");
  CHECK(across[0].curves[0].points.size() == 5);
  const auto closed = plots_after(Profiled::Balances, Axis::Z, 5, 20.0);
  CHECK(closed[0].x_label == "z in a");
  CHECK(names_of(closed[0]) == Names{"mass", "momentum x", "momentum y", "momentum z", "energy"});
  for (const Curve& curve : closed[0].curves) {
    REQUIRE(curve.points.size() == 8);
    for (const Vec2& point : curve.points) CHECK(point.y() < 1e-9);
  }
}

TEST_CASE("Plots: all axes are finite for a gas without motion, or one that comes to rest") {
  using Settings = std::vector<Override>;
  const Override cold{"particles.start.temperature", "0.0"};
  const Override still{"walls.left.drive_speed", "0.0"}, too{"walls.right.drive_speed", "0.0"};
  const Override frozen{"walls.left", "{ kind = \"thermal\", temperature = 0.0 }"};
  const Override likewise{"walls.right", "{ kind = \"thermal\", temperature = 0.0 }"};
  for (const Settings& settings : {Settings{cold}, Settings{still, too}, Settings{cold, still, too},
                                   Settings{frozen, likewise}, Settings{cold, frozen, likewise},
                                   Settings{{"particles.count", "0"}}}) {
    CAPTURE(settings.front().key);
    for (const Profiled profiled : {Profiled::Fields, Profiled::Balances}) {
      const auto run = watched_run(load_scene("vibrated", settings), 1);
      run->show_profile(profiled, Axis::X);
      History history;
      Frame frame;
      frame.run = 1;
      for (double time : {0.0, 1.0, 2.0, 20.0}) {
        go_on(*run, time);
        run->tell(frame, false);
        history.add(frame);
        for (std::size_t name = 0; name < profile_names(Axis::X).size(); ++name) {
          for (const LivePlot& plot : plots_of(history, frame, name, kDarkTheme)) {
            check_finite(plot);
          }
        }
      }
      CHECK(history.samples().size() >= 1);
      for (const Sample& sample : history.samples()) {
        CHECK(sample.temperature.allFinite());
        CHECK(std::isfinite(sample.walls_in - sample.dissipated));
        CHECK(std::isfinite(sample.ledger_residual));
      }
    }
  }
}

TEST_CASE("Plots: compared gases have one curve each, or its difference from the first gas") {
  const TwoFrames first;
  TwoFrames second;
  History other;
  second.begin.tally.temperature_integral = Vec2(2.0, 3.0);
  second.end.tally.temperature_integral = Vec2(16.0, 21.0);
  second.end.tally.dissipated = 50.0;
  for (const Frame& frame : {second.begin, second.end}) other.add(frame);
  const std::vector<PlottedGas> gases = {{&first.history, &first.end, "A"},
                                         {&other, &second.end, "B"}};
  std::map<std::string, LivePlot> plots;
  for (const bool differences : {false, true}) {
    for (const LivePlot& plot : plots_of(gases, 0, kDarkTheme, differences)) {
      plots[plot.title] = plot;
      check_finite(plot);
    }
  }
  CHECK(plots.size() == 6);
  // Mean temperature (6 + 10) / 4 and (14 + 18) / 4 over two time units, until time 12.
  const LivePlot& both = plots.at("Temperature, T");
  CHECK(both.curves.size() == 2);
  check_last(both, "A", 11.0, 4.0);
  check_last(both, "B", 11.0, 8.0);
  const LivePlot& change = plots.at("Temperature, T, minus A");
  CHECK(change.curves.size() == 1);
  check_last(change, "B", 11.0, 4.0);
  check_last(plots.at("Energy per time, dissipated"), "B", 11.0, 22.0);
  check_last(plots.at("Energy per time, dissipated, minus A"), "B", 11.0, 10.0);
  CHECK(curve_of(plots.at("Velocities, v_x"), "A").points.size() == VelocityHistogram::kClasses);
  for (const Vec2& point : plots.at("Velocities, v_x, minus A").curves[0].points) {
    CHECK(point.y() == 0.0);
  }
  const auto lecture = lecture_plot(LecturePlot::Energy, gases, 0, kDarkTheme);
  REQUIRE(lecture);
  CHECK(lecture->title == "Energy per time, dissipated");
}

TEST_CASE("Plots: compared gases have their colours, and differences between the points") {
  LivePlot first{"P", "x", false, true, {}}, second = first;
  first.curves = {{.name = "f",
                   .colour = {},
                   .points = {{0.0, 1.0}, {2.0, 5.0}},
                   .errors = {0.3, 0.3},
                   .compared = true}};
  second.curves = {{.name = "f",
                    .colour = {},
                    .points = {{0.5, 10.0}, {3.0, 10.0}},
                    .errors = {0.4, 0.4},
                    .compared = true}};
  const auto plot = compared_plot({first, second}, {"A", "B"}, true);
  REQUIRE(plot);
  CHECK_FALSE(plot->log_y);
  REQUIRE(plot->curves.size() == 1);
  CHECK(plot->curves[0].points == std::vector<Vec2>{{0.5, 8.0}});
  CHECK(plot->curves[0].errors == std::vector<double>{0.5});
  second.curves[0].compared = false;
  CHECK_FALSE(compared_plot({first, second}, {"A", "B"}, false));

  const auto four = compared_plot({first, first, first, first}, {"A", "B", "C", "D"}, false);
  REQUIRE(four);
  std::vector<Colour> colours;
  for (const Curve& curve : four->curves) colours.push_back(curve.colour);
  // Sky blue, orange, bluish green and reddish purple of Okabe and Ito (2008).
  CHECK(colours ==
        std::vector<Colour>{
            {0x56, 0xb4, 0xe9}, {0xe6, 0x9f, 0x00}, {0x00, 0x9e, 0x73}, {0xcc, 0x79, 0xa7}});
}

}  // namespace clatter
