// The plots of a box that a partition or a piston divides.

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/plots/divider_plots.h"
#include "app/plots/plots.h"
#include "app/results/theory_json.h"
#include "engine/live/watched_run.h"
#include "engine/scene/scene_file.h"
#include "tests/app/plot_checks.h"

namespace clatter::divider_plots {

namespace {

// A run at its last frame, and its history.
struct DividedGas {
  explicit DividedGas(const Scene& scene) : run(watched_run(scene, 3)) {
    for (int k = 1; k <= 6; ++k) {
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

TEST_CASE("Divider plots: shares of a partition, with the theory of the scene") {
  const Scene scene = load_scene("demon");
  const DividedGas gas(scene);
  const LivePlot plot = gas.plot("Compartments");
  check_axes(plot, "time t", "share of the particles", false, false);
  const Vectors& places = gas.frame.snapshot.positions;
  const auto left =
      std::count_if(places.row(0).begin(), places.row(0).end(), [](double x) { return x < 10.0; });
  CHECK(curve_of(plot, "left").points.back().y() == static_cast<double>(left) / 60.0);
  CHECK(curve_of(plot, "right").points.back().y() == static_cast<double>(60 - left) / 60.0);
  const double imbalance = theory_json(scene).at("imbalance");
  CHECK(curve_of(plot, "flux theory").points.front().y() ==
        doctest::Approx(0.5 * (1.0 + imbalance)).epsilon(1e-12));
  CHECK(curve_of(plot, "flux theory").dashed);
  // The equal split has no second line.
  const Scene hot = load_scene("demon", {{"particles.restitution", "0.95"}});
  CHECK(compartments_plot(gas.history.samples(), hot).curves.size() == 3);
}

TEST_CASE("Divider plots: the place of a piston") {
  const DividedGas gas(load_scene("piston"));
  const LivePlot plot = gas.plot("Piston");
  check_axes(plot, "time t", "a", false, false);
  REQUIRE(gas.frame.snapshot.free_piston.has_value());
  CHECK(curve_of(plot, "x").points.back().y() == *gas.frame.snapshot.free_piston);
  CHECK(*gas.frame.snapshot.free_piston > 30.1);
  // It divides the gas where it is, so the numbers on its sides stay.
  CHECK(curve_of(gas.plot("Compartments"), "left").points.back().y() == 160.0 / 240.0);
  REQUIRE(gas.frame.snapshot.obstacles.size() == 1);
  const Obstacle& body = gas.frame.snapshot.obstacles[0];
  CHECK(body.from.x() == doctest::Approx(*gas.frame.snapshot.free_piston - 0.75));
  CHECK(body.to == Vec2(*gas.frame.snapshot.free_piston + 0.75, 24.0));
}

TEST_CASE("Divider plots: a removed partition is not in the picture") {
  const auto run = watched_run(load_scene("echo"), 1);
  const auto partitions_at = [&](double time) {
    run->run_until(time, kNoLimit, kNoLimit);
    Frame frame;
    run->fill(frame, false);
    return frame.snapshot.partitions.size();
  };
  CHECK(partitions_at(4.9) == 1);
  CHECK(partitions_at(5.1) == 0);
}

}  // namespace clatter::divider_plots
