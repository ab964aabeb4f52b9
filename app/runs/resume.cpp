#include "app/runs/resume.h"

#include <algorithm>

#include "engine/error.h"
#include "engine/scene/schedule.h"
#include "engine/scene/scene_file.h"

namespace clatter {

static std::string shown(const std::string& value) {
  return value.empty() ? "absent" : value;
}

[[noreturn]] static void refuse(const Resumed& resumed, const KeyDifference& key,
                                const std::string& advice) {
  throw UserError({resumed.file},
                  key.key + " is " + shown(key.before) + " in the checkpoint and " +
                      shown(key.now) + " in the scene",
                  advice);
}

// Properties that a resumed run must keep: the box, the particles, the body of the piston and the
// walled sides.
static bool is_fixed(const KeyDifference& difference) {
  if (difference.key.starts_with("piston.")) return !may_change_live(difference.key);
  if (difference.key.starts_with("species.")) return !difference.key.ends_with(".colour");
  const bool wall_of_one = difference.before.empty() || difference.now.empty();
  return difference.key == "box.size" || difference.key == "particles.count" ||
         (wall_of_one && difference.key.starts_with("walls.") && difference.key.ends_with(".kind"));
}

// Whether a key changes the dynamics. The other keys concern measurement, pictures and
// descriptions.
static bool is_law(const KeyDifference& difference) {
  const std::string& key = difference.key;
  return !key.starts_with("measure.") && !key.starts_with("view.") &&
         !key.starts_with("species.") && !key.starts_with("particles.start.") &&
         key.find('.') != std::string::npos;
}

// Whether --set has a law. The names of a pair may have either order.
static bool is_set(const CommonOptions& common, const std::string& key) {
  if (common.sets(key)) return true;
  constexpr std::string_view kPair = "pair.";
  if (!key.starts_with(kPair)) return false;
  const std::size_t second = key.find('.', kPair.size()) + 1, last = key.find('.', second);
  const std::string first_name = key.substr(kPair.size(), second - 1 - kPair.size());
  return common.sets(std::string(kPair) + key.substr(second, last - second) + '.' + first_name +
                     key.substr(last));
}

// The numbers of particles in a start state of a file come from the checkpoint.
static void take_counts(Scene& scene, const Scene& saved) {
  if (scene.particles.count == 0) scene.particles.count = saved.particles.count;
  for (Species& species : scene.species) {
    const auto same = find_species(saved.species, species.name);
    if (species.count == 0 && same) species.count = saved.species[*same].count;
  }
}

double Resumed::time() const {
  return std::visit([](const auto& saved) { return Clock(saved.base).absolute(saved.now); },
                    checkpoint.saved);
}

std::optional<Resumed> resume(const CommonOptions& common, const CheckpointOptions& options,
                              Scene& scene) {
  if (options.resume.empty()) return std::nullopt;
  const std::string& file = options.resume;
  Resumed resumed{file, read_checkpoint(file), {}};
  if (scene.particles.start.layout == Layout::File) {
    take_counts(scene, parse_scene(resumed.checkpoint.scene, file, {}, StartFile::Skip));
    scene.particles.start.temperature = resumed.checkpoint.start_temperature;
  }
  resumed.differences = differences(resumed.checkpoint.scene, scene_to_toml(scene), file);
  for (const KeyDifference& key : resumed.differences) {
    if (is_fixed(key)) refuse(resumed, key, "give the scene of the checkpoint");
    if (is_law(key) && !is_set(common, key.key)) {
      refuse(resumed, key,
             "give the scene of the checkpoint, or change the law with --set " + key.key + "=" +
                 shown(key.now));
    }
  }
  const std::uint64_t seed = resumed.checkpoint.seed;
  if (common.seed.value_or(seed) != seed) {
    throw UserError(
        {file}, "this checkpoint has the seed " + std::to_string(seed),
        "omit --seed, or resume a checkpoint with the seed " + std::to_string(*common.seed));
  }
  return resumed;
}

void require_same_measure(const Resumed& resumed, bool burns_in) {
  for (const KeyDifference& key : resumed.differences) {
    if (!key.key.starts_with("measure.") || key.key == "measure.duration") continue;
    if (key.key == kBurnInKey && burns_in) continue;
    refuse(resumed, key,
           "keep the value for the averages with --set " + key.key + "=" + key.before);
  }
}

static bool is_of_view(const KeyDifference& difference) {
  return difference.key.starts_with("view.") && difference.key != "view.speed";
}

bool has_same_view(const Resumed& resumed) {
  return std::ranges::none_of(resumed.differences, is_of_view);
}

void require_same_view(const Resumed& resumed) {
  for (const KeyDifference& key : resumed.differences) {
    if (!is_of_view(key)) continue;
    refuse(resumed, key, "keep the value for this film, or begin another film with --from");
  }
}

std::string changed_laws(const Resumed& resumed) {
  std::string keys;
  for (const KeyDifference& difference : resumed.differences) {
    if (is_law(difference)) keys += (keys.empty() ? "" : ", ") + difference.key;
  }
  return keys;
}

bool differs(const Resumed& resumed, const std::string& key) {
  return std::ranges::find(resumed.differences, key, &KeyDifference::key) !=
         resumed.differences.end();
}

}  // namespace clatter
