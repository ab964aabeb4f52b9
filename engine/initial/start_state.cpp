#include "engine/initial/start_state.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "engine/dynamics/simulation.h"
#include "engine/initial/random_insertion.h"
#include "engine/physics/lattice.h"
#include "engine/physics/random.h"

namespace clatter {

// Random insertion jams at 0.547 (Feder 1980).
static constexpr double kInsertionFraction = 0.54;
// Above, the equilibrium fluid of hard disks ends (Bernard & Krauth 2011: 0.700).
static constexpr double kFluidFraction = 0.7;

static std::vector<Vec2> gaussian_velocities(std::size_t count, double temperature,
                                             std::uint64_t seed) {
  std::vector<Vec2> velocities(count);
  Vec2 mean = Vec2::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, Stream::Velocity, static_cast<std::uint32_t>(i), 0);
    const double x = random.normal();
    velocities[i] = {x, random.normal()};
    mean += velocities[i] / static_cast<double>(count);
  }
  double twice_energy = 0.0;
  for (Vec2& v : velocities) {
    if (count >= 2) v -= mean;
    twice_energy += v.squaredNorm();
  }
  const double scale = std::sqrt(2.0 * static_cast<double>(count) * temperature / twice_energy);
  for (Vec2& v : velocities) v = temperature > 0.0 ? Vec2(v * scale) : Vec2::Zero();
  return velocities;
}

// With the mean that they happen to have: spins have no law of conservation that a mean could
// break.
static std::vector<Spin<2>> gaussian_spins(std::size_t count, double temperature, double inertia,
                                           std::uint64_t seed) {
  std::vector<Spin<2>> spins(count, Spin<2>::Zero());
  if (!(temperature > 0.0)) return spins;
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    spins[i][0] = Random(seed, Stream::StartSpin, static_cast<std::uint32_t>(i), 0).normal();
    sum += spins[i].squaredNorm();
  }
  const double moment = moment_of_inertia(inertia, 1.0);
  const double scale = std::sqrt(static_cast<double>(count) * temperature / (moment * sum));
  for (Spin<2>& spin : spins) spin *= scale;
  return spins;
}

// A random choice of `count` of the sites.
static void choose(std::vector<Vec2>& sites, std::size_t count, Random& random) {
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(sites[i], sites[i + random.below(sites.size() - i)]);
  }
  sites.resize(count);
}

// exp(i m theta) of the direction theta of x, as a vector: a power of the unit vector.
static Vec2 direction_power(const Vec2& x, int m) {
  const Vec2 unit = x / x.norm();
  Vec2 power = unit;
  for (int k = 1; k < m; ++k) {
    power = {power.x() * unit.x() - power.y() * unit.y(),
             power.x() * unit.y() + power.y() * unit.x()};
  }
  return power;
}

// |psi_m| = |<exp(i m theta)>| over all pairs closer than 1.5 diameters: the global bond order.
static double bond_order(const Model<2>& model, const State<2>& state, int m) {
  constexpr double kReach = 1.5;
  Model<2> reach = model;
  reach.diameter = kReach * model.diameter;
  CellGrid<2> grid(reach, static_cast<double>(state.positions.size()));
  for (std::uint32_t i = 0; i < state.positions.size(); ++i) {
    grid.insert(i, grid.cell_at(state.positions[i]));
  }
  Vec2 sum = Vec2::Zero();
  double bonds = 0.0;
  for (std::uint32_t i = 0; i < state.positions.size(); ++i) {
    const Vec2& r = state.positions[i];
    grid.visit(grid.cell_at(r), [&](std::uint32_t j, const Vec2& wrap) {
      const Vec2 x = state.positions[j] - r + wrap.cwiseProduct(model.box);
      if (j == i || x.norm() > reach.diameter) return;
      sum += direction_power(x, m);
      bonds += 1.0;
    });
  }
  return bonds > 0.0 ? sum.norm() / bonds : 0.0;
}

