#include "app/plots/species_plots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "app/plots/plot_colours.h"
#include "app/results/theory_json.h"
#include "render/species_colours.h"

namespace clatter {

// Curves of the plots: the palette has eight colours.
constexpr std::size_t kMostCurves = 8;

LivePlot species_temperature_plot(const History& history, const Scene& scene,
                                  const ThemeColours& theme) {
  const std::vector<Sample>& samples = history.samples();
  LivePlot plot{"Temperatures of species", "time t", false, false, {}, "m a²/t²"};
  plot.log_x = plot.log_y = cools_freely(scene) && scene.changes.empty();
  const SpeciesTheory& theory = history.species_theory();
  bool named = false;
  const std::vector<Colour> colours = species_colours(scene.species, theme.background);
  for (std::size_t s = 0; s < std::min(colours.size(), kMostCurves); ++s) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const double expected = s < theory.temperatures.size() ? theory.temperatures[s] : kNone;
    const bool known = std::isfinite(expected);
    Curve measured{scene.species[s].name, colours[s], {}};
    Curve predicted{.name = "", .colour = colours[s], .points = {}, .dashed = true};
    for (const Sample& sample : samples) {
      measured.points.emplace_back(sample.time, sample.species_temperature[s]);
      const double scale = theory.relative ? sample.temperature.mean() : 1.0;
      predicted.points.emplace_back(sample.time, scale * expected);
    }
    if (known && !std::exchange(named, true)) {
      predicted.name = "theory";
      predicted.help = theory.relative
                           ? "The share of T in equilibrium, or in a homogeneous gas that cools"
                           : "Kinetic theory of a homogeneous mixture";
    }
    measured.compared = s + 1 == std::min(colours.size(), kMostCurves);
    plot.curves.push_back(std::move(measured));
    if (known) plot.curves.push_back(std::move(predicted));
  }
  return plot;
}

LivePlot mixing_plot(const std::vector<Sample>& samples, Colour plain) {
  LivePlot plot{"Mixing", "time t", false, false, {}, "0 apart, 1 mixed"};
  Curve lacey{.name = "Lacey",
              .colour = kBlue,
              .points = {},
              .help = "Index of Lacey in cells of about ten particles",
              .compared = true};
  Curve entropy{.name = "entropy",
                .colour = kOrange,
                .points = {},
                .help = "Entropy of mixing in the same cells"};
  Curve lacey_at_random{.name = "at random",
                        .colour = plain,
                        .points = {},
                        .dashed = true,
                        .help = "Expectation of the index of Lacey for species at random"};
  Curve entropy_at_random{.name = "", .colour = kOrange, .points = {}, .dashed = true};
  for (const auto& [curve, value] : {std::pair{&lacey, &Mixing::lacey},
                                     {&entropy, &Mixing::entropy},
                                     {&entropy_at_random, &Mixing::random_entropy}}) {
    for (const Sample& sample : samples) {
      curve->points.emplace_back(sample.time, sample.mixing.*value);
    }
  }
  for (const Sample& sample : samples) lacey_at_random.points.emplace_back(sample.time, 1.0);
  plot.curves = {std::move(lacey), std::move(lacey_at_random), std::move(entropy),
                 std::move(entropy_at_random)};
  return plot;
}

std::vector<Curve> species_profiles(const Profile& profile, Field field, const Scene& scene,
                                    const ThemeColours& theme) {
  std::vector<Curve> curves;
  const std::vector<Colour> colours = species_colours(scene.species, theme.background);
  for (std::size_t s = 0; s < std::min(colours.size(), kMostCurves); ++s) {
    const auto found = std::ranges::find(profile.fields, field.of(s));
    if (found == profile.fields.end()) continue;
    const auto& values = profile.values[static_cast<std::size_t>(found - profile.fields.begin())];
    Curve curve{scene.species[s].name, colours[s], {}};
    for (std::size_t i = 0; i < values.size(); ++i) {
      curve.points.emplace_back(0.5 * (profile.edges[i] + profile.edges[i + 1]), values[i].mean);
      curve.errors.push_back(values[i].standard_error);
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace clatter
