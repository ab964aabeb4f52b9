#include <doctest/doctest.h>

#include <thread>

#include "engine/live/command_queue.h"

using namespace clatter;

TEST_CASE("CommandQueue: everything arrives once and in order, from a thread that waits") {
  constexpr int kCount = 20'000;
  CommandQueue<int> queue;
  std::vector<int> got;
  std::thread reader([&] {
    while (!queue.closed() || queue.pending()) {
      queue.wait();
      const std::vector<int> some = queue.take();
      got.insert(got.end(), some.begin(), some.end());
      if (got.size() == kCount) return;
    }
  });
  for (int i = 0; i < kCount; ++i) queue.push(i);
  reader.join();
  REQUIRE(got.size() == kCount);
  for (int i = 0; i < kCount; ++i) REQUIRE(got[static_cast<std::size_t>(i)] == i);
}

TEST_CASE("CommandQueue: closing it wakes the waiting thread") {
  CommandQueue<int> queue;
  std::thread reader([&] { queue.wait(); });
  queue.close();
  reader.join();
  CHECK(queue.closed());
  CHECK(queue.pending());
  queue.wait();
  queue.wait_until(CommandQueue<int>::Clock::time_point::max());
}
