#include "engine/scene/scene_file.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "engine/embedded_file.h"
#include "engine/error.h"
#include "engine/scene/key_lister.h"
#include "engine/scene/key_reader.h"
#include "engine/scene/key_writer.h"
#include "engine/scene/lattice.h"
#include "engine/scene/scene_document.h"
#include "engine/scene/text.h"

namespace clatter {

/// Throws where a wall stands without the one opposite.
static void check_walls(const Scene& scene, const toml::table& root, const std::string& file) {
  for (int side = 0; side < 4; ++side) {
    const int opposite = side ^ 1;
    if (!scene.walls[side] || scene.walls[opposite]) continue;
    const std::string path = std::string("walls.") + kSideNames[side];
    throw UserError(place_of(root, path, file), "[" + path + "] has no wall opposite",
                    std::string("add [walls.") + kSideNames[opposite] +
                        "], or remove this one for a periodic axis");
  }
}

/// The number of disks that the input asks for; throws where it asks twice, not at all, or for
/// more than any lattice holds.
static int resolve_count(const SceneInput& input, const toml::table& root,
                         const std::string& file) {
  const Scene& scene = input.scene;
  if (input.count.has_value() == input.area_fraction.has_value()) {
    const std::string path = input.count ? "disks.area_fraction" : "disks";
    throw UserError(place_of(root, path, file),
                    input.count ? "both 'disks.count' and 'disks.area_fraction' are given"
                                : "the number of disks is missing",
                    "give exactly one of 'disks.count' and 'disks.area_fraction'");
  }
  const double area = scene.box.x() * scene.box.y();
  const double count =
      input.count ? *input.count : std::round(*input.area_fraction * 4.0 * area / std::numbers::pi);
  const int capacity =
      lattice_capacity({.box = scene.box, .periodic = {scene.periodic(0), scene.periodic(1)}});
  if (count > capacity) {
    const std::string path = input.count ? "disks.count" : "disks.area_fraction";
    throw UserError(place_of(root, path, file),
                    (input.count ? std::to_string(*input.count) : number_text(count)) +
                        " disks do not fit into the box",
                    "it holds at most " + std::to_string(capacity));
  }
  return static_cast<int>(count);
}

Scene parse_scene(std::string_view text, const std::string& file,
                  const std::vector<Override>& overrides) {
  toml::table root = parse_document(text, file);
  for (const Override& change : overrides) apply_override(root, change);

  SceneInput input;
  KeyLister lister;
  visit_scene(lister, input);
  refuse_unknown_keys(root, lister.keys());

  KeyReader reader(root, file);
  visit_scene(reader, input);
  check_walls(input.scene, root, file);
  input.scene.disks.count = resolve_count(input, root, file);
  return input.scene;
}

/// All bytes of a scene file.
static std::string read_file(const std::string& path) {
  constexpr std::size_t kLargest = 1'000'000;
  std::ifstream file(path, std::ios::binary);
  std::string bytes(kLargest + 1, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (file.bad() || (file.fail() && !file.eof())) {
    throw UserError({path}, "the file cannot be read", "check its permissions");
  }
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  if (bytes.size() > kLargest) {
    throw UserError({path}, "the file is larger than 1 MB", "a scene is a text of a few kB");
  }
  return bytes;
}

[[noreturn]] static void refuse_missing(const std::string& name) {
  std::vector<std::string> gallery;
  for (const EmbeddedFile& scene : embedded_scenes()) {
    gallery.emplace_back(scene.name.substr(0, scene.name.rfind('.')));
  }
  const std::string stem = std::filesystem::path(name).stem().string();
  const std::string_view near = near_miss(stem, gallery);
  throw UserError({name}, "there is no such scene",
                  near.empty() ? "give a file or a name that `clatter scenes` lists"
                               : "did you mean the gallery scene '" + std::string(near) + "'?");
}

Scene load_scene(const std::string& path_or_name, const std::vector<Override>& overrides) {
  std::error_code ignored;  // what cannot be looked at counts as absent
  const std::filesystem::file_status status = std::filesystem::status(path_or_name, ignored);
  const bool directory = std::filesystem::is_directory(status);
  if (std::filesystem::exists(status) && !directory) {
    return parse_scene(read_file(path_or_name), path_or_name, overrides);
  }
  for (const EmbeddedFile& scene : embedded_scenes()) {
    if (scene.name == path_or_name || scene.name == path_or_name + ".toml") {
      return parse_scene(scene.bytes, std::string(scene.name), overrides);
    }
  }
  if (directory) throw UserError({path_or_name}, "this is a directory", "give a scene file in it");
  refuse_missing(path_or_name);
}

template <class Writer>
static std::string written(const Scene& scene) {
  SceneInput input{.count = scene.disks.count, .area_fraction = {}, .scene = scene};
  Writer writer;
  visit_scene(writer, input);
  return writer.text();
}

std::string scene_to_toml(const Scene& scene) {
  return written<TomlWriter>(scene);
}

std::string scene_to_json(const Scene& scene) {
  return written<JsonWriter>(scene);
}

}  // namespace clatter
