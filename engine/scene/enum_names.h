#pragma once

#include <array>
#include <string_view>

#include "engine/scene/scene.h"

namespace clatter {

/// Name of an enumerator in scene files.
template <class E>
struct Named {
  std::string_view name;
  E value;
};

/// The first name of an enumerator or field in a list of pairs of name and value; empty without a
/// name.
template <class E, class Names>
constexpr std::string_view name_of(E chosen, const Names& names) {
  for (const auto& [name, value] : names) {
    if (value == chosen) return name;
  }
  return {};
}

inline constexpr std::array<Named<Layout>, 4> kLayouts = {{{"random", Layout::Random},
                                                           {"insertion", Layout::Insertion},
                                                           {"lattice", Layout::Lattice},
                                                           {"file", Layout::File}}};

inline constexpr std::array<Named<WallKind>, 5> kWallKinds = {
    {{"static", WallKind::Static},
     {"driven", WallKind::Driven},
     {"thermal", WallKind::Thermal},
     {"sawtooth", WallKind::Sawtooth},
     {"sinusoidal", WallKind::Sinusoidal}}};

inline constexpr std::array<Named<PartitionSide>, 2> kPartitionSides = {
    {{"left", PartitionSide::Left}, {"right", PartitionSide::Right}}};
inline constexpr std::array<Named<ObstacleKind>, 3> kObstacleKinds = {
    {{"ball", ObstacleKind::Ball}, {"polygon", ObstacleKind::Polygon}, {"box", ObstacleKind::Box}}};

inline constexpr std::array<Named<ColourBy>, 9> kColourings = {{{"none", ColourBy::None},
                                                                {"speed", ColourBy::Speed},
                                                                {"velocity_x", ColourBy::VelocityX},
                                                                {"velocity_y", ColourBy::VelocityY},
                                                                {"velocity_z", ColourBy::VelocityZ},
                                                                {"spin", ColourBy::Spin},
                                                                {"depth", ColourBy::Depth},
                                                                {"species", ColourBy::Species},
                                                                {"diameter", ColourBy::Diameter}}};

inline constexpr std::array<Named<Palette>, 3> kPalettes = {
    {{"viridis", Palette::Viridis}, {"inferno", Palette::Inferno}, {"cividis", Palette::Cividis}}};
inline constexpr std::array<Named<FieldPalette>, 5> kFieldPalettes = {
    {{"blue", FieldPalette::Blue},
     {"grey", FieldPalette::Grey},
     {"viridis", FieldPalette::Viridis},
     {"inferno", FieldPalette::Inferno},
     {"cividis", FieldPalette::Cividis}}};
inline constexpr std::array<Named<FieldStyle>, 2> kFieldStyles = {
    {{"smooth", FieldStyle::Smooth}, {"cells", FieldStyle::Cells}}};

/// Quantities that arrows can show.
inline constexpr std::array<Named<Quantity>, 2> kArrows = {
    {{traits_of(Quantity::Velocity).name, Quantity::Velocity},
     {traits_of(Quantity::HeatFlux).name, Quantity::HeatFlux}}};

inline constexpr std::array<Named<Theme>, 3> kThemes = {
    {{"dark", Theme::Dark}, {"light", Theme::Light}, {"projector", Theme::Projector}}};

inline constexpr std::array<Named<LecturePlot>, 5> kLecturePlots = {
    {{"none", LecturePlot::None},
     {"temperature", LecturePlot::Temperature},
     {"energy", LecturePlot::Energy},
     {"velocities", LecturePlot::Velocities},
     {"profile", LecturePlot::Profile}}};

inline constexpr std::array<Named<OverlayPart>, 9> kOverlayParts = {
    {{"title", OverlayPart::Title},
     {"caption", OverlayPart::Caption},
     {"time", OverlayPart::Time},
     {"temperature", OverlayPart::Temperature},
     {"collisions", OverlayPart::Collisions},
     {"walls", OverlayPart::Walls},
     {"colour_bars", OverlayPart::ColourBars},
     {"scale_bar", OverlayPart::ScaleBar},
     {"captions", OverlayPart::Captions}}};

inline constexpr std::array<Named<FilmPlot>, 14> kFilmPlots = {
    {{"temperature", FilmPlot::Temperature},
     {"energy", FilmPlot::Energy},
     {"velocities", FilmPlot::Velocities},
     {"species_temperature", FilmPlot::SpeciesTemperature},
     {"mixing", FilmPlot::Mixing},
     {"compartments", FilmPlot::Compartments},
     {"piston", FilmPlot::Piston},
     {"mean_squared_displacement", FilmPlot::MeanSquaredDisplacement},
     {"velocity_autocorrelation", FilmPlot::VelocityAutocorrelation},
     {"density_profile", FilmPlot::DensityProfile},
     {"temperature_profile", FilmPlot::TemperatureProfile},
     {"stress_profile", FilmPlot::StressProfile},
     {"heat_flux_profile", FilmPlot::HeatFluxProfile},
     {"dissipation_profile", FilmPlot::DissipationProfile}}};

inline constexpr std::array<Named<Axis>, 3> kAxes = {
    {{"x", Axis::X}, {"y", Axis::Y}, {"z", Axis::Z}}};

inline constexpr std::array<Named<Estimator>, 2> kEstimators = {
    {{"exact", Estimator::Exact}, {"snapshot", Estimator::Snapshot}}};

inline constexpr std::array<Named<Kernel>, 2> kKernels = {
    {{"box", Kernel::Box}, {"gaussian", Kernel::Gaussian}}};

inline constexpr std::array<Named<ObservableKind>, 18> kObservables = {
    {{"radial_distribution", ObservableKind::RadialDistribution},
     {"velocity_distribution", ObservableKind::VelocityDistribution},
     {"free_flights", ObservableKind::FreeFlights},
     {"collisions", ObservableKind::Collisions},
     {"wall_hits", ObservableKind::WallHits},
     {"mean_squared_displacement", ObservableKind::MeanSquaredDisplacement},
     {"velocity_autocorrelation", ObservableKind::VelocityAutocorrelation},
     {"structure_factor", ObservableKind::StructureFactor},
     {"clusters", ObservableKind::Clusters},
     {"bond_order", ObservableKind::BondOrder},
     {"wall_power", ObservableKind::WallPower},
     {"plane_current", ObservableKind::PlaneCurrent},
     {"local_density", ObservableKind::LocalDensity},
     {"spin_distribution", ObservableKind::SpinDistribution},
     {"probe", ObservableKind::Probe},
     {"collision_counts", ObservableKind::CollisionCounts},
     {"radial_distribution_profile", ObservableKind::RadialDistributionProfile},
     {"mixing", ObservableKind::Mixing}}};

inline constexpr std::array<Named<Spread>, 3> kSpreads = {{{"uniform", Spread::Uniform},
                                                           {"gaussian", Spread::Gaussian},
                                                           {"lognormal", Spread::Lognormal}}};
inline constexpr std::array<Named<KickLaw>, 3> kKickLaws = {{{"velocity", KickLaw::Velocity},
                                                             {"energy", KickLaw::Energy},
                                                             {"momentum", KickLaw::Momentum}}};

inline constexpr std::array<Named<Ramp>, 1> kRamps = {{{"linear", Ramp::Linear}}};

}  // namespace clatter
