// The plots of the window: curves with names and units, also without data.

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/results/theory_json.h"
#include "engine/error.h"
#include "engine/live/watched_run.h"
#include "engine/scene/scene_file.h"
#include "tests/app/plot_checks.h"

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

}  // namespace

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
  const std::vector<std::string> units = {"1/a²", "m a²/t²", "m/t²", "m a/t³", "m/t³"};
  REQUIRE(profile.fields.size() == units.size());
  for (std::size_t k = 0; k < units.size(); ++k) {
    CAPTURE(k);
    const double number = static_cast<double>(k);
    CHECK(profiled_by(k) == Profiled::Fields);
    const LivePlot plot = frames.plot("Profile", k);
    check_axes(plot, "x in a", units[k].c_str(), false, false);
    REQUIRE(plot.curves.size() == 1);
    const Curve& curve = plot.curves[0];
    // The list has the name without the symbol.
    CHECK(curve.name.starts_with(profile_names(Axis::X)[k].substr(0, 6)));
    CHECK(curve.points == std::vector<Vec2>{{1.0, 10.0 + number}, {4.0, 20.0 + number}});
    CHECK(curve.errors == std::vector<double>{0.1 + number, 0.2 + number});
  }
  CHECK(profile_names(Axis::X)[units.size()] == "balance residuals");
  CHECK(profiled_by(units.size()) == Profiled::Balances);
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

// By hand for 3000 disks in 160 x 120, alpha = 0.4, G = 0.1 and chi = 1.22958: b = 0.595, z = 0.42,
// G/nu = 0.85277 and nu = 0.68105 sqrt(T), so Grad's T is 0.02965.
TEST_CASE("Plots: a sheared gas has the theories of its steady temperature") {
  TwoFrames frames;
  *frames.scene = load_scene("shear");
  const LivePlot plot = frames.plot("Temperature");
  check_axes(plot, "time t", "m a²/t²", false, false);
  const Curve& grad = curve_of(plot, "Grad");
  CHECK(grad.dashed);
  CHECK(grad.points.front().y() == doctest::Approx(0.02965).epsilon(1e-3));
  CHECK(grad.points.back().y() == grad.points.front().y());
  CHECK(curve_of(plot, "Enskog").dashed);
  frames.scene->particles.restitution = 1.0;
  CHECK(frames.plot("Temperature").curves.size() == plot.curves.size() - 2);
  // Walls across z take part in the balance.
  *frames.scene = parse_scene(
      "box.size = [9, 9, 9]\nparticles = { count = 9, restitution = 0.9 }\nshear.rate = 1\n", "s");
  CHECK(steady_shear(*frames.scene).has_value());
  frames.scene->walls[kFront] = frames.scene->walls[kBack] = Wall{};
  CHECK_FALSE(steady_shear(*frames.scene).has_value());
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

TEST_CASE("Plots: a theory has the same colour in all plots, and curves of a plot differ") {
  TwoFrames frames;
  frames.end.residuals = ResidualProfile{2.0, Residuals{{{0.0}, {0.0}, {0.0}, {0.0}}}};
  const std::vector<LivePlot> plots = frames.plots();
  CHECK(plots.size() == 6);
  std::map<std::string, Colour> theories;
  for (const LivePlot& plot : plots) {
    CAPTURE(plot.title);
    for (std::size_t c = 0; c < plot.curves.size(); ++c) {
      const Curve& curve = plot.curves[c];
      CAPTURE(curve.name);
      for (std::size_t k = 0; k < c; ++k) CHECK_FALSE(plot.curves[k].colour == curve.colour);
      if (!curve.dashed || curve.name == "Gaussian") continue;
      CHECK_FALSE(curve.help.empty());
      CHECK(theories.emplace(curve.name, curve.colour).first->second == curve.colour);
    }
  }
  CHECK(theories.size() == 3);
}

// Gravity along z: the spheres fall to the back wall.
TEST_CASE("Plots: spheres have curves along z, and profiles along each axis") {
  const auto run = watched_run(
      parse_scene("box.size = [6, 5, 8]\nparticles.count = 60\nwalls.back.kind = 'static'\n"
                  "walls.front.kind = 'static'\ngravity.acceleration = [0, 0, -1]\n"
                  "view.window = 2\n",
                  ""),
      1);
  History history;
  Frame frame;
  frame.run = 1;
  const auto plots_after = [&](Profiled profiled, Axis axis, std::size_t name, double duration) {
    run->show_profile(profiled, axis);
    run->run_until(run->time() + duration, kNoLimit, kNoLimit);
    run->fill(frame, false);
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
        run->fill(frame, false);
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
  for (const Curve& curve : four->curves) {
    const auto same = [&](const Curve& other) { return other.colour == curve.colour; };
    CHECK(std::ranges::count_if(four->curves, same) == 1);
  }
}

}  // namespace clatter
