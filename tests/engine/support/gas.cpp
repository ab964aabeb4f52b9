#include "tests/engine/support/gas.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/physics/random.h"

namespace clatter::testing {

// Plots of at least one diameter, in rows along the axes: the most nearly square that hold `count`.
template <int D>
static IntVec<D> divide(const Model<D>& model, int count) {
  IntVec<D> best = IntVec<D>::Zero();
  double widest = 0.0;
  const double depth = D == 3 ? model.box[D - 1] : model.diameter;
  for (int nz = 1; nz * model.diameter <= depth; ++nz) {
    for (int ny = 1; ny * model.diameter <= model.box.y(); ++ny) {
      const int rows = ny * nz;
      const IntVec<3> plots((count + rows - 1) / rows, ny, nz);
      const double narrowest =
          model.box.cwiseQuotient(plots.head<D>().template cast<double>()).minCoeff();
      if (narrowest > widest) {
        widest = narrowest;
        best = plots.head<D>();
      }
    }
  }
  REQUIRE_MESSAGE(widest >= model.diameter, "no room for that many particles");
  return best;
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
    int rest = i;
    for (int axis = 0; axis < D; ++axis) {
      const double edge = model.box[axis] / plots[axis];
      const double middle = (rest % plots[axis] + 0.5) * edge;
      rest /= plots[axis];
      r[axis] = middle + (random.uniform() - 0.5) * (edge - model.diameter);
      v[axis] = random.normal();
    }
    state.positions.push_back(r);
    state.velocities.push_back(v);
    mean += v / count;
  }
  const bool walled = std::ranges::any_of(model.walls, [](const auto& wall) { return !!wall; });
  if (!walled && count > 1) {
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
  State<D> state = random_gas(inner, count, seed);
  for (Vec<D>& r : state.positions) r += low;
  for (int i = 0; model.spins && i < count; ++i) {
    Spin<D>& spin = state.spins.emplace_back();
    for (int k = 0; k < spin.size(); ++k) spin[k] = 0.3 * i - 1.0 + 0.7 * k;
  }
  return state;
}

template State<2> random_gas(const Model<2>&, int, std::uint64_t);
template State<3> random_gas(const Model<3>&, int, std::uint64_t);
template State<2> clear_gas(const Model<2>&, int, std::uint64_t);
template State<3> clear_gas(const Model<3>&, int, std::uint64_t);

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
