#include "app/plots/plots.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "app/plots/divider_plots.h"
#include "app/plots/plot_colours.h"
#include "app/plots/species_plots.h"
#include "app/plots/table_plots.h"
#include "app/results/theory_json.h"
#include "engine/scene/enum_names.h"
#include "engine/text.h"
#include "render/label.h"

namespace clatter {

namespace {

constexpr std::array<const char*, 3> kAxisNames = {"x", "y", "z"};

// The theories of chapters 6, 7 and 14 of docs/theory.md.
constexpr const char* kHaff = "Haff's law of a gas that stays homogeneous; clusters cool slower";
constexpr const char* kAtmosphere =
    "The pressure carries the weight above, with the equation of state of the elastic gas";
constexpr const char* kSimple = "Theory that averages over all particles; dense gases differ";
constexpr const char* kRefined =
    "Theory that averages over the particles that collide; neglects the dense layer at the walls";
constexpr const char* kCorrected = "The refined theory with the dense layer at the walls";

constexpr const char* kGrad = "Grad's theory of a dilute sheared gas";
constexpr const char* kEnskog = "Enskog's theory of a dense gas of nearly elastic particles";

template <class Value>
Curve over_time(const std::string& name, Colour colour, const std::vector<Sample>& samples,
                Value value) {
  Curve curve{name, colour, {}};
  for (const Sample& sample : samples) curve.points.emplace_back(sample.time, value(sample));
  return curve;
}

Curve level(const char* name, const char* help, Colour colour, const std::vector<Sample>& samples,
            double value) {
  Curve curve{.name = name, .colour = colour, .points = {}, .dashed = true, .help = help};
  if (!samples.empty() && std::isfinite(value)) {
    curve.points = {{samples.front().time, value}, {samples.back().time, value}};
  }
  return curve;
}

// Haff's law from the start, at equal steps of the logarithm of time.
Curve haff_curve(const std::vector<Sample>& samples, double temperature, double rate) {
  constexpr int kPoints = 24;
  Curve curve{.name = "Haff", .colour = kGreen, .points = {}, .dashed = true, .help = kHaff};
  if (samples.empty()) return curve;
  const double first = samples.front().time, last = samples.back().time;
  for (int k = 0; k <= kPoints; ++k) {
    const double time = first * std::pow(last / first, 1.0 * k / kPoints);
    curve.points.emplace_back(time, haff_temperature(temperature, rate, time));
  }
  return curve;
}

LivePlot temperature_plot(const std::vector<Sample>& samples, const Scene& scene, Colour plain) {
  LivePlot plot{"Temperature", "time t", false, false, {}, "m a²/t²"};
  for (int axis = 0; axis < scene.dimension(); ++axis) {
    plot.curves.push_back(over_time(std::string("T_") + kAxisNames[axis], kAxisColours[axis],
                                    samples, [&](const Sample& s) { return s.temperature[axis]; }));
  }
  plot.curves.push_back(
      over_time("T", plain, samples, [](const Sample& s) { return s.temperature.mean(); }));
  plot.curves.back().compared = true;
  // Spins remain under smooth laws.
  const auto spun = [](const Sample& sample) { return sample.spin_temperature > 0.0; };
  if (scene.spins() || std::ranges::any_of(samples, spun)) {
    plot.curves.push_back(
        over_time("T_rot", kPurple, samples, [](const Sample& s) { return s.spin_temperature; }));
  }
  // After a change of laws the decay is no power of the time since the start.
  plot.log_x = plot.log_y = cools_freely(scene) && scene.changes.empty();
  if (const auto rate = haff_rate(scene); rate && plot.log_x) {
    plot.curves.push_back(haff_curve(samples, scene.particles.start.temperature, *rate));
  }
  if (const auto gas = vibrated_gas(scene); gas && gas->drive_speed > 0.0) {
    plot.curves.push_back(level("simple", kSimple, kRed, samples, gas->temperature_simple()));
    plot.curves.push_back(level("refined", kRefined, kGreen, samples, gas->temperature_refined()));
    plot.curves.push_back(
        level("corrected", kCorrected, kPurple, samples, gas->temperature_corrected()));
  }
  if (const auto shear = steady_shear(scene)) {
    plot.curves.push_back(level("Grad", kGrad, kGreen, samples, shear->grad.temperature));
    plot.curves.push_back(level("Enskog", kEnskog, kRed, samples, shear->enskog_temperature));
  }
  return plot;
}

LivePlot energy_plot(const std::vector<Sample>& samples, double count, Colour plain) {
  LivePlot plot{"Energy per time", "time t", false, false, {}, "m a²/t³"};
  // Rounding errors of the energy are far below this share of it.
  constexpr double kShare = 1e-6;
  for (const Sample& sample : samples) {
    plot.span = std::max(plot.span, kShare * count * sample.temperature.mean());
  }
  const auto in = [](const Sample& s) {
    return s.walls_in + s.bulk_in + s.nudges_in + s.gravity_in + s.shear_in;
  };
  plot.curves = {
      over_time("in", kOrange, samples, in),
      over_time("dissipated", kBlue, samples, [](const Sample& s) { return s.dissipated; }),
      over_time("difference", plain, samples, [&](const Sample& s) { return in(s)-s.dissipated; })};
  plot.curves[1].compared = true;
  return plot;
}

// Energy residual and deepest overlap; both are rounding errors.
LivePlot residual_plot(const std::vector<Sample>& samples) {
  LivePlot plot{"Residuals", "time t", false, true, {}, "relative"};
  plot.curves = {
      over_time("energy", kOrange, samples, [](const Sample& s) { return s.ledger_residual; }),
      over_time("overlap", kBlue, samples, [](const Sample& s) { return s.deepest_overlap; })};
  return plot;
}

// Label of a plot's horizontal axis.
std::string along(Axis axis) {
  return std::string(kAxisNames[static_cast<std::size_t>(axis)]) + " in a";
}

// The density of the atmosphere of the scene along the axis of gravity, if it has one.
std::optional<Curve> atmosphere_curve(const Scene& scene, Axis along) {
  const auto air = atmosphere(scene);
  const auto axis = static_cast<Eigen::Index>(along);
  if (!air || (*scene.gravity)[axis] == 0.0) return std::nullopt;
  Curve curve{.name = "atmosphere",
              .colour = kGreen,
              .points = air->profile(),
              .dashed = true,
              .help = kAtmosphere};
  if ((*scene.gravity)[axis] > 0.0) {
    for (Vec2& point : curve.points) point.x() = air->height - point.x();
  }
  return curve;
}

// Whether a profile has values, and the field that is chosen is one of them.
bool has_profile(const Profile& profile, std::size_t chosen) {
  return !profile.fields.empty() && chosen < profiled_fields(profile.axis).size();
}

// A field along an axis, with its standard errors.
LivePlot profile_plot(const Profile& profile, std::size_t chosen, const Scene& scene,
                      const ThemeColours& theme) {
  const int dimension = scene.dimension();
  const Label label = label_of(profile.fields[chosen], dimension);
  LivePlot plot{"Profile", along(profile.axis), false, false, {}, label.unit};
  // In a mixture the colours are those of species.
  const Colour colour = scene.species.empty() ? kBlue : theme.text;
  Curve curve{.name = label.name, .colour = colour, .points = {}, .compared = true};
  for (std::size_t i = 0; i < profile.values[chosen].size(); ++i) {
    const Estimate& value = profile.values[chosen][i];
    curve.points.emplace_back(0.5 * (profile.edges[i] + profile.edges[i + 1]), value.mean);
    curve.errors.push_back(value.standard_error);
  }
  plot.curves.push_back(std::move(curve));
  std::ranges::move(species_profiles(profile, profile.fields[chosen], scene, theme),
                    std::back_inserter(plot.curves));
  if (profile.fields[chosen] == Quantity::Density) {
    if (auto law = atmosphere_curve(scene, profile.axis)) plot.curves.push_back(std::move(*law));
  }
  return plot;
}

// Magnitudes of the balance residuals along an axis. They are rounding errors, so their signs are
// random.
LivePlot balance_plot(const ResidualProfile& profile, int dimension) {
  constexpr double kBelowRounding = 1e-18;
  LivePlot plot{"Balance", along(profile.axis),  false,         true,
                {},        "residual, relative", kBelowRounding};
  for (const Field residual : residual_fields(dimension)) {
    Curve curve{"energy", kRed, {}};
    if (residual.quantity == Quantity::BalanceMass) curve = {"mass", kGreen, {}};
    if (residual.quantity == Quantity::BalanceMomentum) {
      curve = {std::string("momentum ") + kAxisNames[residual.i], kAxisColours[residual.i], {}};
    }
    const std::vector<double> values = profile.residuals.map(residual);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double x = (static_cast<double>(i) + 0.5) * profile.width;
      curve.points.emplace_back(x, std::fabs(values[i]));
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

LivePlot velocity_plot(const VelocityHistogram& velocities, int dimension, Colour plain) {
  LivePlot plot{"Velocities", "v / standard deviation", false, true, {}, "density"};
  Curve gaussian{"Gaussian", plain, {}, true};
  for (double v = -4.0; v <= 4.0; v += 0.1) {
    gaussian.points.emplace_back(v, std::exp(-0.5 * v * v) / std::sqrt(2.0 * std::numbers::pi));
  }
  for (int axis = 0; axis < dimension; ++axis) {
    plot.curves.push_back(
        {std::string("v_") + kAxisNames[axis], kAxisColours[axis], velocities.density(axis)});
  }
  plot.curves.front().compared = true;
  plot.curves.push_back(std::move(gaussian));
  return plot;
}

// Mean temperature of the second half of the run: the steady state, once it is reached.
double settled_temperature(const std::vector<Sample>& samples) {
  double sum = 0.0;
  for (std::size_t i = samples.size() / 2; i < samples.size(); ++i) {
    sum += samples[i].temperature.mean();
  }
  return sum / static_cast<double>(samples.size() - samples.size() / 2);
}

// Fig. 3.1: T/(m v_dr^2) over 1/(eps psi), for elastic walls.
LivePlot figure_plot(const std::vector<Sample>& samples, const VibratedGas& gas) {
  LivePlot plot{"Fig. 3.1", "1/(ε ψ)", true, true, {}, "T/(m v_dr²)"};
  Curve simple{.name = "simple", .colour = kRed, .points = {}, .dashed = true, .help = kSimple};
  Curve refined{
      .name = "refined", .colour = kGreen, .points = {}, .dashed = true, .help = kRefined};
  const double here = 1.0 / (gas.epsilon_effective() * gas.psi());
  const double unit = gas.drive_speed * gas.drive_speed;
  VibratedGas other = gas;
  for (double power = 0.0; power <= 4.0; power += 0.1) {
    // Vary the restitution of this gas from 0 to nearly 1.
    const double epsilon = std::pow(10.0, -power);
    other.restitution = std::sqrt(1.0 - epsilon);
    const double x = 1.0 / (epsilon * gas.psi());
    simple.points.emplace_back(x, other.temperature_simple() / unit);
    refined.points.emplace_back(x, other.temperature_refined() / unit);
  }
  Curve now{"this gas", kPurple, {}, false, true};
  if (!samples.empty()) {
    now.points.emplace_back(here, settled_temperature(samples) / unit);
  }
  plot.curves = {std::move(simple), std::move(refined), std::move(now)};
  return plot;
}

}  // namespace

std::vector<std::string> profile_names(Axis axis) {
  std::vector<std::string> names;
  for (const Field field : profiled_fields(axis)) names.push_back(in_words(name_of(field)));
  names.push_back("balance residuals");
  return names;
}

Profiled profiled_by(std::size_t name) {
  return name < profiled_fields(Axis::X).size() ? Profiled::Fields : Profiled::Balances;
}

std::vector<LivePlot> plots_of(const History& history, const Frame& frame, std::size_t profiled,
                               const ThemeColours& theme) {
  const std::vector<Sample>& samples = history.samples();
  const int dimension = frame.scene->dimension();
  std::vector<LivePlot> plots;
  if (frame.profile && has_profile(*frame.profile, profiled)) {
    plots.push_back(profile_plot(*frame.profile, profiled, *frame.scene, theme));
  }
  if (frame.residuals) plots.push_back(balance_plot(*frame.residuals, dimension));
  if (frame.scene->piston) plots.push_back(piston_plot(samples, *frame.scene, theme.text));
  if (divider_of(*frame.scene)) plots.push_back(compartments_plot(samples, *frame.scene));
  plots.push_back(temperature_plot(samples, *frame.scene, theme.text));
  if (!frame.scene->species.empty()) {
    plots.push_back(species_temperature_plot(history, *frame.scene, theme));
  }
  if (frame.scene->species.size() > 1) plots.push_back(mixing_plot(samples, theme.text));
  plots.push_back(energy_plot(samples, static_cast<double>(frame.snapshot.count()), theme.text));
  plots.push_back(velocity_plot(history.velocities(), dimension, theme.text));
  const auto gas = vibrated_gas(*frame.scene);
  if (gas && gas->drive_speed > 0.0 && gas->wall_restitution == 1.0 && gas->restitution < 1.0) {
    plots.push_back(figure_plot(samples, *gas));
  }
  plots.push_back(residual_plot(samples));
  return plots;
}

// The value of a curve at x, between its points; absent: outside of them.
static std::optional<double> value_at(const std::vector<Vec2>& points, double x) {
  const auto after = std::ranges::lower_bound(points, x, {}, [](const Vec2& p) { return p.x(); });
  if (after == points.end()) return std::nullopt;
  if (after->x() == x) return after->y();
  if (after == points.begin()) return std::nullopt;
  const Vec2 &a = *(after - 1), &b = *after;
  return std::lerp(a.y(), b.y(), (x - a.x()) / (b.x() - a.x()));
}

// A curve minus another one, where both have values. Their errors are independent.
static Curve difference(const Curve& curve, const Curve& other) {
  Curve result = curve;
  result.points.clear();
  result.errors.clear();
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const double x = curve.points[i].x();
    const auto value = value_at(other.points, x);
    if (!value) continue;
    result.points.emplace_back(x, curve.points[i].y() - *value);
    if (curve.errors.empty() || other.errors.size() != curve.errors.size()) continue;
    result.errors.push_back(std::hypot(curve.errors[i], other.errors[i]));
  }
  return result;
}

std::optional<LivePlot> compared_plot(const std::vector<LivePlot>& of_gases,
                                      const std::vector<std::string>& names, bool differences) {
  constexpr std::array<Colour, kMostGases> kColours = {kBlue, kOrange, kGreen, kPurple};
  LivePlot joined = of_gases.front();
  joined.curves.clear();
  for (std::size_t k = 0; k < of_gases.size(); ++k) {
    const auto& curves = of_gases[k].curves;
    const auto curve = std::ranges::find(curves, true, &Curve::compared);
    if (curve == curves.end()) return std::nullopt;
    if (k == 0) joined.title += ", " + curve->name;
    joined.curves.push_back(*curve);
    joined.curves.back().name = names[k];
    joined.curves.back().colour = kColours[k];
    joined.span = std::max(joined.span, of_gases[k].span);
  }
  if (!differences) return joined;
  const Curve first = joined.curves.front();
  joined.curves.erase(joined.curves.begin());
  joined.title += ", minus " + first.name;
  joined.log_y = false;
  for (Curve& curve : joined.curves) curve = difference(curve, first);
  return joined;
}

std::vector<LivePlot> plots_of(const std::vector<PlottedGas>& gases, std::size_t profiled,
                               const ThemeColours& theme, bool differences) {
  std::vector<std::vector<LivePlot>> all;
  std::vector<std::string> names;
  for (const PlottedGas& gas : gases) {
    all.push_back(plots_of(*gas.history, *gas.frame, profiled, theme));
    names.push_back(gas.name);
  }
  if (all.size() == 1) return all.front();
  std::vector<LivePlot> plots;
  for (const LivePlot& first : all.front()) {
    std::vector<LivePlot> of_gases;
    for (const std::vector<LivePlot>& others : all) {
      const auto same = std::ranges::find(others, first.title, &LivePlot::title);
      if (same != others.end()) of_gases.push_back(*same);
    }
    if (of_gases.size() < all.size()) continue;
    if (auto plot = compared_plot(of_gases, names, differences)) plots.push_back(std::move(*plot));
  }
  return plots;
}

static std::optional<LivePlot> lecture_plot_of(LecturePlot which, const PlottedGas& gas,
                                               std::size_t profiled, const ThemeColours& theme) {
  const std::vector<Sample>& samples = gas.history->samples();
  const Frame& frame = *gas.frame;
  switch (which) {
    case LecturePlot::None:
      break;
    case LecturePlot::Temperature:
      return temperature_plot(samples, *frame.scene, theme.text);
    case LecturePlot::Energy:
      return energy_plot(samples, static_cast<double>(frame.snapshot.count()), theme.text);
    case LecturePlot::Velocities:
      return velocity_plot(gas.history->velocities(), frame.scene->dimension(), theme.text);
    case LecturePlot::Profile:
      if (!frame.profile || !has_profile(*frame.profile, profiled)) break;
      return profile_plot(*frame.profile, profiled, *frame.scene, theme);
  }
  return std::nullopt;
}

// The plot of each gas, joined by compared_plot(). Absent: some gas has none.
template <class PlotOf>
static std::optional<LivePlot> joined_plot(const std::vector<PlottedGas>& gases,
                                           const PlotOf& plot_of) {
  std::vector<LivePlot> of_gases;
  std::vector<std::string> names;
  for (const PlottedGas& gas : gases) {
    std::optional<LivePlot> plot = plot_of(gas);
    if (!plot) return std::nullopt;
    of_gases.push_back(std::move(*plot));
    names.push_back(gas.name);
  }
  return gases.size() == 1 ? of_gases.front() : compared_plot(of_gases, names, false);
}

static std::optional<LivePlot> plot_of_species(FilmPlot which, const PlottedGas& gas,
                                               const ThemeColours& theme) {
  const Scene& scene = *gas.frame->scene;
  if (scene.species.empty()) return std::nullopt;
  return which == FilmPlot::Mixing ? mixing_plot(gas.history->samples(), theme.text)
                                   : species_temperature_plot(*gas.history, scene, theme);
}

static std::optional<LivePlot> plot_of_divider(FilmPlot which, const PlottedGas& gas,
                                               const ThemeColours& theme) {
  const std::vector<Sample>& samples = gas.history->samples();
  const Scene& scene = *gas.frame->scene;
  if (which == FilmPlot::Piston) {
    if (!scene.piston) return std::nullopt;
    return piston_plot(samples, scene, theme.text);
  }
  if (!divider_of(scene)) return std::nullopt;
  return compartments_plot(samples, scene);
}

// A plot of an observable has the name of its table.
static std::optional<LivePlot> plot_of_observable(FilmPlot which, const PlottedGas& gas,
                                                  const ThemeColours& theme) {
  if (!gas.frame->observables) return std::nullopt;
  const auto& tables = *gas.frame->observables;
  const auto table = std::ranges::find(tables, name_of(which, kFilmPlots), &ResultTable::name);
  if (table == tables.end()) return std::nullopt;
  LivePlot plot = table_plots(*table, *gas.frame->scene, *gas.history, theme).front();
  plot.title.front() = static_cast<char>(std::toupper(plot.title.front()));
  return plot;
}

static LecturePlot kind_of(FilmPlot which) {
  switch (which) {
    case FilmPlot::Temperature:
      return LecturePlot::Temperature;
    case FilmPlot::Energy:
      return LecturePlot::Energy;
    case FilmPlot::Velocities:
      return LecturePlot::Velocities;
    case FilmPlot::SpeciesTemperature:
    case FilmPlot::Mixing:
    case FilmPlot::Compartments:
    case FilmPlot::Piston:
    case FilmPlot::MeanSquaredDisplacement:
    case FilmPlot::VelocityAutocorrelation:
      break;
    case FilmPlot::DensityProfile:
    case FilmPlot::TemperatureProfile:
    case FilmPlot::StressProfile:
    case FilmPlot::HeatFluxProfile:
    case FilmPlot::DissipationProfile:
      return LecturePlot::Profile;
  }
  return LecturePlot::None;
}

std::optional<LivePlot> film_plot(FilmPlot which, const std::vector<PlottedGas>& gases,
                                  const ThemeColours& theme) {
  if (which == FilmPlot::SpeciesTemperature || which == FilmPlot::Mixing) {
    return joined_plot(gases,
                       [&](const PlottedGas& gas) { return plot_of_species(which, gas, theme); });
  }
  if (which == FilmPlot::Compartments || which == FilmPlot::Piston) {
    return joined_plot(gases,
                       [&](const PlottedGas& gas) { return plot_of_divider(which, gas, theme); });
  }
  if (observable_of(which)) {
    return joined_plot(
        gases, [&](const PlottedGas& gas) { return plot_of_observable(which, gas, theme); });
  }
  const LecturePlot kind = kind_of(which);
  const auto first = static_cast<int>(FilmPlot::DensityProfile);
  const int profiled = is_profile(which) ? static_cast<int>(which) - first : 0;
  return lecture_plot(kind, gases, static_cast<std::size_t>(profiled), theme);
}

std::optional<LivePlot> lecture_plot(LecturePlot which, const std::vector<PlottedGas>& gases,
                                     std::size_t profiled, const ThemeColours& theme) {
  return joined_plot(
      gases, [&](const PlottedGas& gas) { return lecture_plot_of(which, gas, profiled, theme); });
}

}  // namespace clatter
