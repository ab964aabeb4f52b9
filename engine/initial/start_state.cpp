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
#include "engine/physics/theory.h"
#include "engine/system/platform.h"

namespace clatter {

// Packing fractions up to which random insertion is used: it jams at 0.547 for disks (Feder 1980)
// and 0.384 for spheres (Torquato, Uche & Stillinger 2006).
template <int D>
static constexpr double kInsertionFraction = D == 2 ? 0.54 : 0.37;
// Above these packing fractions there is no fluid: the fluid of disks ends at 0.700 (Bernard &
// Krauth 2011), and spheres crystallise spontaneously.
template <int D>
static constexpr double kFluidFraction = D == 2 ? 0.7 : 0.54;

template <int D>
static std::vector<Vec<D>> gaussian_velocities(std::size_t count, double temperature,
                                               std::uint64_t seed, const StopRequest& stop) {
  std::vector<Vec<D>> velocities(count);
  Vec<D> mean = Vec<D>::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    stop.check();
    Random random(seed, Stream::Velocity, static_cast<std::uint32_t>(i), 0);
    for (double& component : velocities[i]) component = random.normal();
    mean += velocities[i] / static_cast<double>(count);
  }
  double twice_energy = 0.0;
  for (Vec<D>& v : velocities) {
    if (count >= 2) v -= mean;
    twice_energy += v.squaredNorm();
  }
  const double freedoms = static_cast<double>(D) * static_cast<double>(count);
  const double scale = std::sqrt(freedoms * temperature / twice_energy);
  for (Vec<D>& v : velocities) v = temperature > 0.0 ? Vec<D>(v * scale) : Vec<D>::Zero();
  return velocities;
}

// The mean is not removed, because spins have no conservation law.
template <int D>
static std::vector<Spin<D>> gaussian_spins(std::size_t count, double temperature, double inertia,
                                           std::uint64_t seed, const StopRequest& stop) {
  std::vector<Spin<D>> spins(count, Spin<D>::Zero());
  if (!(temperature > 0.0)) return spins;
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    stop.check();
    Random random(seed, Stream::StartSpin, static_cast<std::uint32_t>(i), 0);
    for (double& component : spins[i]) component = random.normal();
    sum += spins[i].squaredNorm();
  }
  const double freedoms = static_cast<double>(Spin<D>::SizeAtCompileTime * count);
  const double scale = std::sqrt(freedoms * temperature / (moment_of_inertia(inertia, 1.0) * sum));
  for (Spin<D>& spin : spins) spin *= scale;
  return spins;
}

// A random choice of `count` of the sites.
template <int D>
static void choose(std::vector<Vec<D>>& sites, std::size_t count, Random& random) {
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(sites[i], sites[i + random.below(sites.size() - i)]);
  }
  sites.resize(count);
}

// exp(i m theta) as a vector, where theta is the direction of x: a power of the unit vector.
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

// Whether the lattice has melted. For disks the criterion is the bond order of the square and the
// triangular lattice. For spheres it is a root mean square displacement of one diameter.
static bool is_fluid(const Model<2>& model, const State<2>& state, const std::vector<Vec<2>>&) {
  const double finite = 3.0 / std::sqrt(static_cast<double>(state.positions.size()));
  return bond_order(model, state, 4) < std::max(0.1, finite) &&
         bond_order(model, state, 6) < std::max(0.3, finite);
}
static bool is_fluid(const Model<3>& model, const State<3>& state,
                     const std::vector<Vec<3>>& sites) {
  double squares = 0.0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    Vec<3> way = state.positions[i] - sites[i];
    for (int axis = 0; axis < 3; ++axis) {
      if (!model.periodic(axis)) continue;
      way[axis] -= model.box[axis] * std::round(way[axis] / model.box[axis]);
    }
    squares += way.squaredNorm();
  }
  return squares > static_cast<double>(sites.size()) * model.diameter * model.diameter;
}

