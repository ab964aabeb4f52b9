#pragma once

#include <cstdint>
#include <string_view>

#include "engine/system/checksum.h"

namespace clatter {

/// Whether an input takes the expensive path of its fuzzer: one input in `count`. The choice is a
/// function of the input, so that a finding can be repeated.
inline bool is_one_in(std::uint32_t count, std::string_view input) {
  return checksum(input) % count == 0;
}

}  // namespace clatter
