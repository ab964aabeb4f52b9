#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <stdexcept>

#include "render/output/work_queue.h"

namespace clatter {

TEST_CASE("WorkQueue: every job is done, by one thread in order") {
  std::vector<int> order;
  WorkQueue queue(1, 3);
  for (int i = 0; i < 100; ++i) queue.add([&order, i] { order.push_back(i); });
  queue.finish();
  REQUIRE(order.size() == 100);
  CHECK(std::is_sorted(order.begin(), order.end()));
}

TEST_CASE("WorkQueue: add waits while the queue is full") {
  std::promise<void> gate;
  auto opened = gate.get_future().share();
  WorkQueue queue(1, 2);
  std::atomic<int> added = 0;
  std::thread adder([&] {
    for (int i = 0; i < 10; ++i) {
      queue.add([opened] { opened.wait(); });
      ++added;
    }
  });
  // One job runs and two wait. The fourth has to wait for a place.
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  CHECK(added <= 3);
  gate.set_value();
  adder.join();
  queue.finish();
  CHECK(added == 10);
}

TEST_CASE("WorkQueue: drain waits for the jobs that have begun, too") {
  WorkQueue queue(2, 4);
  std::atomic<int> done = 0;
  for (int round = 1; round <= 20; ++round) {
    for (int i = 0; i < 5; ++i) {
      queue.add([&] {
        std::this_thread::sleep_for(std::chrono::microseconds(300));
        ++done;
      });
    }
    queue.drain();
    CHECK(done == 5 * round);
  }
}

TEST_CASE("WorkQueue: the exception of a job reaches add and finish") {
  WorkQueue queue(2, 2);
  auto add_many = [&] {
    for (int i = 0; i < 1000; ++i) queue.add([] { throw std::runtime_error("broken"); });
  };
  CHECK_THROWS_WITH_AS(add_many(), "broken", std::runtime_error);
  CHECK_THROWS_WITH_AS(queue.finish(), "broken", std::runtime_error);
}

TEST_CASE("WorkQueue: a queue that is dropped ends the job under way and drops those that wait") {
  std::atomic<int> done = 0;
  std::promise<void> started;
  {
    WorkQueue queue(1, 1000);
    queue.add([&] {
      started.set_value();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      ++done;
    });
    // They would take seconds. The queue is dropped before their end.
    for (int i = 0; i < 500; ++i) {
      queue.add([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        ++done;
      });
    }
    started.get_future().wait();
  }
  CHECK(done >= 1);
  CHECK(done < 501);
}

}  // namespace clatter
