#include "app/results/csv_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "engine/scene/enum_names.h"
#include "engine/system/write_file.h"

namespace clatter {

static std::string series_table(const Measured& measured) {
  const std::vector<double>& spin = measured.series.spin_temperature;
  std::string table = std::string("# units, ") + kUnits + "; time: t, temperature: m a^2/t^2";
  table += spin.empty() ? "\n" : ", spin_temperature: m a^2/t^2\n";
  table += spin.empty() ? "time,temperature\n" : "time,temperature,spin_temperature\n";
  for (std::size_t k = 0; k < measured.series.times.size(); ++k) {
    fmt::format_to(std::back_inserter(table), "{:.17g},{:.17g}", measured.series.times[k],
                   measured.series.temperature[k]);
    if (!spin.empty()) fmt::format_to(std::back_inserter(table), ",{:.17g}", spin[k]);
    table += '\n';
  }
  return table;
}

static std::string profile_table(const Profile& profile) {
  const std::string axis(name_of(profile.axis, kAxes));
  std::string units = std::string("# units, ") + kUnits + "; " + axis + ": a";
  std::string header = axis + "_low," + axis + "_high";
  for (std::size_t f = 0; f < profile.fields.size(); ++f) {
    const std::string name = profile.name(f);
    units += ", " + name + ": " + unit_of(profile.fields[f].quantity, profile.dimension);
    header += "," + name + "," + name + "_error";
  }
  std::string table = units + "\n" + header + "\n";
  for (std::size_t i = 0; i + 1 < profile.edges.size(); ++i) {
    fmt::format_to(std::back_inserter(table), "{:.17g},{:.17g}", profile.edges[i],
                   profile.edges[i + 1]);
    for (const auto& column : profile.values) {
      fmt::format_to(std::back_inserter(table), ",{:.17g},{:.17g}", column[i].mean,
                     column[i].standard_error);
    }
    table += '\n';
  }
  return table;
}

// One line per cell, with the position of its centre.
static std::string maps_table(const FieldMaps& maps, const StopRequest& stop) {
  const std::vector<int>& cells = maps.maps.front().cells;
  std::string units = std::string("# units, ") + kUnits;
  std::string header;
  for (std::size_t axis = 0; axis < cells.size(); ++axis) {
    const std::string name(kAxes[axis].name);
    units += (axis == 0 ? "; " : ", ") + name + ": a";
    header += (axis == 0 ? "" : ",") + name;
  }
  for (const FieldMap& map : maps.maps) {
    const std::string name = name_of(map);
    units += ", " + name + ": " + unit_of(map.field.quantity, static_cast<int>(cells.size()));
    header += "," + name;
  }
  std::string table = units + "\n" + header + "\n";
  for (std::size_t cell = 0; cell < maps.maps.front().values.size(); ++cell) {
    stop.check();
    std::size_t rest = cell;
    for (std::size_t axis = 0; axis < cells.size(); ++axis) {
      const auto count = static_cast<std::size_t>(cells[axis]);
      const double middle = (static_cast<double>(rest % count) + 0.5) * maps.cell[axis];
      fmt::format_to(std::back_inserter(table), "{}{:.17g}", axis == 0 ? "" : ",", middle);
      rest /= count;
    }
    for (const FieldMap& map : maps.maps)
      fmt::format_to(std::back_inserter(table), ",{:.17g}", map.values[cell]);
    table += '\n';
  }
  return table;
}

// The table of an observable. Columns with errors have a second column for them.
static std::string observable_table(const ResultTable& table) {
  std::string units = std::string("# units, ") + kUnits;
  std::string header;
  for (const TableColumn& column : table.columns) {
    units += (header.empty() ? "; " : ", ") + column.name + ": " + column.unit;
    header += (header.empty() ? "" : ",") + column.name;
    if (!column.standard_errors.empty()) header += "," + column.name + "_error";
  }
  std::string text = units + "\n" + header + "\n";
  for (std::size_t row = 0; row < table.columns.front().values.size(); ++row) {
    for (const TableColumn& column : table.columns) {
      if (&column != &table.columns.front()) text += ',';
      fmt::format_to(std::back_inserter(text), "{:.17g}", column.values[row]);
      if (column.standard_errors.empty()) continue;
      fmt::format_to(std::back_inserter(text), ",{:.17g}", column.standard_errors[row]);
    }
    text += '\n';
  }
  return text;
}

static constexpr const char* kSeriesFile = "temperature_series.csv";
static constexpr const char* kProfileFile = "profile.csv";
static constexpr const char* kMapsFile = "maps.csv";

static std::string file_of(std::string table) {
  std::ranges::replace(table, '.', '_');
  return table + ".csv";
}

std::vector<std::string> table_files() {
  std::vector<std::string> files = {kSeriesFile, kProfileFile, kMapsFile};
  for (const std::string& table : observable_tables()) files.push_back(file_of(table));
  return files;
}

// The tables of an earlier run that this run does not replace are removed last. A failure loses
// none.
void write_tables(const std::filesystem::path& folder, const Measured& measured,
                  const StopRequest& stop) {
  std::vector<std::string> unused = table_files();
  const auto write = [&](const std::string& file, const std::string& text) {
    write_file(folder / file, text);
    std::erase(unused, file);
  };
  write(kSeriesFile, series_table(measured));
  if (measured.profile) write(kProfileFile, profile_table(*measured.profile));
  if (measured.maps) write(kMapsFile, maps_table(*measured.maps, stop));
  for (const ResultTable& table : measured.tables()) {
    write(file_of(table.name), observable_table(table));
  }
  std::error_code ignored;
  for (const std::string& file : unused) std::filesystem::remove(folder / file, ignored);
}

}  // namespace clatter
