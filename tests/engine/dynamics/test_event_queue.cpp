#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <queue>
#include <string>
#include <vector>

#include "engine/dynamics/event_queue.h"
#include "engine/physics/random.h"

using namespace clatter;

namespace {

struct After {
  bool operator()(const Event& a, const Event& b) const { return before(b, a); }
};

// The queue and the standard queue. Each event has its own particle, so that the order is total.
// `live` of the caller excludes dead events.
class TwoQueues {
 public:
  void add(double time, Random& random) {
    const auto particle = static_cast<std::uint32_t>(dead_.size());
    const std::uint32_t partners[] = {particle / 2, kWall + 1, kCellBorder};
    const Event event{time, particle, partners[random.below(3)]};
    dead_.push_back(false);
    reference_.push(event);
    queue_.push(event);
  }
  void kill(Random& random) { dead_[random.below(dead_.size())] = true; }
  void rebuild() {
    std::vector<Event> events;
    for (auto rest = reference_; !rest.empty(); rest.pop()) events.push_back(rest.top());
    queue_.rebuild(events);
  }
  // Removes the first event from both queues. Returns its time; negative if both are empty.
  double take() {
    while (!reference_.empty() && dead_[reference_.top().particle]) reference_.pop();
    const Event* top = queue_.top([&](const Event& event) { return !dead_[event.particle]; });
    if (!top || reference_.empty()) {
      wrong_ += (top == nullptr) != reference_.empty();
      return -1.0;
    }
    const Event expected = reference_.top();
    wrong_ += top->time != expected.time || top->particle != expected.particle ||
              top->partner != expected.partner;
    reference_.pop();
    queue_.pop();
    return expected.time;
  }
  std::size_t size() const { return reference_.size(); }
  int wrong() const { return wrong_; }

 private:
  EventQueue queue_;
  std::priority_queue<Event, std::vector<Event>, After> reference_;
  std::vector<bool> dead_;
  int wrong_ = 0;
};

using NextTime = std::function<double(double now, Random& random)>;

// Operations on about `pending` events: remove the first, add one or many, kill one in five.
void compare(std::size_t pending, const NextTime& next, std::uint32_t seed) {
  TwoQueues queues;
  Random random(71, Stream::Placement, seed, 0);
  queues.rebuild();
  double now = 0.0;
  for (std::size_t i = 0; i < pending; ++i) queues.add(next(0.0, random), random);
  if (random.below(2)) queues.rebuild();
  for (int operations = 0; operations < 100000; ++operations) {
    const double taken = queues.take();
    if (taken >= 0.0) now = taken;
    if (queues.size() < pending) {
      const std::uint64_t burst = random.below(100) == 0 ? 50 : 1 + random.below(3);
      for (std::uint64_t k = 0; k < burst; ++k, ++operations) queues.add(next(now, random), random);
    }
    if (random.below(5) == 0) queues.kill(random);
    if (random.below(20000) == 0) queues.rebuild();
  }
  while (queues.take() >= 0.0) continue;
  CHECK(queues.wrong() == 0);
  CHECK(queues.size() == 0);
}

}  // namespace

TEST_CASE("EventQueue: events come in the order of the standard queue, over 10^6 operations") {
  const auto exponential = [](Random& random) { return -std::log(random.uniform()); };
  const std::vector<std::pair<std::string, NextTime>> kinds = {
      {"like collisions", [&](double now, Random& r) { return now + exponential(r); }},
      {"few distinct times",
       [](double now, Random& r) { return std::floor(now) + static_cast<double>(r.below(4)); }},
      {"one in three at a time that others have",
       [&](double now, Random& r) {
         const double time = now + 3.0 * exponential(r);
         return r.below(3) == 0 ? std::ceil(time) : time;
       }},
      {"all at one time", [](double, Random&) { return 3.25; }},
      {"scales from 1e-12 to 1e12",
       [](double now, Random& r) { return now + std::pow(10.0, 24.0 * r.uniform() - 12.0); }},
      {"mostly soon, some in the far future",
       [&](double now, Random& r) {
         return now + exponential(r) * (r.below(10) == 0 ? 1e9 : 1e-3);
       }},
      {"a little before what was taken last",
       [&](double now, Random& r) { return std::max(0.0, now + 0.1 * (r.uniform() - 0.2)); }},
      {"a hot crowd before many cold particles",
       [&](double now, Random& r) {
         const double cold = r.below(10) == 0 ? 1e9 : 3000.0;
         return now + exponential(r) * (now > 0.0 || r.below(5) == 0 ? 1e-9 : cold);
       }},
      {"slower and slower, as a gas that cools",
       [&](double now, Random& r) { return now + (1e-6 + 0.1 * now) * exponential(r); }},
      {"faster and faster, as a gas that is heated",
       [&](double now, Random& r) { return now + exponential(r) / (1.0 + now * now); }}};
  std::uint32_t seed = 0;
  for (const auto& [name, next] : kinds) {
    for (const std::size_t pending : {1, 30, 20000}) {
      CAPTURE(name);
      CAPTURE(pending);
      compare(pending, next, ++seed);
    }
  }
}

TEST_CASE(
    "EventQueue: at equal times particles come before walls and cell borders, low numbers first") {
  std::vector<Event> events = {{1.0, 0, kCellBorder}, {1.0, 1, kWall + 2}, {1.0, 1, kWall + 0},
                               {1.0, 9, 2},           {1.0, 3, 4},         {0.5, 7, kCellBorder}};
  EventQueue queue;
  queue.rebuild(events);
  std::vector<std::uint32_t> partners;
  const auto live = [](const Event&) { return true; };
  while (const Event* top = queue.top(live)) {
    partners.push_back(top->partner);
    queue.pop();
  }
  CHECK(partners ==
        std::vector<std::uint32_t>{kCellBorder, 2, 4, kWall + 0, kWall + 2, kCellBorder});
}

TEST_CASE("EventQueue: a pair counts the same from either side") {
  CHECK_FALSE(before({1.0, 3, 5}, {1.0, 5, 3}));
  CHECK_FALSE(before({1.0, 5, 3}, {1.0, 3, 5}));
  CHECK(before({1.0, 5, 3}, {1.0, 4, 5}));
}

TEST_CASE("EventQueue: events come after an empty start") {
  EventQueue queue;
  std::vector<Event> none;
  queue.rebuild(none);
  const auto live = [](const Event&) { return true; };
  CHECK(queue.top(live) == nullptr);
  for (const double time : {700.5, 3.5, 0.25, 1e9}) queue.push({time, 1, 2});
  for (const double time : {0.25, 3.5, 700.5, 1e9}) {
    REQUIRE(queue.top(live));
    CHECK(queue.top(live)->time == time);
    queue.pop();
  }
}
