#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "engine/embedded_file.h"
#include "engine/scene/field.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/scene/refusal.h"
#include "tests/support/temporary_folder.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

void check_equal(const Roughness& a, const Roughness& b) {
  CHECK(a.friction == b.friction);
  CHECK(a.tangential_restitution == b.tangential_restitution);
}

void check_equal(const std::optional<Wall>& a, const std::optional<Wall>& b) {
  REQUIRE(a.has_value() == b.has_value());
  if (!a) return;
  CHECK(a->kind == b->kind);
  CHECK(a->restitution == b->restitution);
  CHECK(a->drive_speed == b->drive_speed);
  CHECK(a->temperature == b->temperature);
  CHECK(a->stroke == b->stroke);
  CHECK(a->frequency == b->frequency);
  CHECK(a->phase == b->phase);
  check_equal(a->roughness, b->roughness);
}

void check_equal(const std::optional<BulkDrive>& a, const std::optional<BulkDrive>& b) {
  REQUIRE(a.has_value() == b.has_value());
  if (!a) return;
  CHECK(a->interval == b->interval);
  CHECK(a->kick_speed == b->kick_speed);
  CHECK(a->kick_spin == b->kick_spin);
}

void check_equal(const Scene& a, const Scene& b) {
  CHECK(a.title == b.title);
  CHECK(a.caption == b.caption);
  CHECK(a.goal == b.goal);
  CHECK(a.try_this == b.try_this);
  CHECK(a.box == b.box);
  CHECK(a.particles.count == b.particles.count);
  CHECK(a.particles.restitution == b.particles.restitution);
  check_equal(a.particles.roughness, b.particles.roughness);
  CHECK(a.particles.inertia == b.particles.inertia);
  CHECK(a.particles.start.layout == b.particles.start.layout);
  CHECK(a.particles.start.file == b.particles.start.file);
  CHECK(a.particles.start.state == b.particles.start.state);
  CHECK(a.particles.start.temperature == b.particles.start.temperature);
  CHECK(a.particles.start.spin_temperature == b.particles.start.spin_temperature);
  for (int side = 0; side < 4; ++side) check_equal(a.walls[side], b.walls[side]);
  CHECK(a.gravity == b.gravity);
  check_equal(a.bulk_drive, b.bulk_drive);
  CHECK(a.contact_time == b.contact_time);
  CHECK(a.measure.burn_in == b.measure.burn_in);
  CHECK(a.measure.duration == b.measure.duration);
  CHECK(a.measure.series_interval == b.measure.series_interval);
  CHECK(a.measure.fields == b.measure.fields);
  CHECK(a.measure.cells == b.measure.cells);
  CHECK(a.measure.profile_axis == b.measure.profile_axis);
  CHECK(a.measure.estimator == b.measure.estimator);
  CHECK(a.measure.interval == b.measure.interval);
  CHECK(a.measure.kernel == b.measure.kernel);
  CHECK(a.measure.width == b.measure.width);
  CHECK(a.view.colour_by == b.view.colour_by);
  CHECK(a.view.field == b.view.field);
  CHECK(a.view.window == b.view.window);
  CHECK(a.view.estimator == b.view.estimator);
  CHECK(a.view.interval == b.view.interval);
  CHECK(a.view.speed == b.view.speed);
  CHECK(a.measure.observables == b.measure.observables);
  const auto& [radial_interval, radial_range, radial_bins] = a.measure.radial_distribution;
  CHECK(radial_interval == b.measure.radial_distribution.interval);
  CHECK(radial_range == b.measure.radial_distribution.range);
  CHECK(radial_bins == b.measure.radial_distribution.bins);
  const auto check_region = [](const RegionSettings& first, const RegionSettings& second) {
    const auto& [lower, upper] = first;
    CHECK(lower == second.lower);
    CHECK(upper == second.upper);
  };
  const auto& [velocity_interval, velocity_range, velocity_bins, velocity_region] =
      a.measure.velocity_distribution;
  CHECK(velocity_interval == b.measure.velocity_distribution.interval);
  CHECK(velocity_range == b.measure.velocity_distribution.range);
  CHECK(velocity_bins == b.measure.velocity_distribution.bins);
  check_region(velocity_region, b.measure.velocity_distribution.region);
  const auto& [spin_interval, spin_range, spin_bins] = a.measure.spin_distribution;
  CHECK(spin_interval == b.measure.spin_distribution.interval);
  CHECK(spin_range == b.measure.spin_distribution.range);
  CHECK(spin_bins == b.measure.spin_distribution.bins);
  const auto& [probe_interval, probe_region] = a.measure.probe;
  CHECK(probe_interval == b.measure.probe.interval);
  check_region(probe_region, b.measure.probe.region);
  CHECK(a.measure.collision_counts.interval == b.measure.collision_counts.interval);
  const auto& [slab_interval, slab_range, slab_bins, slab_axis, slabs] =
      a.measure.radial_distribution_profile;
  CHECK(slab_interval == b.measure.radial_distribution_profile.interval);
  CHECK(slab_range == b.measure.radial_distribution_profile.range);
  CHECK(slab_bins == b.measure.radial_distribution_profile.bins);
  CHECK(slab_axis == b.measure.radial_distribution_profile.axis);
  CHECK(slabs == b.measure.radial_distribution_profile.slabs);
  const auto check_lags = [](const TimeCorrelationSettings& first,
                             const TimeCorrelationSettings& second) {
    const auto& [interval, longest, count] = first;
    CHECK(interval == second.interval);
    CHECK(longest == second.longest);
    CHECK(count == second.lags);
  };
  check_lags(a.measure.mean_squared_displacement, b.measure.mean_squared_displacement);
  check_lags(a.measure.velocity_autocorrelation, b.measure.velocity_autocorrelation);
  const auto& [cluster_interval, cluster_range] = a.measure.clusters;
  CHECK(cluster_interval == b.measure.clusters.interval);
  CHECK(cluster_range == b.measure.clusters.range);
  const auto& [bond_lags, bond_range] = a.measure.bond_order;
  check_lags(bond_lags, b.measure.bond_order.lags_in_time);
  CHECK(bond_range == b.measure.bond_order.range);
  CHECK(a.measure.wall_power.interval == b.measure.wall_power.interval);
  const auto& [current_interval, current_axis, current_position] = a.measure.plane_current;
  CHECK(current_interval == b.measure.plane_current.interval);
  CHECK(current_axis == b.measure.plane_current.axis);
  CHECK(current_position == b.measure.plane_current.position);
  const auto& [density_interval, density_cell] = a.measure.local_density;
  CHECK(density_interval == b.measure.local_density.interval);
  CHECK(density_cell == b.measure.local_density.cell);
  CHECK(a.view.palette == b.view.palette);
  CHECK(a.view.range == b.view.range);
  CHECK(a.view.field_palette == b.view.field_palette);
  CHECK(a.view.opacity == b.view.opacity);
  CHECK(a.view.field_style == b.view.field_style);
  CHECK(a.view.field_range == b.view.field_range);
  CHECK(a.view.arrows == b.view.arrows);
  CHECK(a.view.theme == b.view.theme);
  CHECK(a.view.background == b.view.background);
  CHECK(a.view.grid == b.view.grid);
  CHECK(a.view.tiling == b.view.tiling);
  CHECK(a.view.overlay == b.view.overlay);
  CHECK(a.view.trails == b.view.trails);
  CHECK(a.view.tracer == b.view.tracer);
  CHECK(a.view.card == b.view.card);
  REQUIRE(a.view.camera.size() == b.view.camera.size());
  for (std::size_t k = 0; k < a.view.camera.size(); ++k) {
    CHECK(a.view.camera[k].time == b.view.camera[k].time);
    CHECK(a.view.camera[k].centre == b.view.camera[k].centre);
    CHECK(a.view.camera[k].follow == b.view.camera[k].follow);
    CHECK(a.view.camera[k].width == b.view.camera[k].width);
  }
  REQUIRE(a.view.captions.size() == b.view.captions.size());
  for (std::size_t k = 0; k < a.view.captions.size(); ++k) {
    CHECK(a.view.captions[k].text == b.view.captions[k].text);
    CHECK(a.view.captions[k].from == b.view.captions[k].from);
    CHECK(a.view.captions[k].to == b.view.captions[k].to);
  }
}

