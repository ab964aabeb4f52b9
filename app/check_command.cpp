#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/write_file.h"
#include "engine/dynamics/memory.h"
#include "engine/measure/measurement.h"
#include "engine/physics/theory.h"
#include "engine/scene/scene_keys.h"

namespace clatter {

namespace {

// Something that a scene may have the program model.
struct Part {
  const char* name;
  std::string extent;  // "no", "yes", or what of it
  double bytes;        // in all
  double price;        // CPU time with it over that without, as `clatter bench features` has it
};

std::string yes(bool modelled) {
  return modelled ? "yes" : "no";
}

std::string names_of(const std::vector<Field>& fields) {
  std::string names;
  std::string_view last;
  for (const Field field : fields) {
    const std::string_view name = name_of(field, kProfiles);
    if (name != last) names += (names.empty() ? "" : ", ") + std::string(name);
    last = name;
  }
  return names;
}

Part fields_of(const Scene& scene) {
  const Measure& measure = scene.measure;
  constexpr double kExact = 1.4, kSnapshots = 1.1, kBalance = 2.0;
  const bool exact = measure.estimator == Estimator::Exact;
  double price = exact ? kExact : kSnapshots;
  if (measure.fields.empty()) return {"fields", "no", 0.0, price};
  if (std::ranges::any_of(measure.fields, is_residual)) {
    const bool averages = !std::ranges::all_of(measure.fields, is_residual);
    price = averages ? price + kBalance - 1.0 : kBalance;
  }
  return {"fields", names_of(measure.fields), cells_memory(measure, scene.spins()), price};
}

// A kick of a disk costs about half a collision of two; at the start's temperature.
double kick_price(const Scene& scene) {
  constexpr double kKick = 0.45;
  const double rate = enskog_rate(scene.area_fraction(), scene.disks.start.temperature);
  return 1.0 + kKick / (0.5 * rate * scene.bulk_drive->interval);
}

std::vector<Part> parts_of(const Scene& scene) {
  const GasMemory memory = gas_memory(scene);
  const bool moving =
      std::ranges::any_of(scene.walls, [](const auto& wall) { return wall && wall->moves(); });
  return {{"disks", "yes", memory.disks, 1.0},
          {"spins", yes(scene.spins()), memory.spins, 1.05},
          {"gravity", yes(scene.gravity.has_value()), 0.0, 1.1},
          {"moving walls", yes(moving), 0.0, 1.0},
          {"bulk drive", yes(scene.bulk_drive.has_value()), 0.0,
           scene.bulk_drive ? kick_price(scene) : std::nan("")},
          {"t_c", yes(scene.contact_time.has_value()), memory.last_collisions, 1.0},
          fields_of(scene)};
}

std::string price_text(double price) {
  if (!std::isfinite(price)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "x%.3g", price);
  return text;
}

void print_parts(const Scene& scene) {
  const std::vector<Part> parts = parts_of(scene);
  double bytes = 0.0;
  for (const Part& part : parts) bytes += part.bytes;
  std::fprintf(
      stderr,
      "Memory: about %.3g MB. Modelled, with bytes a disk, and what CPU time with it is to that "
      "without:\n",
      1e-6 * bytes);
  for (const Part& part : parts) {
    const double share = part.bytes / std::max(1, scene.disks.count);
    std::fprintf(stderr, "  %-12s %6.0f %5s  %s\n", part.name, share,
                 price_text(part.price).c_str(), part.extent.c_str());
  }
}

void print_events(const Scene& scene, double end) {
  const double temperature = scene.disks.start.temperature;
  const double rate = 0.5 * scene.disks.count * enskog_rate(scene.area_fraction(), temperature);
  std::fprintf(stderr, "Events until t = %g: about %.3g disk-disk collisions", end, rate * end);
  if (scene.bulk_drive) {
    std::fprintf(stderr, ", %.3g kicks of all disks", std::floor(end / scene.bulk_drive->interval));
  }
  std::fprintf(stderr, "; at the start's temperature %g.\n", temperature);
}

int check(const CommonOptions& options) {
  const Scene scene = load(options);
  print(scene_to_toml(scene));
  std::fprintf(stderr, "The scene is sound: %d disks, area fraction %.4f.\n", scene.disks.count,
               scene.area_fraction());
  print_events(scene, options.until.value_or(scene.measure.burn_in + scene.measure.duration));
  print_parts(scene);
  return kOk;
}

}  // namespace

void add_check_command(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App* command = program.add_subcommand(
      "check", "Read and validate a scene, print it with every default written out, run nothing");
  add_common_flags(*command, *options);
  command->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace clatter
