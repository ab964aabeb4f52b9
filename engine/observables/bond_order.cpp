#include "engine/observables/bond_order.h"

#include <complex>

#include "engine/observables/lag_table.h"
#include "engine/observables/near_cells.h"

namespace clatter {

namespace {

// Layout of the sums: of the means, then [lags][2] samples and products.
struct BondSums {
  static constexpr std::size_t kSamples = 0;
  static constexpr std::size_t kLocal = 1;   // mean |psi_6| of the disks
  static constexpr std::size_t kGlobal = 2;  // |mean psi_6|
  static constexpr std::size_t kLags = 3;
  static constexpr std::size_t kRow = 2;
};

}  // namespace

BondOrder::BondOrder(const Simulation<2>& simulation, const BondOrderSettings& settings)
    : simulation_(simulation),
      lags_(settings.lags_in_time),
      range_(settings.range),
      cells_(simulation.model(), simulation.particles().size(),
             settings.range * simulation.model().diameter),
      history_(lags_) {}

void BondOrder::save(ArchiveWriter& io) {
  Observable::save(io);
  io(history_);
}

void BondOrder::restore(ArchiveReader& io) {
  Observable::restore(io);
  io(history_);
  io.require(history_.is_complete(simulation_.particles().size()));
}

// psi_6 of each disk as a vector of its real and imaginary part; 0 without neighbours.
std::vector<Vec<2>> BondOrder::orders() {
  const std::size_t count = simulation_.particles().size();
  std::vector<Vec<2>> orders(count, Vec<2>::Zero());
  std::vector<double> neighbours(count, 0.0);
  cells_.sort(simulation_.positions(), simulation_.domain());
  cells_.each_pair([&](std::uint32_t first, std::uint32_t second, const Vec<2>& apart) {
    if (!are_near(simulation_, first, second, apart, range_)) return;
    const std::complex<double> direction = std::complex(apart[0], apart[1]) / apart.norm();
    const std::complex<double> cube = direction * direction * direction;
    const std::complex<double> bond = cube * cube;
    // The opposite direction has the same sixth power.
    for (const std::uint32_t disk : {first, second}) {
      orders[disk] += Vec<2>(bond.real(), bond.imag());
      neighbours[disk] += 1.0;
    }
  });
  for (std::size_t i = 0; i < count; ++i) {
    if (neighbours[i] > 0.0) orders[i] /= neighbours[i];
  }
  return orders;
}

void BondOrder::sample() {
  if (simulation_.particles().empty()) return;
  const std::vector<Vec<2>> now = orders();
  const double per_disk = 1.0 / static_cast<double>(now.size());
  std::vector<double>& sums = sums_.values;
  Vec<2> mean = Vec<2>::Zero();
  for (const Vec<2>& order : now) {
    mean += per_disk * order;
    sums[BondSums::kLocal] += per_disk * order.norm();
  }
  sums[BondSums::kSamples] += 1.0;
  sums[BondSums::kGlobal] += mean.norm();
  history_.add(now, [&](std::size_t lag, const std::vector<Vec<2>>& earlier) {
    double products = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) products += now[i].dot(earlier[i]);
    double* const row = &sums[BondSums::kLags + lag * BondSums::kRow];
    row[0] += 1.0;
    row[1] += per_disk * products;
  });
}

ObservableResult BondOrder::result(const ObservableParts& parts) const {
  LagTable table("bond_order", lags_.interval, history_.lags(), parts.coarse,
                 {BondSums::kLags, BondSums::kRow});
  table.add("correlation", "1", 1, 1, 1.0);
  return {{std::move(table).table()},
          {{"bond_order.local", ratio_of(parts.fine, BondSums::kLocal, BondSums::kSamples)},
           {"bond_order.global", ratio_of(parts.fine, BondSums::kGlobal, BondSums::kSamples)}}};
}

}  // namespace clatter
