#pragma once

#include <vector>

#include "app/plots/history.h"
#include "engine/scene/scene.h"
#include "render/charts/live_plot.h"
#include "render/theme.h"

namespace clatter {

/// Temperatures of species by kinetic theory (theory 12.14-12.15).
struct SpeciesTheory {
  std::vector<double> temperatures;  ///< [S] NaN: the theory has none for this species
  bool relative = false;             ///< over T: the gas cools freely
};

/// The theory of a scene with species.
SpeciesTheory species_theory(const Scene& scene);

/// The temperature of each species over time, with theory. The last species stands for its gas
/// where several gases are compared.
LivePlot species_temperature_plot(const std::vector<Sample>& samples, const Scene& scene,
                                  const ThemeColours& theme);

/// The mixing of the species over time, with its expectation for species at random.
LivePlot mixing_plot(const std::vector<Sample>& samples, Colour plain);

/// The curves of each species in a profile of its density or temperature. Empty for other fields.
std::vector<Curve> species_profiles(const Profile& profile, Field field, const Scene& scene,
                                    const ThemeColours& theme);

}  // namespace clatter
