#include "tests/engine/support/gas.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/physics/random.h"

namespace clatter::testing {

// Plots of at least one diameter, in rows along x and y: the most nearly square that hold `count`.
static IntVec<2> divide(const Model<2>& model, int count) {
  IntVec<2> best = {0, 0};
  double widest = 0.0;
  for (int ny = 1; ny * model.diameter <= model.box.y(); ++ny) {
    const int nx = (count + ny - 1) / ny;
    const double narrowest = std::min(model.box.x() / nx, model.box.y() / ny);
    if (narrowest > widest) {
      widest = narrowest;
      best = {nx, ny};
    }
  }
  REQUIRE_MESSAGE(widest >= model.diameter, "no room for that many particles");
  return best;
}

State<2> random_gas(const Model<2>& model, int count, std::uint64_t seed) {
  State<2> state;
  if (count == 0) return state;
  const IntVec<2> plots = divide(model, count);
  Vec2 mean = Vec2::Zero();
  for (int i = 0; i < count; ++i) {
    Random random(seed, Stream::Placement, static_cast<std::uint32_t>(i), 0);
    const int at[2] = {i % plots[0], i / plots[0]};
    Vec2 r, v;
    for (int axis = 0; axis < 2; ++axis) {
      const double edge = model.box[axis] / plots[axis];
      const double middle = (at[axis] + 0.5) * edge;
      r[axis] = middle + (random.uniform() - 0.5) * (edge - model.diameter);
      v[axis] = random.normal();
    }
    state.positions.push_back(r);
    state.velocities.push_back(v);
    mean += v / count;
  }
  if (model.periodic(0) && model.periodic(1) && count > 1) {
    for (Vec2& v : state.velocities) v -= mean;
  }
  return state;
}

State<2> clear_gas(const Model<2>& model, int count, std::uint64_t seed) {
  Model<2> inner = model;
  Vec2 low = Vec2::Zero();
  for (int side = 0; side < 4; ++side) {
    if (!model.walls[side]) continue;
    const double travel = model.walls[side]->innermost_travel();
    inner.box[side / 2] -= travel;
    if (side % 2 == 0) low[side / 2] = travel;
  }
  State<2> state = random_gas(inner, count, seed);
  for (Vec2& r : state.positions) r += low;
  for (int i = 0; model.spins && i < count; ++i) state.spins.push_back(Spin<2>(0.3 * i - 1.0));
  return state;
}

double brute_force_overlap(const Model<2>& model, const State<2>& state) {
  double deepest = 0.0;
  const auto reach = [&](int axis) { return model.periodic(axis) ? 2 : 0; };
  const std::size_t count = state.positions.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2& r = state.positions[i];
    for (std::size_t j = i + 1; j < count; ++j) {
      const Vec2 x = r - state.positions[j];
      for (int kx = -reach(0); kx <= reach(0); ++kx) {
        for (int ky = -reach(1); ky <= reach(1); ++ky) {
          const Vec2 image = x + Vec2(kx * model.box.x(), ky * model.box.y());
          const double squared = image.squaredNorm();
          if (squared >= model.diameter * model.diameter) continue;
          deepest = std::max(deepest, 1.0 - std::sqrt(squared) / model.diameter);
        }
      }
    }
    for (int axis = 0; axis < 2; ++axis) {
      if (model.periodic(axis)) continue;
      const double beyond =
          std::max(model.wall_plane(axis, 0) - r[axis], r[axis] - model.wall_plane(axis, 1));
      deepest = std::max(deepest, beyond / model.diameter);
    }
  }
  return deepest;
}

Vec2 momentum(const State<2>& state) {
  Vec2 sum = Vec2::Zero();
  for (const Vec2& v : state.velocities) sum += v;
  return sum;
}

bool finite_and_inside(const Model<2>& model, const State<2>& state) {
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const Vec2& r = state.positions[i];
    if (!r.allFinite() || !state.velocities[i].allFinite()) return false;
    if ((r.array() < 0.0).any() || (r.array() > model.box.array()).any()) return false;
  }
  return true;
}

std::string stop_of(Simulation<2>& simulation, double time) {
  try {
    simulation.run_until(time);
  } catch (const PhysicalStop& stop) {
    return stop.what();
  }
  return "";
}

void check_sound(const Simulation<2>& simulation) {
  CHECK(simulation.checks().clock_steps_back < 1e-13);
  CHECK(simulation.checks().deepest_overlap < 1e-12);
}

}  // namespace clatter::testing
