#include "app/runs/options.h"

#include <algorithm>

#include "app/runs/picture_scene.h"
#include "app/system/missing_newline.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/error.h"

namespace clatter {

bool CommonOptions::sets(std::string_view key) const {
  return std::ranges::any_of(settings, [&](const std::string& setting) {
    const std::string_view set = std::string_view(setting).substr(0, setting.find('='));
    const std::string_view longer = set.size() < key.size() ? key : set;
    const std::string_view shorter = set.size() < key.size() ? set : key;
    return longer.starts_with(shorter) &&
           (longer.size() == shorter.size() || longer[shorter.size()] == '.');
  });
}

Scene load(const CommonOptions& options, StartFile start_file) {
  std::vector<Override> overrides;
  for (const std::string& setting : options.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw UserError({"--set " + setting, 0, 0}, "no value is set",
                      "write --set KEY=VALUE, for example --set particles.count=500");
    }
    overrides.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  Scene scene = load_any_scene(options.scene, overrides, start_file);
  if (start_file == StartFile::Read && !options.quiet) {
    note_missing_newline(scene.particles.start.file);
  }
  return scene;
}

std::vector<std::filesystem::path> inputs_of(const CommonOptions& options,
                                             const CheckpointOptions& checkpoints,
                                             const Scene& scene,
                                             const std::filesystem::path& checkpoint) {
  std::vector<std::filesystem::path> inputs = {options.scene, scene.particles.start.file};
  std::error_code ignored;
  if (!std::filesystem::equivalent(checkpoints.resume, checkpoint, ignored) &&
      !std::filesystem::equivalent(checkpoints.resume, previous_checkpoint(checkpoint), ignored)) {
    inputs.emplace_back(checkpoints.resume);
  }
  return inputs;
}

}  // namespace clatter
