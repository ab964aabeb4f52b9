#include "tests/engine/support/gas.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/physics/random.h"

namespace clatter::testing {

// Plots of at least one diameter, in rows along the axes. The shape nearest to cubes that holds
// `count` plots.
template <int D>
static IntVec<D> divide(const Model<D>& model, int count) {
  IntVec<D> best = IntVec<D>::Zero(), plots = IntVec<D>::Ones();
  double widest = 0.0;
  const auto fits = [&](int axis) { return plots[axis] * model.diameter <= model.box[axis]; };
  while (fits(D - 1)) {
    const int across = plots.prod() / plots[0];
    plots[0] = (count + across - 1) / across;
    const double narrowest = model.box.cwiseQuotient(plots.template cast<double>()).minCoeff();
    if (narrowest > widest) {
      widest = narrowest;
      best = plots;
    }
    for (int axis = 1; ++plots[axis], !fits(axis) && axis < D - 1; ++axis) plots[axis] = 1;
  }
  REQUIRE_MESSAGE(widest >= model.diameter, "no room for that many particles");
  return best;
}

template <int D>
static bool is_walled(const Model<D>& model) {
  return std::ranges::any_of(model.walls, [](const auto& wall) { return wall.has_value(); });
}

template <int D>
State<D> random_gas(const Model<D>& model, int count, std::uint64_t seed) {
  State<D> state;
  if (count == 0) return state;
  const IntVec<D> plots = divide(model, count);
  Vec<D> mean = Vec<D>::Zero();
  for (int i = 0; i < count; ++i) {
    Random random(seed, Stream::Placement, static_cast<std::uint32_t>(i), 0);
    Vec<D> r, v;
    int left = i;
    for (int axis = 0; axis < D; ++axis) {
      const int at = left % plots[axis];
      left /= plots[axis];
      const double edge = model.box[axis] / plots[axis];
      const double middle = (at + 0.5) * edge;
      r[axis] = middle + (random.uniform() - 0.5) * (edge - model.diameter);
      v[axis] = random.normal();
    }
    state.positions.push_back(r);
    state.velocities.push_back(v);
    mean += v / count;
  }
  if (!is_walled(model) && count > 1) {
    for (Vec<D>& v : state.velocities) v -= mean;
  }
  return state;
}

template <int D>
State<D> clear_gas(const Model<D>& model, int count, std::uint64_t seed) {
  Model<D> inner = model;
  Vec<D> low = Vec<D>::Zero();
  for (int side = 0; side < 2 * D; ++side) {
    if (!model.walls[side]) continue;
    const double travel = model.walls[side]->innermost_travel();
    inner.box[side / 2] -= travel;
    if (side % 2 == 0) low[side / 2] = travel;
  }
  State<D> state = random_gas<D>(inner, count, seed);
  for (Vec<D>& r : state.positions) r += low;
  for (int i = 0; model.spins && i < count; ++i) {
    Spin<D>& spin = state.spins.emplace_back();
    for (int k = 0; k < spin.size(); ++k) spin[k] = 0.3 * i - 1.0 + 0.7 * k;
  }
  return state;
}

template <int D>
State<D> mixed(const Model<D>& model, State<D> state, double ratio) {
  const double radius = 0.5 * model.diameter;
  const Grain grains[] = {
      {.radius = radius, .mass = 2.0, .inertia = model.inertia, .species = 0},
      {.radius = radius / ratio, .mass = 1.0 / ratio, .inertia = 0.8 * model.inertia, .species = 1},
      {.radius = radius / std::sqrt(ratio), .mass = 3.0, .inertia = model.inertia, .species = 2}};
  Vec<D> momentum = Vec<D>::Zero();
  double mass = 0.0;
  for (std::size_t i = 0; i < state.velocities.size(); ++i) {
    state.grains.push_back(grains[i % 3]);
    momentum += grains[i % 3].mass * state.velocities[i];
    mass += grains[i % 3].mass;
  }
  if (is_walled(model)) return state;
  for (Vec<D>& v : state.velocities) v -= momentum / mass;
  return state;
}

template <int D>
State<D> mixed_gas(const Model<D>& model, int count, std::uint64_t seed, double ratio) {
  return mixed(model, clear_gas(model, count, seed), ratio);
}

template <int D>
double brute_force_overlap(const Model<D>& model, const State<D>& state) {
  double deepest = 0.0;
  IntVec<D> reach;
  for (int axis = 0; axis < D; ++axis) reach[axis] = model.periodic(axis) ? 2 : 0;
  const std::size_t count = state.positions.size();
  const auto radius = [&](std::size_t i) {
    return state.grains.empty() ? 0.5 * model.diameter : state.grains[i].radius;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Vec<D>& r = state.positions[i];
    for (std::size_t j = i + 1; j < count; ++j) {
      const Vec<D> x = r - state.positions[j];
      IntVec<D> image = -reach;
      while (image[D - 1] <= reach[D - 1]) {
        const double squared =
            (x + image.template cast<double>().cwiseProduct(model.box)).squaredNorm();
        const double distance = radius(i) + radius(j);
        if (squared < distance * distance) {
          deepest = std::max(deepest, (distance - std::sqrt(squared)) / model.diameter);
        }
        for (int axis = 0; ++image[axis] > reach[axis] && axis < D - 1; ++axis) {
          image[axis] = -reach[axis];
        }
      }
    }
    for (int axis = 0; axis < D; ++axis) {
      if (model.periodic(axis)) continue;
      const double beyond = std::max(radius(i) - r[axis], r[axis] - (model.box[axis] - radius(i)));
      deepest = std::max(deepest, beyond / model.diameter);
    }
  }
  return deepest;
}

template <int D>
Vec<D> momentum(const State<D>& state) {
  Vec<D> sum = Vec<D>::Zero();
  for (const Vec<D>& v : state.velocities) sum += v;
  return sum;
}

template <int D>
bool finite_and_inside(const Model<D>& model, const State<D>& state) {
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const Vec<D>& r = state.positions[i];
    if (!r.allFinite() || !state.velocities[i].allFinite()) return false;
    if ((r.array() < 0.0).any() || (r.array() > model.box.array()).any()) return false;
  }
  return true;
}

