#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/observables/observable.h"

namespace clatter {

/// Place of the sums of lags among the sums of an observable. Each lag has a row with the number of
/// samples, and then the sums of quantities.
struct LagRows {
  std::size_t first;  ///< place of the first row
  std::size_t size;   ///< of a row
};

/// A table of correlations in time, with a row for each lag and the column "time".
class LagTable {
 public:
  /// `lags` are in units of `interval`.
  LagTable(std::string name, double interval, std::span<const std::uint64_t> lags,
           std::span<const ObservableSums> parts, LagRows rows);

  /// Adds a column: `count` consecutive sums of a row from `first`, times `scale`, per sample.
  void add(std::string name, const std::string& unit, std::size_t first, std::size_t count,
           double scale);

  ResultTable table() && { return std::move(table_); }

 private:
  Estimate estimate(std::vector<double> sums, std::vector<double> samples, std::uint64_t lag) const;

  ResultTable table_;
  std::span<const std::uint64_t> lags_;
  std::span<const ObservableSums> parts_;
  LagRows rows_;
};

}  // namespace clatter