/// A scene in which every key differs from its default.
Scene unusual_scene() {
  Scene scene;
  scene.title = "quotes \" ' \\ and \x7f, tab\t, line\n, é ∞";
  scene.caption = "\x1b[31m #not a comment = {}";
  scene.goal = "to see";
  scene.try_this = "to do";
  scene.box = Vec2(123456.7, 0.1 + 0.2 + 2.0);
  scene.particles.count = 17;
  scene.particles.restitution = 1.0 / 3.0;
  scene.particles.roughness = {.friction = std::numeric_limits<double>::infinity(),
                               .tangential_restitution = -0.1};
  scene.particles.inertia = 0.4;
  scene.particles.start.layout = Layout::Lattice;
  scene.particles.start.temperature = 1e-300;
  scene.particles.start.spin_temperature = 0.7;
  scene.walls[kLeft] = Wall{.kind = WallKind::Driven, .restitution = 0.9, .drive_speed = 2.5};
  scene.walls[kRight] = Wall{.kind = WallKind::Thermal, .temperature = 12345678901234567890.0};
  scene.walls[kBottom] = Wall{.kind = WallKind::Sawtooth,
                              .restitution = 0.25,
                              .roughness = {.friction = 0.1, .tangential_restitution = {}},
                              .stroke = 0.1,
                              .frequency = 1e9 / 3.0,
                              .phase = -0.3};
  scene.walls[kTop] =
      Wall{.kind = WallKind::Sinusoidal, .restitution = 1.5, .stroke = 0.05, .frequency = 2.0};
  scene.gravity = Vec2(0.1, -1.0 / 3.0);
  scene.bulk_drive = {.interval = 0.05, .kick_speed = 0.12, .kick_spin = 0.3};
  scene.contact_time = 1e-6;
  scene.measure.burn_in = 0.0;
  scene.measure.duration = 1e308;
  scene.measure.series_interval = 5e-324;
  scene.measure.fields = {Field(Quantity::Velocity, 0), Field(Quantity::Velocity, 1),
                          Field(Quantity::Temperature, 1), Quantity::Density};
  scene.measure.cells = {3, 7};
  scene.measure.profile_axis = Axis::Y;
  scene.measure.estimator = Estimator::Snapshot;
  scene.measure.interval = 0.3;
  scene.measure.kernel = Kernel::Gaussian;
  scene.measure.width = 123456.7;
  scene.measure.observables = {ObservableKind::VelocityAutocorrelation,
                               ObservableKind::RadialDistribution,
                               ObservableKind::MeanSquaredDisplacement,
                               ObservableKind::VelocityDistribution,
                               ObservableKind::WallHits,
                               ObservableKind::Clusters,
                               ObservableKind::BondOrder,
                               ObservableKind::WallPower,
                               ObservableKind::PlaneCurrent,
                               ObservableKind::LocalDensity,
                               ObservableKind::SpinDistribution,
                               ObservableKind::Probe,
                               ObservableKind::CollisionCounts,
                               ObservableKind::RadialDistributionProfile};
  scene.measure.radial_distribution = {.interval = 0.7, .range = 1.1, .bins = 17};
  scene.measure.velocity_distribution = {
      .interval = 1e-3, .range = 0.1, .bins = 3, .region = {Vec2(0.25, 0.5), Vec2(7.0, 1.5)}};
  scene.measure.mean_squared_displacement = {.interval = 0.3, .longest = 2e6, .lags = 2};
  scene.measure.velocity_autocorrelation = {.interval = 0.2, .longest = 0.2, .lags = 999};
  scene.measure.clusters = {.interval = 8.0, .range = 1.01};
  scene.measure.bond_order = {{.interval = 2.5, .longest = 9.0, .lags = 3}, 1.6};
  scene.measure.spin_distribution = {.interval = 3.5, .range = 7.0, .bins = 5};
  scene.measure.wall_power = {.interval = 0.4};
  scene.measure.plane_current = {.interval = 0.6, .axis = Axis::Y, .position = 0.25};
  scene.measure.local_density = {.interval = 0.9, .cell = 2.2};
  scene.measure.probe = {.interval = 0.45, .region = {Vec2(0.0, 1e-3), Vec2(1.0 / 3.0, 0.2)}};
  scene.measure.collision_counts = {.interval = 5.5};
  scene.measure.radial_distribution_profile = {
      .interval = 2.25, .range = 1.2, .bins = 19, .axis = Axis::Y, .slabs = 7};
  scene.view = {
      .colour_by = ColourBy::Spin,
      .field = Field(Quantity::Temperature, 0),
      .window = 0.125,
      .speed = 1e-7,
      .palette = Palette::Inferno,
      .range = {ColourRange::Given, {-1.5, 2.0}},
      .opacity = 1e-9,
      .field_palette = FieldPalette::Cividis,
      .field_style = FieldStyle::Cells,
      .field_range = {ColourRange::Locked},
      .arrows = Quantity::HeatFlux,
      .theme = Theme::Projector,
      .background = Rgb{0, 10, 255},
      .grid = true,
      .tiling = true,
      .overlay = false,
      .overlay_hides = {OverlayPart::ScaleBar, OverlayPart::Time, OverlayPart::Captions},
      .plots = {FilmPlot::HeatFluxProfile, FilmPlot::Energy, FilmPlot::Velocities},
      .trails = 0.75,
      .tracer = Tracer{41, 0.3},
      .card = 1e-3,
      .captions = {{.text = "T_x \\_", .from = {}, .to = 0.1}, {.text = "", .from = 0.3, .to = {}}},
      .pace = {{0.0, 1e-6}, {7.5, 2.0}},
      .camera = {{.time = 0.5, .centre = {}, .follow = 1, .width = 0.1},
                 {.time = 1e9, .centre = Vec2(-1.0, 1e-7), .follow = {}, .width = {}}}};
  return scene;
}

}  // namespace

