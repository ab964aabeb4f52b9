#include "engine/initial/mixture_state.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/initial/gaussian_velocities.h"
#include "engine/initial/overlap_removal.h"
#include "engine/physics/random.h"

namespace clatter {

std::vector<Grain> grains_of(const Scene& scene) {
  std::vector<Grain> grains;
  for (std::size_t k = 0; k < scene.species.size(); ++k) {
    const int count = scene.species[k].count;
    for (int i = 0; i < count; ++i) grains.push_back(scene.grain(k, i, count));
  }
  return grains;
}

// A height of rows in which particles are about as far from each other as rows are. The C library's
// roots may differ between processors, those of the square do not.
template <int D>
static double row_height(const std::vector<Vec<D>>& places) {
  double rows = 1.0, highest = 0.0;
  const auto count = static_cast<double>(places.size());
  while ((D == 2 ? rows * rows : rows * rows * rows) < count) rows += 1.0;
  for (const Vec<D>& place : places) highest = std::max(highest, place[D - 1]);
  return std::max(highest, 1e-3) / rows;
}

// The order of particles by species, then from bottom to top by rows of a height, then along rows.
template <int D>
static std::vector<std::uint32_t> order_of(const std::vector<Vec<D>>& places,
                                           const std::vector<Grain>& grains, double height) {
  std::vector<std::uint32_t> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
    if (grains[a].species != grains[b].species) return grains[a].species < grains[b].species;
    for (int k = D - 1; k > 0; --k) {
      const double row_a = std::floor(places[a][k] / height);
      const double row_b = std::floor(places[b][k] / height);
      if (row_a != row_b) return row_a < row_b;
    }
    return places[a][0] < places[b][0];
  });
  return order;
}

template <int D>
State<D> state_at_places(const std::vector<Vec<D>>& places, const std::vector<Grain>& grains,
                         double temperature, std::uint64_t seed, const StopRequest& stop) {
  State<D> state;
  std::vector<double> masses;
  for (const std::uint32_t i : order_of<D>(places, grains, row_height<D>(places))) {
    state.positions.push_back(places[i]);
    state.grains.push_back(grains[i]);
    masses.push_back(grains[i].mass);
  }
  state.velocities = gaussian_velocities<D>(masses, temperature, seed, stop);
  return state;
}

template <int D>
State<D> mixture_state(const Model<D>& model, const std::vector<Grain>& grains, double temperature,
                       std::uint64_t seed, const StopRequest& stop) {
  Random random(seed, Stream::Placement, 0, 0);
  OverlapRemoval<D> removal(model.domain(), grains, random,
                            FixtureImages<D>(model.fixtures, model.domain()));
  if (!removal.advance(stop)) throw Interrupted();
  const std::vector<Vec<D>> places = removal.take();
  if (places.empty()) return {};
  return state_at_places<D>(places, grains, temperature, seed, stop);
}

template State<2> state_at_places(const std::vector<Vec<2>>&, const std::vector<Grain>&, double,
                                  std::uint64_t, const StopRequest&);
template State<3> state_at_places(const std::vector<Vec<3>>&, const std::vector<Grain>&, double,
                                  std::uint64_t, const StopRequest&);
template State<2> mixture_state(const Model<2>&, const std::vector<Grain>&, double, std::uint64_t,
                                const StopRequest&);
template State<3> mixture_state(const Model<3>&, const std::vector<Grain>&, double, std::uint64_t,
                                const StopRequest&);

}  // namespace clatter
