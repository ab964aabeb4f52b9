#include "app/sweep/sweep_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "engine/error.h"
#include "engine/scene/field.h"
#include "engine/scene/key_docs.h"
#include "engine/system/write_file.h"
#include "engine/text.h"
#include "engine/whole_number.h"
#include "render/context/context.h"
#include "render/output/image.h"

namespace clatter {

namespace {

using Json = nlohmann::ordered_json;

constexpr Size kChartSize = {1200, 900};

// A factor of a quantity: a column or a number, to the power 1 or -1.
struct Factor {
  std::string column;  // empty: the number
  double number = 1.0;
  bool divides = false;
};

using Product = std::vector<Factor>;

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == text.npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(' ') - first + 1));
}

// `flag` is the name for errors.
void require_column(const std::string& column, const SweepTable& table, const char* flag) {
  if (std::ranges::find(table.columns, column) != table.columns.end()) return;
  const std::string near(near_miss(column, table.columns));
  throw UserError(
      {flag, 0, 0}, "the table has no column '" + column + "'",
      near.empty() ? "give a name of the first line of table.csv" : "did you mean '" + near + "'?");
}

// Reads a quantity such as 1/theory.psi. `flag` is the name for errors.
Product product_in(const std::string& text, const SweepTable& table, const char* flag) {
  Product factors;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find_first_of("*/", begin), text.size());
    Factor factor;
    factor.column = trimmed(std::string_view(text).substr(begin, end - begin));
    factor.divides = begin > 0 && text[begin - 1] == '/';
    if (const auto number = real_number(factor.column)) {
      factor.number = *number;
      factor.column.clear();
    } else {
      require_column(factor.column, table, flag);
    }
    factors.push_back(factor);
    begin = end + 1;
  }
  return factors;
}

double number_in(const Json& row, const std::string& column) {
  const auto cell = row.find(column);
  return cell != row.end() && cell->is_number() ? cell->get<double>() : NAN;
}

// The value of a quantity and its standard error, of independent factors.
ChartPoint value_of(const Product& quantity, const Json& row) {
  double value = 1.0, variance = 0.0;
  for (const Factor& factor : quantity) {
    const double number = factor.column.empty() ? factor.number : number_in(row, factor.column);
    value = factor.divides ? value / number : value * number;
    const double error = number_in(row, factor.column + "_standard_error");
    if (std::isfinite(error)) variance += (error / number) * (error / number);
  }
  return {.y = value, .error = std::fabs(value) * std::sqrt(variance)};
}

bool contains(const Product& quantity, const std::string& column) {
  return std::ranges::find(quantity, column, &Factor::column) != quantity.end();
}

// A theory of a column, or of the ratio of two columns.
struct Theory {
  std::string_view measured;
  std::string_view divisor;  // empty: none
  std::string_view column;
  std::string_view name;
  LineStyle style;
};

constexpr std::array<Theory, 11> kTheories = {
    {{"temperature", "", "theory.temperature_simple", "simple theory", LineStyle::Dotted},
     {"temperature", "", "theory.temperature_refined", "refined theory", LineStyle::Dashed},
     {"temperature", "", "theory.temperature_corrected", "corrected theory", LineStyle::Solid},
     {"temperature", "", "theory.temperature_driven", "kinetic theory", LineStyle::Solid},
     {"temperature", "", "theory.temperature_grad", "Grad's theory", LineStyle::Dashed},
     {"temperature", "", "theory.temperature_enskog", "Enskog's theory", LineStyle::Dotted},
     {"shear.viscosity", "", "theory.viscosity_grad", "Grad's theory", LineStyle::Dashed},
     {"shear.viscosity", "", "theory.viscosity_enskog", "Enskog's theory", LineStyle::Dotted},
     {"spin_temperature", "temperature", "theory.temperature_ratio", "kinetic theory",
      LineStyle::Solid},
     {"pressure.virial", "", "theory.compressibility", "kinetic theory", LineStyle::Solid},
     {"compartments.imbalance", "", "theory.imbalance", "flux theory", LineStyle::Dashed}}};

// The quantity with the theory's column in place of the measured columns. Absent if the quantity
// does not contain these.
std::optional<Product> predicted(const Theory& theory, const Product& quantity) {
  Product result = quantity;
  const auto find = [&](std::string_view column, bool divides) {
    return std::ranges::find_if(result, [&](const Factor& factor) {
      return factor.column == column && factor.divides == divides;
    });
  };
  const auto measured = find(theory.measured, false);
  if (measured == result.end()) return std::nullopt;
  measured->column = theory.column;
  if (theory.divisor.empty()) return result;
  const auto divisor = find(theory.divisor, true);
  if (divisor == result.end()) return std::nullopt;
  result.erase(divisor);
  return result;
}

