#include "app/film/compared_scenes.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "app/runs/picture_scene.h"
#include "engine/error.h"
#include "engine/scene/scene_differences.h"
#include "engine/scene/scene_file.h"
#include "engine/text.h"

namespace clatter {

namespace {

// The scene of `run` with a further setting. Errors name --compare.
Scene load_with(CommonOptions run, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw UserError({"--compare " + setting, 0, 0}, "no value is set",
                    "write --compare KEY=VALUE, for example --compare particles.restitution=1");
  }
  const std::string key = setting.substr(0, equals);
  run.settings.push_back(setting);
  try {
    return load(run);
  } catch (const UserError& error) {
    if (!std::string_view(error.what()).starts_with("--set " + key)) throw;
    throw UserError({"--compare " + key, 0, 0}, error.problem(), error.advice());
  }
}

std::string letter(std::size_t number) {
  return std::string(1, static_cast<char>('A' + number));
}

}  // namespace

std::vector<ComparedScene> compared_scenes(ComparedScene first, const CompareOptions& compare,
                                           const CommonOptions& run, bool one_seed) {
  const std::uint64_t seed = first.seed;
  std::vector<ComparedScene> scenes = {std::move(first)};
  for (const std::string& other : compare.scenes) {
    CommonOptions own = run;
    own.scene = other;
    const std::optional<std::uint64_t> in_picture = seed_of_picture(other);
    scenes.push_back({load(own), one_seed ? seed : in_picture.value_or(seed)});
  }
  for (const std::string& setting : compare.settings) {
    scenes.push_back({load_with(run, setting), seed});
  }
  return scenes;
}

std::vector<std::filesystem::path> inputs_of(const CompareOptions& compare,
                                             const std::vector<ComparedScene>& scenes) {
  std::vector<std::filesystem::path> inputs(compare.scenes.begin(), compare.scenes.end());
  for (std::size_t number = 1; number < scenes.size(); ++number) {
    inputs.emplace_back(scenes[number].scene.particles.start.file);
  }
  return inputs;
}

namespace {

// A TOML value without quotes, and with numbers as a person writes them: 1 for 1.0.
std::string plain(const std::string& value) {
  std::string text;
  bool in_name = false;
  for (const char* at = value.c_str(); *at != '\0';) {
    char* after = nullptr;
    const double number = std::strtod(at, &after);
    if (!in_name && after != at && *at != ' ') {
      text += number_text(number);
      at = after;
      continue;
    }
    in_name = std::isalnum(static_cast<unsigned char>(*at)) != 0 || *at == '_';
    if (*at != '"' && *at != '\'') text += *at;
    ++at;
  }
  return text;
}

constexpr std::string_view kChanges = "change";

// "restitution 1", "no friction", "walls left drive speed 2", "with changes".
std::string in_words_with(const std::string& key, const std::string& value) {
  if (key == kChanges) return value.empty() ? "without changes" : "with changes";
  constexpr std::string_view kParticles = "particles.";
  std::string name = in_words(key.starts_with(kParticles) ? key.substr(kParticles.size()) : key);
  std::ranges::replace(name, '.', ' ');
  return value.empty() ? "no " + name : name + ' ' + plain(value);
}

// The keys that name a cell: not the texts of the scene, and not the settings of measurements.
bool names_cell(const std::string& key) {
  return key == kChanges || (key.find('.') != std::string::npos && !key.starts_with("measure."));
}

// The keys in which some scenes differ, each with its values in these scenes.
std::map<std::string, std::vector<std::string>> different_values(
    const std::vector<const Scene*>& scenes) {
  std::map<std::string, std::vector<std::string>> values;
  const std::string first = scene_to_toml(*scenes.front());
  for (std::size_t number = 1; number < scenes.size(); ++number) {
    for (const KeyDifference& key : differences(first, scene_to_toml(*scenes[number]), "")) {
      if (!names_cell(key.key)) continue;
      auto& all = values[key.key];
      all.resize(scenes.size(), key.before);
      all[number] = key.now;
    }
  }
  return values;
}

// What distinguishes the scene `number` from those of the same title.
std::vector<std::string> own_values(const std::vector<ComparedScene>& scenes, std::size_t number) {
  constexpr std::size_t kMostKeys = 3;
  std::vector<const Scene*> alike;
  std::size_t place = 0;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    if (k == number) place = alike.size();
    if (scenes[k].scene.title == scenes[number].scene.title) alike.push_back(&scenes[k].scene);
  }
  std::vector<std::string> words;
  for (const auto& [key, values] : different_values(alike)) {
    if (words.size() < kMostKeys) words.push_back(in_words_with(key, values[place]));
  }
  return words;
}

}  // namespace

std::vector<std::string> cell_titles(const std::vector<ComparedScene>& scenes) {
  const ComparedScene& first = scenes.front();
  const bool one_title = std::ranges::all_of(scenes, [&](const ComparedScene& compared) {
    return compared.scene.title == first.scene.title;
  });
  const bool one_seed = std::ranges::all_of(
      scenes, [&](const ComparedScene& compared) { return compared.seed == first.seed; });
  std::vector<std::string> titles;
  for (std::size_t number = 0; number < scenes.size(); ++number) {
    std::vector<std::string> parts;
    if (!one_title) parts.push_back(scenes[number].scene.title);
    if (!one_seed) parts.push_back("seed " + std::to_string(scenes[number].seed));
    for (std::string& words : own_values(scenes, number)) parts.push_back(std::move(words));
    std::string title = letter(number);
    for (const std::string& part : parts) title += (title.size() == 1 ? ": " : ", ") + part;
    titles.push_back(std::move(title));
  }
  return titles;
}

std::vector<PngText> picture_texts(const std::vector<ComparedScene>& scenes) {
  std::vector<PngText> texts = picture_texts(scenes.front().scene, scenes.front().seed);
  for (std::size_t number = 1; number < scenes.size(); ++number) {
    texts.push_back({"Seed " + letter(number), std::to_string(scenes[number].seed)});
    texts.push_back({"Scene " + letter(number), scene_to_toml(scenes[number].scene)});
  }
  return texts;
}

}  // namespace clatter
