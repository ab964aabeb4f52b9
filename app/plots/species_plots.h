#pragma once

#include <vector>

#include "app/plots/history.h"
#include "engine/scene/scene.h"
#include "render/charts/live_plot.h"
#include "render/theme.h"

namespace clatter {

/// The temperature of each species over time, with the theory of the history. The last species
/// stands for its gas where several gases are compared.
LivePlot species_temperature_plot(const History& history, const Scene& scene,
                                  const ThemeColours& theme);

/// The mixing of the species over time, with its expectation for species at random.
LivePlot mixing_plot(const std::vector<Sample>& samples, Colour plain);

/// The curves of each species in a profile of its density or temperature. Empty for other fields.
std::vector<Curve> species_profiles(const Profile& profile, Field field, const Scene& scene,
                                    const ThemeColours& theme);

}  // namespace clatter
