// Cost of features that are present but switched off: the median ratio over interleaved slices of
// two runs, with and without them. A ratio of 1 within 2 % means no cost.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <vector>

#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"

using namespace clatter;

// CPU time of a number of collisions.
static double slice(Simulation<2>& simulation) {
  constexpr std::uint64_t kCollisions = 40'000;
  const std::clock_t began = std::clock();
  simulation.run_until(kNever, simulation.counts().collisions() + kCollisions);
  return static_cast<double>(std::clock() - began);
}

int main() {
  constexpr int kPairs = 51;
  const std::string text =
      "box.size = [50, 50]\nparticles = { count = 1000, restitution = 0.9 }\n"
      "walls.left = { kind = 'driven', drive_speed = 1 }\nwalls.right = { kind = 'static' }\n";
  const std::vector<Override> off = {{"gravity.acceleration", "[0, 0]"},
                                     {"particles.friction", "0"},
                                     {"walls.right.tangential_restitution", "-1"},
                                     {"view.field", "'density'"},
                                     {"measure.fields", "['stress']"}};
  const auto without = simulation_of<2>(parse_scene(text, "s.toml"), 125);
  const auto with = simulation_of<2>(parse_scene(text, "s.toml", off), 125);
  std::vector<double> ratios;
  for (int pair = 0; pair < kPairs; ++pair) {
    const bool first = pair % 2 == 0;
    const double before = slice(first ? *without : *with), after = slice(first ? *with : *without);
    ratios.push_back(first ? after / before : before / after);
  }
  std::ranges::nth_element(ratios, ratios.begin() + kPairs / 2);
  std::printf("parts that are switched off take %.3f of the time without them\n",
              ratios[kPairs / 2]);
}
