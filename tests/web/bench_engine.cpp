// Collisions per second of CPU time of elastic disks in WebAssembly: node bench_engine.js N PHI.
// Compare with `clatter bench engine --count N --area-fraction PHI` on the same machine.

#include <emscripten.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/dynamics/simulation.h"
#include "engine/initial/start_state.h"
#include "engine/scene/scene_file.h"
#include "engine/whole_number.h"

using namespace clatter;

// clang-format off
EM_JS(double, cpu_seconds, (), { return 1e-6 * process.cpuUsage().user; })
// clang-format on

int main(int argc, char** argv) {
  const auto count = argc == 3 ? whole_number<int>(argv[1]) : std::nullopt;
  const auto fraction = argc == 3 ? real_number(argv[2]) : std::nullopt;
  if (!count || !fraction) {
    std::fprintf(stderr, "node bench_engine.js N PHI\n");
    return 2;
  }
  const double side = std::sqrt(*count * std::numbers::pi / 4.0 / *fraction);
  const std::string text =
      fmt::format("box.size = [{0}, {0}]\nparticles.count = {1}\n", side, *count);
  const Scene scene = parse_scene(text, "bench");
  Simulation<2> gas(model_of<2>(scene, 1), start_state<2>(scene, 1));
  const auto collisions = static_cast<std::uint64_t>(*count) * 10;
  gas.run_until(kNever, collisions);  // towards equilibrium
  double best = 0.0;
  for (std::uint64_t batch = 0; batch < 5; ++batch) {
    const std::uint64_t before = gas.counts().collisions();
    const double began = cpu_seconds();
    gas.run_until(kNever, before + 400'000);
    const double taken = cpu_seconds() - began;
    const double rate = 1e-6 * static_cast<double>(gas.counts().collisions() - before) / taken;
    best = std::max(best, rate);
  }
  std::printf("%d %g %.2f\n", *count, *fraction, best);
  return 0;
}
