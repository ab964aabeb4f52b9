#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/engine.h"
#include "render/charts/plot.h"

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

/// The run of a gas on a number of threads.
struct CoresRate {
  int count = 0;           ///< of particles
  double fraction = 0.0;   ///< of the box that they fill
  int threads = 0;         ///< 0: the gas as a whole
  double rate = 0.0;       ///< millions of pair collisions per second of wall time
  double busy = 1.0;       ///< share of the time in which the threads compute
  double redundant = 0.0;  ///< collisions of copies, per collision of the gas
  double redone = 0.0;     ///< share of the runs of tiles that repeat a run
  std::uint64_t hash = 0;  ///< of the state at the end
};

/// The plot of these rates of disks or spheres: a panel for each gas. The rates of a gas are in
/// succession, the first is that of the gas as a whole.
Plot cores_plot(int dimension, const std::vector<CoresRate>& rates);

/// Prints the collision rate of elastic particles in a periodic box, as a whole and in tiles on 1,
/// 2, 4, ... threads. Writes the table to `json` and a plot to `plot`, unless these are empty.
/// Throws UserError if no box holds the only cell, and RunError if a state hash depends on the
/// threads. Returns the exit code.
int bench_cores(const std::string& json, const std::string& plot, const CoresTable& table);

}  // namespace clatter