// Melts a lattice by elastic motion, until is_fluid() or for at most kRounds rounds.
template <int D>
static std::vector<Vec<D>> melt(const Room<D>& room, const std::vector<Vec<D>>& sites,
                                std::uint64_t seed, const StopRequest& stop) {
  constexpr int kRounds = 10;
  constexpr std::uint64_t kCollisionsPerRound = 20;  // per particle
  // Longest time of a round. At T = 1 in a dense gas a round takes less than 10; a lone particle
  // never collides.
  constexpr double kLongestRound = 100.0;
  Model<D> elastic;
  elastic.box = room.box;
  elastic.diameter = room.diameter;
  for (int side = 0; side < 2 * D; ++side) {
    if (room.walled[side / 2]) elastic.walls[side] = Wall{};
  }
  Simulation<D> simulation(elastic, {sites, gaussian_velocities<D>(sites.size(), 1.0, ~seed, stop)},
                           0.0, stop);
  for (int round = 1; round <= kRounds; ++round) {
    simulation.run_until(kLongestRound * round, kCollisionsPerRound * round * sites.size() / 2,
                         kNoLimit, stop);
    stop.check();
    if (is_fluid(elastic, simulation.state(), sites)) break;
  }
  return simulation.positions();
}

template <int D>
static std::vector<Vec<D>> random_positions(const Room<D>& room, int count, std::uint64_t seed,
                                            const StopRequest& stop) {
  Random random(seed, Stream::Placement, 0, 0);
  const double fraction = packing_fraction(D, count / room.box.prod());
  if (fraction <= kInsertionFraction<D>) {
    std::vector<Vec<D>> placed = random_insertion(room, count, random, stop);
    if (static_cast<int>(placed.size()) == count) return placed;
  }
  std::vector<Vec<D>> sites = primitive_lattice(room, count);
  const bool primitive = !sites.empty();
  if (!primitive) sites = face_centred_lattice(room, count);
  choose<D>(sites, static_cast<std::size_t>(count), random);
  // A square lattice fits at every density of the fluid of disks, except in narrow rooms; there
  // disks stay on their sites. A cubic lattice of spheres often does not fit, because it fills at
  // most 0.52.
  const bool melts = primitive || D == 3;
  if (!melts || fraction > kFluidFraction<D>) return sites;
  return melt(room, sites, seed, stop);
}

template <int D>
static std::vector<Vec<D>> lattice_positions(const Room<D>& room, int count, std::uint64_t seed) {
  std::vector<Vec<D>> sites = face_centred_lattice(room, count);
  if (sites.empty()) sites = primitive_lattice(room, count);
  Random random(seed, Stream::Placement, 0, 0);
  choose<D>(sites, static_cast<std::size_t>(count), random);
  return sites;
}

// Numbers particles along rows, and rows from bottom to top. Near particles are then near in memory
// too, which makes large gases faster by a quarter.
template <int D>
static void number_by_rows(std::vector<Vec<D>>& positions) {
  constexpr double kRowHeight = 1.3;  // diameters: about that of the engine's cells
  const auto comes_first = [](const Vec<D>& a, const Vec<D>& b) {
    for (int k = D - 1; k > 0; --k) {
      const double row_a = std::floor(a[k] / kRowHeight), row_b = std::floor(b[k] / kRowHeight);
      if (row_a != row_b) return row_a < row_b;
    }
    return a[0] < b[0];
  };
  std::stable_sort(positions.begin(), positions.end(), comes_first);
}

template <int D>
State<D> start_state(const Scene& scene, std::uint64_t seed, const StopRequest& stop) {
  const Start& start = scene.particles.start;
  if (start.layout == Layout::File) return std::get<State<D>>(start.state);
  const Room<D> room = scene.start_room<D>();
  const int count = scene.particles.count;
  State<D> state;
  state.positions = start.layout == Layout::Random ? random_positions(room, count, seed, stop)
                                                   : lattice_positions(room, count, seed);
  return_unused_memory();  // of random insertion
  number_by_rows<D>(state.positions);
  const Vec<D> corner = scene.clear_corner();
  for (Vec<D>& position : state.positions) position += corner;
  state.velocities = gaussian_velocities<D>(state.positions.size(), start.temperature, seed, stop);
  if (scene.spins()) {
    state.spins = gaussian_spins<D>(state.positions.size(), start.spin_temperature,
                                    scene.particles.inertia, seed, stop);
  }
  return state;
}

template State<2> start_state(const Scene&, std::uint64_t, const StopRequest&);
template State<3> start_state(const Scene&, std::uint64_t, const StopRequest&);

}  // namespace clatter
