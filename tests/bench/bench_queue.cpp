// Time of one push and one pop in the steady state of a gas: the first event is removed, and the
// next event of its particle is added after an exponential delay. A priority_queue does the same
// for comparison.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <queue>
#include <vector>

#include "engine/dynamics/event_queue.h"
#include "engine/physics/random.h"
#include "tests/bench/table.h"

using namespace clatter;

static constexpr int kEvents = 1000000;

static std::vector<double> delays() {
  Random random(1, Stream::Velocity, 0, 0);
  std::vector<double> delays(1 << 16);
  for (double& delay : delays) delay = -std::log(random.uniform());
  return delays;
}

static std::vector<Event> start(std::uint32_t pending, const std::vector<double>& delays) {
  std::vector<Event> events;
  for (std::uint32_t i = 0; i < pending; ++i) {
    events.push_back({delays[i % delays.size()] + 1e-9 * i, i, kCellBorder});
  }
  return events;
}

static double time_ladder(std::uint32_t pending, const std::vector<double>& delays) {
  return bench::seconds([&] {
    std::vector<Event> events = start(pending, delays);
    EventQueue queue;
    queue.rebuild(events);
    const auto live = [](const Event&) { return true; };
    for (int i = 0; i < kEvents; ++i) {
      Event event = *queue.top(live);
      queue.pop();
      event.time += delays[static_cast<std::size_t>(i) % delays.size()];
      queue.push(event);
    }
  });
}

static double time_heap(std::uint32_t pending, const std::vector<double>& delays) {
  const auto after = [](const Event& a, const Event& b) { return before(b, a); };
  return bench::seconds([&] {
    std::priority_queue<Event, std::vector<Event>, decltype(after)> queue(after,
                                                                          start(pending, delays));
    for (int i = 0; i < kEvents; ++i) {
      Event event = queue.top();
      queue.pop();
      event.time += delays[static_cast<std::size_t>(i) % delays.size()];
      queue.push(event);
    }
  });
}

int main() {
  const std::vector<double> delays = ::delays();
  std::printf("%10s %18s %18s\n", "pending", "ladder ns/event", "heap ns/event");
  for (const std::uint32_t pending : {1000u, 10000u, 100000u, 1000000u}) {
    std::printf("%10u %18.1f %18.1f\n", pending, 1e9 / kEvents * time_ladder(pending, delays),
                1e9 / kEvents * time_heap(pending, delays));
  }
}
