// libFuzzer target: reads the text of a scene, validates it, and runs twenty collisions. One text
// in eight runs two hundred collisions, is drawn and measured. The JSON of the result is parsed
// again and has finite numbers only. Lines
// "#set key=value" are settings of --set. A custom mutator adds these lines for all keys, with
// extreme values.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/results/result_json.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/measure/measurement.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/act_checks.h"
#include "engine/scene/key_lister.h"
#include "engine/scene/scene_file.h"
#include "engine/scene/scene_keys.h"
#include "render/context/context.h"
#include "render/gl/canvas.h"
#include "render/layers/renderer.h"
#include "tests/fuzz/depth.h"
#include "tests/fuzz/extreme_number.h"

using namespace clatter;

namespace {

// More particles would only be slower.
constexpr int kMaxParticles = 250;
constexpr std::uint64_t kCollisions = 200, kSteps = 4000;
constexpr std::uint64_t kFewCollisions = 20, kFewSteps = 400;
// Averages also take time without motion.
constexpr double kWindows = 100.0;
constexpr int kMaxCells = 3;  // along each axis
constexpr double kSamples = 100.0;

constexpr std::string_view kSetting = "#set ";

// The paths of a key in settings: items of lists have the names in tests/fuzz/scenes.
std::vector<std::string> paths_of(const std::string& key) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> lists = {
      {"species.", {"a.", "b."}},
      {"pair.", {"a.b.", "b.b."}},
      {"obstacle.", {"disk.", "wedge."}},
      {"partition.", {"wall."}}};
  for (const auto& [list, names] : lists) {
    if (!key.starts_with(list)) continue;
    std::vector<std::string> paths;
    for (const std::string& name : names) paths.push_back(list + name + key.substr(list.size()));
    return paths;
  }
  return {key};
}

std::vector<std::string> keys_of_scenes() {
  std::vector<std::string> keys;
  for (const int dimension : {2, 3}) {
    KeyLister lister;
    SceneInput any;
    any.scene = default_scene(dimension);
    any.species_names = {"a", "b"};
    visit_scene(lister, any);
    for (const std::string& key : lister.keys()) {
      for (std::string& path : paths_of(key)) keys.push_back(std::move(path));
    }
  }
  return keys;
}

// A list of changes by one nudge of a region or of a particle.
std::string extreme_nudges(std::minstd_rand& random) {
  const std::string region =
      random() % 2 ? "centre = " + extreme_list(random) + ", radius = " + extreme_number(random)
                   : "particle = " + std::to_string(random() % 4);
  constexpr std::array kMeans = {"scale = ", "add = ", "set = "};
  const std::size_t means = random() % kMeans.size();
  const std::string value = means == 0 ? extreme_number(random) : extreme_list(random);
  return "[{ time = 0.1, nudge = { " + region + ", " + kMeans[means] + value + " } }]";
}

// A list of two strokes of the piston.
std::string extreme_strokes(std::minstd_rand& random) {
  const std::string time = extreme_number(random);
  return "[{ time = 0.1, piston = " + extreme_number(random) + ", until = " + time +
         " }, { time = " + time + ", piston = " + extreme_number(random) + ", until = 5 }]";
}

// A list of changes by a puff and by a throw of one of its particles.
std::string extreme_puffs(std::minstd_rand& random) {
  return "[{ time = 0.1, puff = { count = " + std::to_string(1 + random() % 50) + ", centre = [" +
         extreme_number(random) + ", " + extreme_number(random) +
         "], radius = " + extreme_number(random) + ", temperature = " + extreme_number(random) +
         (random() % 2 ? ", species = 'b'" : "") + " } }, { time = " + extreme_number(random) +
         ", nudge = { particle = " + std::to_string(random() % 50) + ", set = [1, " +
         extreme_number(random) + "] } }]";
}

// A list of holes of a partition, one of them with a valve, or of corners of a polygon.
std::string extreme_holes(std::minstd_rand& random) {
  if (random() % 2) return "[" + extreme_list(random) + ", [1, 2], " + extreme_list(random) + "]";
  return "[{ from = [" + extreme_number(random) + "], to = [" + extreme_number(random) +
         "] }, { from = [1], to = [3], valve = { faster_than = " + extreme_number(random) + " } }]";
}

std::string extreme_value(std::minstd_rand& random) {
  constexpr std::array<const char*, 20> kWords = {
      "static",   "driven", "thermal",  "sawtooth",  "sinusoidal", "exact",  "snapshot",
      "gaussian", "box",    "lattice",  "random",    "auto",       "locked", "speed",
      "spin",     "none",   "velocity", "stress_xy", "light",      "x"};
  switch (random() % 10) {
    case 0:
      return kWords[random() % kWords.size()];
    case 1:
      return extreme_list(random);
    case 2:
      return "[{ time = " + extreme_number(random) + ", width = " + extreme_number(random) + " }]";
    case 3:
      return "[{ time = " + extreme_number(random) +
             ", set = { 'particles.restitution' = " + extreme_number(random) +
             " }, ramp = 'linear', until = " + extreme_number(random) + " }]";
    case 4:
      return random() % 2 ? "true" : "false";
    case 5:
      return extreme_holes(random);
    default:
      return extreme_number(random);
  }
}

// Sides from one diameter on, of two or three dimensions.
std::string narrow_box(std::minstd_rand& random) {
  constexpr std::array kSides = {"1", "1.2", "1.5", "1.5000001", "2", "2.1", "3", "4.5", "7"};
  std::string sides = kSides[random() % kSides.size()];
  for (auto more = 1 + random() % 2; more > 0; --more) {
    sides += std::string(", ") + kSides[random() % kSides.size()];
  }
  return "[" + sides + "]";
}

