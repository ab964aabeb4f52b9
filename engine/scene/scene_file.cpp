#include "engine/scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <system_error>

#include "engine/error.h"
#include "engine/physics/state.h"
#include "engine/scene/key_lister.h"
#include "engine/scene/key_reader.h"
#include "engine/scene/key_writer.h"
#include "engine/scene/obstacle_checks.h"
#include "engine/scene/scene_checks.h"
#include "engine/scene/scene_document.h"
#include "engine/scene/scene_keys.h"
#include "engine/scene/schedule.h"
#include "engine/scene/state_file.h"
#include "engine/system/read_file.h"
#include "engine/text.h"

namespace clatter {

namespace {

constexpr std::size_t kLargestState = 4'000'000'000;

const EmbeddedFile* find_embedded(std::span<const EmbeddedFile> files, std::string_view name) {
  const auto found = std::ranges::find(files, name, &EmbeddedFile::name);
  return found == files.end() ? nullptr : &*found;
}

bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;  // an inaccessible file counts as absent
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_directory(status);
}

[[noreturn]] void refuse_missing_state(const Place& place, const std::filesystem::path& path) {
  std::vector<std::string> names;
  std::error_code ignored;
  const auto folder = path.has_parent_path() ? path.parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".csv") names.push_back(entry.path().filename().string());
  }
  const std::string near(near_miss(path.filename().string(), names));
  throw UserError(place, "there is no file '" + path.string() + "'",
                  near.empty() ? "name a CSV file, relative to the scene's folder"
                               : "did you mean '" + near + "'?");
}

/// Reads the scene's start state, and changes the name of its file to be relative to the working
/// directory.
void load_start_state(Scene& scene, const toml::table& root, const std::string& file,
                      Origin origin) {
  Start& start = scene.particles.start;
  const Place place = place_of(root, "particles.start.file", file);
  // A name in an override is relative to the working directory, not to the scene.
  const bool typed = from_override(place);
  std::filesystem::path path = start.file;
  if (!typed && origin == Origin::Folder) path = std::filesystem::path(file).parent_path() / path;
  const EmbeddedFile* embedded = find_embedded(embedded_start_states(), start.file);
  if ((typed || origin == Origin::Folder) && is_file(path)) {
    start.file = path.string();
    const std::string csv = read_file(start.file, kLargestState, "write one line per particle");
    start.state = parse_state(csv, start.file, scene);
  } else if (embedded) {
    start.state = parse_state(embedded->bytes, start.file, scene);
  } else {
    refuse_missing_state(place, path);
  }
  start.temperature = std::visit(
      [&]<int D>(State<D> state) {
        add_flow(state, model_of<D>(scene, 0).domain(), -1.0);
        return temperature_of(state);
      },
      start.state);
}

/// Dimension of a document's box: 3 if its size has three numbers, otherwise 2.
int dimension_of(const toml::table& root) {
  const toml::array* size = root.at_path("box.size").as_array();
  return size && size->size() == 3 ? 3 : 2;
}

void check_dimension(const toml::table& root, const std::string& file) {
  const toml::array* size = root.at_path("box.size").as_array();
  if (!size || size->size() == 2 || size->size() == 3) return;
  throw UserError(place_of(root, "box.size", file),
                  "'box.size' has " + counted(size->size(), "number"),
                  "give two numbers for disks, or three for spheres");
}

SceneInput read_keys(const toml::table& root, const std::string& file, bool spins) {
  SceneInput input;
  input.spins = spins;
  input.scene = default_scene(dimension_of(root));
  input.species_names = species_names(root);
  KeyReader reader(root, file);
  visit_scene(reader, input);
  for (const SpeciesInput& one : input.species) input.scene.species.push_back(one.species);
  return input;
}

/// The validated scene of a document. `load_state` reads the start state of layout File, unless
/// `start_file` is Skip.
Scene read_scene(const toml::table& root, const std::string& file, StartFile start_file,
                 const std::function<void(Scene&)>& load_state) {
  check_dimension(root, file);
  check_species_count(root, file);
  SceneInput any;
  any.scene = default_scene(dimension_of(root));
  any.species_names = species_names(root);
  KeyLister lister;
  visit_scene(lister, any);
  refuse_unknown_keys(root, lister.keys());

  SceneInput input = read_keys(root, file, true);
  // The existence of spins is known only after all keys are read. Without spins a second pass
  // rejects their keys.
  if (!input.scene.spins()) input = read_keys(root, file, false);
  Scene& scene = input.scene;
  if (scene.gravity && !root.at_path("measure.profile_axis")) {
    Eigen::Index axis = 0;
    scene.gravity->cwiseAbs().maxCoeff(&axis);
    scene.measure.profile_axis = static_cast<Axis>(axis);
  }
  check_species(input, root, file);
  resolve_species(input, root, file);
  check_fixtures(scene, root, file);
  check_scene(scene, root, file);
  const bool from_file = scene.particles.start.layout == Layout::File;
  if (from_file && start_file == StartFile::Skip) {
    scene.particles.count =
        scene.species.empty() ? input.count.value_or(0) : count_of(scene.species);
    return scene;
  }
  if (from_file) load_state(scene);
  scene.particles.count =
      scene.species.empty() ? resolve_count(input, root, file) : resolve_mixture(input, root, file);
  check_divider(scene, root, file);
  check_followed(scene, root, file);
  check_change_tables(scene, root, file);
  return scene;
}

