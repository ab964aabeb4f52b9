// Structure factor, clusters and bond order.

#include <doctest/doctest.h>

#include <algorithm>
#include <complex>
#include <numbers>
#include <numeric>

#include "tests/engine/observables/observed.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr double kStructureInterval = 2.0;
constexpr int kStructureSamples = 5;

// A gas between two walls, periodic along the other axes, with sides without symmetry.
template <int D>
Scene slab() {
  Scene scene = gas(D == 2 ? VecX(Vec2(11.0, 7.0)) : VecX(Vec<3>(7.0, 5.0, 6.0)), 40, 0.9);
  wall_in(scene, 1, {.kind = WallKind::Thermal, .temperature = 1.0});
  return scene;
}

// Calls visit(state) at the times of the samples.
template <int D, class Visit>
void at_samples(const Scene& scene, std::uint64_t seed, const Visit& visit) {
  const auto simulation = simulation_of<D>(scene, seed);
  for (int sample = 1; sample <= kStructureSamples; ++sample) {
    simulation->run_until(sample * kStructureInterval);
    visit(simulation->state());
  }
}

}  // namespace

// The shell has all wave vectors below its edge: in 2D one along x, in 3D one along x, one along z
// and two diagonal ones.
TEST_CASE_TEMPLATE("Structure factor: it is that of all samples", Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const Scene scene = slab<D>();
  Measure measure;
  measure.structure_factor = {
      .interval = kStructureInterval, .range = D == 2 ? 1.0 : 1.5, .bins = 1, .vectors = 20};
  const ResultTable table = table_of(
      observed<D>(scene, measure, ObservableKind::StructureFactor, 10.0, 3), "structure_factor");
  std::vector<Vec<D>> vectors = {2.0 * std::numbers::pi / scene.box[0] * Vec<D>::UnitX()};
  if constexpr (D == 3) {
    const Vec<D> z = 2.0 * std::numbers::pi / scene.box[2] * Vec<D>::UnitZ();
    vectors.insert(vectors.end(), {z, vectors[0] + z, vectors[0] - z});
  }
  double length = 0.0, expected = 0.0;
  for (const Vec<D>& k : vectors) {
    length += k.norm() / static_cast<double>(vectors.size());
    at_samples<D>(scene, 3, [&](const State<D>& state) {
      std::complex<double> density = 0.0;
      for (const Vec<D>& position : state.positions) density += std::polar(1.0, k.dot(position));
      expected +=
          std::norm(density) / 40.0 / kStructureSamples / static_cast<double>(vectors.size());
    });
  }
  REQUIRE(column_of(table, "vectors").values ==
          std::vector<double>{static_cast<double>(vectors.size())});
  CHECK(column_of(table, "k").values[0] == doctest::Approx(length).epsilon(1e-12));
  CHECK(column_of(table, "S").values[0] == doctest::Approx(expected).epsilon(1e-9));
}

// S(0) is the compressibility of Henderson's equation of state. 1200 independent values have a
// standard error of 3 %. At k = .3, S is higher by a few percent.
TEST_CASE("Structure factor: long waves have the theory's compressibility") {
  constexpr double kPhi = 0.3;
  const double side = std::sqrt(2000.0 * std::numbers::pi / (4.0 * kPhi));
  Measure measure;
  measure.structure_factor = {.interval = 2.0, .range = 0.3, .bins = 1, .vectors = 8};
  const ResultTable table = table_of(
      observed<2>(gas(side, side, 2000, 1.0), measure, ObservableKind::StructureFactor, 300.0, 1),
      "structure_factor");
  // The derivative of phi (1 + phi^2/8)/(1 - phi)^2.
  const double inverse = (1.0 + 3.0 * kPhi * kPhi / 8.0) / std::pow(1.0 - kPhi, 2) +
                         2.0 * kPhi * (1.0 + kPhi * kPhi / 8.0) / std::pow(1.0 - kPhi, 3);
  CHECK(column_of(table, "vectors").values[0] == 8.0);
  CHECK(column_of(table, "S").values[0] == doctest::Approx(1.0 / inverse).epsilon(0.12));
}

