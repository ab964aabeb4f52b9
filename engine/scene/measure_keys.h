#pragma once

#include "engine/scene/enum_names.h"
#include "engine/scene/key_rules.h"
#include "engine/scene/key_table.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene.h"

// The keys of measurements, see scene_keys.h.

namespace clatter {

inline constexpr auto kMeasureKeys = key_table(
    "measure",
    {{"burn_in", "t", "Time before averages start."},
     {"duration", "t", "Time over which averages are taken."},
     {"series_interval", "t",
      "Spacing of the series of temperatures. The series starts at time 0."},
     {"fields", "", "Fields that are averaged, and residuals of the balance equations."},
     {"cells", "1", "Number of cells along each axis, for fields."},
     {"profile_axis", "",
      "Axis of the profiles. With gravity the default is its axis. z is for spheres only."},
     {"estimator", "", "Estimator of the fields. It integrates every flight, or takes snapshots."},
     {"interval", "t", "Time between snapshots."},
     {"kernel", "",
      "Weight of a particle in the cells. A box counts it in its own cell. A Gaussian needs "
      "snapshots."},
     {"width", "a", "Standard deviation of the Gaussian, per axis. At least half a cell."},
     {"observables", "", "Quantities that are measured besides means and fields."}});

inline constexpr auto kRadialDistributionKeys = key_table(
    "measure",
    {{"interval", "t", "Time between samples of the distances of all pairs."},
     {"range", "a",
      "Largest distance. In small boxes it is half the shortest period, or the shortest distance "
      "between walls."},
     {"bins", "1", "Number of equal bins between contact and `range`."}});

inline constexpr auto kVelocityDistributionKeys = key_table(
    "measure", {{"interval", "t", "Time between samples of all velocities."},
                {"range", "1", "Largest velocity component, in units of the thermal speed."},
                {"bins", "1", "Number of equal bins between -`range` and `range`."},
                {"lower", "a",
                 "Lower corner of the region of the particles. Without a value it is that of the "
                 "box."},
                {"upper", "a",
                 "Upper corner of the region of the particles. Without a value it is that of the "
                 "box."}});

inline constexpr auto kStructureFactorKeys = key_table(
    "measure",
    {{"interval", "t", "Time between samples."},
     {"range", "1/a", "Largest wave number."},
     {"bins", "1", "Number of shells of equal width between 0 and `range`."},
     {"vectors", "1", "Largest number of wave vectors in a shell, in spread directions."}});

inline constexpr auto kClusterKeys = key_table(
    "measure", {{"interval", "t", "Time between samples."},
                {"range", "a", "Largest distance of the centres of connected particles."}});

inline constexpr auto kBondOrderKeys =
    key_table("measure", {{"range", "a", "Largest distance of the centres of neighbours."}});

inline constexpr auto kSpinDistributionKeys = key_table(
    "measure", {{"interval", "t", "Time between samples of all spins."},
                {"range", "1", "Largest spin component, in units of the root mean square."},
                {"bins", "1", "Number of equal bins between -`range` and `range`."}});

inline constexpr auto kWallPowerKeys =
    key_table("measure", {{"interval", "t", "Time over which the power is averaged."}});

inline constexpr auto kPlaneCurrentKeys =
    key_table("measure", {{"interval", "t", "Time over which the crossings are counted."},
                          {"axis", "", "Normal of the plane. z is for spheres only."},
                          {"position", "1", "Position of the plane, as a share of the box."}});

inline constexpr auto kLocalDensityKeys =
    key_table("measure", {{"interval", "t", "Time between samples."},
                          {"cell", "a", "Shortest edge of the cells, which fill the box."}});

inline constexpr auto kMixingKeys =
    key_table("measure", {{"interval", "t", "Time between samples."},
                          {"cell", "a",
                           "Shortest edge of the cells, which fill the box. A cell needs several "
                           "particles."}});

inline constexpr auto kProbeKeys = key_table(
    "measure", {{"interval", "t", "Time between samples."},
                {"lower", "a",
                 "Lower corner of the region. Without a value it is at 1/4 of each side of the "
                 "box."},
                {"upper", "a",
                 "Upper corner of the region. Without a value it is at 3/4 of each side of the "
                 "box."}});

inline constexpr auto kCollisionCountKeys =
    key_table("measure", {{"interval", "t", "Time over which the collisions are counted."}});

inline constexpr auto kRadialProfileKeys = key_table(
    "measure",
    {{"interval", "t", "Time between samples of the distances of all pairs."},
     {"range", "a",
      "Largest distance. In small boxes it is half the shortest period, or the shortest distance "
      "between walls."},
     {"bins", "1", "Number of equal bins between contact and `range`."},
     {"axis", "", "Normal of the slabs. z is for spheres only."},
     {"slabs", "1", "Number of equal slabs of the region of the centres."}});

inline constexpr auto kTimeCorrelationKeys = key_table(
    "measure", {{"interval", "t", "Shortest lag. All particles are sampled at this interval."},
                {"longest", "t", "Longest lag."},
                {"lags", "1",
                 "Number of lags of equal spacing. Longer lags have a spacing larger by this "
                 "factor, and so on."}});

/// The keys of a correlation in time.
template <class Visitor>
void visit_time_correlation(Visitor& io, TimeCorrelationSettings& settings, Presence presence) {
  io.value(kTimeCorrelationKeys.at("interval"), settings.interval, above(0.0), presence);
  io.value(kTimeCorrelationKeys.at("longest"), settings.longest, above(0.0), presence);
  io.value(kTimeCorrelationKeys.at("lags"), settings.lags, between(2, 1000), presence);
}

/// The keys of a region.
template <const auto& keys, class Visitor>
void visit_region(Visitor& io, RegionSettings& region, Presence presence) {
  io.value(keys.at("lower"), region.lower, at_least(0.0), presence);
  io.value(keys.at("upper"), region.upper, above(0.0), presence);
}

/// The keys of a distribution.
template <const auto& keys, class Visitor, class Settings>
void visit_distribution(Visitor& io, Settings& settings, Presence presence) {
  io.value(keys.at("interval"), settings.interval, above(0.0), presence);
  io.value(keys.at("range"), settings.range, above(0.0), presence);
  io.value(keys.at("bins"), settings.bins, between(2, 100'000), presence);
}

/// The tables of the observables in [measure]. Each requires its observable.
template <class Visitor>
void visit_observables(Visitor& io, Measure& measure) {
  io.choice(kMeasureKeys.at("observables"), measure.observables, kObservables);
  const auto presence_of = [&](ObservableKind kind) {
    return measure.observes(kind) ? kOptional : kNotObserved;
  };
  io.table("radial_distribution", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::RadialDistribution);
    RadialDistributionSettings& settings = measure.radial_distribution;
    io.value(kRadialDistributionKeys.at("interval"), settings.interval, above(0.0), presence);
    io.value(kRadialDistributionKeys.at("range"), settings.range, above(1.0), presence);
    io.value(kRadialDistributionKeys.at("bins"), settings.bins, between(10, 100'000), presence);
  });
  io.table("velocity_distribution", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::VelocityDistribution);
    visit_distribution<kVelocityDistributionKeys>(io, measure.velocity_distribution, presence);
    visit_region<kVelocityDistributionKeys>(io, measure.velocity_distribution.region, presence);
  });
  io.table("spin_distribution", [&](auto& io) {
    visit_distribution<kSpinDistributionKeys>(io, measure.spin_distribution,
                                              presence_of(ObservableKind::SpinDistribution));
  });
  io.table("mean_squared_displacement", [&](auto& io) {
    visit_time_correlation(io, measure.mean_squared_displacement,
                           presence_of(ObservableKind::MeanSquaredDisplacement));
  });
  io.table("velocity_autocorrelation", [&](auto& io) {
    visit_time_correlation(io, measure.velocity_autocorrelation,
                           presence_of(ObservableKind::VelocityAutocorrelation));
  });
  io.table("structure_factor", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::StructureFactor);
    StructureFactorSettings& settings = measure.structure_factor;
    io.value(kStructureFactorKeys.at("interval"), settings.interval, above(0.0), presence);
    io.value(kStructureFactorKeys.at("range"), settings.range, above(0.0), presence);
    io.value(kStructureFactorKeys.at("bins"), settings.bins, between(1, 10'000), presence);
    io.value(kStructureFactorKeys.at("vectors"), settings.vectors, between(1, 100), presence);
  });
  io.table("clusters", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::Clusters);
    io.value(kClusterKeys.at("interval"), measure.clusters.interval, above(0.0), presence);
    io.value(kClusterKeys.at("range"), measure.clusters.range, above(1.0), presence);
  });
  io.table("bond_order", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::BondOrder);
    visit_time_correlation(io, measure.bond_order.lags_in_time, presence);
    io.value(kBondOrderKeys.at("range"), measure.bond_order.range, above(1.0), presence);
  });
  io.table("wall_power", [&](auto& io) {
    io.value(kWallPowerKeys.at("interval"), measure.wall_power.interval, above(0.0),
             presence_of(ObservableKind::WallPower));
  });
  io.table("plane_current", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::PlaneCurrent);
    PlaneCurrentSettings& settings = measure.plane_current;
    io.value(kPlaneCurrentKeys.at("interval"), settings.interval, above(0.0), presence);
    io.choice(kPlaneCurrentKeys.at("axis"), settings.axis, kAxes, presence);
    io.value(kPlaneCurrentKeys.at("position"), settings.position, between(0.0, 1.0), presence);
  });
  io.table("local_density", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::LocalDensity);
    io.value(kLocalDensityKeys.at("interval"), measure.local_density.interval, above(0.0),
             presence);
    io.value(kLocalDensityKeys.at("cell"), measure.local_density.cell, above(0.0), presence);
  });
  io.table("probe", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::Probe);
    io.value(kProbeKeys.at("interval"), measure.probe.interval, above(0.0), presence);
    visit_region<kProbeKeys>(io, measure.probe.region, presence);
  });
  io.table("collision_counts", [&](auto& io) {
    io.value(kCollisionCountKeys.at("interval"), measure.collision_counts.interval, above(0.0),
             presence_of(ObservableKind::CollisionCounts));
  });
  io.table("radial_distribution_profile", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::RadialDistributionProfile);
    RadialProfileSettings& settings = measure.radial_distribution_profile;
    io.value(kRadialProfileKeys.at("interval"), settings.interval, above(0.0), presence);
    io.value(kRadialProfileKeys.at("range"), settings.range, above(1.0), presence);
    io.value(kRadialProfileKeys.at("bins"), settings.bins, between(2, 1000), presence);
    io.choice(kRadialProfileKeys.at("axis"), settings.axis, kAxes, presence);
    io.value(kRadialProfileKeys.at("slabs"), settings.slabs, between(1, 200), presence);
  });
  io.table("mixing", [&](auto& io) {
    const Presence presence = presence_of(ObservableKind::Mixing);
    io.value(kMixingKeys.at("interval"), measure.mixing.interval, above(0.0), presence);
    io.value(kMixingKeys.at("cell"), measure.mixing.cell, above(0.0), presence);
  });
}

