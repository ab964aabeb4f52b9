#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/bench/engine.h"
#include "render/layers/plot.h"

namespace clatter {

/// The cells of the table of cores.
struct CoresTable {
  int dimension = 2;
  int count = 0;  ///< largest number of particles, or that of the only cell; 0: 10^7
  std::optional<double> area_fraction = {};  ///< of disks in the only cell; absent: all cells
  int threads = 0;  ///< largest number of threads; 0: the number of processors
};

/// The cells of the table, by number and then by fraction. Throws UserError if no box holds the
/// only cell.
std::vector<EngineCell> cores_cells(const CoresTable& table);

/// The plot of the table for disks or spheres, without panels.
Plot empty_cores_plot(int dimension);

/// Prints the collision rate of elastic particles in a periodic box, as a whole and in tiles on 1,
/// 2, 4, ... threads. Writes the table to `json` and a plot to `plot`, unless these are empty.
/// Throws UserError if no box holds the only cell, and RunError if a state hash depends on the
/// threads. Returns the exit code.
int bench_cores(const std::string& json, const std::string& plot, const CoresTable& table);

}  // namespace clatter
