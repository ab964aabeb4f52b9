#include "app/sweep/sweep_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "app/results/hdf5_writer.h"
#include "engine/error.h"
#include "engine/statistics/estimate.h"
#include "engine/system/read_file.h"
#include "engine/system/write_file.h"
#include "engine/text.h"

namespace clatter {

namespace {

using Json = nlohmann::ordered_json;
using Replicas = std::vector<Json>;  // results of the same point

constexpr std::size_t kLargestResult = 4'000'000'000;

// A value of a setting. TOML and JSON have the same numbers, texts and lists.
Json value_of_setting(const std::string& toml) {
  Json value = Json::parse(toml, nullptr, /*allow_exceptions=*/false);
  return value.is_number() || value.is_string() ? value : Json(toml);
}

double root_of_squares(const std::vector<double>& errors) {
  double sum = 0.0;
  for (const double error : errors) sum += error * error;
  return std::sqrt(sum);
}

// The numbers at a place in all replicas. Empty if a replica has none.
std::vector<double> numbers_at(const Replicas& replicas, const Json::json_pointer& place) {
  std::vector<double> numbers;
  for (const Json& result : replicas) {
    if (!result.contains(place) || !result.at(place).is_number()) return {};
    numbers.push_back(result.at(place).get<double>());
  }
  return numbers;
}

// A mean over replicas. Its standard error is that between replicas. The error from correlations in
// time is in the next column; a single replica has this error only.
void add_mean(Json& row, const std::string& name, const std::vector<double>& means,
              const std::vector<double>& errors) {
  const Estimate between = independent_estimate(means);
  const double blocked = root_of_squares(errors) / static_cast<double>(means.size());
  row[name] = between.mean;
  row[name + "_standard_error"] = means.size() > 1 ? between.standard_error : blocked;
  if (means.size() > 1) row[name + "_blocking_error"] = blocked;
}

// The name of an item of a list: of a species its name, of a pair "small+large"; empty without one.
std::string name_of_item(const Json& item) {
  if (!item.is_object()) return {};
  if (item.contains("name")) return item.at("name");
  const auto pair = item.find("species");
  if (pair == item.end() || pair->size() != 2) return {};
  return pair->at(0).get<std::string>() + '+' + pair->at(1).get<std::string>();
}

// All objects with a mean and a standard error, below `place`.
void add_means(Json& row, const Replicas& replicas, const std::string& name,
               const Json::json_pointer& place) {
  for (const auto& [key, value] : replicas.front().at(place).items()) {
    if (!value.is_structured() || key == "scene" || key == "profile" || key == "theory") continue;
    const std::string item = name_of_item(value), last = item.empty() ? key : item;
    const std::string path = name.empty() ? last : name + '.' + last;
    const std::vector<double> means = numbers_at(replicas, place / key / "mean");
    const std::vector<double> errors = numbers_at(replicas, place / key / "standard_error");
    if (!means.empty() && !errors.empty()) {
      // A setting may have the name of a mean, as piston.position has.
      add_mean(row, row.contains(path) ? path + ".mean" : path, means, errors);
    } else {
      add_means(row, replicas, path, place / key);
    }
  }
}

// The numbers below `place`, each combined over the replicas.
template <class Combine>
void add_numbers(Json& row, const Replicas& replicas, const std::string& name,
                 const Json::json_pointer& place, Combine combine) {
  for (const auto& [key, value] : replicas.front().at(place).items()) {
    const std::string item = name_of_item(value);
    const std::string path = name + '.' + (item.empty() ? key : item);
    const std::vector<double> numbers = numbers_at(replicas, place / key);
    if (!numbers.empty()) {
      row[path] = combine(numbers);
    } else if (value.is_structured()) {
      add_numbers(row, replicas, path, place / key, combine);
    }
  }
}

// The same of a group such as "events".
template <class Combine>
void add_group(Json& row, const Replicas& replicas, const std::string& group, Combine combine) {
  const auto found = replicas.front().find(group);
  if (found == replicas.front().end()) return;
  add_numbers(row, replicas, group, Json::json_pointer("/" + group), combine);
}

Json sum_of(const std::vector<double>& numbers) {
  double sum = 0.0;
  for (const double number : numbers) sum += number;
  return sum;
}

// Counts of events are whole numbers.
Json count_of(const std::vector<double>& numbers) {
  return static_cast<std::uint64_t>(sum_of(numbers).get<double>());
}

Json largest_of(const std::vector<double>& numbers) {
  return *std::ranges::max_element(numbers, {}, [](double x) { return std::fabs(x); });
}

Json first_of(const std::vector<double>& numbers) {
  return numbers.front();
}

Json row_of(const SweepPoint& point, const Replicas& replicas) {
  Json row;
  for (const Override& setting : point) row[setting.key] = value_of_setting(setting.value);
  row["replicas"] = replicas.size();
  add_means(row, replicas, "", Json::json_pointer());
  row["time.measured"] = sum_of(numbers_at(replicas, Json::json_pointer("/time/measured")));
  add_group(row, replicas, "events", count_of);
  add_group(row, replicas, "checks", largest_of);
  add_group(row, replicas, "balance", largest_of);
  add_group(row, replicas, "theory", first_of);
  const std::vector<double> reached = numbers_at(replicas, Json::json_pointer("/accuracy/reached"));
  if (!reached.empty()) row["accuracy.reached"] = largest_of(reached);
  const auto joined = [&](const char* key) {
    std::string text;
    for (const Json& result : replicas) {
      const Json& value = result.at(key);
      text +=
          (text.empty() ? "" : " ") + (value.is_string() ? value.get<std::string>() : value.dump());
    }
    return text;
  };
  row["seeds"] = joined("seed");
  row["state_hashes"] = joined("state_hash");
  row["program"] = replicas.front().at("program");
  return row;
}

// A number of a profile; null without particles.
double number_in(const Json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

Json number_or_null(double number) {
  return std::isfinite(number) ? Json(number) : Json(nullptr);
}

// The mean of the profiles of all replicas, over those with particles in a cell.
Json mean_profile(const Replicas& replicas) {
  const Json& first = replicas.front();
  if (!first.contains("profile")) return nullptr;
  Json profile = first.at("profile");
  if (replicas.size() == 1) return profile;
  for (const auto& [name, errors] : first.at("profile").at("standard_error").items()) {
    for (std::size_t cell = 0; cell < errors.size(); ++cell) {
      std::vector<double> means;
      for (const Json& result : replicas) {
        const double mean = number_in(result.at("profile").at(name).at(cell));
        if (std::isfinite(mean)) means.push_back(mean);
      }
      const Estimate estimate = means.empty() ? Estimate{.mean = NAN} : independent_estimate(means);
      profile[name][cell] = number_or_null(estimate.mean);
      profile["standard_error"][name][cell] = number_or_null(estimate.standard_error);
    }
  }
  return profile;
}

[[noreturn]] void refuse_damaged(const std::string& file) {
  throw RunError(file + " is damaged; remove it, and start the sweep again");
}

Json read_result(const std::filesystem::path& file, std::uint64_t seed) {
  Json result = Json::parse(read_file(file.string(), kLargestResult, ""), nullptr, false);
  const bool is_complete = result.is_object() && result.value("seed", Json()) == Json(seed) &&
                           result.contains("state_hash") && result.contains("program");
  if (!is_complete) refuse_damaged(file.string());
  return result;
}

std::string csv_cell(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_number_float()) return number_text(value.get<double>());
  if (!value.is_string()) return value.dump();
  const std::string& text = value.get_ref<const std::string&>();
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string quoted;
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return '"' + quoted + '"';
}

std::string csv_of(const SweepTable& table) {
  std::string csv;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    csv += (k > 0 ? "," : "") + csv_cell(table.columns[k]);
  }
  csv += '\n';
  for (const Json& row : table.rows) {
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      const auto cell = row.find(table.columns[k]);
      csv += (k > 0 ? "," : "") + (cell == row.end() ? "" : csv_cell(*cell));
    }
    csv += '\n';
  }
  return csv;
}

