#include "engine/observables/observable.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "engine/scene/enum_names.h"

namespace clatter {

std::string axis_name(std::size_t axis) {
  return std::string(kAxes[axis].name);
}

ObservableSums& ObservableSums::operator+=(const ObservableSums& other) {
  for (std::size_t k = 0; k < values.size(); ++k) values[k] += other.values[k];
  return *this;
}

void Observable::start() {
  sums_.values.assign(size(), 0.0);
}

ObservableSums Observable::close_window() {
  ObservableSums window = sums_;
  std::ranges::fill(sums_.values, 0.0);
  return window;
}

void Observable::save(ArchiveWriter& io) {
  io(sums_);
}

void Observable::restore(ArchiveReader& io) {
  io(sums_);
  io.require(sums_.values.size() == size());
}

Estimate ratio_of(std::span<const double> numerator, std::span<const double> denominator) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double total = std::accumulate(denominator.begin(), denominator.end(), 0.0);
  return total > 0.0 ? ratio_estimate(numerator, denominator) : Estimate{kNone, kNone};
}

Estimate ratio_of(std::span<const ObservableSums> parts, std::size_t numerator,
                  std::size_t denominator, double scale) {
  std::vector<double> above, below;
  for (const ObservableSums& part : parts) {
    above.push_back(part.values[numerator]);
    below.push_back(scale * part.values[denominator]);
  }
  return ratio_of(above, below);
}

Estimate variance_of(std::span<const ObservableSums> parts, std::size_t count) {
  const double mean = ratio_of(parts, count + 1, count).mean;
  std::vector<double> squares, counts;
  for (const ObservableSums& part : parts) {
    const double number = part.values[count], sum = part.values[count + 1];
    squares.push_back(part.values[count + 2] - 2.0 * mean * sum + mean * mean * number);
    counts.push_back(number);
  }
  return ratio_of(squares, counts);
}

void append(TableColumn& column, const Estimate& estimate) {
  column.values.push_back(estimate.mean);
  column.standard_errors.push_back(estimate.standard_error);
}

}  // namespace clatter
