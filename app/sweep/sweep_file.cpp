#include "app/sweep/sweep_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "engine/error.h"
#include "engine/scene/key_reader.h"
#include "engine/scene/scene_document.h"
#include "engine/system/read_file.h"
#include "engine/text.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

// Largest number of runs of a sweep.
constexpr double kMostRuns = 1e5;

[[noreturn]] void refuse(const Place& place, const std::string& problem,
                         const std::string& advice) {
  throw UserError(place, problem, advice);
}

// A key with its place. TOML++ sorts the keys of a table by name.
struct Entry {
  std::string key;
  Place place;
  const toml::node* value;
};

// The entries of a table in the order of the file.
std::vector<Entry> entries_of(const toml::table& table, const std::string& file) {
  std::vector<Entry> entries;
  for (const auto& [key, value] : table) {
    const toml::source_position at = key.source().begin;
    entries.push_back({std::string(key.str()),
                       {file, static_cast<int>(at.line), static_cast<int>(at.column)},
                       &value});
  }
  std::ranges::sort(entries, {}, [](const Entry& entry) {
    return std::pair(entry.place.line, entry.place.column);
  });
  return entries;
}

// The entries of a table without nested tables: [axes.walls.left] has keys "walls.left...".
void flatten(const toml::table& table, const std::string& prefix, const std::string& file,
             std::vector<Entry>& flat) {
  for (const Entry& entry : entries_of(table, file)) {
    const toml::table* inner = entry.value->as_table();
    if (inner && !inner->is_inline()) {
      flatten(*inner, prefix + entry.key + '.', file, flat);
    } else {
      flat.push_back({prefix + entry.key, entry.place, entry.value});
    }
  }
}

std::vector<Entry> flat_entries(const toml::table& root, const char* table,
                                const std::string& file) {
  std::vector<Entry> flat;
  const toml::node* node = root.get(table);
  if (!node) return flat;
  if (!node->is_table()) {
    refuse(place_of(root, table, file), fmt::format("'{}' is not a table", table),
           fmt::format("write [{}] and below it keys of the scene", table));
  }
  flatten(*node->as_table(), "", file, flat);
  return flat;
}

// A range { from, to, count, scale } of an axis.
struct Range {
  double from = 0.0;
  double to = 0.0;
  int count = 0;
  bool logarithmic = false;
  bool whole = false;  // both ends are whole numbers, so that all values are
};

Range range_in(const Entry& axis, const std::string& file) {
  enum class Scale { Linear, Log };
  static constexpr std::array<std::pair<std::string_view, Scale>, 2> kScales = {
      {{"linear", Scale::Linear}, {"log", Scale::Log}}};
  const toml::table& table = *axis.value->as_table();
  refuse_unknown_keys(table, {"from", "to", "count", "scale"});
  for (const char* key : {"from", "to", "count"}) {
    if (table.contains(key)) continue;
    refuse(axis.place, fmt::format("the range of {} has no '{}'", in_quotes(axis.key), key),
           "write, say, { from = 0.5, to = 0.9, count = 5 }");
  }
  KeyReader reader(table, file);
  Range range;
  Scale scale = Scale::Linear;
  reader.value("from", range.from, Limits{});
  reader.value("to", range.to, Limits{});
  reader.value("count", range.count, between(1, static_cast<int>(kMostRuns)));
  reader.choice("scale", scale, kScales);
  range.logarithmic = scale == Scale::Log;
  range.whole = table.get("from")->is_integer() && table.get("to")->is_integer();
  if (range.logarithmic && !(range.from > 0.0 && range.to > 0.0)) {
    refuse(axis.place, "a logarithmic range needs positive ends",
           "give from and to greater than 0, or scale = \"linear\"");
  }
  return range;
}

// A value of a range; the ends are exact. 12 digits show 0.3 as 0.3.
std::string value_of(const Range& range, int index) {
  double value = range.from;
  if (index > 0 && index == range.count - 1) {
    value = range.to;
  } else if (index > 0) {
    const double share = static_cast<double>(index) / (range.count - 1);
    // Products of powers and shares stay finite where to / from or to - from do not.
    value = range.logarithmic ? std::pow(range.from, 1.0 - share) * std::pow(range.to, share)
                              : (1.0 - share) * range.from + share * range.to;
  }
  if (range.whole) return fmt::format("{:.0f}", value);
  const std::string text = fmt::format("{:.12g}", value);
  return text.find_first_of(".e") == text.npos ? text + ".0" : text;
}

