#include "engine/observables/lag_table.h"

#include <cmath>
#include <utility>

namespace clatter {

LagTable::LagTable(std::string name, double interval, std::span<const std::uint64_t> lags,
                   std::span<const ObservableSums> parts, LagRows rows)
    : table_{std::move(name), {{"time", "t", {}}}}, lags_(lags), parts_(parts), rows_(rows) {
  for (const std::uint64_t lag : lags) {
    table_.columns[0].values.push_back(static_cast<double>(lag) * interval);
  }
}

void LagTable::add(std::string name, const std::string& unit, std::size_t first, std::size_t count,
                   double scale) {
  TableColumn column{std::move(name), unit, {}};
  for (std::size_t lag = 0; lag < lags_.size(); ++lag) {
    const std::size_t row = rows_.first + lag * rows_.size;
    std::vector<double> sums, samples;
    for (const ObservableSums& part : parts_) {
      double sum = 0.0;
      for (std::size_t k = first; k < first + count; ++k) sum += part.values[row + k];
      sums.push_back(scale * sum);
      samples.push_back(part.values[row]);
    }
    append(column, estimate(std::move(sums), std::move(samples), lags_[lag]));
  }
  table_.columns.push_back(std::move(column));
}

static void join_neighbours(std::vector<double>& sums) {
  for (std::size_t k = 1; k < sums.size(); ++k) {
    if (k % 2 == 0) {
      sums[k / 2] = sums[k];
    } else {
      sums[k / 2] += sums[k];
    }
  }
  sums.resize((sums.size() + 1) / 2);
}

// Correlations over a lag overlap in time. Parts are joined until they are twice as long as the
// lag. If too few remain, the error is unknown.
Estimate LagTable::estimate(std::vector<double> sums, std::vector<double> samples,
                            std::uint64_t lag) const {
  constexpr std::size_t kMinParts = 8;
  // Each sample has the lag 0.
  double intervals = parts_.empty() ? 0.0 : parts_.front().values[rows_.first];
  while (intervals > 0.0 && intervals < 2.0 * static_cast<double>(lag) && sums.size() > 1) {
    join_neighbours(sums);
    join_neighbours(samples);
    intervals *= 2.0;
  }
  Estimate estimate = ratio_of(sums, samples);
  if (sums.size() < kMinParts) estimate.standard_error = std::nan("");
  return estimate;
}

}  // namespace clatter
