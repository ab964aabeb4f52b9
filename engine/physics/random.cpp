#include "engine/physics/random.h"

#include <cmath>

#include "engine/physics/elementary.h"

namespace clatter {

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = 0xD2511F53ull * counter[0];
    const std::uint64_t p1 = 0xCD9E8D57ull * counter[2];
    const auto high = [](std::uint64_t p) { return static_cast<std::uint32_t>(p >> 32); };
    const auto low = [](std::uint64_t p) { return static_cast<std::uint32_t>(p); };
    counter = {high(p1) ^ counter[1] ^ key[0], low(p1), high(p0) ^ counter[3] ^ key[1], low(p0)};
    key[0] += 0x9E3779B9u;
    key[1] += 0xBB67AE85u;
  }
  return counter;
}

// The low word of the counter numbers the blocks of four words. A stream takes the low 8 bits of the
// high word.
Random::Random(std::uint64_t seed, Stream stream, std::uint32_t owner, std::uint64_t item)
    : counter_{0, static_cast<std::uint32_t>(item), owner,
               static_cast<std::uint32_t>(stream) | static_cast<std::uint32_t>(item >> 32) << 8},
      key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)} {}

std::uint64_t Random::bits() {
  if (left_ == 0) {
    block_ = philox(counter_, key_);
    ++counter_[0];
    left_ = 4;
  }
  left_ -= 2;
  return static_cast<std::uint64_t>(block_[left_ + 1]) << 32 | block_[left_];
}

double Random::uniform() {
  return (static_cast<double>(bits() >> 12) + 0.5) * 0x1p-52;
}

double Random::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2.0 * natural_log(uniform()));
  const SineCosine direction = sin_cos_2pi(uniform());
  spare_ = radius * direction.sine;
  has_spare_ = true;
  return radius * direction.cosine;
}

std::uint64_t Random::below(std::uint64_t n) {
  // Rejection of the incomplete span makes every value equally probable.
  const std::uint64_t reject = (0 - n) % n;
  for (;;) {
    const std::uint64_t word = bits();
    if (word >= reject) return word % n;
  }
}

}  // namespace clatter