// The values of an axis as TOML.
std::vector<std::string> values_of(const Entry& axis, const std::string& file) {
  std::vector<std::string> values;
  if (axis.value->is_table()) {
    const Range range = range_in(axis, file);
    for (int k = 0; k < range.count; ++k) values.push_back(value_of(range, k));
  } else if (const toml::array* list = axis.value->as_array()) {
    for (const toml::node& value : *list) values.push_back(toml_text(value));
  } else {
    refuse(axis.place, "the axis " + in_quotes(axis.key) + " has a single value",
           "give a list such as [0.8, 0.9], a range such as { from = 0.5, to = 0.9, count = 5 }, "
           "or move the key to [set]");
  }
  if (values.empty()) {
    refuse(axis.place, "the axis " + in_quotes(axis.key) + " has no values", "give at least one");
  }
  return values;
}

// Start files belong to the scene, because a sweep folder has one copy of them.
void require_no_start_file(const Entry& entry) {
  for (const char* key : {"particles", "particles.start", "particles.start.file"}) {
    if (entry.key != key) continue;
    refuse(entry.place, "a sweep cannot set " + in_quotes(key),
           "name the start file in the scene, and set single keys such as "
           "\"particles.start.temperature\"");
  }
}

// The groups of axes that vary together: those of `zip`, then all others alone. Groups are in the
// order of their first axis.
std::vector<std::vector<std::size_t>> groups_of(const toml::table& root,
                                                const std::vector<Entry>& axes,
                                                const std::string& file) {
  std::vector<std::size_t> leader(axes.size());
  for (std::size_t k = 0; k < axes.size(); ++k) leader[k] = k;
  const toml::node* zip = root.get("zip");
  const auto index_of = [&](const toml::node& name) {
    const std::string key(name.value_or(std::string_view()));
    const auto found = std::ranges::find(axes, key, &Entry::key);
    if (found == axes.end()) {
      refuse(place_of(name, file), toml_text(name) + " is not an axis", "name keys of [axes]");
    }
    return static_cast<std::size_t>(found - axes.begin());
  };
  std::set<std::size_t> zipped;
  if (zip && !zip->is_array()) {
    refuse(place_of(root, "zip", file), "'zip' is not a list",
           "give lists of axes that vary together");
  }
  if (zip) {
    for (const toml::node& names : *zip->as_array()) {
      if (!names.is_array() || names.as_array()->empty()) {
        refuse(place_of(names, file), "an item of 'zip' is not a list of axes",
               "write, say, zip = [[\"box.size\", \"particles.count\"]]");
      }
      std::size_t first = axes.size();
      for (const toml::node& name : *names.as_array()) first = std::min(first, index_of(name));
      for (const toml::node& name : *names.as_array()) {
        const std::size_t index = index_of(name);
        if (!zipped.insert(index).second) {
          refuse(place_of(name, file), toml_text(name) + " is in 'zip' twice", "remove one");
        }
        leader[index] = first;
      }
    }
  }
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < axes.size(); ++k) {
    if (leader[k] != k) continue;
    groups.emplace_back();
    for (std::size_t other = k; other < axes.size(); ++other) {
      if (leader[other] == k) groups.back().push_back(other);
    }
  }
  return groups;
}

// A key has one meaning in a sweep: [set] and [axes] give it once in all.
void require_distinct_keys(const std::vector<Entry>& set, const std::vector<Entry>& axes) {
  std::set<std::string> seen;
  for (const auto* entries : {&set, &axes}) {
    for (const Entry& entry : *entries) {
      if (seen.insert(entry.key).second) continue;
      refuse(entry.place, in_quotes(entry.key) + " is given twice", "remove one");
    }
  }
}

