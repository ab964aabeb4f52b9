#include "app/sweep/refinement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "app/sweep/sweep_table.h"
#include "engine/error.h"

namespace clatter {

namespace {

// A measured point of a curve. `x` is the logarithm on a logarithmic axis.
struct CurvePoint {
  double x;
  double y;
  double error;
  SweepPoint settings;
  std::size_t axis;  // index of the first axis in the settings

  const std::string& value() const { return settings[axis].value; }
};

// An interval that can be divided, with the error of a linear interpolation.
struct Interval {
  double error;
  SweepPoint middle;
};

bool is_whole(const std::string& toml) {
  return toml.find_first_of(".en") == toml.npos;
}

// The curves of the results, by the values of all axes except the first.
std::map<std::string, std::vector<CurvePoint>> curves_of(const SweepTable& table,
                                                         const Sweep& sweep) {
  const std::string axis = sweep.axes().front(), of = sweep.accuracy.of;
  std::map<std::string, std::vector<CurvePoint>> curves;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto& values = table.rows[row];
    if (!values.contains(of)) continue;
    SweepPoint settings = table.points[row];
    const auto at = std::ranges::find(settings, axis, &Override::key);
    const double x = values.at(axis).get<double>();
    const CurvePoint point{sweep.logarithmic ? std::log(x) : x, values.at(of).get<double>(),
                           values.at(of + "_standard_error").get<double>(), settings,
                           static_cast<std::size_t>(at - settings.begin())};
    settings.erase(at);
    curves[settings_text(settings)].push_back(point);
  }
  if (curves.empty() && !table.rows.empty()) {
    throw UserError({"accuracy_of", 0, 0}, "the results have no mean '" + of + "'",
                    "name a mean of the result file");
  }
  for (auto& [name, curve] : curves) std::ranges::sort(curve, {}, &CurvePoint::x);
  return curves;
}

// Second derivative of the parabola through three points.
double curvature(const CurvePoint& a, const CurvePoint& b, const CurvePoint& c) {
  return 2.0 * ((c.y - b.y) / (c.x - b.x) - (b.y - a.y) / (b.x - a.x)) / (c.x - a.x);
}

// The setting in the middle of an interval; absent between neighbouring whole numbers.
std::optional<SweepPoint> middle_of(const CurvePoint& a, const CurvePoint& b, bool logarithmic) {
  const double x = 0.5 * (a.x + b.x);
  const double value = logarithmic ? std::exp(x) : x;
  SweepPoint middle = a.settings;
  std::string& text = middle[a.axis].value;
  if (is_whole(a.value()) && is_whole(b.value())) {
    text = fmt::format("{:.0f}", std::nearbyint(value) + 0.0);  // no -0
  } else {
    text = fmt::format("{:.12g}", value);
    if (is_whole(text)) text += ".0";
  }
  if (text == a.value() || text == b.value()) return std::nullopt;
  return middle;
}

// The intervals of a curve. Their errors are relative to the range of the curve.
void add_intervals(const std::vector<CurvePoint>& curve, bool logarithmic,
                   std::vector<Interval>& intervals) {
  const auto [low, high] = std::ranges::minmax(curve, {}, &CurvePoint::y);
  const double range = high.y - low.y;
  for (std::size_t k = 0; k + 1 < curve.size(); ++k) {
    double bend = 0.0;
    if (k > 0) bend = std::fabs(curvature(curve[k - 1], curve[k], curve[k + 1]));
    if (k + 2 < curve.size()) {
      bend = std::max(bend, std::fabs(curvature(curve[k], curve[k + 1], curve[k + 2])));
    }
    const double width = curve[k + 1].x - curve[k].x;
    const double error =
        0.125 * bend * width * width + std::hypot(curve[k].error, curve[k + 1].error);
    const auto middle = middle_of(curve[k], curve[k + 1], logarithmic);
    if (middle) intervals.push_back({range > 0.0 ? error / range : 0.0, *middle});
  }
}

}  // namespace

std::vector<SweepPoint> refined_points(const SweepFolder& folder, const Sweep& sweep) {
  constexpr std::size_t kAtOnce = 4;  // constant, so that the points do not depend on the machine
  std::set<std::string> known;
  for (const SweepRun& run : folder.runs()) known.insert(settings_text(run.settings));
  const auto budget = static_cast<std::size_t>(sweep.refinement->budget);
  if (known.size() >= budget) return {};
  std::vector<Interval> intervals;
  for (const auto& [name, curve] : curves_of(read_table(folder), sweep)) {
    add_intervals(curve, sweep.logarithmic, intervals);
  }
  std::ranges::stable_sort(intervals, std::greater(), &Interval::error);
  std::vector<SweepPoint> points;
  for (const Interval& interval : intervals) {
    if (points.size() == std::min(kAtOnce, budget - known.size())) break;
    if (!known.contains(settings_text(interval.middle))) points.push_back(interval.middle);
  }
  return points;
}

std::vector<SweepPoint> points_without_goal(const SweepFolder& folder, const Sweep& sweep) {
  const SweepTable table = read_table(folder);
  std::vector<SweepPoint> points;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (!table.rows[row].contains(sweep.accuracy.of)) points.push_back(table.points[row]);
  }
  return points;
}

}  // namespace clatter