// A curve of a theory.
struct PredictedCurve {
  std::string name;
  LineStyle style;
  Product quantity;
};

// Temperatures of species are known for a gas that is kicked, and their ratios for one that cools.
void add_species_predictions(const Product& quantity, std::vector<PredictedCurve>& predictions) {
  constexpr std::string_view kSpecies = "species.", kTemperature = ".temperature";
  for (const std::string_view suffix : {".temperature", ".temperature_ratio"}) {
    Product result = quantity;
    int above = 0, below = 0;
    for (Factor& factor : result) {
      std::string& column = factor.column;
      if (!column.starts_with(kSpecies) || !column.ends_with(kTemperature)) continue;
      column.resize(column.size() - kTemperature.size());
      column = "theory." + column + std::string(suffix);
      ++(factor.divides ? below : above);
    }
    const bool is_known = suffix == kTemperature ? above + below > 0 : above > 0 && above == below;
    if (is_known) predictions.push_back({"kinetic theory", LineStyle::Solid, result});
  }
}

// All theories of a quantity.
std::vector<PredictedCurve> predictions_of(const Product& quantity) {
  std::vector<PredictedCurve> predictions;
  for (const Theory& theory : kTheories) {
    if (const auto result = predicted(theory, quantity)) {
      predictions.push_back({std::string(theory.name), theory.style, *result});
    }
  }
  add_species_predictions(quantity, predictions);
  return predictions;
}

// Symbols of columns, with their unit.
struct Symbol {
  std::string_view column;
  std::string_view symbol;
  std::string_view unit;  // in letters of kUnits; empty: 1
};

constexpr std::array<Symbol, 18> kSymbols = {
    {{"temperature", "temperature T", "m a²/t²"},
     {"temperature_x", "temperature T_x", "m a²/t²"},
     {"temperature_y", "temperature T_y", "m a²/t²"},
     {"temperature_z", "temperature T_z", "m a²/t²"},
     {"spin_temperature", "spin temperature T_rot", "m a²/t²"},
     {"collision_rate", "collision rate per particle ω", "1/t"},
     {"pressure.virial", "compressibility Z = p/(ρT)", ""},
     {"energy.dissipated", "dissipated power", "m a²/t³"},
     {"energy.walls_in", "power of the walls", "m a²/t³"},
     {"energy.bulk_in", "power of the kicks", "m a²/t³"},
     {"theory.psi", "ψ", ""},
     {"theory.chi", "χ", ""},
     {"theory.epsilon_effective", "ε", ""},
     {"particles.count", "number of particles N", ""},
     {"particles.area_fraction", "area fraction φ", ""},
     {"particles.volume_fraction", "volume fraction φ", ""},
     {"particles.restitution", "restitution α", ""},
     {"particles.tangential_restitution", "tangential restitution β", ""}}};

// A column that is a key.
struct ColumnKey {
  std::string path;   // of its documentation, which all walls, species and pairs share
  std::string owner;  // "small+large" of a pair, "large" of a species; empty: none
};

ColumnKey key_of(const std::string& column) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= column.size(); begin += parts.back().size() + 1) {
    parts.push_back(column.substr(begin, column.find('.', begin) - begin));
  }
  ColumnKey key;
  if (parts[0] == "species" && parts.size() > 2) {
    key.owner = parts[1];
    parts.erase(parts.begin() + 1);
  } else if (parts[0] == "pair" && parts.size() > 3) {
    key.owner = parts[1] + '+' + parts[2];
    parts.erase(parts.begin() + 1, parts.begin() + 3);
  } else if (parts[0] == "walls" && parts.size() > 2) {
    const std::string side = std::exchange(parts[1], "SIDE");
    if (parts[2] == "species" && parts.size() > 4) {
      key.owner = std::exchange(parts[3], "NAME") + " at " + side;
    }
  }
  for (const std::string& part : parts) key.path += (key.path.empty() ? "" : ".") + part;
  return key;
}

// "restitution" of "particles.restitution", "mass of large" of "species.large.mass".
std::string short_name(const std::string& column) {
  const std::string owner = key_of(column).owner;
  return in_words(column.substr(column.rfind('.') + 1)) + (owner.empty() ? "" : " of " + owner);
}

