#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <thread>

#include "engine/live/triple_buffer.h"

using namespace clatter;

TEST_CASE(
    "TripleBuffer: the reader has the newest value, and keeps it until there is a newer one") {
  TripleBuffer<int> latest;
  CHECK_FALSE(latest.update());
  for (int value : {1, 2, 3}) {
    latest.back() = value;
    latest.publish();
  }
  CHECK(latest.update());
  CHECK(latest.front() == 3);
  CHECK_FALSE(latest.update());
  CHECK(latest.front() == 3);
  latest.back() = 4;
  CHECK_FALSE(latest.update());
  CHECK(latest.front() == 3);
  latest.publish();
  CHECK(latest.update());
  CHECK(latest.front() == 4);
}

TEST_CASE("TripleBuffer: across threads values come whole, in order, and the last one arrives") {
  constexpr std::uint64_t kLast = 200'000;
  TripleBuffer<std::array<std::uint64_t, 8>> latest;
  std::thread writer([&] {
    for (std::uint64_t value = 1; value <= kLast; ++value) {
      latest.back().fill(value);
      latest.publish();
    }
  });
  std::uint64_t seen = 0;
  bool whole = true, in_order = true;
  while (seen < kLast) {
    if (!latest.update()) continue;
    const auto& values = latest.front();
    for (const std::uint64_t value : values) whole = whole && value == values[0];
    in_order = in_order && values[0] > seen;
    seen = values[0];
  }
  writer.join();
  CHECK(whole);
  CHECK(in_order);
}
