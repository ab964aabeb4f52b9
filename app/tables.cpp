#include "app/tables.h"

#include <cstdarg>
#include <cstdio>
#include <string>

#include "app/write_file.h"

namespace clatter {

[[gnu::format(printf, 2, 3)]] static void append(std::string& text, const char* format, ...) {
  char line[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text += line;
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

  if (!measured.profile) return;
  const Profile& profile = *measured.profile;
  std::string table =
      "# units: disk diameter, disk mass and the scene's velocity unit are 1; density: disks per "
      "area\n"
      "x_low,x_high,density,density_error,temperature_x,temperature_x_error,temperature_y,"
      "temperature_y_error\n";
  for (std::size_t i = 0; i < profile.density.size(); ++i) {
    append(table, "%.17g,%.17g", profile.edges[i], profile.edges[i + 1]);
    for (const auto* column : {&profile.density, &profile.temperature_x, &profile.temperature_y}) {
      append(table, ",%.17g,%.17g", (*column)[i].mean, (*column)[i].standard_error);
    }
    table += '\n';
  }
  write_file(folder / "profile.csv", table);
}

}  // namespace clatter
