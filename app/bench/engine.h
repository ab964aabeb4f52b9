#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/scene.h"
#include "render/charts/plot.h"

namespace clatter {

/// Elastic disks in a periodic square, or elastic spheres in a periodic cube, that fill a fraction
/// of the area or volume.
Scene elastic_gas(int count, double fraction, int dimension = 2);

/// Whether a start state of this gas exists.
bool has_room(int count, double fraction, int dimension);

/// One species of a mixture that is measured.
struct BenchSpecies {
  int count = 0;
  double diameter = 1.0;
  double mass = 1.0;
};

/// Species from text like "500:1:1,500:1.4:1.96", see `clatter bench engine --help`. Throws
/// UserError.
std::vector<BenchSpecies> parse_species(const std::string& text);

/// The cells of the engine's table.
struct EngineTable {
  int dimension = 2;
  int count = 0;                           ///< particles of the only cell; 0: the whole table
  double area_fraction = 0.5;              ///< of disks, in the only cell
  std::optional<double> volume_fraction;   ///< of spheres, in the only cell; absent: disks
  std::vector<BenchSpecies> species = {};  ///< of a mixture, the only cell; empty: one species
  bool start_only = false;                 ///< measures the set-up alone, and no rate
};

/// A row of the engine's table: the number of particles, and the fraction that they fill.
using EngineCell = std::pair<int, double>;

/// The rows of the engine's table, in order.
std::vector<EngineCell> engine_cells(const EngineTable& table);
/// The rows of the table of growth for disks up to a number, in order; 0: all.
std::vector<EngineCell> growth_cells(int count);

/// A measured cell of the engine's table.
struct EngineRate {
  int count = 0;
  double fraction = 0.0;       ///< of the area or volume that particles fill
  double rate = 0.0;           ///< millions of pair collisions per CPU second, best of three; NaN
                               ///< if the set-up alone was measured
  double setup_seconds = 0.0;  ///< CPU time to build the start state and the simulation
  /// Peak resident size minus the size before the state was built; NaN: too little for the heap of
  /// the process.
  double bytes_per_particle = 0.0;
};

/// Prints the collision rate of elastic particles in a periodic box, by number and by the fraction
/// that they fill. Writes the table also to `json`, unless it is empty. Returns the exit code.
int bench_engine(const std::string& json, const EngineTable& table);

/// A gas with clusters of disks. The table of growth compares its rate with that of a homogeneous
/// gas of the same number and mean density.
struct Inhomogeneous {
  const char* name;
  Scene scene;
  std::uint64_t after;  ///< collisions per disk before the rate is measured
};

/// The gases with clusters, of `count` disks each.
std::vector<Inhomogeneous> inhomogeneous_gases(int count);

/// The plot of rates by the number of disks, with a panel for each area fraction. Rates of the same
/// fraction are neighbours.
Plot growth_plot(const std::vector<EngineRate>& rates);

/// Prints the dependence of this rate on the number of disks: 100 to 4 million at phi = 0.5, and
/// 100,000 at other phi from 0.01 to 0.88. A `count` other than 0 limits the number. Writes the
/// table to `json` and a plot to `plot`, unless these are empty. Returns the exit code.
int bench_growth(const std::string& json, const std::string& plot, int count);

}  // namespace clatter
