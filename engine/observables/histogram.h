#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/observables/observable.h"

namespace clatter {

/// The bins of a column of densities.
struct NamedBins {
  std::string column;
  std::size_t first;  ///< index of the first count in the sums
};

/// The table of a histogram with LogBins: columns `low`, `high` and `density`, the share of the
/// counts per unit of the quantity. The counts are values[first] to values[first + kCount - 1] of
/// the sums, and their number is values[total]. Rows end at the last bin with a count.
ResultTable log_histogram(std::string name, const std::string& unit,
                          std::span<const ObservableSums> parts, std::size_t first,
                          std::size_t total);

/// The same with CountBins: `density` is the mean count per whole number, and `high` the first
/// number of the next bin.
ResultTable count_histogram(std::string name, std::span<const ObservableSums> parts,
                            std::size_t first, std::size_t total);

/// The same with SignedLogBins. Bins without counts have no row.
ResultTable signed_log_histogram(std::string name, const std::string& unit,
                                 std::span<const ObservableSums> parts, std::size_t first,
                                 std::size_t total);

/// The same with a column for the counts of each of `densities`, instead of `density`.
ResultTable signed_log_histogram(std::string name, const std::string& unit,
                                 std::span<const ObservableSums> parts,
                                 const std::vector<NamedBins>& densities, std::size_t total);

/// The same with SignedCountBins, as in count_histogram. Bins without counts have no row.
ResultTable signed_count_histogram(std::string name, std::span<const ObservableSums> parts,
                                   std::size_t first, std::size_t total);

/// The same for `bins` equal bins between `low` and `high`.
ResultTable linear_histogram(std::string name, const std::string& unit,
                             std::span<const ObservableSums> parts, std::size_t first,
                             std::size_t bins, double low, double high, std::size_t total);

}  // namespace clatter
