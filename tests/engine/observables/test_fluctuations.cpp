// Fluctuations: power of the walls, current through a plane, number of particles in cells.

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <numeric>

#include "engine/observables/bins.h"
#include "tests/engine/observables/observed.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

constexpr double kInterval = 0.7;
constexpr int kSamples = 60;

template <int D>
Measured fluctuations(const Scene& scene, const Measure& measure, ObservableKind kind) {
  return observed<D>(scene, measure, kind, kSamples * kInterval, 3);
}

// Energies that walls give since the last call of take().
template <int D>
class WallEnergies : public Observer<D> {
 public:
  void on_wall(const WallCollision<D>& collision) override {
    energies_[collision.side] += collision.particle.energy();
  }
  std::map<int, double> take() { return std::exchange(energies_, {}); }

 private:
  std::map<int, double> energies_;
};

}  // namespace

TEST_CASE("Signed bins: every number is between the edges of its bin") {
  for (double size = 1e-19; size < 4e9; size *= 1.0173) {
    for (const double number : {-size, size}) {
      CAPTURE(number);
      const std::size_t bin = SignedLogBins::of(number);
      CHECK(SignedLogBins::edge(bin) <= number);
      CHECK(SignedLogBins::edge(bin + 1) >= number);
    }
  }
  CHECK(SignedLogBins::edge(SignedLogBins::of(0.0)) == 0.0);
  for (long number = -3000; number < 3000; ++number) {
    CAPTURE(number);
    const std::size_t bin = SignedCountBins::of(number);
    CHECK(SignedCountBins::edge(bin) <= static_cast<double>(number));
    CHECK(SignedCountBins::edge(bin + 1) > static_cast<double>(number));
    if (number >= -16 && number < 16) {
      CHECK(SignedCountBins::edge(bin) == static_cast<double>(number));
      CHECK(SignedCountBins::edge(bin + 1) == static_cast<double>(number + 1));
    }
  }
}

TEST_CASE_TEMPLATE("Wall power: each wall has the energies of its hits", Dimension, Plane, Space) {
  constexpr int D = Dimension::value;
  const Scene scene = heated_gas<D>();
  Measure measure;
  measure.wall_power = {.interval = kInterval};
  const Measured measured = fluctuations<D>(scene, measure, ObservableKind::WallPower);
  const auto simulation = simulation_of<D>(scene, 3);
  WallEnergies<D> energies;
  simulation->add_observer(energies);
  std::vector<double> left, right, total;
  for (int sample = 1; sample <= kSamples; ++sample) {
    simulation->run_until(sample * kInterval);
    std::map<int, double> gained = energies.take();
    left.push_back(gained[kLeft] / kInterval);
    right.push_back(gained[kRight] / kInterval);
    total.push_back(left.back() + right.back());
  }
  const auto check = [&](const std::string& name, const std::vector<double>& numbers) {
    check_numbers(measured, name, name + ".mean", name + ".variance", numbers);
  };
  check("wall_power.left", left);
  check("wall_power.right", right);
  check("wall_power.total", total);
  CHECK(std::ranges::min(left) < 0.0);
  CHECK(mean_of(measured, "wall_power.total.mean").mean ==
        doctest::Approx(measured.walls_in->mean).epsilon(1e-9));
  CHECK_THROWS(table_of(measured, "wall_power.bottom"));
}

// Positions are unwrapped in steps that are short beside the box.
TEST_CASE_TEMPLATE("Plane current: it is the change of the unwrapped positions", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  const Scene scene = heated_gas<D>();
  for (const int axis : {0, D - 1}) {
    CAPTURE(axis);
    Measure measure;
    measure.plane_current = {
        .interval = kInterval, .axis = static_cast<Axis>(axis), .position = 0.3};
    const Measured measured = fluctuations<D>(scene, measure, ObservableKind::PlaneCurrent);
    const auto simulation = simulation_of<D>(scene, 3);
    const double length = scene.box[axis], plane = 0.3 * length;
    std::vector<Vec<D>> before = simulation->state().positions;
    std::vector<double> unwrapped;
    for (const Vec<D>& position : before) unwrapped.push_back(position[axis]);
    const auto beyond = [&] {
      double sum = 0.0;
      for (const double coordinate : unwrapped) {
        sum += axis == 0 ? (coordinate >= plane ? 1.0 : 0.0)
                         : std::floor((coordinate - plane) / length);
      }
      return sum;
    };
    constexpr int kSteps = 70;
    std::vector<double> numbers;
    double earlier = beyond();
    for (int sample = 0; sample < kSamples; ++sample) {
      for (int step = 1; step <= kSteps; ++step) {
        simulation->run_until((sample + static_cast<double>(step) / kSteps) * kInterval);
        const std::vector<Vec<D>> now = simulation->state().positions;
        for (std::size_t i = 0; i < now.size(); ++i) {
          const double apart = now[i][axis] - before[i][axis];
          unwrapped[i] += axis == 0 ? apart : apart - length * std::round(apart / length);
        }
        before = now;
      }
      numbers.push_back(beyond() - earlier);
      earlier = beyond();
    }
    check_numbers(measured, "plane_current.number", "plane_current.mean_number",
                  "plane_current.number_variance", numbers);
    CHECK(std::ranges::min(numbers) < 0.0);
    CHECK(std::ranges::max(numbers) > 0.0);
  }
}

// In short times the particles of a dilute gas cross independently. The variance is then the mean
// number of crossings in both directions, n A t sqrt(2 T/(pi m)) = 12.6. Sample: 4000 intervals.
TEST_CASE("Plane current: short times have the variance of independent particles") {
  const double side = 100.0;
  Scene scene = gas(side, side, 400, 1.0);
  Measure measure;
  measure.plane_current = {.interval = 4.0, .axis = Axis::Y, .position = 0.5};
  const Measured measured = observed<2>(scene, measure, ObservableKind::PlaneCurrent, 16'000.0, 5);
  const double expected = 400.0 / side * 4.0 * std::sqrt(2.0 / std::numbers::pi);
  const Estimate variance = mean_of(measured, "plane_current.number_variance");
  CHECK(variance.standard_error < 0.03 * expected);
  CHECK(errors_off(variance, expected) < 5.0);
}

TEST_CASE_TEMPLATE("Local density: cells have the numbers of all samples", Dimension, Plane,
                   Space) {
  constexpr int D = Dimension::value;
  const Scene scene = heated_gas<D>();
  Measure measure;
  measure.local_density = {.interval = kInterval, .cell = 2.4};
  const Measured measured = fluctuations<D>(scene, measure, ObservableKind::LocalDensity);
  // Cells along each axis: those of an edge of at least 2.4.
  const std::vector<int> cells = D == 2 ? std::vector{4, 2} : std::vector{2, 2, 2};
  const auto simulation = simulation_of<D>(scene, 3);
  std::vector<double> numbers;
  for (int sample = 1; sample <= kSamples; ++sample) {
    simulation->run_until(sample * kInterval);
    std::map<std::vector<int>, int> counts;
    for (const Vec<D>& position : simulation->state().positions) {
      std::vector<int> cell;
      for (int axis = 0; axis < D; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        cell.push_back(static_cast<int>(position[axis] / (scene.box[axis] / cells[k])));
      }
      ++counts[cell];
    }
    for (const auto& [cell, count] : counts) numbers.push_back(count);
    const int all = std::accumulate(cells.begin(), cells.end(), 1, std::multiplies<>());
    numbers.resize(static_cast<std::size_t>(sample * all), 0.0);
  }
  check_numbers(measured, "local_density.number", "local_density.mean_number",
                "local_density.number_variance", numbers);
}
