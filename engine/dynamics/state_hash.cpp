#include "engine/dynamics/state_hash.h"

#include <bit>

namespace clatter {

static std::uint64_t mix(std::uint64_t hash, double number) {
  const double positive_zero = number == 0.0 ? 0.0 : number;
  std::uint64_t z = hash + 0x9e3779b97f4a7c15ull + std::bit_cast<std::uint64_t>(positive_zero);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

template <int D>
std::uint64_t state_hash(const State<D>& state) {
  std::uint64_t hash = state.positions.size();
  for (const auto* vectors : {&state.positions, &state.velocities}) {
    for (const Vec<D>& vector : *vectors) {
      for (int k = 0; k < D; ++k) hash = mix(hash, vector[k]);
    }
  }
  for (const Spin<D>& spin : state.spins) {
    for (const double component : spin) hash = mix(hash, component);
  }
  if (state.piston) hash = mix(mix(hash, state.piston->place), state.piston->velocity);
  return hash;
}

template std::uint64_t state_hash<2>(const State<2>&);
template std::uint64_t state_hash<3>(const State<3>&);

}  // namespace clatter
