#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/checkpoint/archive.h"
#include "engine/statistics/estimate.h"

namespace clatter {

/// Name of an axis in columns and means: "x", "y" or "z".
std::string axis_name(std::size_t axis);

/// A column of a table of results.
struct TableColumn {
  std::string name;
  std::string unit;                          ///< in the letters of kUnits; "1": dimensionless
  std::vector<double> values;                ///< [rows] NaN where there is none
  std::vector<double> standard_errors = {};  ///< [rows]; empty: the values are exact
};

/// A table of results: bins, lags or the like, and values at them.
struct ResultTable {
  std::string name;  ///< dotted, for example "free_flights.time"
  std::vector<TableColumn> columns;
};

/// The results of an observable.
struct ObservableResult {
  std::vector<ResultTable> tables;
  std::vector<std::pair<std::string, Estimate>> means;  ///< with dotted names
};

/// Sums of an observable over a window of time.
struct ObservableSums {
  std::vector<double> values;

  ObservableSums& operator+=(const ObservableSums& other);
  /// Memory of the values.
  std::size_t bytes() const { return values.size() * sizeof(double); }
};

/// Visits all members, for checkpoints.
template <class Archive>
void visit(Archive& io, ObservableSums& sums) {
  auto& [values] = sums;
  io(values);
}

/// The sums of an observable in consecutive parts of a run. Standard errors come from their
/// scatter.
struct ObservableParts {
  std::span<const ObservableSums> fine;    ///< for means; only the first sums, in up to 1024 parts
  std::span<const ObservableSums> coarse;  ///< for tables; all sums, in up to 64 parts
};

/// A quantity that accumulates sums over windows of time. An observable of events is also an
/// Observer of the simulation; an observable of states is sampled at equal intervals.
class Observable {
 public:
  virtual ~Observable() = default;

  /// Number of sums.
  virtual std::size_t size() const = 0;
  /// Number of sums, from the first, that the means need.
  virtual std::size_t mean_size() const = 0;
  /// Begins to accumulate, at the simulation's time.
  virtual void start();
  /// Adds the present state, if the observable is sampled.
  virtual void sample() {}
  /// The sums since the last call or the start.
  virtual ObservableSums close_window();
  /// The results of a run.
  virtual ObservableResult result(const ObservableParts& parts) const = 0;

  /// Writes or reads the members that a checkpoint keeps. The continued simulation must be at the
  /// same time.
  virtual void save(ArchiveWriter& io);
  virtual void restore(ArchiveReader& io);

 protected:
  ObservableSums sums_;  // of the present window
};

/// sum(numerator)/sum(denominator) over the parts of a run; NaN if the denominator is 0.
Estimate ratio_of(std::span<const double> numerator, std::span<const double> denominator);

/// Estimate of the ratio of two sums: sum(values[numerator]) / sum(scale * values[denominator]).
Estimate ratio_of(std::span<const ObservableSums> parts, std::size_t numerator,
                  std::size_t denominator, double scale = 1.0);

/// Variance of a quantity. The sums from `count` on are those of 1, of the quantity and of its
/// square.
Estimate variance_of(std::span<const ObservableSums> parts, std::size_t count);

/// Appends an estimate to a column.
void append(TableColumn& column, const Estimate& estimate);

}  // namespace clatter
