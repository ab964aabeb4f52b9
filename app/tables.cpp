#include "app/tables.h"

#include <cstdarg>
#include <cstdio>
#include <string>

#include "app/write_file.h"
#include "engine/scene/scene_keys.h"
#include "engine/scene/unit.h"

namespace clatter {

[[gnu::format(printf, 2, 3)]] static void append(std::string& text, const char* format, ...) {
  char line[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text += line;
}

static std::string profile_table(const Profile& profile) {
  const std::string axis(name_of(profile.axis, kAxes));
  std::string units =
      "# units, a: disk diameter, m: disk mass, t: time unit of the scene; " + axis + ": a";
  std::string header = axis + "_low," + axis + "_high";
  for (const Field field : profile.fields) {
    const std::string name(name_of(field, kHeatmaps));
    units += ", " + name + ": " + unit_of(field);
    header += "," + name + "," + name + "_error";
  }
  std::string table = units + "\n" + header + "\n";
  for (std::size_t i = 0; i + 1 < profile.edges.size(); ++i) {
    append(table, "%.17g,%.17g", profile.edges[i], profile.edges[i + 1]);
    for (const auto& column : profile.values) {
      append(table, ",%.17g,%.17g", column[i].mean, column[i].standard_error);
    }
    table += '\n';
  }
  return table;
}

void write_tables(const std::filesystem::path& folder, const Measured& measured) {
  std::string series =
      "# units: disk diameter, disk mass and the scene's velocity unit are 1\n"
      "time,temperature";
  const std::vector<double>& spin = measured.series_spin_temperature;
  series += spin.empty() ? "\n" : ",spin_temperature\n";
  for (std::size_t k = 0; k < measured.series_time.size(); ++k) {
    append(series, "%.17g,%.17g", measured.series_time[k], measured.series_temperature[k]);
    if (!spin.empty()) append(series, ",%.17g", spin[k]);
    series += '\n';
  }
  write_file(folder / "temperature_series.csv", series);

  if (measured.profile) write_file(folder / "profile.csv", profile_table(*measured.profile));
}

}  // namespace clatter
