#include "app/view/playlist.h"

#include <toml++/toml.h>

#include <filesystem>
#include <limits>

#include "app/runs/picture_scene.h"
#include "engine/error.h"
#include "engine/scene/key_reader.h"
#include "engine/scene/scene_document.h"
#include "engine/scene/scene_file.h"
#include "engine/system/read_file.h"
#include "engine/text.h"

namespace clatter {

namespace {

// A scene in the list, before it is loaded.
struct Entry {
  Place place;
  std::string scene;
  std::vector<Override> set = {};
  std::optional<std::uint64_t> seed = {};
};

std::uint64_t seed_in(const toml::node& node, const std::string& file) {
  const auto* whole = node.as_integer();
  if (whole && whole->get() >= 0) return static_cast<std::uint64_t>(whole->get());
  throw UserError(place_of(node, file), "'seed' cannot be " + toml_text(node),
                  "give a whole number between 0 and " +
                      std::to_string(std::numeric_limits<std::int64_t>::max()));
}

Entry entry_in(const toml::node& node, const std::string& file) {
  Entry entry{.place = place_of(node, file), .scene = {}};
  if (node.is_string()) {
    entry.scene = node.as_string()->get();
    return entry;
  }
  const toml::table* table = node.as_table();
  if (!table) {
    throw UserError(entry.place, toml_text(node) + " cannot be a scene",
                    "give a name, a path, or a table { scene = \"vibrated\" }");
  }
  const std::vector<std::string> known = {"scene", "set", "seed"};
  for (const auto& [key, value] : *table) {
    const std::string name(key.str());
    if (name == "seed") {
      entry.seed = seed_in(value, file);
    } else if (name == "scene" && value.is_string()) {
      entry.scene = value.as_string()->get();
    } else if (name == "scene") {
      throw UserError(place_of(value, file), "'scene' cannot be " + toml_text(value),
                      "give a name or a path between quotes");
    } else if (name == "set" && value.is_table()) {
      KeyReader(*table, file).settings("set", entry.set);
    } else if (name == "set") {
      throw UserError(place_of(value, file), "'set' cannot be " + toml_text(value),
                      "give a table of keys and values");
    } else {
      const std::string near(near_miss(name, known));
      throw UserError(place_of(value, file), "unknown key '" + name + "' of a scene",
                      near.empty() ? "use scene, set and seed" : "did you mean '" + near + "'?");
    }
  }
  if (entry.scene.empty()) {
    throw UserError(entry.place, "a scene has no name", "add scene = \"vibrated\"");
  }
  return entry;
}

// A path relative to the folder of the playlist, if there is such a file; else a name.
std::string found_beside(const std::string& scene, const std::string& file) {
  const std::filesystem::path beside = std::filesystem::path(file).parent_path() / scene;
  std::error_code ignored;
  return std::filesystem::is_regular_file(beside, ignored) ? beside.string() : scene;
}

// Errors of the settings, and of names that do not exist, have the place of the entry.
Scene load(const Entry& entry, const std::string& file) {
  const std::string scene = found_beside(entry.scene, file);
  try {
    return load_any_scene(scene, entry.set);
  } catch (const UserError& error) {
    const std::string_view message = error.what();
    if (message.starts_with("--set ")) {
      throw UserError(entry.place, error.problem(), error.advice());
    }
    if (message.starts_with(scene + ": ")) throw UserError(entry.place, error.what(), "");
    throw;
  }
}

}  // namespace

std::vector<PlaylistItem> read_playlist(std::string_view text, const std::string& file) {
  const toml::table root = parse_document(text, file);
  refuse_unknown_keys(root, {"schema", "scenes"});
  int schema = 1;
  KeyReader(root, file).value("schema", schema, between(1, 1), kRequired);
  const toml::node* node = root.get("scenes");
  const toml::array* list = node ? node->as_array() : nullptr;
  if (!list || list->empty()) {
    throw UserError(node ? place_of(*node, file) : Place{file},
                    node ? "'scenes' cannot be " + toml_text(*node) : "'scenes' is missing",
                    "give a list of scenes, such as scenes = [\"cradle\", \"shaker\"]");
  }
  std::vector<PlaylistItem> items;
  for (const toml::node& item : *list) {
    const Entry entry = entry_in(item, file);
    items.push_back({load(entry, file), entry.seed});
  }
  return items;
}

std::vector<PlaylistItem> load_playlist(const std::string& file) {
  return read_playlist(read_file(file, kLargestScene, "a playlist is a text of a few kB"), file);
}

}  // namespace clatter