void read_axes(const toml::table& root, const std::string& file, Sweep& sweep) {
  const std::vector<Entry> axes = flat_entries(root, "axes", file);
  for (const Entry& axis : axes) require_no_start_file(axis);
  double runs = static_cast<double>(sweep.seeds.size());
  for (const std::vector<std::size_t>& group : groups_of(root, axes, file)) {
    std::vector<SweepPoint> entries;
    std::vector<std::string>& keys = sweep.groups.emplace_back();
    for (const std::size_t index : group) {
      const Entry& axis = axes[index];
      keys.push_back(axis.key);
      const std::vector<std::string> values = values_of(axis, file);
      if (entries.empty()) entries.resize(values.size());
      if (entries.size() != values.size()) {
        refuse(axis.place,
               fmt::format("the axis {} has {} values, and {} has {}", in_quotes(axis.key),
                           values.size(), in_quotes(keys.front()), entries.size()),
               "axes in one list of 'zip' need the same number of values");
      }
      for (std::size_t k = 0; k < values.size(); ++k) entries[k].push_back({axis.key, values[k]});
    }
    std::set<std::string> seen;
    for (const SweepPoint& entry : entries) {
      if (seen.insert(settings_text(entry)).second) continue;
      refuse(axes[group.front()].place, settings_text(entry) + " is given twice",
             "remove one, or write a range of decimals as from = 0.0");
    }
    runs *= static_cast<double>(entries.size());
    sweep.entries.push_back(std::move(entries));
  }
  if (runs > kMostRuns) {
    refuse(place_of(root, "axes", file), fmt::format("the sweep has {:.6g} runs", runs),
           fmt::format("give fewer values; a sweep has at most {:g} runs", kMostRuns));
  }
}

void read_seeds(const toml::table& root, const std::string& file, Sweep& sweep) {
  int replicas = 1;
  KeyReader(root, file).value("replicas", replicas, between(1, static_cast<int>(kMostRuns)));
  const toml::node* node = root.get("seeds");
  if (!node) {
    sweep.seeds.clear();
    for (int k = 1; k <= replicas; ++k) sweep.seeds.push_back(static_cast<std::uint64_t>(k));
    return;
  }
  const Place place = place_of(root, "seeds", file);
  if (root.contains("replicas")) {
    refuse(place, "both 'replicas' and 'seeds' are given",
           "give one of them; replicas = 3 means seeds = [1, 2, 3]");
  }
  sweep.seeds.clear();
  std::set<std::int64_t> seen;
  const toml::array* list = node->as_array();
  for (std::size_t k = 0; list && k < list->size(); ++k) {
    const auto seed = (*list)[k].value_exact<std::int64_t>();
    if (!seed || *seed < 0 || !seen.insert(*seed).second) {
      refuse(place_of((*list)[k], file), toml_text((*list)[k]) + " cannot be one of the seeds",
             "give different whole numbers of at least 0");
    }
    sweep.seeds.push_back(static_cast<std::uint64_t>(*seed));
  }
  if (sweep.seeds.empty())
    refuse(place, "'seeds' is no list of seeds", "write, say, seeds = [1, 2, 3]");
}

void read_accuracy(const toml::table& root, const std::string& file, Sweep& sweep) {
  KeyReader(root, file).value("accuracy_of", sweep.accuracy.of);
  const toml::node* node = root.get("accuracy");
  if (!node) {
    if (!root.contains("accuracy_of")) return;
    refuse(place_of(root, "accuracy_of", file), "'accuracy_of' without 'accuracy'",
           "add, say, accuracy = \"0.5%\"");
  }
  const std::string text = node->is_string() ? node->as_string()->get() : toml_text(*node);
  const std::optional<double> share = share_in(text);
  if (!share) {
    refuse(place_of(root, "accuracy", file), "'accuracy' cannot be " + toml_text(*node),
           "give a share such as \"0.5%\" or 0.005");
  }
  sweep.accuracy.relative = *share;
}

void read_refinement(const toml::table& root, const std::string& file, Sweep& sweep) {
  KeyReader reader(root, file);
  bool refine = false;
  Refinement refinement;
  reader.value("refine", refine);
  reader.value("budget", refinement.budget, between(1, kMostRuns), refine ? kRequired : kOptional);
  if (!refine) {
    if (!root.contains("budget")) return;
    refuse(place_of(root, "budget", file), "'budget' without 'refine'", "add refine = true");
  }
  const auto is_numeric = [](const SweepPoint& entry) {
    return entry.size() == 1 && real_number(entry.front().value);
  };
  const bool has_axis = !sweep.entries.empty() && sweep.entries.front().size() >= 3 &&
                        std::ranges::all_of(sweep.entries.front(), is_numeric);
  if (!has_axis) {
    refuse(place_of(root, "refine", file),
           "refinement needs a first axis of at least three numbers, outside of 'zip'",
           "begin [axes] with, say, \"particles.restitution\" = [0.5, 0.7, 0.9]");
  }
  const Entry first = flat_entries(root, "axes", file).front();
  sweep.logarithmic = first.value->is_table() && range_in(first, file).logarithmic;
  sweep.refinement = refinement;
}

}  // namespace