std::string label_of_column(const std::string& column) {
  const auto symbol = std::ranges::find(kSymbols, column, &Symbol::column);
  if (symbol != kSymbols.end()) {
    const std::string unit(symbol->unit);
    return std::string(symbol->symbol) + (unit.empty() ? "" : " (" + unit + ")");
  }
  const std::string path = key_of(column).path;
  for (const KeyDoc& key : key_docs()) {
    if (key.path() != path || key.key.unit.empty()) continue;
    const std::string unit(key.key.unit);
    return short_name(column) + (unit == "1" ? "" : " (" + unit + ")");
  }
  return in_words(column);
}

std::string label_of(const std::string& text, const Product& quantity) {
  const bool is_column = quantity.size() == 1 && !quantity.front().column.empty();
  return is_column ? label_of_column(text) : text;
}

// "restitution 0.8, count 50".
std::string series_name(const Json& row, const std::vector<std::string>& columns) {
  std::string name;
  for (const std::string& column : columns) {
    const Json value = row.value(column, Json(nullptr));
    const std::string text = value.is_string()         ? value.get<std::string>()
                             : value.is_number_float() ? number_text(value.get<double>())
                                                       : value.dump();
    name += (name.empty() ? "" : ", ") + short_name(column) + ' ' + text;
  }
  return name;
}

void sort_points(ChartLine& line) {
  std::erase_if(line.points, [](const Vec2& point) { return !point.allFinite(); });
  std::ranges::sort(line.points, {}, [](const Vec2& point) { return point[0]; });
}

bool is_monotone(const ChartLine& line) {
  const auto y = [](const Vec2& point) { return point[1]; };
  return std::ranges::is_sorted(line.points, {}, y) ||
         std::ranges::is_sorted(line.points, std::greater(), y);
}

// Whether a sorted line has one value at each x.
bool is_function(const ChartLine& line) {
  return std::ranges::adjacent_find(line.points, [](const Vec2& a, const Vec2& b) {
           return a[0] == b[0] && a[1] != b[1];
         }) == line.points.end();
}

// Adds the lines of a theory, one per series. A theory that depends on x only is one line for all
// series: its points together are a monotone function.
void add_theory(const std::vector<ChartLine>& lines, Chart& chart) {
  ChartLine all = lines.front();
  all.series.reset();
  all.points.clear();
  for (const ChartLine& line : lines) {
    all.points.insert(all.points.end(), line.points.begin(), line.points.end());
  }
  sort_points(all);
  if (all.points.empty()) return;
  if (lines.size() > 1 && is_monotone(all) && is_function(all))
    return chart.lines.push_back(std::move(all));
  for (ChartLine line : lines) {
    sort_points(line);
    if (!line.points.empty()) chart.lines.push_back(std::move(line));
  }
}

}  // namespace

Chart chart_of(const SweepTable& table, const std::vector<std::string>& axes,
               const SweepPlot& plot) {
  const auto x = product_in(plot.x, table, "--x"), y = product_in(plot.y, table, "--y");
  std::vector<std::string> by = {plot.by};
  if (plot.by.empty()) {
    by = axes;
    std::erase_if(by, [&](const std::string& axis) { return contains(x, axis); });
  } else {
    require_column(plot.by, table, "--by");
  }
  Chart chart{.title = plot.title,
              .caption = plot.caption,
              .x = {plot.x_label.empty() ? label_of(plot.x, x) : plot.x_label, plot.log_x},
              .y = {plot.y_label.empty() ? label_of(plot.y, y) : plot.y_label, plot.log_y},
              .series = {},
              .lines = {}};
  std::map<std::string, std::size_t> index_of;
  std::vector<std::vector<const Json*>> rows;
  for (const Json& row : table.rows) {
    const std::string name = series_name(row, by);
    const auto [at, is_new] = index_of.emplace(name, chart.series.size());
    if (is_new) {
      chart.series.push_back({name, {}});
      rows.emplace_back();
    }
    ChartPoint point = value_of(y, row);
    point.x = value_of(x, row).y;
    chart.series[at->second].points.push_back(point);
    rows[at->second].push_back(&row);
  }
  if (!plot.theory || chart.series.empty()) return chart;
  for (const PredictedCurve& theory : predictions_of(y)) {
    std::vector<ChartLine> lines;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      ChartLine line{theory.name, {}, theory.style, k};
      for (const Json* row : rows[k]) {
        line.points.emplace_back(value_of(x, *row).y, value_of(theory.quantity, *row).y);
      }
      lines.push_back(std::move(line));
    }
    add_theory(lines, chart);
  }
  return chart;
}

void write_chart(const std::filesystem::path& file, const Chart& chart) {
  if (file.extension() == ".svg") return write_file(file, chart_svg(chart, kChartSize));
  const auto context = open_context(Backend::Auto);
  write_png(file, chart_image(context->gl(), chart, kChartSize));
}

}  // namespace clatter