/// Throws if a change of the scene results in an invalid scene, or is impossible during a run.
void check_changes(const Scene& scene, const toml::table& root, const std::string& file) {
  for (Schedule schedule(scene); schedule.next() < std::numeric_limits<double>::infinity();) {
    const std::size_t change = schedule.next_change();
    try {
      schedule.advance();
    } catch (const UserError& error) {
      throw UserError(place_of((*root["change"].as_array())[change], file),
                      "at this change " + error.problem(), error.advice());
    }
  }
}

[[noreturn]] void refuse_missing(const std::string& name) {
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

}  // namespace

Scene parse_scene(const SceneText& source, const std::vector<Override>& overrides,
                  StartFile start_file) {
  const std::string& file = source.file;
  toml::table root = parse_document(source.text, file);
  for (const Override& change : overrides) apply_override(root, change);
  const auto load_state = [&](Scene& read) { load_start_state(read, root, file, source.origin); };
  const Scene scene = read_scene(root, file, start_file, load_state);
  check_changes(scene, root, file);
  return scene;
}

Scene parse_scene(std::string_view text, const std::string& file,
                  const std::vector<Override>& overrides, StartFile start_file) {
  return parse_scene({std::string(text), file}, overrides, start_file);
}

// Removes colours and fields of spins.
static void hide_spins(Scene& scene) {
  scene.view.hide_spins();
  std::erase_if(scene.measure.fields, of_spins);
}

// The text of a scene, with or without the keys, colours and fields of spins.
template <class Writer>
static std::string written(const Scene& scene, bool spins) {
  SceneInput input;
  input.spins = spins;
  input.scene = scene;
  if (scene.species.empty()) input.count = scene.particles.count;
  for (const Species& one : scene.species) {
    input.species.push_back({.count = one.count, .packing_fraction = {}, .species = one});
  }
  input.species_names = names_of(scene.species);
  if (!spins) hide_spins(input.scene);
  Writer writer;
  visit_scene(writer, input);
  return writer.text();
}

// Restores colours and fields of spins that hide_spins() has removed from a scene, unless settings
// have replaced them.
static void keep_hidden(Scene& made, const Scene& scene) {
  Scene hidden = scene;
  hide_spins(hidden);
  const auto keep = [](auto& value, const auto& without, const auto& with) {
    if (value == without) value = with;
  };
  keep(made.view.colour_by, hidden.view.colour_by, scene.view.colour_by);
  keep(made.view.field, hidden.view.field, scene.view.field);
  keep(made.measure.fields, hidden.measure.fields, scene.measure.fields);
}

Scene with_settings(const Scene& scene, const std::vector<Override>& settings) {
  const auto document = [&](bool spins) {
    toml::table root = parse_document(written<TomlWriter>(scene, spins), "");
    root.erase("change");
    for (const Override& setting : settings) apply_override(root, setting);
    return root;
  };
  // Without spins the keys of spins are forbidden, but the scene keeps their values for later.
  toml::table root = document(scene.spins());
  const bool spins = read_keys(root, "", true).scene.spins();
  if (spins != scene.spins()) root = document(spins);
  const Start& start = scene.particles.start;
  const bool skipped = start.layout == Layout::File && particle_count(start.state) == 0;
  const auto keep_state = [&](Scene& read) { read.particles.start.state = start.state; };
  Scene made = read_scene(root, "", skipped ? StartFile::Skip : StartFile::Read, keep_state);
  if (made.particles.start.layout == Layout::File)
    made.particles.start.temperature = start.temperature;
  if (!spins) {
    made.particles.inertia = scene.particles.inertia;
    made.particles.start.spin_temperature = start.spin_temperature;
    for (std::size_t k = 0; k < std::min(made.species.size(), scene.species.size()); ++k) {
      made.species[k].inertia = scene.species[k].inertia;
    }
    if (made.bulk_drive && scene.bulk_drive)
      made.bulk_drive->kick_spin = scene.bulk_drive->kick_spin;
    keep_hidden(made, scene);
  }
  made.changes = scene.changes;
  return made;
}

std::vector<Override> fixture_settings(const Scene& scene) {
  const toml::table root = parse_document(scene_to_toml(scene), "");
  std::vector<Override> settings;
  for (const char* const list : {"obstacle", "partition"}) {
    const toml::node* items = root.get(list);
    settings.push_back({list, items ? toml_text(*items) : "[]"});
  }
  return settings;
}

Scene load_gallery_scene(const EmbeddedFile& scene, const std::vector<Override>& overrides) {
  return parse_scene({std::string(scene.bytes), std::string(scene.name), Origin::Gallery},
                     overrides);
}

SceneText find_scene(const std::string& path_or_name) {
  if (is_file(path_or_name)) {
    return {read_file(path_or_name, kLargestScene, "a scene is a text of a few kB"), path_or_name};
  }
  for (const std::string& name : {path_or_name, path_or_name + ".toml"}) {
    const EmbeddedFile* scene = find_embedded(embedded_scenes(), name);
    if (scene) return {std::string(scene->bytes), name, Origin::Gallery};
  }
  std::error_code error;
  if (std::filesystem::is_directory(path_or_name, error)) {
    throw UserError({path_or_name}, "this is a directory", "give a scene file in it");
  }
  if (error == std::errc::permission_denied) {
    throw UserError({path_or_name}, "the folder cannot be read", "check its permissions");
  }
  refuse_missing(path_or_name);
}

Scene load_scene(const std::string& path_or_name, const std::vector<Override>& overrides,
                 StartFile start_file) {
  return parse_scene(find_scene(path_or_name), overrides, start_file);
}

std::string scene_to_toml(const Scene& scene) {
  return written<TomlWriter>(scene, scene.spins());
}

std::string scene_to_json(const Scene& scene) {
  return written<JsonWriter>(scene, scene.spins());
}

}  // namespace clatter
