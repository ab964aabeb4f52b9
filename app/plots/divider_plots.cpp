#include "app/plots/divider_plots.h"

#include <utility>

#include "app/plots/plot_colours.h"
#include "app/results/theory_json.h"

namespace clatter {

LivePlot compartments_plot(const std::vector<Sample>& samples, const Scene& scene) {
  LivePlot plot{"Compartments", "time t", false, false, {}, "share of the particles"};
  Curve left{.name = "left", .colour = kBlue, .points = {}, .compared = true};
  Curve right{.name = "right", .colour = kOrange, .points = {}};
  if (divider_of(scene)->axis != 0) {
    left.name = "lower";
    right.name = "upper";
  }
  for (const Sample& sample : samples) {
    left.points.emplace_back(sample.time, sample.share_left);
    right.points.emplace_back(sample.time, 1.0 - sample.share_left);
  }
  plot.curves = {std::move(left), std::move(right)};
  const auto gas = two_compartments(scene);
  if (!gas || samples.empty()) return plot;
  const double fuller = gas->fuller_share();
  const auto level = [&](const char* name, double share) {
    plot.curves.push_back(
        {.name = name,
         .colour = kGreen,
         .points = {{samples.front().time, share}, {samples.back().time, share}},
         .dashed = true,
         .help = "Stable shares by the flux through the opening of a dilute gas"});
  };
  level("flux theory", fuller);
  if (fuller > 0.5) level("", 1.0 - fuller);
  return plot;
}

LivePlot piston_plot(const std::vector<Sample>& samples, const Scene& scene, Colour plain) {
  LivePlot plot{"Piston", "time t", false, false, {}, "a"};
  constexpr const char* kAxisLetters[] = {"x", "y", "z"};
  Curve place{.name = kAxisLetters[static_cast<std::size_t>(scene.piston->axis)],
              .colour = plain,
              .points = {},
              .help = "Place of the middle of the piston",
              .compared = true};
  for (const Sample& sample : samples) place.points.emplace_back(sample.time, sample.piston);
  plot.curves = {std::move(place)};
  return plot;
}

}  // namespace clatter