TEST_CASE("Scene file: a short scene has the defaults") {
  Scene expected;
  expected.particles.count = 10;
  check_equal(parse_scene(kParticles, "s.toml"), expected);
}

TEST_CASE("Scene file: every key arrives at its place") {
  const Scene scene = parse_scene(R"(
    schema = 1
    title = "T"
    box.size = [12, 8.5]
    [particles]
    count = 3
    restitution = 0.9
    friction = inf
    inertia = 0.4
    start = { layout = "lattice", temperature = 2, spin_temperature = 3 }
    [walls]
    left = { kind = "driven", drive_speed = 1, restitution = 0.5 }
    right = { kind = "thermal", temperature = 3 }
    bottom = { kind = "sawtooth", stroke = 0.5, frequency = 4, tangential_restitution = 1 }
    top = { kind = "sinusoidal", stroke = 0.25, frequency = 3, phase = 0.5, restitution = 10 }
    [gravity]
    acceleration = [0, -1]
    [bulk_drive]
    interval = 0.05
    kick_speed = 0.12
    kick_spin = 0.1
    [collapse]
    contact_time = 1e-6
    [measure]
    fields = ["velocity", "density", "velocity"]
    cells = [4, 5]
    profile_axis = "y"
    estimator = "snapshot"
    interval = 0.5
    kernel = "gaussian"
    width = 1.5
    [view]
    field = "velocity_y"
    range = [0, 3]
    field_range = "locked"
    trails = 0.5
    captions = [{ text = "v^2", from = 1 }, { text = "T_x", to = 2 }]
    camera = [{ follow = 2 }, { time = 2, centre = [1, 2.5], width = 4 }]
  )",
                                  "s.toml");
  CHECK(scene.title == "T");
  CHECK(scene.box == Vec2(12.0, 8.5));
  CHECK(scene.particles.start.layout == Layout::Lattice);
  CHECK(scene.walls[kLeft]->drive_speed == 1.0);
  CHECK(scene.walls[kRight]->temperature == 3.0);
  CHECK(!scene.periodic(0));
  CHECK(scene.particles.roughness.friction == std::numeric_limits<double>::infinity());
  CHECK(!scene.particles.roughness.tangential_restitution);
  CHECK(scene.particles.inertia == 0.4);
  CHECK(scene.particles.start.spin_temperature == 3.0);
  CHECK(scene.walls[kBottom]->kind == WallKind::Sawtooth);
  CHECK(scene.walls[kBottom]->stroke == 0.5);
  CHECK(scene.walls[kBottom]->frequency == 4.0);
  CHECK(scene.walls[kBottom]->phase == 0.0);
  CHECK(scene.walls[kBottom]->roughness.tangential_restitution == 1.0);
  CHECK(scene.walls[kTop]->kind == WallKind::Sinusoidal);
  CHECK(scene.walls[kTop]->phase == 0.5);
  CHECK(scene.walls[kTop]->restitution == 10.0);
  CHECK(scene.gravity == Vec2(0.0, -1.0));
  CHECK(scene.bulk_drive->interval == 0.05);
  CHECK(scene.bulk_drive->kick_speed == 0.12);
  CHECK(scene.bulk_drive->kick_spin == 0.1);
  CHECK(scene.contact_time == 1e-6);
  CHECK(scene.view.trails == 0.5);
  REQUIRE(scene.view.captions.size() == 2);
  CHECK(scene.view.captions[0].text == "v^2");
  CHECK(scene.view.captions[0].from == 1.0);
  CHECK(!scene.view.captions[0].to);
  CHECK(scene.view.captions[1].to == 2.0);
  REQUIRE(scene.view.camera.size() == 2);
  CHECK(scene.view.camera[0].follow == 2);
  CHECK(!scene.view.camera[0].width);
  CHECK(scene.view.camera[1].time == 2.0);
  CHECK(scene.view.camera[1].centre == Vec2(1.0, 2.5));
  CHECK(scene.view.camera[1].width == 4.0);
  const std::vector<Field> fields = {Field(Quantity::Velocity, 0), Field(Quantity::Velocity, 1),
                                     Quantity::Density};
  CHECK(scene.measure.fields == fields);
  CHECK(scene.measure.cells == std::vector{4, 5});
  CHECK(scene.measure.profile_axis == Axis::Y);
  CHECK(scene.measure.estimator == Estimator::Snapshot);
  CHECK(scene.measure.interval == 0.5);
  CHECK(scene.measure.kernel == Kernel::Gaussian);
  CHECK(scene.measure.width == 1.5);
  CHECK(scene.view.field == Field(Quantity::Velocity, 1));
  CHECK(scene.view.range == ColourRange{ColourRange::Given, {0.0, 3.0}});
  CHECK(scene.view.field_range.kind == ColourRange::Locked);
}