template <int D>
std::string stop_of(Simulation<D>& simulation, double time) {
  try {
    simulation.run_until(time);
  } catch (const PhysicalStop& stop) {
    return stop.what();
  }
  return "";
}

template <int D>
void check_sound(const Simulation<D>& simulation) {
  CHECK(simulation.checks().clock_steps_back < 1e-13);
  CHECK(simulation.checks().deepest_overlap < 1e-12);
}

template State<2> random_gas(const Model<2>&, int, std::uint64_t);
template State<2> clear_gas(const Model<2>&, int, std::uint64_t);
template State<2> mixed(const Model<2>&, State<2>, double);
template State<2> mixed_gas(const Model<2>&, int, std::uint64_t, double);
template double brute_force_overlap(const Model<2>&, const State<2>&);
template Vec<2> momentum(const State<2>&);
template bool finite_and_inside(const Model<2>&, const State<2>&);
template std::string stop_of(Simulation<2>&, double);
template void check_sound(const Simulation<2>&);
template State<3> random_gas(const Model<3>&, int, std::uint64_t);
template State<3> clear_gas(const Model<3>&, int, std::uint64_t);
template State<3> mixed(const Model<3>&, State<3>, double);
template State<3> mixed_gas(const Model<3>&, int, std::uint64_t, double);
template double brute_force_overlap(const Model<3>&, const State<3>&);
template Vec<3> momentum(const State<3>&);
template bool finite_and_inside(const Model<3>&, const State<3>&);
template std::string stop_of(Simulation<3>&, double);
template void check_sound(const Simulation<3>&);

}  // namespace clatter::testing