std::string json_lines_of(const SweepTable& table) {
  std::string lines;
  for (std::size_t p = 0; p < table.rows.size(); ++p) {
    Json row = table.rows[p];
    if (!table.profiles[p].is_null()) row["profile"] = table.profiles[p];
    lines += row.dump() + '\n';
  }
  return lines;
}

void write_texts(const H5::Group& group, const std::string& name,
                 const std::vector<std::string>& texts) {
  std::vector<const char*> bytes;
  for (const std::string& text : texts) bytes.push_back(text.c_str());
  const H5::DataSet dataset =
      group.createDataSet(name, text_type(), space_of({texts.size()}), dataset_properties());
  if (!texts.empty()) dataset.write(bytes.data(), text_type());
}

void write_column(const H5::Group& group, const SweepTable& table, const std::string& name) {
  std::vector<double> numbers;
  std::vector<std::string> texts;
  for (const Json& row : table.rows) {
    const Json value = row.value(name, Json(nullptr));
    numbers.push_back(number_in(value));
    texts.push_back(value.is_string() ? value.get<std::string>() : csv_cell(value));
  }
  const bool is_text = std::ranges::any_of(
      table.rows, [&](const Json& row) { return row.value(name, Json(nullptr)).is_string(); });
  if (is_text) {
    write_texts(group, name, texts);
  } else {
    write_dataset(group, name, "", numbers);
  }
}