std::vector<std::string> Sweep::axes() const {
  std::vector<std::string> keys;
  for (const auto& group : groups) keys.insert(keys.end(), group.begin(), group.end());
  return keys;
}

std::vector<Override> Sweep::settings_at(const SweepPoint& point) const {
  std::vector<Override> settings = set;
  settings.insert(settings.end(), point.begin(), point.end());
  return settings;
}

std::vector<SweepPoint> Sweep::points() const {
  std::vector<SweepPoint> points = {{}};
  for (const std::vector<SweepPoint>& group : entries) {
    std::vector<SweepPoint> longer;
    longer.reserve(points.size() * group.size());
    for (const SweepPoint& point : points) {
      for (const SweepPoint& entry : group) {
        longer.push_back(point);
        longer.back().insert(longer.back().end(), entry.begin(), entry.end());
      }
    }
    points = std::move(longer);
  }
  return points;
}

std::string sweep_text(const std::string& file) {
  return read_file(file, 1'000'000, "a sweep is a text of a few kB");
}

Sweep read_sweep(const std::string& text, const std::string& file) {
  const toml::table root = parse_document(text, file);
  refuse_unknown_keys(root, {"scene", "replicas", "seeds", "accuracy", "accuracy_of", "until",
                             "set", "axes", "zip", "refine", "budget"});
  Sweep sweep;
  KeyReader reader(root, file);
  reader.value("scene", sweep.scene, {}, kRequired);
  reader.value("until", sweep.until, above(0.0));
  read_seeds(root, file, sweep);
  read_accuracy(root, file, sweep);
  const std::vector<Entry> set = flat_entries(root, "set", file);
  require_distinct_keys(set, flat_entries(root, "axes", file));
  for (const Entry& entry : set) {
    require_no_start_file(entry);
    sweep.set.push_back({entry.key, toml_text(*entry.value)});
  }
  read_axes(root, file, sweep);
  read_refinement(root, file, sweep);
  return sweep;
}

void check_entries(const Sweep& sweep, const SceneText& scene, const std::string& text,
                   const std::string& file) {
  const toml::table root = parse_document(text, file);
  std::vector<Entry> keys = flat_entries(root, "axes", file);
  for (const Entry& entry : flat_entries(root, "set", file)) keys.push_back(entry);
  // The error of a setting names its key. All other errors have the place of the changed axis.
  const auto test = [&](const SweepPoint& point, const std::string& changed) {
    try {
      parse_scene(scene, sweep.settings_at(point));
    } catch (const UserError& error) {
      const std::string_view message = error.what();
      Place place = {file};
      for (const Entry& entry : keys) {
        const bool named = message.starts_with("--set " + entry.key + ':');
        if (named || entry.key == changed) place = entry.place;
        if (named) break;
      }
      const std::string where = point.empty() ? "" : "at " + settings_text(point) + ": ";
      const std::string problem = message.starts_with("--set ") ? error.problem() : error.what();
      throw UserError(place, where + problem, error.what() == problem ? "" : error.advice());
    }
  };
  SweepPoint first;
  for (const auto& group : sweep.entries) {
    first.insert(first.end(), group.front().begin(), group.front().end());
  }
  test(first, "");
  std::size_t begin = 0;
  for (const std::vector<SweepPoint>& group : sweep.entries) {
    for (std::size_t k = 1; k < group.size(); ++k) {
      SweepPoint point = first;
      std::ranges::copy(group[k], point.begin() + static_cast<std::ptrdiff_t>(begin));
      test(point, group[k].front().key);
    }
    begin += group.front().size();
  }
}

std::string settings_text(const std::vector<Override>& settings) {
  std::string text;
  for (const Override& setting : settings) {
    text += (text.empty() ? "" : " ") + setting.key + '=' + setting.value;
  }
  return text;
}

}  // namespace clatter