std::string extreme_setting(const std::vector<std::string>& keys, std::minstd_rand& random) {
  switch (random() % 8) {
    case 0:
      return "box.size=" + narrow_box(random);
    case 1:
      switch (random() % 3) {
        case 0:
          return "change=" + extreme_nudges(random);
        case 1:
          return "change=" + extreme_puffs(random);
        default:
          return "change=" + extreme_strokes(random);
      }
    case 2:
      return "view.captions=[{ text = 'T_{0} v^2', from = " + extreme_number(random) +
             ", to = " + extreme_number(random) + " }]";
    default:
      return keys[random() % keys.size()] + "=" + extreme_value(random);
  }
}

// The settings of a text, in order.
std::vector<Override> settings_in(std::string_view text) {
  std::vector<Override> settings;
  for (std::size_t at = text.find(kSetting); at != text.npos; at = text.find(kSetting, at + 1)) {
    const std::string_view line = text.substr(at + kSetting.size());
    const std::string setting(line.substr(0, line.find('\n')));
    const std::size_t equals = setting.find('=');
    if (equals == setting.npos) continue;
    settings.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  return settings;
}

void draw(const Scene& scene, const Snapshot& snapshot) {
  static const auto context = open_context(Backend::Auto);
  static const Canvas canvas(context->gl(), {64, 48});
  static Renderer renderer(context->gl());
  canvas.bind();
  const OverlayText text{scene.title, scene.caption};
  const Camera camera = renderer.fit(snapshot, {64, 48}, scene.view, text);
  renderer.draw(snapshot, camera, {64, 48}, scene.view, text);
}

// JSON writes a number that is not finite as null.
void require_finite(const nlohmann::ordered_json& json, const std::string& name) {
  for (const auto& [key, value] : json.items()) {
    // A column that no particle visits has no temperature, few samples have no errors, and a species
    // has no mean position along periodic axes.
    const bool observable =
        std::ranges::find(kObservables, key, &Named<ObservableKind>::name) != kObservables.end();
    if (key == "profile" || key == "mean_position" || observable) continue;
    if (value.is_null()) {
      std::fprintf(stderr, "%s.%s is not finite\n", name.c_str(), key.c_str());
      std::abort();
    }
    if (value.is_structured()) require_finite(value, name + '.' + key);
  }
}

// Intervals between the samples of observables.
std::array<double*, 15> intervals_of(Measure& measure) {
  return {&measure.radial_distribution.interval,
          &measure.velocity_distribution.interval,
          &measure.mean_squared_displacement.interval,
          &measure.velocity_autocorrelation.interval,
          &measure.structure_factor.interval,
          &measure.clusters.interval,
          &measure.bond_order.lags_in_time.interval,
          &measure.wall_power.interval,
          &measure.plane_current.interval,
          &measure.local_density.interval,
          &measure.spin_distribution.interval,
          &measure.probe.interval,
          &measure.collision_counts.interval,
          &measure.radial_distribution_profile.interval,
          &measure.mixing.interval};
}

// Measures a scene without changes up to a time, and reads the result's text again.
template <int D>
void measure(Scene scene, double end) {
  if (!scene.changes.empty() || !(end > 0.0)) return;
  for (int& cells : scene.measure.cells) cells = std::min(cells, kMaxCells);
  scene.measure.burn_in = 0.0;
  scene.measure.series_interval = std::max(scene.measure.series_interval, end / kSamples);
  scene.measure.interval = std::max(scene.measure.interval, end / kSamples);
  for (double* interval : intervals_of(scene.measure)) {
    *interval = std::max(*interval, end / kSamples);
  }
  const auto simulation = simulation_of<D>(scene, 1);
  Measurement measurement(*simulation, scene.measure, end);
  simulation->run_until(end, kCollisions, kSteps);
  const auto result = result_json(scene, 1, *simulation, measurement.result(), {});
  require_finite(nlohmann::ordered_json::parse(result.dump()), "result");
}

template <int D>
void run(const Scene& scene, bool deep) {
  ScheduledRun<D> run(scene, 1);
  if (!deep) {
    run.run_until(scene.measure.duration, kFewCollisions, kFewSteps);
    return;
  }
  run.show(scene.view);
  const double end = scene.measure.burn_in + scene.measure.duration;
  run.run_until(std::min(end, kWindows * scene.view.window), kCollisions, kSteps);
  draw(run.scene(), run.snapshot());
  measure<D>(scene, run.simulation().time());
}

void run(const std::string& text) {
  const Scene scene = parse_scene(text, "fuzz.toml", settings_in(text));
  if (final_count(scene) > kMaxParticles) return;
  with_dimension(scene.dimension(),
                 [&](auto dimension) { run<dimension>(scene, is_one_in(8, text)); });
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  static const std::vector<std::string> keys = keys_of_scenes();
  std::minstd_rand random(seed);
  random.discard(2);
  if (random() % 4 == 0) return LLVMFuzzerMutate(data, size, most);
  const std::string line = "\n" + std::string(kSetting) + extreme_setting(keys, random);
  if (size + line.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::memcpy(data + size, line.data(), line.size());
  return size + line.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    run({reinterpret_cast<const char*>(data), size});
  } catch (const UserError&) {
  } catch (const PhysicalStop&) {
  }
  return 0;
}
