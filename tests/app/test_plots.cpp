// What the window plots where there is nothing to plot.

#include <doctest/doctest.h>

#include <cmath>

#include "app/view/plots.h"
#include "engine/error.h"
#include "engine/publish/watched_run.h"
#include "engine/scene/scene_file.h"

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

// As far as it gets: a wall of temperature 0 lets no disk go.
void go_on(WatchedRun& run, double time) {
  try {
    run.run_until(time, kNoLimit, kNoLimit);
  } catch (const PhysicalStop&) {
  }
}

}  // namespace

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
      run->show_profile(profiled);
      History history;
      Frame frame;
      frame.run = 1;
      for (double time : {0.0, 1.0, 2.0, 20.0}) {
        go_on(*run, time);
        run->tell(frame, false);
        history.add(frame);
        for (std::size_t name = 0; name < profile_names().size(); ++name) {
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

}  // namespace clatter