TEST_CASE("Scene file: no key takes the value of another") {
  const Scene scene = parse_scene(R"(
    caption = "C"
    goal = "G"
    try_this = "Y"
    box.size = [12, 8.5]
    [particles]
    count = 3
    restitution = 0.91
    friction = 0.42
    tangential_restitution = 0.53
    inertia = 0.44
    start = { temperature = 2.5, spin_temperature = 3.5 }
    [walls]
    left = { kind = "driven", drive_speed = 1.25, restitution = 0.55, friction = 0.66 }
    right = { kind = "static", restitution = 0.77, tangential_restitution = 0.33 }
    bottom = { kind = "sawtooth", stroke = 0.15, frequency = 4.5, phase = 0.6 }
    top = { kind = "thermal", temperature = 3.25 }
    [measure]
    burn_in = 11
    duration = 12
    series_interval = 13
    [view]
    colour_by = "velocity_x"
    field = "stress_xy_kinetic"
    window = 14
    estimator = "snapshot"
    interval = 0.16
    speed = 17
    palette = "inferno"
    range = [-18, 19]
    opacity = 0.19
    field_palette = "cividis"
    field_style = "cells"
    field_range = [20, 21]
    arrows = "heat_flux"
    theme = "light"
    background = "#16171a"
    grid = true
    tiling = true
    overlay = false
    trails = 27
    card = 28
    [[change]]
    time = 29
    set = { "particles.restitution" = 0.3 }
    ramp = "linear"
    until = 31
  )",
                                  "s.toml");
  CHECK(scene.caption == "C");
  CHECK(scene.goal == "G");
  CHECK(scene.try_this == "Y");
  CHECK(scene.particles.count == 3);
  CHECK(scene.particles.restitution == 0.91);
  CHECK(scene.particles.roughness.friction == 0.42);
  CHECK(scene.particles.roughness.tangential_restitution == 0.53);
  CHECK(scene.particles.inertia == 0.44);
  CHECK(scene.particles.start.temperature == 2.5);
  CHECK(scene.particles.start.spin_temperature == 3.5);
  CHECK(scene.walls[kLeft]->drive_speed == 1.25);
  CHECK(scene.walls[kLeft]->restitution == 0.55);
  CHECK(scene.walls[kLeft]->roughness.friction == 0.66);
  CHECK(scene.walls[kRight]->restitution == 0.77);
  CHECK(scene.walls[kRight]->roughness.tangential_restitution == 0.33);
  CHECK(scene.walls[kBottom]->stroke == 0.15);
  CHECK(scene.walls[kBottom]->frequency == 4.5);
  CHECK(scene.walls[kBottom]->phase == 0.6);
  CHECK(scene.walls[kTop]->temperature == 3.25);
  CHECK(scene.measure.burn_in == 11.0);
  CHECK(scene.measure.duration == 12.0);
  CHECK(scene.measure.series_interval == 13.0);
  CHECK(scene.measure.estimator == Estimator::Exact);
  const View& view = scene.view;
  CHECK(view.colour_by == ColourBy::VelocityX);
  CHECK(view.field == Field(Quantity::Stress, 0, 1, Part::Kinetic));
  CHECK(view.window == 14.0);
  CHECK(view.estimator == Estimator::Snapshot);
  CHECK(view.interval == 0.16);
  CHECK(view.speed == 17.0);
  CHECK(view.palette == Palette::Inferno);
  CHECK(view.range == ColourRange{ColourRange::Given, {-18.0, 19.0}});
  CHECK(view.opacity == 0.19);
  CHECK(view.field_palette == FieldPalette::Cividis);
  CHECK(view.field_style == FieldStyle::Cells);
  CHECK(view.field_range == ColourRange{ColourRange::Given, {20.0, 21.0}});
  CHECK(view.arrows == Quantity::HeatFlux);
  CHECK(view.theme == Theme::Light);
  CHECK(view.background == Rgb{0x16, 0x17, 0x1a});
  CHECK(view.grid);
  CHECK(view.tiling);
  CHECK_FALSE(view.overlay);
  CHECK(view.trails == 27.0);
  CHECK(view.card == 28.0);
  REQUIRE(scene.changes.size() == 1);
  CHECK(scene.changes[0].time == 29.0);
  CHECK(scene.changes[0].ramp == Ramp::Linear);
  CHECK(scene.changes[0].until == 31.0);
}

