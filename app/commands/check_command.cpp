#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/flags.h"
#include "app/measure/feature_cost.h"
#include "app/results/theory_json.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/dynamics/tile_sizes.h"
#include "engine/physics/theory.h"
#include "engine/scene/act_checks.h"
#include "engine/scene/enum_names.h"
#include "engine/system/allocation.h"
#include "engine/text.h"

namespace clatter {

namespace {

void print_parts(const Scene& scene) {
  const std::vector<FeatureCost> parts = feature_costs(scene);
  std::fprintf(stderr,
               "Memory: about %.3g MB. Features and their cost; a dash: not in this scene.\n"
               "  feature       bytes per particle  CPU time  in this scene\n",
               1e-6 * memory_of(scene));
  for (const FeatureCost& part : parts) {
    const double share = part.bytes / std::max(1.0, static_cast<double>(final_count(scene)));
    const bool off = part.extent == "no";
    std::fprintf(stderr, "  %-12s  %18s  %8s  %s\n", part.name,
                 off ? "-" : fmt::format("{:.0f}", share).c_str(),
                 off ? "-" : cost_text(part.price).c_str(), part.extent.c_str());
  }
}

void print_allocation() {
  std::fprintf(stderr, "This process may use %s and %.3g GB of memory.\n",
               counted(static_cast<std::size_t>(processors()), "processor").c_str(),
               1e-9 * available_memory());
}

void print_way(const Scene& scene) {
  const auto particles = static_cast<std::size_t>(scene.particles.count);
  const auto has_valve = [](const Partition& partition) {
    return std::ranges::any_of(partition.holes,
                               [](const Hole& hole) { return hole.valve.has_value(); });
  };
  const bool whole =
      scene.piston || scene.shear_rate || std::ranges::any_of(scene.partitions, has_valve);
  if (whole || !runs_in_tiles(scene.dimension(), particles, processors())) return;
  std::fputs(watched_runs_in_tiles(processors())
                 ? "Runs in tiles on several threads.\n"
                 : "Runs as a whole on fewer than 4 threads; only films of elastic gases without "
                   "heatmaps and trails run in tiles.\n",
             stderr);
}

void print_events(const Scene& scene, double end) {
  const double temperature = scene.particles.start.temperature;
  const double rate = 0.5 * scene.particles.count * collision_rate(scene, temperature);
  std::fprintf(stderr, "Events until t = %g: about %.3g collisions", end, rate * end);
  if (scene.bulk_drive) {
    std::fprintf(stderr, ", %.3g kicks of all particles",
                 std::floor(end / scene.bulk_drive->interval));
  }
  std::fprintf(stderr, "; at the start temperature %g.\n", temperature);
}

// The smallest diameter of a particle.
double least_diameter(const Scene& scene) {
  double least = scene.species.empty() ? 1.0 : scene.largest_diameter();
  for (const Species& species : scene.species) {
    least = std::min(least, species.smallest_diameter());
  }
  return least;
}

void print_fixtures(const Scene& scene) {
  if (!scene.has_fixtures()) return;
  std::fprintf(stderr, "Fixtures: %s and %s, which leave %.3f of the box free.\n",
               counted(scene.obstacles.size(), "obstacle").c_str(),
               counted(scene.partitions.size(), "partition").c_str(), free_share(scene));
  const double least = least_diameter(scene);
  for (std::size_t k = 0; k < scene.partitions.size(); ++k) {
    for (const Hole& hole : scene.partitions[k].holes) {
      double width = hole.to[0] - hole.from[0];
      if (hole.to.size() > 1) width = std::min(width, hole.to[1] - hole.from[1]);
      if (width >= least) continue;
      std::fprintf(stderr, "A hole of %s is %s wide: no particle passes it.\n",
                   partition_name(scene.partitions[k], k).c_str(), number_text(width).c_str());
    }
  }
}

void print_piston(const Scene& scene) {
  if (!scene.piston) return;
  int below = 0;
  const std::size_t kinds = std::max<std::size_t>(scene.species.size(), 1);
  for (std::size_t k = 0; k < kinds; ++k) below += count_left(scene, k);
  const bool from_file = scene.particles.start.layout == Layout::File;
  const std::string sides = from_file
                                ? std::string()
                                : " between " + std::to_string(below) + " and " +
                                      std::to_string(scene.particles.count - below) + " particles";
  std::fprintf(stderr, "Piston: a free body along %s%s; the gas runs on one thread.\n",
               std::string(name_of(scene.piston->axis, kAxes)).c_str(), sides.c_str());
}

void print_shear(const Scene& scene) {
  if (!scene.shear_rate) return;
  std::fprintf(stderr, "Shear: a flow along x at the rate %s; the gas runs on one thread.\n",
               number_text(*scene.shear_rate).c_str());
}

void print_packing(const Scene& scene) {
  const double most = compressed_fraction(scene), closest = closest_packing(scene.dimension());
  if (most <= closest) return;
  std::fprintf(
      stderr,
      "The changes would bring the gas to a fraction of %.4f, beyond the closest packing of %.4f; "
      "the run will stop there.\n",
      most, closest);
}

int check(const CommonOptions& options) {
  const Scene scene = load(options);
  require_room(scene);
  print(scene_to_toml(scene));
  if (options.quiet) return kOk;
  const bool disks = scene.dimension() == 2;
  const auto count = static_cast<std::size_t>(scene.particles.count);
  std::fprintf(stderr, "The scene is valid: %s, %s fraction %.4f",
               counted(count, disks ? "disk" : "sphere").c_str(), disks ? "area" : "volume",
               scene.packing_fraction());
  if (options.seed) std::fprintf(stderr, ", seed %s", std::to_string(*options.seed).c_str());
  if (const auto added = final_count(scene) - scene.particles.count; added > 0) {
    std::fprintf(stderr, "; its changes add %s", std::to_string(added).c_str());
  }
  std::fputs(".\n", stderr);
  print_events(scene, options.until.value_or(scene.measure.burn_in + scene.measure.duration));
  print_packing(scene);
  print_fixtures(scene);
  print_piston(scene);
  print_shear(scene);
  print_allocation();
  print_way(scene);
  print_parts(scene);
  return kOk;
}

}  // namespace

void add_check_command(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App* command = program.add_subcommand(
      "check",
      "Validate a scene, and print it with all defaults. The command also estimates memory and "
      "collisions.");
  add_common_flags(*command, *options);
  command->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace clatter
