#include "app/sweep/sweep_folder.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "app/runs/picture_scene.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/error.h"
#include "engine/scene/scene_document.h"
#include "engine/system/read_file.h"
#include "engine/system/write_file.h"
#include "engine/text.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLargestFailure = 1'000'000;
constexpr std::size_t kLargestManifest = 1'000'000'000;

constexpr const char* kManifestAdvice = "restore the file, or start the sweep in another folder";

std::string line_of(const SweepRun& run) {
  Json settings = Json::object();
  for (const Override& setting : run.settings) settings[setting.key] = setting.value;
  return Json{{"id", run.id}, {"set", settings}, {"seed", run.seed}}.dump() + '\n';
}

// The run of a line of the manifest. `id` is the number of the line.
SweepRun run_in(const std::string& line, int id, const std::string& manifest) {
  try {
    const Json json = Json::parse(line);
    SweepRun run{json.at("id"), {}, json.at("seed")};
    for (const auto& [key, value] : json.at("set").items()) run.settings.push_back({key, value});
    if (run.id == id) return run;
  } catch (const nlohmann::json::exception&) {  // reported below
  }
  throw RunError(
      fmt::format("{} is damaged: line {} is not run {}; {}", manifest, id, id, kManifestAdvice));
}

// The same text for the same run, in any order of the axes.
std::string identity(SweepPoint settings, std::uint64_t seed) {
  std::ranges::sort(settings, {}, &Override::key);
  return settings_text(settings) + " seed=" + std::to_string(seed);
}

// The settings of a point in the order of another point with the same keys.
SweepPoint in_order_of(const SweepPoint& other, const SweepPoint& point) {
  SweepPoint ordered;
  for (const Override& setting : other) {
    ordered.push_back(*std::ranges::find(point, setting.key, &Override::key));
  }
  return ordered;
}

bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

// Whether a folder is absent or empty, or has a sweep, which may have been killed while it made the
// folder. The folder of the locks is made first.
bool can_hold_sweep(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder, ignored)) return true;
  if (is_file(folder / "manifest.jsonl") || is_file(folder / "runs/locks")) return true;
  if (!std::filesystem::is_directory(folder, ignored)) return false;
  return std::ranges::all_of(std::filesystem::directory_iterator(folder, ignored),
                             [](const auto& entry) { return entry.path().filename() == "runs"; });
}

// A scene beside the sweep file has precedence over the gallery.
SceneText scene_of(const Sweep& sweep, const std::string& sweep_file) {
  const auto beside = std::filesystem::path(sweep_file).parent_path() / sweep.scene;
  if (is_file(beside)) return find_any_scene(beside.string());
  SceneText scene;
  try {
    scene = find_any_scene(sweep.scene);
  } catch (const UserError& error) {
    throw UserError({sweep_file}, "the scene '" + sweep.scene + "': " + error.problem(),
                    error.advice());
  }
  if (scene.origin == Origin::Gallery) return scene;
  throw UserError({sweep_file}, "the scene '" + sweep.scene + "' is not in the folder of this file",
                  "give its path from there");
}

// Names in the folder of a sweep that a start file cannot have.
constexpr std::array<std::string_view, 10> kOwnNames = {
    "scene.toml", "sweep.toml", "manifest.jsonl", "runs",     "results",
    "failed",     "table.csv",  "table.jsonl",    "table.h5", "slurm"};

// A file that every run needs, with its name in the sweep's folder.
struct Input {
  std::filesystem::path name;
  std::string bytes;
};

// The scene and, if it lies beside the scene, its start file.
std::vector<Input> inputs_of(const SceneText& scene) {
  std::vector<Input> inputs = {{"scene.toml", scene.text}};
  const toml::table root = parse_document(scene.text, scene.file);
  const std::filesystem::path name = root.at_path("particles.start.file").value_or(std::string());
  const auto file = std::filesystem::path(scene.file).parent_path() / name;
  if (scene.origin == Origin::Gallery || name.empty() || name.is_absolute() || !is_file(file)) {
    return inputs;
  }
  const std::filesystem::path first = *name.lexically_normal().begin();
  const Place place = place_of(root, "particles.start.file", scene.file);
  if (first == "..") {
    throw UserError(place, "the start file is not below the folder of the scene",
                    "copy it there, or give its absolute path");
  }
  if (std::ranges::find(kOwnNames, first) != std::end(kOwnNames)) {
    throw UserError(place, "the folder of a sweep has its own " + in_quotes(first.string()),
                    "rename the start file, or give its absolute path");
  }
  inputs.push_back({name, read_file(file.string(), std::numeric_limits<int>::max(), "")});
  return inputs;
}