/// The keys of [measure] in a box of this dimension. Keys of snapshots and of the Gaussian kernel
/// require these.
template <class Visitor>
void visit_measure(Visitor& io, Measure& measure, int dimension) {
  io.value(kMeasureKeys.at("burn_in"), measure.burn_in, at_least(0.0));
  io.value(kMeasureKeys.at("duration"), measure.duration, above(0.0));
  io.value(kMeasureKeys.at("series_interval"), measure.series_interval, above(0.0));
  io.choice(kMeasureKeys.at("fields"), measure.fields, measured_names(dimension));
  io.value(kMeasureKeys.at("cells"), measure.cells, between(1, 2000));
  io.choice(kMeasureKeys.at("profile_axis"), measure.profile_axis, kAxes);
  io.choice(kMeasureKeys.at("estimator"), measure.estimator, kEstimators);
  const bool exact = measure.estimator == Estimator::Exact;
  io.value(kMeasureKeys.at("interval"), measure.interval, above(0.0),
           exact ? kNotOfExact : kRequired);
  io.choice(kMeasureKeys.at("kernel"), measure.kernel, kKernels);
  const bool box = measure.kernel == Kernel::Box;
  io.value(kMeasureKeys.at("width"), measure.width, above(0.0), box ? kNotOfBox : kRequired);
  visit_observables(io, measure);
}

}  // namespace clatter
