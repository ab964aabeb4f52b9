#pragma once

#include <string>

namespace clatter {

/// Prints the collision rate of elastic disks in a periodic box, by number of disks and area
/// fraction. `count` and `area_fraction` select one cell of the table; count 0: all. Writes the
/// table also to `json`, unless it is empty. Returns the exit code.
int bench_engine(const std::string& json, int count, double area_fraction);

/// Prints the dependence of this rate on the number of disks: 100 to 4 million at phi = 0.5, and
/// 100,000 at other phi from 0.01 to 0.88. A `count` other than 0 limits the number. Writes the
/// table to `json` and a plot to `plot`, unless these are empty. Returns the exit code.
int bench_growth(const std::string& json, const std::string& plot, int count);

}  // namespace clatter