TEST_CASE("Scene file: a stroke of the piston is read and written") {
  const Scene scene = parse_scene(
      "box.size = [12, 10]\nparticles.count = 4\nwalls.left.kind = 'static'\n"
      "walls.right.kind = 'static'\n[[change]]\ntime = 2.5\npiston = 7.25\nuntil = 4\n",
      "s.toml");
  const std::vector<Change> stroke = {{.time = 2.5, .piston = 7.25, .until = 4.0}};
  CHECK(scene.changes == stroke);
  CHECK(parse_scene(scene_to_toml(scene), "again.toml").changes == stroke);
}

TEST_CASE("Scene file: every word is the choice of its name") {
  const auto scene_with = [](const std::string& line) {
    return parse_scene("particles = { count = 3, friction = 0.5 }\n" + line, "s.toml");
  };
  const auto view_with = [&](const std::string& line) { return scene_with("view." + line).view; };
  CHECK(view_with("colour_by = 'none'").colour_by == ColourBy::None);
  CHECK(view_with("colour_by = 'speed'").colour_by == ColourBy::Speed);
  CHECK(view_with("colour_by = 'velocity_x'").colour_by == ColourBy::VelocityX);
  CHECK(view_with("colour_by = 'velocity_y'").colour_by == ColourBy::VelocityY);
  CHECK(view_with("colour_by = 'spin'").colour_by == ColourBy::Spin);
  CHECK(view_with("palette = 'viridis'").palette == Palette::Viridis);
  CHECK(view_with("palette = 'inferno'").palette == Palette::Inferno);
  CHECK(view_with("palette = 'cividis'").palette == Palette::Cividis);
  CHECK(view_with("arrows = 'velocity'").arrows == Quantity::Velocity);
  CHECK(view_with("arrows = 'heat_flux'").arrows == Quantity::HeatFlux);
  CHECK(view_with("theme = 'dark'").theme == Theme::Dark);
  CHECK(view_with("theme = 'light'").theme == Theme::Light);
  CHECK(view_with("theme = 'projector'").theme == Theme::Projector);
  CHECK(view_with("range = 'auto'").range.kind == ColourRange::Auto);
  CHECK(view_with("range = 'locked'").range.kind == ColourRange::Locked);
  CHECK(view_with("estimator = 'exact'").estimator == Estimator::Exact);
  CHECK(scene_with("measure.profile_axis = 'x'").measure.profile_axis == Axis::X);
  CHECK(scene_with("measure.profile_axis = 'y'").measure.profile_axis == Axis::Y);
  CHECK(scene_with("measure.kernel = 'box'").measure.kernel == Kernel::Box);
  CHECK(scene_with("measure.estimator = 'exact'").measure.estimator == Estimator::Exact);
  const auto layout = [](const std::string& word) {
    return parse_scene("particles = { count = 3, start.layout = '" + word + "' }", "s.toml")
        .particles.start.layout;
  };
  CHECK(layout("random") == Layout::Random);
  CHECK(layout("lattice") == Layout::Lattice);
  const auto kind = [&](const std::string& left) {
    return scene_with("walls = { left = { kind = " + left + " }, right = { kind = 'static' } }")
        .walls[kLeft]
        ->kind;
  };
  CHECK(kind("'static'") == WallKind::Static);
  CHECK(kind("'driven', drive_speed = 1") == WallKind::Driven);
  CHECK(kind("'thermal', temperature = 1") == WallKind::Thermal);
  CHECK(kind("'sawtooth', stroke = 0.1, frequency = 1") == WallKind::Sawtooth);
  CHECK(kind("'sinusoidal', stroke = 0.1, frequency = 1") == WallKind::Sinusoidal);
}

