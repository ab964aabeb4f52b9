#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/sweep/sweep_folder.h"

namespace clatter {

/// The results of a sweep: a row per point, in the order of the manifest. A row is the mean over
/// the replicas that have a result. Points without any result have no row.
struct SweepTable {
  /// Settings, means and their errors, events, checks and theory, by their dotted names.
  std::vector<std::string> columns;
  /// [points] Settings.
  std::vector<SweepPoint> points;
  /// [points] Values by column: a number or a text. Absent where the point has no such value.
  std::vector<nlohmann::ordered_json> rows;
  /// [points] Profiles as in the result file. Null without a profile.
  std::vector<nlohmann::ordered_json> profiles;
};

/// Reads all results of a sweep. Throws RunError if a result is damaged.
SweepTable read_table(const SweepFolder& folder);

/// Writes the table into the folder of the sweep: table.csv, and with the profiles table.jsonl and
/// table.h5. Throws RunError.
void write_table(const SweepFolder& folder, const SweepTable& table);

}  // namespace clatter
