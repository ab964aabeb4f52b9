#include "app/runs/picture_scene.h"

#include <filesystem>
#include <system_error>

#include "engine/error.h"
#include "engine/whole_number.h"

namespace clatter {

// A file that is named as a picture would otherwise be read as TOML, with a confusing error.
static void require_not_named_png(const std::filesystem::path& path) {
  std::error_code ignored;
  if (path.extension() != ".png" || !std::filesystem::is_regular_file(path, ignored)) return;
  throw UserError({path.string()}, "this is not a PNG picture",
                  "give a picture made by clatter, or a scene file NAME.toml");
}

SceneText find_any_scene(const std::string& path_or_name) {
  if (!is_png(path_or_name)) {
    require_not_named_png(path_or_name);
    return find_scene(path_or_name);
  }
  const auto inside = png_text(path_or_name, "Scene");
  if (!inside) {
    throw UserError({path_or_name}, "this picture contains no scene",
                    "give a picture made by clatter, or a scene file");
  }
  if (inside->size() > kLargestScene) {
    throw UserError({path_or_name}, "the scene in this picture is larger than 1 MB",
                    "give a picture made by clatter");
  }
  return {*inside, path_or_name};
}

Scene load_any_scene(const std::string& path_or_name, const std::vector<Override>& overrides,
                     StartFile start_file) {
  return parse_scene(find_any_scene(path_or_name), overrides, start_file);
}

std::vector<PngText> picture_texts(const Scene& scene, std::uint64_t seed) {
  return {{"Title", scene.title},
          {"Software", "clatter " CLATTER_VERSION},
          {"Seed", std::to_string(seed)},
          {"Scene", scene_to_toml(scene)}};
}

std::optional<std::uint64_t> seed_of_picture(const std::string& path) {
  const auto text = png_text(path, "Seed");
  if (!text) return std::nullopt;
  return whole_number<std::uint64_t>(*text);
}

}  // namespace clatter