TEST_CASE("Scene file: area_fraction becomes the nearest count") {
  const Scene scene = parse_scene("box.size = [10, 10]\nparticles.area_fraction = 0.3\n", "s.toml");
  CHECK(scene.particles.count == 38);  // 0.3 * 400 / pi = 38.197
}

TEST_CASE("Scene file: a field name means all components, and each component has a name") {
  const auto fields = [](const std::string& list) {
    return parse_scene(kParticles + "friction = 0.5\n[measure]\nfields = " + list, "s.toml")
        .measure.fields;
  };
  CHECK(fields(R"(["stress"])") == std::vector{Field(Quantity::Stress, 0, 0),
                                               Field(Quantity::Stress, 1, 1),
                                               Field(Quantity::Stress, 0, 1)});
  CHECK(fields(R"(["heat_flux_kinetic", "spin"])") ==
        std::vector{Field(Quantity::HeatFlux, 0, Part::Kinetic),
                    Field(Quantity::HeatFlux, 1, Part::Kinetic), Field(Quantity::Spin)});
  CHECK(fields(R"(["temperature_y"])") == std::vector{Field(Quantity::Temperature, 1)});
  CHECK(fields(R"(["temperature"])") == std::vector{Field(Quantity::Temperature),
                                                    Field(Quantity::Temperature, 0),
                                                    Field(Quantity::Temperature, 1)});
  // Each can be read as it is written.
  for (const auto& [name, field] : measured_names(2)) {
    Scene scene = parse_scene(kParticles + "friction = 0.5\n", "s.toml");
    scene.measure.fields = fields("[\"" + name + "\"]");
    CHECK(std::ranges::find(scene.measure.fields, field) != scene.measure.fields.end());
    CHECK(parse_scene(scene_to_toml(scene), "s.toml").measure.fields == scene.measure.fields);
  }
}

TEST_CASE("Scene file: a scene unlike the defaults in every key survives writing and reading") {
  check_equal(parse_scene(scene_to_toml(unusual_scene()), "s.toml"), unusual_scene());
  Scene plain;
  plain.particles.count = 10;
  check_equal(parse_scene(scene_to_toml(plain), "s.toml"), plain);
}

TEST_CASE("Scene file: a scene as JSON has the keys of the file") {
  Scene scene = parse_scene(R"(
    title = "a \"b\"\n\u0007"
    box.size = [2.5, 20]
    particles.count = 3
    walls.bottom = { kind = "static" }
    walls.top = { kind = "thermal", temperature = 2 }
    measure.fields = ["velocity", "temperature"])",
                            "s.toml");
  CHECK(
      scene_to_json(scene) ==
      R"({"schema": 1, "title": "a \"b\"\u000a\u0007", "caption": "", "goal": "", "try_this": "", )"
      R"("box": {"size": [2.5, 20.0]}, )"
      R"("particles": {"count": 3, "restitution": 1.0, )"
      R"("start": {"layout": "random", "temperature": 1.0}}, )"
      R"("walls": {"bottom": {"kind": "static", "restitution": 1.0}, )"
      R"("top": {"kind": "thermal", "temperature": 2.0}}, )"
      R"("measure": {"burn_in": 100.0, "duration": 1000.0, "series_interval": 1.0, )"
      R"("fields": ["velocity", "temperature", "temperature_x", "temperature_y"], )"
      R"("cells": [20, 20], "profile_axis": "x", "estimator": "exact", "kernel": "box", )"
      R"("observables": []}, )"
      R"("view": {"colour_by": "speed", "window": 20.0, "estimator": "exact", "speed": 1.0, )"
      R"("palette": "viridis", )"
      R"("range": "auto", "opacity": 1.0, "field_palette": "blue", "field_style": "smooth", )"
      R"("field_range": "auto", "theme": "dark", "grid": false, "tiling": false, )"
      R"("overlay": true, "overlay_hides": [], "plots": [], )"
      R"("lecture": {"sliders": [], "plot": "temperature"}}})");
}

