#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

struct MovesOfBase : Observer<2> {
  int count = 0;
  void on_base_moved(double) override { ++count; }
};

Model<2> driven_box() {
  return with_walls(periodic_box(9.0, 8.0), 0, kDriven);
}

}  // namespace

TEST_CASE("Timers: they fire at decimal times, all of them, across base moves") {
  for (const double from : {0.0, 1e9}) {
    CAPTURE(from);
    Simulation<2> simulation(driven_box(), random_gas(driven_box(), 20, 111), from);
    MovesOfBase moves;
    simulation.add_observer(moves);
    std::vector<double> times;
    int late = 0;
    const double start = from + 0.25;
    simulation.every(start, 0.1, [&](double time) {
      times.push_back(time);
      // The reading of the clock may add one rounding.
      late += std::fabs(simulation.time() - time) > 0x1p-52 * time;
    });
    simulation.run_until(from + 200.25 - 1e-5);
    REQUIRE(times.size() == 2000);
    for (std::size_t k = 0; k < times.size(); ++k) {
      REQUIRE(times[k] == (20.0 * start + 2.0 * static_cast<double>(k)) / 20.0);
    }
    CHECK(late == 0);
    CHECK(moves.count >= 10);
    check_sound(simulation);
  }
}

TEST_CASE("Timers: all fire in the order of time, then in the order of registration") {
  Simulation<2> simulation(driven_box(), random_gas(driven_box(), 20, 112));
  std::vector<std::pair<double, int>> log;
  const auto note = [&](int who) { return [&log, who](double t) { log.push_back({t, who}); }; };
  simulation.every(0.0, 0.5, note(0));
  simulation.every(7.0, 0.0, note(1));  // once
  simulation.every(1.0, 0.25, note(2));
  for (const double halt : {0.3, 0.5, 0.5, 6.9, 7.0, 31.7, 40.0}) simulation.run_until(halt);
  std::vector<std::pair<double, int>> expected;
  for (int quarter = 0; quarter <= 160; ++quarter) {
    const double t = 0.25 * quarter;
    if (quarter % 2 == 0) expected.push_back({t, 0});
    if (quarter == 28) expected.push_back({t, 1});
    if (quarter >= 4) expected.push_back({t, 2});
  }
  CHECK(log == expected);
}

// Multiples of decimal intervals, whose digits beyond double precision are above or below those of
// the decimal number. The kick at 0.7 belongs to the burn-in that ends there.
TEST_CASE("Timers: runs until a decimal time include its sample and its kick") {
  struct Case {
    double interval, until;
    std::uint64_t count;
  };
  for (const auto& [interval, until, count] :
       {Case{0.1, 0.3, 3}, Case{0.1, 0.7, 7}, Case{0.1, 12.6, 126}, Case{0.2, 12.6, 63},
        Case{0.6, 6.6, 11}, Case{0.1, 100.3, 1003}}) {
    CAPTURE(interval);
    CAPTURE(until);
    const Model<2> model = kicked(driven_box(), interval, 0.1);
    Simulation<2> simulation(model, random_gas(model, 20, 113));
    std::uint64_t samples = 0;
    std::vector<std::uint64_t> kicks_before_end;
    simulation.every(0.0, interval, [&](double) { ++samples; });
    simulation.every(until, 0.0,
                     [&](double) { kicks_before_end.push_back(simulation.counts().kicks); });
    simulation.run_until(until);
    CHECK(simulation.counts().kicks == count);
    CHECK(samples == count + 1);
    CHECK(kicks_before_end == std::vector<std::uint64_t>{count});
    CHECK(simulation.time() == until);
  }
}

TEST_CASE("Timers: physical events of the same time come first") {
  State<2> start;
  start.positions = {{2.0, 2.0}, {7.0, 2.0}};
  start.velocities = {{1.0, 0.0}, {-1.0, 0.0}};  // a gap of 4, closed at speed 2
  Simulation<2> simulation(periodic_box(20.0, 20.0), start);
  std::vector<std::uint64_t> seen;
  for (const double at : {std::nextafter(2.0, 0.0), 2.0}) {
    simulation.every(at, 0.0, [&](double) { seen.push_back(simulation.counts().pair_collisions); });
  }
  simulation.run_until(2.0);
  CHECK(seen == std::vector<std::uint64_t>{0, 1});
  CHECK(simulation.time() == 2.0);
}

TEST_CASE("Timers: those before the last collision fire in a run up to it") {
  Simulation<2> simulation(driven_box(), random_gas(driven_box(), 20, 113));
  std::vector<double> times;
  simulation.every(0.1, 0.1, [&](double time) { times.push_back(time); });
  simulation.run_until(kNever, 2000);
  REQUIRE(!times.empty());
  CHECK(times.back() <= simulation.time());
  CHECK(times.back() > simulation.time() - 0.1);
  CHECK(std::fabs(times.back() - 0.1 * static_cast<double>(times.size())) < 1e-9);
}

TEST_CASE("Timers: an action may start others") {
  Simulation<2> simulation(driven_box(), random_gas(driven_box(), 20, 114));
  std::vector<double> times;
  simulation.every(1.0, 0.0, [&simulation, &times](double time) {
    for (int i = 0; i < 20; ++i) {
      simulation.every(2.0 + i, 0.0, [&times](double t) { times.push_back(t); });
    }
    times.push_back(time);  // the captures of the action must still be valid
  });
  simulation.run_until(30.0);
  REQUIRE(times.size() == 21);
  CHECK(times.front() == 1.0);
  for (int i = 0; i < 20; ++i) CHECK(times[static_cast<std::size_t>(i) + 1] == 2.0 + i);
}

TEST_CASE("Timers: one with an interval near the largest double fires once") {
  Simulation<2> simulation(driven_box(), random_gas(driven_box(), 20, 115));
  std::vector<double> times;
  for (const double start : {1.0, 1e305}) {
    simulation.every(start, 1e305, [&](double time) { times.push_back(time); });
  }
  simulation.run_until(5.0);
  CHECK(times == std::vector<double>{1.0});
}

TEST_CASE("Timers: a request to stop halts the run before the next one, and changes no bit") {
  Simulation<2> straight(driven_box(), random_gas(driven_box(), 20, 116));
  straight.run_until(3.0);

  Simulation<2> simulation(driven_box(), random_gas(driven_box(), 20, 116));
  int fired = 0;
  bool stop = false;
  simulation.every(1.0, 0x1p-13, [&](double) {
    ++fired;
    stop = true;
  });
  const auto run = [&] {
    return simulation.run_until(3.0, kNoLimit, kNoLimit, [&] { return stop; });
  };
  CHECK_FALSE(run());
  CHECK(simulation.time() == 1.0);
  CHECK_FALSE(run());
  CHECK(fired == 1);
  for (int expected = 2; expected <= 10; ++expected) {
    stop = false;
    CHECK_FALSE(run());
    CHECK(fired == expected);
  }
  CHECK(simulation.run_until(3.0));
  CHECK(fired == 16385);
  CHECK(simulation.state_hash() == straight.state_hash());
}

TEST_CASE("Timers: a request to stop halts a run without timers within a thousand steps") {
  Simulation<2> simulation(driven_box(), random_gas(driven_box(), 20, 117));
  int looks = 0;
  CHECK_FALSE(simulation.run_until(kNever, kNoLimit, kNoLimit, [&] { return ++looks == 5; }));
  CHECK(simulation.counts().steps() > 0);
  CHECK(simulation.counts().steps() <= 4000);
}
