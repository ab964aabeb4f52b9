#include "engine/initial/adapt_to_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "engine/initial/free_room.h"
#include "engine/initial/mixture_state.h"
#include "engine/initial/random_insertion.h"
#include "engine/initial/start_state.h"
#include "engine/physics/state.h"

namespace clatter {

namespace {

constexpr std::size_t kNew = ~std::size_t{0};

// A particle of a mixture, and the number of the particle of the old state that becomes it, or
// kNew.
struct Heir {
  Grain grain;
  std::size_t from = kNew;
};

// The particles of a scene. Those of a species continue particles in the order of their sizes;
// their own order is that of the old state.
template <int D>
std::vector<Heir> heirs_of(const State<D>& state, const Scene& scene) {
  std::vector<Heir> heirs;
  for (const Grain& grain : grains_of(scene)) heirs.push_back({grain});
  std::size_t begin = 0;
  for (std::uint32_t s = 0; s < scene.species.size(); ++s) {
    const auto count = static_cast<std::size_t>(scene.species[s].count);
    std::vector<std::size_t> present;
    for (std::size_t i = 0; i < state.grains.size() && present.size() < count; ++i) {
      if (state.grains[i].species == s) present.push_back(i);
    }
    std::ranges::stable_sort(present, {}, [&](std::size_t i) { return state.grains[i].radius; });
    // Further particles are of all sizes.
    for (std::size_t k = 0; k < present.size(); ++k) {
      heirs[begin + k * count / present.size()].from = present[k];
    }
    const auto first = heirs.begin() + static_cast<std::ptrdiff_t>(begin);
    std::stable_sort(first, first + scene.species[s].count,
                     [](const Heir& one, const Heir& other) { return one.from < other.from; });
    begin += count;
  }
  return heirs;
}

template <int D>
bool is_in_box(const Vec<D>& place, const Vec<D>& box) {
  return (place.array() >= 0.0).all() && (place.array() < box.array()).all();
}

// The state of a mixture, see adapt_to_scene(). Without particles if one finds no room.
template <int D>
State<D> adapted_mixture(const State<D>& state, const Scene& scene, std::uint64_t seed) {
  constexpr int kTries = 10'000;  // of a particle
  const Model<D> model = model_of<D>(scene, seed);
  std::vector<Heir> heirs = heirs_of(state, scene);
  const Vec<D> low = scene.clear_corner(), high = low + Vec<D>(scene.clear_box());
  FreeRoom<D> room(model.domain(), model.diameter, low, high, model.fixtures);
  std::vector<std::size_t> large_first(heirs.size());
  std::iota(large_first.begin(), large_first.end(), std::size_t{0});
  std::ranges::stable_sort(large_first, std::greater<>(),
                           [&](std::size_t k) { return heirs[k].grain.radius; });
  State<D> fitted;
  fitted.positions.resize(heirs.size());
  for (const std::size_t k : large_first) {
    auto& [grain, from] = heirs[k];
    if (from == kNew) continue;
    fitted.positions[k] = state.positions[from];
    const bool stays = is_in_box<D>(fitted.positions[k], model.box) &&
                       room.insert_if_free(fitted.positions[k], grain.radius, grain.species);
    if (!stays) from = kNew;
  }
  Random random(seed, Stream::Placement, 1, 0);
  for (const std::size_t k : large_first) {
    bool placed = heirs[k].from != kNew;
    for (int tries = 0; tries < kTries && !placed; ++tries) {
      for (int axis = 0; axis < D; ++axis) {
        fitted.positions[k][axis] = std::lerp(low[axis], high[axis], random.uniform());
      }
      placed =
          room.insert_if_free(fitted.positions[k], heirs[k].grain.radius, heirs[k].grain.species);
    }
    if (!placed) return {};
  }
  const double temperature = temperature_of(state);
  for (std::size_t k = 0; k < heirs.size(); ++k) {
    const auto& [grain, from] = heirs[k];
    fitted.grains.push_back(grain);
    if (from != kNew) {
      fitted.velocities.push_back(state.velocities[from]);
    } else {
      Random random_velocity(seed, Stream::Velocity, static_cast<std::uint32_t>(k), 1);
      const double speed = std::sqrt(temperature / grain.mass);
      Vec<D>& velocity = fitted.velocities.emplace_back();
      for (double& component : velocity) component = speed * random_velocity.normal();
    }
    if (!scene.spins()) continue;
    const bool spun = from != kNew && !state.spins.empty();
    fitted.spins.push_back(spun ? state.spins[from] : Spin<D>::Zero());
  }
  return fitted;
}

}  // namespace

template <int D>
State<D> adapt_to_scene(const State<D>& state, const Scene& scene, std::uint64_t seed) {
  if (starts_divided(scene)) return start_state<D>(scene, seed);
  if (!scene.species.empty() && !state.grains.empty()) {
    State<D> fitted = adapted_mixture(state, scene, seed);
    return fitted.positions.empty() ? start_state<D>(scene, seed) : fitted;
  }
  if (!scene.species.empty() || !state.grains.empty()) return start_state<D>(scene, seed);
  const Vec<D> corner = scene.clear_corner();
  const auto count = static_cast<std::size_t>(scene.particles.count);
  Random random(seed, Stream::Placement, 1, 0);
  const Room<D> room = scene.start_room<D>();
  RandomInsertion<D> insertion(room, scene.particles.count, random,
                               start_fixtures<D>(scene, corner));
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < state.positions.size() && kept.size() < count; ++i) {
    if (insertion.place_first(state.positions[i] - corner)) kept.push_back(i);
  }
  insertion.advance();
  State<D> fitted;
  fitted.positions = insertion.take();
  if (fitted.positions.empty()) return start_state<D>(scene, seed);

  const double speed = std::sqrt(temperature_of(state));
  for (std::size_t i = 0; i < fitted.positions.size(); ++i) {
    fitted.positions[i] += corner;
    if (i < kept.size()) {
      fitted.velocities.push_back(state.velocities[kept[i]]);
    } else {
      Random random_velocity(seed, Stream::Velocity, static_cast<std::uint32_t>(i), 1);
      Vec<D>& velocity = fitted.velocities.emplace_back();
      for (double& component : velocity) component = speed * random_velocity.normal();
    }
    if (!scene.spins()) continue;
    const bool spun = i < kept.size() && !state.spins.empty();
    fitted.spins.push_back(spun ? state.spins[kept[i]] : Spin<D>::Zero());
  }
  return fitted;
}

template State<2> adapt_to_scene(const State<2>&, const Scene&, std::uint64_t);
template State<3> adapt_to_scene(const State<3>&, const Scene&, std::uint64_t);

}  // namespace clatter
