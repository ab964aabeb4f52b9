#include "app/plots/table_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "app/plots/plot_colours.h"
#include "engine/scene/enum_names.h"
#include "engine/text.h"
#include "render/label.h"
#include "render/species_colours.h"

namespace clatter {

namespace {

// The common x axis of the curves of a table.
struct Abscissa {
  std::string label;
  std::vector<double> values;  // [rows]
  std::size_t columns;         // of the table, before those of the curves
};

std::string with_unit(const std::string& name, const std::string& unit) {
  const std::string typeset_unit = typeset(unit);
  return typeset_unit.empty() ? in_words(name) : in_words(name) + " in " + typeset_unit;
}

// The middles of the bins of a histogram, or the first column.
Abscissa abscissa_of(const ResultTable& table) {
  const TableColumn& first = table.columns[0];
  if (first.name != "low") return {with_unit(first.name, first.unit), first.values, 1};
  Abscissa middles{with_unit("value", first.unit), {}, 2};
  for (std::size_t row = 0; row < first.values.size(); ++row) {
    middles.values.push_back(0.5 * (first.values[row] + table.columns[1].values[row]));
  }
  return middles;
}

// Whether the spacing of positive values grows with them. The first one may be 0.
bool has_growing_spacing(const std::vector<double>& values) {
  constexpr double kGrowth = 5.0;
  const std::size_t count = values.size();
  return count > 2 && values[0] >= 0.0 &&
         values[count - 1] - values[count - 2] > kGrowth * (values[1] - values[0]);
}

// Whether no value is negative, and the positive ones differ by a large factor.
bool has_wide_range(const std::vector<Curve>& curves) {
  constexpr double kWide = 100.0;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (const Curve& curve : curves) {
    for (const Vec2& point : curve.points) {
      if (point.y() < 0.0) return false;
      if (point.y() > 0.0) smallest = std::min(smallest, point.y());
      largest = std::max(largest, point.y());
    }
  }
  return largest > kWide * smallest;
}

// Removes points with large relative errors. Few counts in a narrow bin would be a peak.
void remove_uncertain(Curve& curve) {
  constexpr double kLargest = 0.5;
  if (curve.errors.empty()) return;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < curve.points.size(); ++k) {
    if (curve.errors[k] > kLargest * curve.points[k].y()) continue;
    curve.points[kept] = curve.points[k];
    curve.errors[kept++] = curve.errors[k];
  }
  curve.points.resize(kept);
  curve.errors.resize(kept);
}

// The axis at the end of a name, as in "drift_x"; none: the number of axes.
std::size_t axis_of(const std::string& name) {
  std::size_t axis = 0;
  while (axis < kAxes.size() && name != kAxes[axis].name &&
         !name.ends_with("_" + std::string(kAxes[axis].name))) {
    ++axis;
  }
  return axis;
}

Curve curve_of(const TableColumn& column, const std::vector<double>& x, std::size_t begin,
               std::size_t end) {
  Curve curve{.name = in_words(column.name), .colour = {}, .points = {}};
  for (std::size_t row = begin; row < end; ++row) {
    if (!std::isfinite(column.values[row])) continue;
    curve.points.emplace_back(x[row], column.values[row]);
    if (column.standard_errors.empty()) continue;
    const double error = column.standard_errors[row];
    curve.errors.push_back(std::isfinite(error) ? error : 0.0);
  }
  return curve;
}

// Whether a table is of the displacement, and of its columns the one that is not of an axis.
bool is_displacement(const ResultTable& table) {
  return table.name == "mean_squared_displacement";
}
const char* whole_column(const ResultTable& table) {
  return is_displacement(table) ? "total" : "mean";
}

// Whether the columns of a table are a mean or a sum over the axes, then the axes, of all particles
// and of each species.
bool is_correlation(const ResultTable& table) {
  return is_displacement(table) || table.name == "velocity_autocorrelation";
}

// The species whose name is the longest one at the end of a column's name, as in "total_heavy". In
// "drift_x" the x is an axis, also beside a species of this name.
std::optional<std::size_t> species_of(const std::string& column,
                                      const std::vector<Species>& species) {
  std::optional<std::size_t> longest;
  for (std::size_t s = 0; s < species.size(); ++s) {
    if (!column.ends_with("_" + species[s].name)) continue;
    if (column == "drift_" + species[s].name) continue;
    if (!longest || species[s].name.size() > species[*longest].name.size()) longest = s;
  }
  return longest;
}

// The velocity correlation and the squared displacement of a particle of a species (theory 12.23).
std::optional<Curve> diffusion_curve(const ResultTable& table, const Scene& scene,
                                     const SpeciesTheory& theory, std::size_t species,
                                     const std::vector<double>& lags) {
  if (species >= theory.frictions.size() || !std::isfinite(theory.frictions[species])) {
    return std::nullopt;
  }
  const double damping = theory.frictions[species], diffusion = theory.diffusions[species];
  const std::string& name = scene.species[species].name;
  Curve curve{.name = name + ", theory", .colour = {}, .points = {}, .dashed = true};
  curve.help = "D = T/(m γ), Einstein's relation, with the friction γ of Enskog's theory";
  for (const double lag : lags) {
    const double value = is_displacement(table) ? 2.0 * scene.dimension() * diffusion *
                                                      (lag + std::expm1(-damping * lag) / damping)
                                                : diffusion * damping * std::exp(-damping * lag);
    curve.points.emplace_back(lag, value);
  }
  return curve;
}

// A curve for each slab, with the brighter colours of viridis along the axis. The first and the
// last are named.
LivePlot slab_plot(const ResultTable& table) {
  const TableColumn& low = table.columns[0];
  const TableColumn& r = table.columns[2];
  LivePlot plot{table_title(table), with_unit(r.name, r.unit), false, false, {}, "g"};
  const std::size_t rows = low.values.size();
  for (std::size_t begin = 0, end = 0; begin < rows; begin = end) {
    while (end < rows && low.values[end] == low.values[begin]) ++end;
    Curve curve = curve_of(table.columns[3], r.values, begin, end);
    const double span = low.values.back() - low.values.front() + 1.0;
    const ColourScale scale{colour_map(Palette::Viridis), low.values.front() - 0.5 * span,
                            low.values.front() + span};
    curve.colour = scale(low.values[begin]);
    curve.name = begin == 0 || end == rows
                     ? fmt::format("{} = {:.3g} to {:.3g}", low.name.substr(0, 1),
                                   low.values[begin], table.columns[1].values[begin])
                     : "";
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

}  // namespace

std::string table_title(const ResultTable& table) {
  std::string title;
  for (const char letter : in_words(table.name)) {
    title += letter == '.' ? std::string(", ") : std::string(1, letter);
  }
  return title;
}

std::vector<LivePlot> table_plots(const ResultTable& table, const Scene& scene,
                                  const History& history, const ThemeColours& theme) {
  if (table.columns[0].name.ends_with("_low")) return {slab_plot(table)};
  const Abscissa abscissa = abscissa_of(table);
  const bool estimates = std::ranges::any_of(
      table.columns, [](const TableColumn& column) { return !column.standard_errors.empty(); });
  const std::vector<Colour> colours = species_colours(scene.species, theme.background);
  std::vector<LivePlot> plots;
  std::vector<std::string> units;
  for (std::size_t k = abscissa.columns; k < table.columns.size(); ++k) {
    const TableColumn& column = table.columns[k];
    // Beside estimates, exact numbers describe the row.
    if (estimates && column.standard_errors.empty()) continue;
    const auto species = species_of(column.name, scene.species);
    const bool whole = species && is_correlation(table) &&
                       column.name == whole_column(table) + ("_" + scene.species[*species].name);
    if (species && is_correlation(table) && !whole) continue;  // axes of species: too many curves
    const auto plot =
        static_cast<std::size_t>(std::ranges::find(units, column.unit) - units.begin());
    if (plot == units.size()) {
      units.push_back(column.unit);
      plots.push_back({table_title(table),
                       abscissa.label,
                       has_growing_spacing(abscissa.values),
                       false,
                       {},
                       typeset(column.unit)});
    }
    Curve curve = curve_of(column, abscissa.values, 0, abscissa.values.size());
    const std::size_t axis = axis_of(column.name);
    curve.colour = species               ? colours[*species]
                   : axis < kAxes.size() ? kAxisColours[axis]
                                         : theme.text;
    curve.compared = is_correlation(table) && column.name == whole_column(table);
    plots[plot].curves.push_back(std::move(curve));
    if (!whole) continue;
    auto expected =
        diffusion_curve(table, scene, history.species_theory(), *species, abscissa.values);
    if (!expected) continue;
    expected->colour = colours[*species];
    plots[plot].curves.push_back(std::move(*expected));
  }
  for (LivePlot& plot : plots) {
    plot.log_y = has_wide_range(plot.curves);
    if (plot.log_y) std::ranges::for_each(plot.curves, remove_uncertain);
  }
  return plots;
}

}  // namespace clatter