TEST_CASE(
    "Scene file: a scene as JSON has the keys of rough and driven gases, and infinity as a text") {
  const std::string json = scene_to_json(parse_scene(R"(
    particles = { count = 3, friction = inf, start.spin_temperature = 2 }
    walls.left = { kind = "sawtooth", stroke = 0.5, frequency = 3, friction = 0.5 }
    walls.right = { kind = "sinusoidal", stroke = 0.5, frequency = 3 }
    gravity.acceleration = [0, -1]
    bulk_drive = { interval = 0.5, kick_speed = 2 }
    collapse.contact_time = 1e-6)",
                                                     "s.toml"));
  CAPTURE(json);
  for (const char* part :
       {R"("particles": {"count": 3, "restitution": 1.0, "friction": "inf", "inertia": 0.5, )",
        R"("temperature": 1.0, "spin_temperature": 2.0})",
        R"("left": {"kind": "sawtooth", "restitution": 1.0, "friction": 0.5, "stroke": 0.5, )",
        R"("right": {"kind": "sinusoidal", "restitution": 1.0, "stroke": 0.5, "frequency": 3.0, )"
        R"("phase": 0.0}})",
        R"("gravity": {"acceleration": [0.0, -1.0]})",
        R"("bulk_drive": {"interval": 0.5, "kick_speed": 2.0, "kick_spin": 0.0})",
        R"("collapse": {"contact_time": 1e-06})"}) {
    CAPTURE(part);
    CHECK(says(json, part));
  }
}

TEST_CASE("Scene file: overrides replace values, and their mistakes name the flag") {
  const std::string text =
      "[particles]\narea_fraction = 0.3\n[walls.left]\nkind = \"driven\"\n"
      "drive_speed = 1\n[walls.right]\nkind = \"static\"\n[view]\nspeed = 2\n";
  const Scene scene = parse_scene(text, "s.toml",
                                  {{"particles.count", "50"},
                                   {"walls.left.drive_speed", "0"},
                                   {"walls.right", "{ kind = \"thermal\", temperature = 2 }"},
                                   {"view.range", "[0,3]"},
                                   {"view.palette", "inferno"},
                                   {"view.field", "\"density\""},
                                   {"title", "two words"},
                                   {"particles.start.temperature", "4"}});
  CHECK(scene.particles.count == 50);
  CHECK(scene.walls[kLeft]->drive_speed == 0.0);
  CHECK(scene.walls[kRight]->kind == WallKind::Thermal);
  CHECK(scene.view.range == ColourRange{ColourRange::Given, {0.0, 3.0}});
  CHECK(scene.view.palette == Palette::Inferno);
  CHECK(scene.view.field == Quantity::Density);
  CHECK(scene.view.speed == 2.0);
  CHECK(scene.title == "two words");
  CHECK(scene.particles.start.temperature == 4.0);
  CHECK(
      parse_scene(kParticles, "s.toml", {{"particles.area_fraction", "0.0078"}}).particles.count ==
      5);
  const std::string spheres = "box.size = [10, 10, 10]\n" + kParticles;
  CHECK(parse_scene(spheres, "s.toml", {{"particles.volume_fraction", "0.0105"}}).particles.count ==
        20);

  CHECK(refusal(text, {{"walls.left", "{ kind = \"static\" }"}}) == "");

  CHECK(refusal(text, {{"particles.restitution", "2"}}) ==
        "--set particles.restitution: 'particles.restitution' cannot be 2; give a number between 0 "
        "and 1");
  CHECK(refusal(text, {{"particles.restitutoin", "1"}}) ==
        "--set particles.restitutoin: unknown key 'restitutoin'; did you mean 'restitution'?");
  CHECK(says(refusal(text, {{"particles.count", "many"}}),
             "--set particles.count: 'particles.count' cannot be \"many\"; give a whole number"));
  CHECK(says(refusal(text, {{"particles.count", "10000"}}),
             "--set particles.count: 10000 particles have no place on a lattice in the box; give "
             "at most "));
  CHECK(says(refusal(text, {{"walls.top.kind", "static"}}),
             "--set walls.top.kind: [walls.top] has no wall opposite"));
  CHECK(says(refusal(text, {{"particles..count", "1"}}),
             "--set particles..count: \"particles..count\" cannot be a key"));
  CHECK(says(refusal(text, {{"#", "1"}}), "--set #: \"#\" cannot be a key"));
  CHECK(says(refusal(text, {{"", "1"}}), "cannot be a key"));
}

