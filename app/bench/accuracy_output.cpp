#include "app/bench/accuracy_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/system/page_parts.h"
#include "engine/system/read_file.h"

namespace clatter {

namespace {

using Json = nlohmann::ordered_json;

// Names of the compared columns, in files and in tables.
constexpr std::array<const char*, kCompared> kNames = {"temperature", "pressure",    "stress",
                                                       "heat_flux",   "dissipation", "density"};
constexpr std::array<const char*, kCompared> kSymbols = {"T", "p", "σ", "q", "ζ", "ρ(x)"};

// A number, or a dash for NaN.
std::string number(fmt::format_string<double&> format, double value) {
  return std::isnan(value) ? "-" : fmt::format(format, value);
}

// A difference in percent.
std::string percent(const Estimate& bias) {
  if (std::isnan(bias.mean)) return "-";
  if (bias.mean == 0.0 && bias.standard_error == 0.0) return "0";
  const double error = 100.0 * bias.standard_error;
  const int digits = static_cast<int>(std::clamp(1.0 - std::floor(std::log10(error)), 0.0, 4.0));
  return fmt::format("{:+.{}f} ±{:.{}f}", 100.0 * bias.mean, digits, error, digits);
}

// The cells of a row, in the order of kHeadings.
std::vector<std::string> cells_of(const AccuracyRow& row) {
  std::vector<std::string> cells = {
      row.setting + (row.dominated ? " *" : ""), number("{:.3g}", 1e3 * row.cpu_per_time),
      number("{:.2f}", 1e-6 * row.events_per_second), number("{:.0f}", 1e-3 * row.bytes)};
  for (const Estimate& bias : row.comparison.bias) cells.push_back(percent(bias));
  cells.push_back(number("{:.1g}", row.deepest_overlap));
  cells.push_back(number("{:.2g}", 100.0 * row.elasticised_share));
  cells.push_back(number("{:.2g}", 100.0 * row.comparison.error));
  return cells;
}

std::vector<std::string> cells_of(const PictureRow& row) {
  return {row.setting + (row.dominated ? " *" : ""), number("{:.3g}", 1e3 * row.cpu_seconds),
          number("{:.4f}", row.ssim), number("{:.2g}", row.centre_error),
          number("{:.0f}", 1e-3 * row.bytes)};
}

const std::vector<std::string> kPictureHeadings = {"setting", "ms", "SSIM", "centre px", "kB/s"};

std::vector<std::string> headings() {
  std::vector<std::string> names = {"setting", "ms/t", "Mev/s", "kB"};
  for (const char* symbol : kSymbols) names.push_back(std::string(symbol) + " %");
  names.insert(names.end(), {"overlap", "el. %", "error %"});
  return names;
}

// Number of UTF-8 characters.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

using Grid = std::vector<std::vector<std::string>>;

template <class Row>
Grid grid_of(const std::vector<Row>& rows, const std::vector<std::string>& heads) {
  Grid grid = {heads};
  for (const Row& row : rows) grid.push_back(cells_of(row));
  return grid;
}

// Without the columns that no row has.
Grid grid_of(const PictureTable& table) {
  Grid grid = grid_of(table.rows, kPictureHeadings);
  for (std::size_t k = kPictureHeadings.size(); k-- > 0;) {
    const auto is_absent = [k](const PictureRow& row) { return cells_of(row)[k] == "-"; };
    if (!std::ranges::all_of(table.rows, is_absent)) continue;
    for (auto& line : grid) line.erase(line.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return grid;
}

std::string text_of(const std::string& title, const Grid& grid) {
  std::string text = "\n" + title + "\n";
  for (const auto& line : grid) {
    for (std::size_t k = 0; k < line.size(); ++k) {
      std::size_t widest = 0;
      for (const auto& other : grid) widest = std::max(widest, width_of(other[k]));
      const std::string space(widest - width_of(line[k]), ' ');
      text += k == 0 ? line[k] + space : "  " + space + line[k];
    }
    text += "\n";
  }
  return text;
}

std::string markdown_of(const std::string& title, const Grid& grid) {
  std::string text = "\n**" + title + "**\n\n";
  for (std::size_t row = 0; row < grid.size(); ++row) {
    for (const std::string& cell : grid[row]) {
      text += "| ";
      for (const char letter : cell) {
        if (letter == '*') text += '\\';  // otherwise Markdown emphasis
        text += letter;
      }
      text += " ";
    }
    text += "|\n";
    if (row > 0) continue;
    for (std::size_t k = 0; k < grid[row].size(); ++k) text += k == 0 ? "|---|" : "---:|";
    text += "\n";
  }
  return text;
}

}  // namespace

std::string accuracy_statement(const AccuracyBench& bench) {
  return fmt::format("{}: {} runs of each setting, seeds 1 to {}, of {:g} time units after {:g}; ",
                     bench.scene, kAccuracyReplicas, kAccuracyReplicas, bench.duration,
                     0.2 * bench.duration) +
         "± is a standard error over runs.\n"
         "ms/t: CPU milliseconds per time unit; Mev/s: 10^6 events per CPU second; T, p, σ, q, ζ, "
         "ρ(x): temperature, wall pressure, stress, heat flux, dissipation and density profile "
         "(root mean square), relative to the dial's first row; overlap: deepest, in diameters; "
         "el.: collisions that t_c made elastic; error: sqrt(bias² + variance per CPU second), "
         "root mean square over those six; SSIM: similarity to a picture of 4 x 4 samples per "
         "pixel; centre px: distance between a drawn disk and the disk, for frame rates half a "
         "frame later; kB/s: of a film; *: another setting of the dial has both a lower cost and a "
         "lower error, by "
         "at least one tenth.\n";
}

std::string accuracy_text(const AccuracyTable& table) {
  return text_of(table.title, grid_of(table.rows, headings()));
}

std::string accuracy_text(const PictureTable& table) {
  return text_of(table.title, grid_of(table));
}

std::string accuracy_csv(const std::vector<AccuracyTable>& tables,
                         const std::vector<PictureTable>& pictures) {
  std::string text = "dial,setting,value,cpu_seconds_per_time,events_per_cpu_second,bytes";
  for (const std::string name : kNames) text += "," + name + "_bias," + name + "_bias_error";
  text += ",deepest_overlap,elasticised_share,error,cpu_seconds_per_picture,ssim";
  text += ",centre_error_pixels,bytes_per_second,dominated\n";
  for (const AccuracyTable& table : tables) {
    for (const AccuracyRow& row : table.rows) {
      text += table.dial + "," + row.setting;
      for (const double value : {row.value, row.cpu_per_time, row.events_per_second, row.bytes}) {
        text += fmt::format(",{:.6g}", value);
      }
      for (const Estimate& bias : row.comparison.bias) {
        text += fmt::format(",{:.6g},{:.6g}", bias.mean, bias.standard_error);
      }
      text += fmt::format(",{:.6g},{:.6g},{:.6g},nan,nan,nan,nan,{:d}\n", row.deepest_overlap,
                          row.elasticised_share, row.comparison.error, row.dominated);
    }
  }
  for (const PictureTable& table : pictures) {
    for (const PictureRow& row : table.rows) {
      text += table.dial + "," + row.setting + fmt::format(",{:.6g}", row.value);
      for (int k = 0; k < 2 * kCompared + 6; ++k) text += ",nan";
      text += fmt::format(",{:.6g},{:.6g},{:.6g},{:.6g},{:d}\n", row.cpu_seconds, row.ssim,
                          row.centre_error, row.bytes, row.dominated);
    }
  }
  return text;
}

std::string accuracy_json(const AccuracyBench& bench, const std::vector<AccuracyTable>& tables,
                          const std::vector<PictureTable>& pictures) {
  // Absent values are null.
  Json json{{"scene", bench.scene},
            {"replicas", kAccuracyReplicas},
            {"duration", bench.duration},
            {"dials", Json::array()}};
  for (const AccuracyTable& table : tables) {
    Json rows = Json::array();
    for (const AccuracyRow& row : table.rows) {
      Json bias = Json::object();
      for (int k = 0; k < kCompared; ++k) {
        bias[kNames[k]] = {{"mean", row.comparison.bias[k].mean},
                           {"standard_error", row.comparison.bias[k].standard_error}};
      }
      rows.push_back({{"setting", row.setting},
                      {"value", row.value},
                      {"cpu_seconds_per_time", row.cpu_per_time},
                      {"events_per_cpu_second", row.events_per_second},
                      {"bytes", row.bytes},
                      {"bias", bias},
                      {"deepest_overlap", row.deepest_overlap},
                      {"elasticised_share", row.elasticised_share},
                      {"error", row.comparison.error},
                      {"dominated", row.dominated}});
    }
    json["dials"].push_back({{"dial", table.dial}, {"title", table.title}, {"settings", rows}});
  }
  for (const PictureTable& table : pictures) {
    Json rows = Json::array();
    for (const PictureRow& row : table.rows) {
      rows.push_back({{"setting", row.setting},
                      {"value", row.value},
                      {"cpu_seconds_per_picture", row.cpu_seconds},
                      {"ssim", row.ssim},
                      {"centre_error_pixels", row.centre_error},
                      {"bytes_per_second", row.bytes},
                      {"dominated", row.dominated}});
    }
    json["dials"].push_back({{"dial", table.dial}, {"title", table.title}, {"settings", rows}});
  }
  return json.dump(1) + "\n";
}

std::string with_accuracy_tables(const AccuracyBench& bench,
                                 const std::vector<AccuracyTable>& tables,
                                 const std::vector<PictureTable>& pictures) {
  std::string page = read_file(bench.markdown, 1 << 20, "a page of text");
  std::string text = accuracy_statement(bench);
  for (const AccuracyTable& table : tables) {
    text += markdown_of(table.title, grid_of(table.rows, headings()));
  }
  for (const PictureTable& table : pictures) {
    text += markdown_of(table.title, grid_of(table));
  }
  replace_part(page, bench.markdown, "tables", text + "\n");
  return page;
}

Plot accuracy_plot(const AccuracyBench& bench, const std::vector<AccuracyTable>& tables) {
  Plot plot{.title = "What accuracy costs",
            .caption = bench.scene +
                       ": error of means that take one CPU second, against CPU time per time "
                       "unit; hollow: another setting of the dial costs less and errs less",
            .x_name = "CPU milliseconds per time unit",
            .y_name = "error, %",
            .panels = {}};
  for (const AccuracyTable& table : tables) {
    PlotPanel panel{table.title, {}};
    for (const AccuracyRow& row : table.rows) {
      if (std::isnan(row.cpu_per_time)) continue;
      panel.points.push_back({1e3 * row.cpu_per_time, 100.0 * row.comparison.error, row.setting,
                              row.dominated, std::isnan(row.value)});
    }
    plot.panels.push_back(panel);
  }
  return plot;
}

}  // namespace clatter
