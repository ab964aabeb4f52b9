#pragma once

#include <string>

namespace clatter {

/// Prints how fast collisions of elastic disks in a periodic box are, by number of disks and area
/// fraction; `count` and `area_fraction` ask for one cell of the table, count 0 for all. Writes it
/// to `json` too, unless that is empty; returns the exit code.
int bench_engine(const std::string& json, int count, double area_fraction);

/// Prints how that rate falls as disks become more, 100 to 4 million at phi = 0.5 and 100,000 at
/// others from 0.01 to 0.88, or to `count`, where that is not 0; writes the table to `json` and
/// draws it to `plot`, unless these are empty; returns the exit code.
int bench_growth(const std::string& json, const std::string& plot, int count);

}  // namespace clatter