TEST_CASE("Scene file: a file is found by path or name, or the reason why not is given") {
  CHECK(load_scene("vibrated").title == "Vibrated box");
  CHECK(load_scene("vibrated.toml", {{"particles.count", "7"}}).particles.count == 7);
  CHECK(load_refusal("vibratd") ==
        "vibratd: there is no such scene; did you mean the gallery scene 'vibrated'?");
  CHECK(says(load_refusal("scenes/vibrated.toml"),
             "scenes/vibrated.toml: there is no such scene; did you mean the gallery scene 'vib"));
  CHECK(says(load_refusal("nothing-like-it"), "give a file or a name that `clatter scenes` lists"));
  const TemporaryFolder folder;
  const std::string path = folder / "";
  CHECK(says(load_refusal(path), path + ": this is a directory"));
  const std::string marked = "\xef\xbb\xbf[particles]\r\ncount = 3\r\n";
  CHECK(load_scene(folder.write("marked.toml", marked)).particles.count == 3);
  const std::string large = folder.write("large.toml", kParticles + std::string(1'000'000, '#'));
  CHECK(says(load_refusal(large), large + ": the file is larger than 1 MB"));
}

TEST_CASE("Scene file: the gallery's scenes are sound and presented") {
  CHECK(embedded_scenes().size() == 17);
  for (const EmbeddedFile& file : embedded_scenes()) {
    CAPTURE(file.name);
    const Scene scene = load_scene(std::string(file.name));
    CHECK(!scene.title.empty());
    CHECK(!scene.caption.empty());
    CHECK(!scene.goal.empty());
    CHECK(!scene.try_this.empty());
    CHECK(scene.particles.count > 0);
    CHECK(!scene.measure.fields.empty());
    check_equal(parse_scene(scene_to_toml(scene), "s.toml"), scene);
  }
}

TEST_CASE("Scene file: a zero has no sign") {
  const Scene scene = parse_scene(
      "particles = { count = 10, start.temperature = -0.0 }\ngravity.acceleration = [-0.0, -1.0]\n",
      "s.toml");
  CHECK_FALSE(std::signbit(scene.particles.start.temperature));
  CHECK_FALSE(std::signbit((*scene.gravity)[0]));
}

TEST_CASE("Scene: colours and fields of spins return with the spins, unless they are replaced") {
  const Scene rough = parse_scene(
      "box.size = [20, 20]\nparticles = { count = 9, tangential_restitution = 0.5 }\n"
      "view = { colour_by = 'spin', field = 'spin' }\n"
      "measure.fields = ['density', 'spin']\n",
      "s.toml");
  const std::vector<Override> smooth = {{"particles.tangential_restitution", "-1"},
                                        {"particles.friction", "0"}};
  const std::vector<Override> again = {{"particles.tangential_restitution", "0.5"},
                                       {"particles.friction", "inf"}};
  const Scene without = with_settings(rough, smooth);
  CHECK_FALSE(without.spins());
  const Scene back = with_settings(without, again);
  CHECK(back.view.colour_by == ColourBy::Spin);
  CHECK(back.view.field == Quantity::Spin);
  CHECK(back.measure.fields == std::vector<Field>{Quantity::Density, Quantity::Spin});

  const Scene replaced = with_settings(without, {{"view.colour_by", "\"none\""},
                                                 {"view.field", "\"density\""},
                                                 {"view.speed", "7.5"},
                                                 {"measure.fields", "[\"temperature\"]"}});
  CHECK(replaced.view.colour_by == ColourBy::None);
  CHECK(replaced.view.field == Quantity::Density);
  CHECK(replaced.view.speed == 7.5);
  CHECK(replaced.measure.fields.front() == Quantity::Temperature);
}

TEST_CASE("Scene file: profiles are along gravity, unless the scene has another axis") {
  const auto axis_of = [](const std::string& keys) {
    return parse_scene("particles.count = 5\n" + keys, "s.toml").measure.profile_axis;
  };
  CHECK(axis_of("") == Axis::X);
  CHECK(axis_of("gravity.acceleration = [0.2, -1.0]\n") == Axis::Y);
  CHECK(axis_of("gravity.acceleration = [1.0, 0.0]\n") == Axis::X);
  CHECK(axis_of("gravity.acceleration = [0.2, -1.0]\nmeasure.profile_axis = \"x\"\n") == Axis::X);
  CHECK(axis_of("box.size = [9, 9, 9]\ngravity.acceleration = [0.0, 0.0, -1.0]\n") == Axis::Z);
  for (const char* name : {"barometer", "shaker", "spheres_leidenfrost"}) {
    CAPTURE(std::string(name));
    const auto measure = load_scene(name).measure;
    CHECK(measure.profile_axis == Axis::Y);
    CHECK(measure.cells[1] > 20);
  }
}