// The clusters are found again by flooding from each particle.
TEST_CASE_TEMPLATE("Clusters: sizes are those of all samples", Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  constexpr double kRange = D == 2 ? 1.4 : 1.3;
  const Scene scene = slab<D>();
  Measure measure;
  measure.clusters = {.interval = kStructureInterval, .range = kRange};
  const Measured measured = observed<D>(scene, measure, ObservableKind::Clusters, 10.0, 3);
  const Model<D> model = model_of<D>(scene, 3);
  std::vector<double> counts(41, 0.0);
  double number = 0.0, largest = 0.0, mean_size = 0.0;
  at_samples<D>(scene, 3, [&](const State<D>& state) {
    std::vector<bool> seen(state.positions.size(), false);
    std::size_t most = 0;
    for (std::size_t start = 0; start < seen.size(); ++start) {
      if (seen[start]) continue;
      std::vector<std::size_t> cluster = {start};
      seen[start] = true;
      for (std::size_t next = 0; next < cluster.size(); ++next) {
        for (std::size_t other = 0; other < seen.size(); ++other) {
          const Vec<D> apart =
              nearest_image<D>(model, state.positions[cluster[next]] - state.positions[other]);
          if (seen[other] || apart.norm() > kRange) continue;
          seen[other] = true;
          cluster.push_back(other);
        }
      }
      ++counts[cluster.size()];
      ++number;
      most = std::max(most, cluster.size());
      mean_size += static_cast<double>(cluster.size() * cluster.size()) / 40.0;
    }
    largest += static_cast<double>(most);
  });
  CHECK(mean_of(measured, "clusters.number").mean == doctest::Approx(number / kStructureSamples));
  CHECK(mean_of(measured, "clusters.largest").mean == doctest::Approx(largest / kStructureSamples));
  CHECK(mean_of(measured, "clusters.mean_size").mean ==
        doctest::Approx(mean_size / kStructureSamples));
  const ResultTable sizes = table_of(measured, "clusters.size");
  const TableColumn low = column_of(sizes, "low"), high = column_of(sizes, "high");
  double particles = 0.0;
  for (std::size_t bin = 0; bin < low.values.size(); ++bin) {
    double expected = 0.0;
    for (auto size = static_cast<std::size_t>(low.values[bin]);
         size < static_cast<std::size_t>(high.values[bin]) && size < counts.size(); ++size) {
      expected += counts[size] / kStructureSamples;
      particles += static_cast<double>(size) * counts[size];
    }
    CHECK(column_of(sizes, "density").values[bin] * (high.values[bin] - low.values[bin]) ==
          doctest::Approx(expected));
  }
  CHECK(particles == 40.0 * kStructureSamples);
  // Parts without samples have no row.
  const ResultTable growth = table_of(measured, "clusters.growth");
  CHECK(column_of(growth, "time").values == std::vector<double>{2.0, 4.0, 6.0, 8.0, 10.0});
  const std::vector<double> most = column_of(growth, "largest").values;
  CHECK(std::accumulate(most.begin(), most.end(), 0.0) == doctest::Approx(largest));
}

TEST_CASE("Bond order: psi_6 is that of all samples") {
  const Scene scene = slab<2>();
  Measure measure;
  measure.bond_order = {
      {.interval = kStructureInterval, .longest = 2.0 * kStructureInterval, .lags = 2}, 1.5};
  const Measured measured = observed<2>(scene, measure, ObservableKind::BondOrder, 10.0, 3);
  const Model<2> model = model_of<2>(scene, 3);
  double local = 0.0, global = 0.0;
  std::vector<std::vector<std::complex<double>>> all;
  at_samples<2>(scene, 3, [&](const State<2>& state) {
    std::vector<std::complex<double>> orders;
    for (const Vec2& own : state.positions) {
      std::complex<double> sum = 0.0;
      double neighbours = 0.0;
      for (const Vec2& other : state.positions) {
        const Vec2 apart = nearest_image<2>(model, other - own);
        if (&other == &own || apart.norm() > 1.5) continue;
        sum += std::polar(1.0, 6.0 * std::atan2(apart[1], apart[0]));
        neighbours += 1.0;
      }
      orders.push_back(neighbours > 0.0 ? sum / neighbours : 0.0);
    }
    std::complex<double> mean = 0.0;
    for (const std::complex<double>& order : orders) {
      local += std::abs(order) / 40.0 / kStructureSamples;
      mean += order / 40.0;
    }
    global += std::abs(mean) / kStructureSamples;
    all.push_back(orders);
  });
  CHECK(mean_of(measured, "bond_order.local").mean == doctest::Approx(local));
  CHECK(mean_of(measured, "bond_order.global").mean == doctest::Approx(global));
  const ResultTable table = table_of(measured, "bond_order");
  CHECK(column_of(table, "time").values == std::vector<double>{0.0, 2.0, 4.0});
  for (std::size_t lag = 0; lag < 3; ++lag) {
    double expected = 0.0;
    for (std::size_t sample = lag; sample < kStructureSamples; ++sample) {
      for (std::size_t i = 0; i < 40; ++i) {
        expected += (std::conj(all[sample - lag][i]) * all[sample][i]).real() / 40.0 /
                    static_cast<double>(kStructureSamples - lag);
      }
    }
    CHECK(column_of(table, "correlation").values[lag] == doctest::Approx(expected));
  }
}