// Throws if the folder cannot continue with this sweep file.
void require_same_sweep(const SweepFolder& folder, const Sweep& sweep,
                        const std::vector<Input>& inputs, const std::string& file) {
  const auto refuse = [&](const std::string& difference) {
    throw UserError({file}, folder.path().string() + " has runs with " + difference,
                    "give another folder as --out");
  };
  for (const Input& input : inputs) {
    const auto copy = folder.path() / input.name;
    if (!is_file(copy) ||
        read_file(copy.string(), std::numeric_limits<int>::max(), "") != input.bytes) {
      refuse("another scene");
    }
  }
  const Sweep before = folder.sweep();
  const auto sorted = [](std::vector<std::string> keys) {
    std::ranges::sort(keys);
    return keys;
  };
  if (identity(before.set, 0) != identity(sweep.set, 0)) refuse("other settings in [set]");
  if (sorted(before.axes()) != sorted(sweep.axes())) refuse("other axes");
  if (before.accuracy.relative != sweep.accuracy.relative ||
      before.accuracy.of != sweep.accuracy.of)
    refuse("another 'accuracy'");
  if (before.until != sweep.until) refuse("another 'until'");
}

}  // namespace

bool SweepFailure::is_final() const {
  return code == kPhysicalStop;
}

SweepFolder::SweepFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
  if (is_file(folder_ / "manifest.jsonl")) return;
  throw UserError({folder_.string()}, "this is not the folder of a sweep",
                  "start one with `clatter sweep FILE --out DIR`");
}

SweepFolder SweepFolder::make(const std::string& text, const std::string& file,
                              const std::filesystem::path& folder) {
  const Sweep sweep = read_sweep(text, file);
  const SceneText scene = scene_of(sweep, file);
  check_entries(sweep, scene, text, file);
  const std::vector<Input> inputs = inputs_of(scene);
  if (!can_hold_sweep(folder)) {
    throw UserError({"--out", 0, 0}, folder.string() + " exists and is not the folder of a sweep",
                    "give another name");
  }
  for (const auto& place : {folder, folder / "runs"}) make_folder(place, "--out");
  SweepFolder made;
  made.folder_ = folder;
  if (!made.lock(0)) {
    throw UserError({"--out", 0, 0}, "another sweep runs in " + folder.string(),
                    "wait for its end, or give another folder");
  }
  for (const char* inner : {"results", "failed"}) make_folder(folder / inner, "--out");
  if (!made.runs().empty()) {
    require_same_sweep(made, sweep, inputs, file);
  } else {
    std::error_code ignored;
    for (const Input& input : inputs) {
      std::filesystem::create_directories((folder / input.name).parent_path(), ignored);
      write_file(folder / input.name, input.bytes);
    }
  }
  write_file(folder / "sweep.toml", text);
  made.add(sweep.points(), sweep.seeds);
  return made;
}

Sweep SweepFolder::sweep() const {
  const std::string file = folder_ / "sweep.toml";
  return read_sweep(sweep_text(file), file);
}

std::vector<SweepRun> SweepFolder::runs() const {
  const std::string manifest = folder_ / "manifest.jsonl";
  // Before the manifest is read, because another process may add runs.
  int last = 0;
  for (const auto& ids : {ids_in("results", ".json"), failed(), ids_in("runs", ".checkpoint")}) {
    if (!ids.empty()) last = std::max(last, ids.back());
  }
  std::vector<SweepRun> runs;
  if (is_file(manifest)) {
    std::istringstream lines(read_file(manifest, kLargestManifest, ""));
    for (std::string line; std::getline(lines, line);) {
      runs.push_back(run_in(line, static_cast<int>(runs.size()) + 1, manifest));
    }
  }
  if (last <= static_cast<int>(runs.size())) return runs;
  throw RunError(fmt::format("{} is damaged: it has no run {}, which has begun; {}", manifest, last,
                             kManifestAdvice));
}

