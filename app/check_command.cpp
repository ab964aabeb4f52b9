#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "app/commands.h"
#include "app/write_file.h"
#include "engine/dynamics/disk.h"
#include "engine/dynamics/prediction.h"
#include "engine/measure/measurement.h"
#include "engine/physics/theory.h"

namespace clatter {

// Besides the disk and its plan: one line of a cell each, and two entries of the event queue with
// room to grow.
static constexpr double kBytesPerDisk =
    sizeof(Disk<2>) + sizeof(Plan<2>) + sizeof(CellGrid<2>::Line) + 4 * sizeof(Event);

static int check(const CommonOptions& options) {
  const Scene scene = load(options);
  print(scene_to_toml(scene));
  const double count = scene.disks.count;
  const double temperature = scene.start_temperature();
  const double end = options.until.value_or(scene.measure.burn_in + scene.measure.duration);
  const double rate = 0.5 * count * enskog_rate(scene.area_fraction(), temperature);
  const double cells = cells_memory(scene.measure, scene.spins());
  std::fprintf(
      stderr,
      "The scene is sound: %d disks, area fraction %.4f.\n"
      "Memory: about %.3g MB (%.0f bytes a disk; %.3g MB for the cells that are measured).\n"
      "Events: about %.3g disk-disk collisions until t = %g at the start's temperature %g.\n",
      scene.disks.count, scene.area_fraction(), 1e-6 * (count * kBytesPerDisk + cells),
      kBytesPerDisk, 1e-6 * cells, rate * end, end, temperature);
  return kOk;
}

void add_check_command(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App* command = program.add_subcommand(
      "check", "Read and validate a scene, print it with every default written out, run nothing");
  add_common_flags(*command, *options);
  command->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace clatter
