// The samples of a run, and the plots over time that show them.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "app/plots/history.h"
#include "app/results/theory_json.h"
#include "engine/live/watched_run.h"
#include "tests/app/plot_checks.h"

namespace clatter {

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
    run->fill(frame, false);
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

// Light particles have the velocities 2 and -2, one of the mass 4 has 1: all have the same energy.
TEST_CASE("Plots: velocities of a mixture are times the root of the mass") {
  Snapshot snapshot;
  snapshot.positions = snapshot.velocities = Vectors::Zero(2, 3);
  snapshot.velocities.row(0) << 2.0, -2.0, 1.0;
  snapshot.grains = {{}, {}, {.mass = 4.0, .species = 1}};
  VelocityHistogram histogram;
  histogram.add(snapshot);
  int filled = 0;
  for (const Vec2& point : histogram.density(0)) filled += point.y() > 0.0 ? 1 : 0;
  CHECK(filled == 2);
}

}  // namespace clatter
