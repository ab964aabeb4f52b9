#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace clatter {

/// How well the species of a mixture are mixed, from their numbers in cells (theory 12.18-12.20).
struct Mixing {
  double lacey;           ///< Lacey's index, by number: 0 in separate cells, 1 at random
  double entropy;         ///< entropy of mixing: 0 in separate cells, 1 with equal shares in all
  double random_entropy;  ///< its expectation where species are at random in the same cells
};

/// The mixing of the particles in cells. `numbers` [cells][species] has those of each species. NaN
/// where all particles are of one species, or each is alone in its cell.
Mixing mixing_of(std::span<const std::uint32_t> numbers, std::size_t species);

}  // namespace clatter
