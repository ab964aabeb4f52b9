#include "engine/observables/histogram.h"

#include <algorithm>
#include <utility>

#include "engine/observables/bins.h"

namespace clatter {

static std::string inverse(const std::string& unit) {
  if (unit == "1") return "1";
  return unit.find(' ') == std::string::npos && unit.find('/') == std::string::npos
             ? "1/" + unit
             : "1/(" + unit + ")";
}

namespace {

// A table of the densities of consecutive bins.
class DensityTable {
 public:
  DensityTable(std::string name, const std::string& unit, std::span<const ObservableSums> parts,
               std::vector<NamedBins> densities, std::size_t total)
      : table_{std::move(name), {{"low", unit, {}}, {"high", unit, {}}}},
        parts_(parts),
        densities_(std::move(densities)),
        total_(total) {
    for (const NamedBins& density : densities_) {
      table_.columns.push_back({density.column, inverse(unit), {}});
    }
  }

  void add(std::size_t bin, double low, double high) {
    table_.columns[0].values.push_back(low);
    table_.columns[1].values.push_back(high);
    for (std::size_t k = 0; k < densities_.size(); ++k) {
      append(table_.columns[2 + k],
             ratio_of(parts_, densities_[k].first + bin, total_, high - low));
    }
  }

  bool is_filled(std::size_t bin) const {
    return std::ranges::any_of(densities_, [&](const NamedBins& density) {
      return std::ranges::any_of(parts_, [&](const ObservableSums& part) {
        return part.values[density.first + bin] > 0.0;
      });
    });
  }

  ResultTable table() && { return std::move(table_); }

 private:
  ResultTable table_;
  std::span<const ObservableSums> parts_;
  std::vector<NamedBins> densities_;
  std::size_t total_;
};

// The columns of a single histogram.
std::vector<NamedBins> single(std::size_t first) {
  return {{"density", first}};
}

// The table of all bins with counts.
template <class Bins>
ResultTable filled_bins(std::string name, const std::string& unit,
                        std::span<const ObservableSums> parts,
                        const std::vector<NamedBins>& columns, std::size_t total) {
  DensityTable densities(std::move(name), unit, parts, columns, total);
  for (std::size_t bin = 0; bin < Bins::kCount; ++bin) {
    if (!densities.is_filled(bin)) continue;
    densities.add(bin, Bins::edge(bin), Bins::edge(bin + 1));
  }
  return std::move(densities).table();
}

// The table of all bins between the first and the last with counts.
template <class Bins>
ResultTable bins_in_range(std::string name, const std::string& unit,
                          std::span<const ObservableSums> parts, std::size_t first,
                          std::size_t total) {
  DensityTable densities(std::move(name), unit, parts, single(first), total);
  std::size_t begin = Bins::kCount, end = 0;
  for (std::size_t bin = 0; bin < Bins::kCount; ++bin) {
    if (!densities.is_filled(bin)) continue;
    begin = std::min(begin, bin);
    end = bin + 1;
  }
  for (std::size_t bin = begin; bin < end; ++bin) {
    densities.add(bin, Bins::edge(bin), Bins::edge(bin + 1));
  }
  return std::move(densities).table();
}

}  // namespace

ResultTable log_histogram(std::string name, const std::string& unit,
                          std::span<const ObservableSums> parts, std::size_t first,
                          std::size_t total) {
  return bins_in_range<LogBins>(std::move(name), unit, parts, first, total);
}

ResultTable count_histogram(std::string name, std::span<const ObservableSums> parts,
                            std::size_t first, std::size_t total) {
  return bins_in_range<CountBins>(std::move(name), "1", parts, first, total);
}

ResultTable signed_log_histogram(std::string name, const std::string& unit,
                                 std::span<const ObservableSums> parts, std::size_t first,
                                 std::size_t total) {
  return filled_bins<SignedLogBins>(std::move(name), unit, parts, single(first), total);
}

ResultTable signed_log_histogram(std::string name, const std::string& unit,
                                 std::span<const ObservableSums> parts,
                                 const std::vector<NamedBins>& densities, std::size_t total) {
  return filled_bins<SignedLogBins>(std::move(name), unit, parts, densities, total);
}

ResultTable signed_count_histogram(std::string name, std::span<const ObservableSums> parts,
                                   std::size_t first, std::size_t total) {
  return filled_bins<SignedCountBins>(std::move(name), "1", parts, single(first), total);
}

ResultTable linear_histogram(std::string name, const std::string& unit,
                             std::span<const ObservableSums> parts, std::size_t first,
                             std::size_t bins, double low, double high, std::size_t total) {
  const auto edge = [&](std::size_t bin) {
    return low + (high - low) * static_cast<double>(bin) / static_cast<double>(bins);
  };
  DensityTable densities(std::move(name), unit, parts, single(first), total);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    densities.add(bin, edge(bin), edge(bin + 1));
  }
  return std::move(densities).table();
}

}  // namespace clatter