// Lists of all points as one array. Shorter lists are filled with NaN.
void write_lists(const H5::Group& group, const std::string& name,
                 const std::vector<const Json*>& lists) {
  std::size_t longest = 0;
  for (const Json* list : lists) longest = std::max(longest, list ? list->size() : 0);
  std::vector<double> values;
  for (const Json* list : lists) {
    for (std::size_t k = 0; k < longest; ++k) {
      values.push_back(list && k < list->size() ? number_in(list->at(k)) : NAN);
    }
  }
  write_dataset(group, name, "", values, {lists.size(), longest});
}

void write_profiles(const H5::Group& group, const SweepTable& table) {
  std::vector<std::string> names;
  std::vector<std::string> axes;
  for (const Json& profile : table.profiles) {
    axes.push_back(profile.is_null() ? "" : profile.at("axis").get<std::string>());
    if (profile.is_null()) continue;
    for (const auto& [name, errors] : profile.at("standard_error").items()) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  const auto lists_at = [&](const Json::json_pointer& place) {
    std::vector<const Json*> lists;
    for (const Json& profile : table.profiles) {
      lists.push_back(profile.contains(place) ? &profile.at(place) : nullptr);
    }
    return lists;
  };
  write_texts(group, "axis", axes);
  write_lists(group, "edges", lists_at(Json::json_pointer("/edges")));
  const H5::Group errors = group.createGroup("standard_error");
  for (const std::string& name : names) {
    write_lists(group, name, lists_at(Json::json_pointer("/" + name)));
    write_lists(errors, name, lists_at(Json::json_pointer("/standard_error/" + name)));
  }
}

}  // namespace

SweepTable read_table(const SweepFolder& folder) {
  const std::vector<int> done = folder.done();
  const std::set<int> has_result(done.begin(), done.end());
  // Points in the order of their first run.
  std::map<std::string, std::size_t> index_of;
  std::vector<std::pair<SweepPoint, std::vector<SweepRun>>> points;
  for (const SweepRun& run : folder.runs()) {
    if (!has_result.contains(run.id)) continue;
    const auto [at, is_new] = index_of.emplace(settings_text(run.settings), points.size());
    if (is_new) points.push_back({run.settings, {}});
    points[at->second].second.push_back(run);
  }
  SweepTable table;
  std::set<std::string> known;
  for (const auto& [point, runs] : points) {
    Replicas replicas;
    for (const SweepRun& run : runs) {
      replicas.push_back(read_result(folder.result(run.id), run.seed));
    }
    table.points.push_back(point);
    try {
      table.rows.push_back(row_of(point, replicas));
      table.profiles.push_back(mean_profile(replicas));
    } catch (const Json::exception&) {
      std::string files;
      for (const SweepRun& run : runs) {
        files += (files.empty() ? "" : " or ") + folder.result(run.id).string();
      }
      refuse_damaged(files);
    }
    for (const auto& [name, value] : table.rows.back().items()) {
      if (known.insert(name).second) table.columns.push_back(name);
    }
  }
  return table;
}

void write_table(const SweepFolder& folder, const SweepTable& table) {
  write_file(folder.path() / "table.csv", csv_of(table));
  write_file(folder.path() / "table.jsonl", json_lines_of(table));
  write_hdf5(folder.path() / "table.h5", [&](const H5::H5File& file) {
    const H5::Group root = file.openGroup("/");
    for (const std::string& name : table.columns) write_column(root, table, name);
    const auto is_profile = [](const Json& profile) { return !profile.is_null(); };
    if (std::ranges::any_of(table.profiles, is_profile)) {
      write_profiles(file.createGroup("profile"), table);
    }
  });
}

}  // namespace clatter
