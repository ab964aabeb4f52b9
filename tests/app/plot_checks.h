#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "app/plots/plots.h"

namespace clatter {

/// A gas with driven walls, and two frames of it. The sums gain different numbers between the
/// frames.
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

inline void check_axes(const LivePlot& plot, const char* x, const char* y, bool log_x, bool log_y) {
  CHECK(plot.x_label == x);
  CHECK(plot.y_label == y);
  CHECK(plot.log_x == log_x);
  CHECK(plot.log_y == log_y);
}

inline const Curve& curve_of(const LivePlot& plot, const std::string& name) {
  for (const Curve& curve : plot.curves) {
    if (curve.name == name) return curve;
  }
  FAIL("no curve " << name);
  return plot.curves.front();
}

// The end point of a plot's curve.
inline void check_last(const LivePlot& plot, const std::string& name, double x, double y) {
  CAPTURE(name);
  const Vec2 last = curve_of(plot, name).points.back();
  CHECK(last.x() == doctest::Approx(x));
  CHECK(std::fabs(last.y() - y) <= 1e-12 * y);
}

}  // namespace clatter
