#include <fmt/printf.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "app/bench/tables.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/live/watched_run.h"
#include "engine/system/usage.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

struct Jumps {
  double megabytes = 0.0;       // of the record
  std::vector<double> seconds;  // of the jumps, sorted
};

Jumps measure(const Scene& scene, double end) {
  constexpr int kJumps = 50;
  const auto run = watched_run(scene, 1);
  constexpr std::uint64_t kSlice = 10'000;  // steps, as in the window
  while (!run->run_until(end, kNoLimit, run->counts().steps() + kSlice)) {
  }
  Frame frame;
  run->fill(frame, true);
  Jumps jumps{.megabytes = 1e-6 * static_cast<double>(frame.record_bytes), .seconds = {}};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> times(0.0, end);
  for (int jump = 0; jump < kJumps; ++jump) {
    const double time = times(random);
    const double began = cpu_seconds();
    run->go_back(time);
    run->run_until(time, kNoLimit, kNoLimit);
    run->fill(frame, true);
    jumps.seconds.push_back(cpu_seconds() - began);
  }
  std::ranges::sort(jumps.seconds);
  return jumps;
}

}  // namespace

int bench_timeline(const std::string& json, int count) {
  constexpr double kSeconds = 600.0;
  std::fprintf(stderr,
               "10 minutes of the vibrated box at its speed, temperature field; CPU time of jumps "
               "to random times, memory of the recorded states\n");
  print(fmt::sprintf("%10s %12s %12s %12s\n", "N", "median ms", "longest ms", "MB"));
  auto rows = nlohmann::ordered_json::array();
  for (const int particles : count ? std::vector{count} : std::vector{1000, 20'000}) {
    const Scene scene = window_scene(particles);
    const Jumps jumps = measure(scene, kSeconds * scene.view.speed);
    const double median = 1e3 * jumps.seconds[jumps.seconds.size() / 2];
    const double longest = 1e3 * jumps.seconds.back();
    print(fmt::sprintf("%10d %12.2f %12.2f %12.2f\n", particles, median, longest, jumps.megabytes));
    rows.push_back({{"count", particles},
                    {"median_milliseconds", median},
                    {"longest_milliseconds", longest},
                    {"record_megabytes", jumps.megabytes}});
  }
  if (!json.empty()) write_file(json, rows.dump(1) + "\n");
  return kOk;
}

}  // namespace clatter