// Elastic motion from lattice sites until the bond order of the square and of the triangular
// lattice is that of a fluid, or for long enough that it would have been.
static std::vector<Vec2> melt(const Room& room, const std::vector<Vec2>& sites,
                              std::uint64_t seed) {
  constexpr int kRounds = 10;
  constexpr std::uint64_t kCollisionsPerRound = 20;  // per particle
  // At T = 1 and above phi = 0.5 these take less than 10; a lone particle never has them.
  constexpr double kLongestRound = 100.0;
  const double count = static_cast<double>(sites.size());
  const double square_order = std::max(0.1, 3.0 / std::sqrt(count));
  const double triangular_order = std::max(0.3, 3.0 / std::sqrt(count));
  Model<2> elastic;
  elastic.box = room.box;
  elastic.diameter = room.diameter;
  for (int side = 0; side < 4; ++side) {
    if (!room.periodic[side / 2]) elastic.walls[side] = Wall{};
  }
  Simulation<2> simulation(elastic, {sites, gaussian_velocities(sites.size(), 1.0, ~seed)});
  for (int round = 1; round <= kRounds; ++round) {
    simulation.run_until(kLongestRound * round, kCollisionsPerRound * round * sites.size() / 2);
    const State<2> state = simulation.state();
    if (bond_order(elastic, state, 4) < square_order &&
        bond_order(elastic, state, 6) < triangular_order) {
      break;
    }
  }
  return simulation.state().positions;
}

static std::vector<Vec2> random_positions(const Room& room, int count, std::uint64_t seed) {
  Random random(seed, Stream::Placement, 0, 0);
  const double fraction = count * std::numbers::pi / (4.0 * room.box.x() * room.box.y());
  if (fraction <= kInsertionFraction) {
    std::vector<Vec2> placed = random_insertion(room, count, random);
    if (static_cast<int>(placed.size()) == count) return placed;
  }
  std::vector<Vec2> sites = square_lattice(room, count);
  const bool square = !sites.empty();
  if (!square) sites = hexagonal_lattice(room, count);
  choose(sites, static_cast<std::size_t>(count), random);
  if (!square || fraction > kFluidFraction) return sites;
  return melt(room, sites, seed);
}

static std::vector<Vec2> lattice_positions(const Room& room, int count, std::uint64_t seed) {
  std::vector<Vec2> sites = hexagonal_lattice(room, count);
  if (sites.empty()) sites = square_lattice(room, count);
  Random random(seed, Stream::Placement, 0, 0);
  choose(sites, static_cast<std::size_t>(count), random);
  return sites;
}

// Numbers particles along rows, upwards: those that are near each other then lie near each other in
// memory too, which large gases gain a quarter of their speed from.
static void number_by_rows(std::vector<Vec2>& positions) {
  constexpr double kRowHeight = 1.3;  // diameters: about that of the engine's cells
  const auto row = [](const Vec2& r) { return std::floor(r.y() / kRowHeight); };
  std::stable_sort(positions.begin(), positions.end(), [&](const Vec2& a, const Vec2& b) {
    return std::pair(row(a), a.x()) < std::pair(row(b), b.x());
  });
}

State<2> start_state(const Scene& scene, std::uint64_t seed) {
  const Start& start = scene.particles.start;
  if (start.layout == Layout::File) return start.state;
  const Room room = scene.start_room();
  const int count = scene.particles.count;
  State<2> state;
  state.positions = start.layout == Layout::Random ? random_positions(room, count, seed)
                                                   : lattice_positions(room, count, seed);
  number_by_rows(state.positions);
  const Vec2 corner = scene.clear_corner();
  for (Vec2& position : state.positions) position += corner;
  state.velocities = gaussian_velocities(state.positions.size(), start.temperature, seed);
  if (scene.spins()) {
    state.spins = gaussian_spins(state.positions.size(), start.spin_temperature,
                                 scene.particles.inertia, seed);
  }
  return state;
}

}  // namespace clatter
