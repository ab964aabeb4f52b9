#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/laws/model.h"
#include "engine/measure/species_totals.h"
#include "engine/statistics/estimate.h"

namespace clatter {

/// Results of one species, averaged over time. Results that it cannot have are absent.
struct SpeciesMeans {
  std::string name;
  std::size_t count = 0;                ///< N_s
  std::optional<Estimate> temperature;  ///< T_s, in the same frame as T; absent without particles
  std::vector<Estimate> axis_temperatures;   ///< [D] T_s,k; empty without particles
  std::optional<Estimate> spin_temperature;  ///< I <omega^2>; absent without spins
  /// [D] mean of the coordinate; absent along periodic axes.
  std::vector<std::optional<Estimate>> mean_position;
  std::optional<Estimate> walls_in;  ///< power of the walls
  std::optional<Estimate> bulk_in;   ///< power of the kicks of bulk driving
  /// Share of the collisions with particles, of particles of this species, that t_c made elastic.
  std::optional<double> elasticised_share;
};

/// Results of the collisions between two species, averaged over time.
struct PairMeans {
  std::array<std::string, 2> species;
  Estimate collision_rate;  ///< collisions per time, of all particles
  Estimate dissipated;      ///< energy per time lost, > 0
};

/// The means of each species from windows of equal duration.
template <int D>
std::vector<SpeciesMeans> species_means(std::span<const SpeciesTotalsWindow<D>> windows,
                                        const Model<D>& model,
                                        const std::vector<std::size_t>& counts);

/// The means of each pair of species that can collide, in the order of pair_index.
template <int D>
std::vector<PairMeans> pair_means(std::span<const SpeciesTotalsWindow<D>> windows,
                                  const Model<D>& model, const std::vector<std::size_t>& counts);

extern template std::vector<SpeciesMeans> species_means(std::span<const SpeciesTotalsWindow<2>>,
                                                        const Model<2>&,
                                                        const std::vector<std::size_t>&);
extern template std::vector<SpeciesMeans> species_means(std::span<const SpeciesTotalsWindow<3>>,
                                                        const Model<3>&,
                                                        const std::vector<std::size_t>&);
extern template std::vector<PairMeans> pair_means(std::span<const SpeciesTotalsWindow<2>>,
                                                  const Model<2>&, const std::vector<std::size_t>&);
extern template std::vector<PairMeans> pair_means(std::span<const SpeciesTotalsWindow<3>>,
                                                  const Model<3>&, const std::vector<std::size_t>&);

}  // namespace clatter