SweepRun SweepFolder::run(int id) const {
  const std::string manifest = folder_ / "manifest.jsonl";
  std::istringstream lines(read_file(manifest, kLargestManifest, ""));
  std::string line;
  for (int k = 0; k < id; ++k) {
    if (std::getline(lines, line)) continue;
    throw UserError({folder_.string()}, fmt::format("there is no run {}", id),
                    fmt::format("give a number from 1 to {}", k));
  }
  return run_in(line, id, manifest);
}

bool SweepFolder::has_result(int id) const {
  std::error_code error;
  return std::filesystem::file_size(result(id), error) > 0 && !error;
}

std::vector<int> SweepFolder::done() const {
  std::vector<int> ids = ids_in("results", ".json");
  std::erase_if(ids, [this](int id) { return !has_result(id); });
  return ids;
}

std::optional<SweepFailure> SweepFolder::failure(int id) const {
  const auto path = file("failed", id, ".json");
  if (!is_file(path)) return std::nullopt;
  try {
    const Json json = Json::parse(read_file(path.string(), kLargestFailure, ""));
    return SweepFailure{json.at("code"), json.at("reason")};
  } catch (const nlohmann::json::exception&) {
    return SweepFailure{kFailed, "unknown"};
  }
}

void SweepFolder::add(const std::vector<SweepPoint>& points,
                      const std::vector<std::uint64_t>& seeds) const {
  std::vector<SweepRun> runs = this->runs();
  std::set<std::string> known;
  std::string text;
  for (const SweepRun& run : runs) {
    known.insert(identity(run.settings, run.seed));
    text += line_of(run);
  }
  const std::size_t before = text.size();
  int id = static_cast<int>(runs.size());
  for (const SweepPoint& added : points) {
    // A longer file may have another order of the axes. Equal points need equal lines.
    const SweepPoint point = runs.empty() ? added : in_order_of(runs.front().settings, added);
    for (const std::uint64_t seed : seeds) {
      if (known.insert(identity(point, seed)).second) text += line_of({++id, point, seed});
    }
  }
  if (text.size() > before) write_file(folder_ / "manifest.jsonl", text);
}

void SweepFolder::publish(int id) const {
  rename_synced(part(id), result(id));
  forget_failure(id);
  std::error_code ignored;
  std::filesystem::remove(checkpoint(id), ignored);
  std::filesystem::remove(previous_checkpoint(checkpoint(id)), ignored);
}

void SweepFolder::fail(int id, const SweepFailure& failure) const {
  std::error_code ignored;
  std::filesystem::remove(part(id), ignored);
  write_file(file("failed", id, ".json"),
             Json{{"code", failure.code}, {"reason", failure.reason}}.dump() + '\n');
}

void SweepFolder::forget_failure(int id) const {
  std::error_code ignored;
  std::filesystem::remove(file("failed", id, ".json"), ignored);
}

bool SweepFolder::lock(int id) {
  if (!locks_) {
    const auto path = folder_ / "runs/locks";
    locks_ = open_for_writing(path);
    if (!locks_) throw RunError("cannot write " + path.string() + ": " + std::strerror(errno));
  }
  // Such locks belong to the process, and closing the file in any way would end them: hence one
  // descriptor for all.
  if (locks_.lock_byte(static_cast<std::uint64_t>(id))) return true;
  if (errno == EACCES || errno == EAGAIN) return false;
  fail_to_lock();
}

void SweepFolder::unlock(int id) {
  if (!locks_.unlock_byte(static_cast<std::uint64_t>(id))) fail_to_lock();
}

void SweepFolder::fail_to_lock() const {
  throw RunError("cannot lock " + (folder_ / "runs/locks").string() + ": " + std::strerror(errno) +
                 "; put the folder on a file system with locks");
}

std::filesystem::path SweepFolder::file(const char* folder, int id, const char* suffix) const {
  return folder_ / folder / (std::to_string(id) + suffix);
}

std::vector<int> SweepFolder::ids_in(const char* folder, const char* suffix) const {
  std::vector<int> ids;
  std::error_code error;
  const std::filesystem::directory_iterator entries(folder_ / folder, error);
  if (error && error != std::errc::no_such_file_or_directory) {
    throw RunError("cannot read " + (folder_ / folder).string() + ": " + error.message());
  }
  for (const auto& entry : entries) {
    const auto id = whole_number<int>(entry.path().stem().string());
    if (id && *id > 0 && entry.path() == file(folder, *id, suffix)) ids.push_back(*id);
  }
  std::ranges::sort(ids);
  return ids;
}

}  // namespace clatter
