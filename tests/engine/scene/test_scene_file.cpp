#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "engine/embedded_file.h"
#include "engine/scene/field.h"
#include "engine/scene/scene_differences.h"
#include "engine/scene/scene_file.h"
#include "tests/engine/scene/refusal.h"
#include "tests/support/temporary_folder.h"

using namespace clatter;
using namespace clatter::testing;

namespace {

/// A scene in which every key differs from its default.
Scene unusual_scene() {
  Scene scene;
  scene.title = "quotes \" ' \\ and \x7f, tab\t, line\n, é ∞";
  scene.caption = "\x1b[31m #not a comment = {}";
  scene.goal = "to see";
  scene.try_this = "to do";
  scene.box = Vec2(123456.7, 2.3);
  scene.particles.count = 17;
  scene.particles.restitution = 1.0 / 3.0;
  scene.particles.roughness = {.friction = std::numeric_limits<double>::infinity(),
                               .tangential_restitution = -0.1};
  scene.particles.inertia = 0.4;
  scene.particles.start.layout = Layout::Lattice;
  scene.particles.start.temperature = 1e-300;
  scene.particles.start.spin_temperature = 0.7;
  scene.walls[kLeft] = Wall{.kind = WallKind::Driven, .restitution = 0.9, .drive_speed = 2.5};
  scene.walls[kLeft]->surface_velocity[1] = -1.5;
  scene.walls[kRight] = Wall{.kind = WallKind::Thermal, .temperature = 12345678901234567890.0};
  scene.walls[kBottom] = Wall{.kind = WallKind::Sawtooth,
                              .restitution = 0.25,
                              .roughness = {.friction = 0.1, .tangential_restitution = {}},
                              .stroke = 0.1,
                              .frequency = 1e9 / 3.0,
                              .phase = -0.3,
                              .surface_velocity = {0.75, 0.0, 0.0}};
  scene.walls[kTop] = Wall{.kind = WallKind::Sinusoidal,
                           .restitution = 1.5,
                           .stroke = 0.05,
                           .frequency = 2.0,
                           .phase = 0.5,
                           .surface_velocity = {-3.0, 0.0, 0.0}};
  scene.walls[kRight]->surface_velocity[1] = 2.25;
  scene.gravity = Vec2(0.1, -1.0 / 3.0);
  scene.bulk_drive = {
      .interval = 0.05, .kick_speed = 0.12, .kick_spin = 0.3, .law = KickLaw::Momentum};
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
  using enum ObservableKind;
  scene.measure.observables = {VelocityAutocorrelation,
                               RadialDistribution,
                               MeanSquaredDisplacement,
                               VelocityDistribution,
                               WallHits,
                               Clusters,
                               BondOrder,
                               WallPower,
                               PlaneCurrent,
                               LocalDensity,
                               SpinDistribution,
                               Probe,
                               CollisionCounts,
                               RadialDistributionProfile,
                               Collisions,
                               FreeFlights};
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
      .estimator = Estimator::Snapshot,
      .interval = 0.03,
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
      .lecture = {{"restitution"}, LecturePlot::Energy},
      .captions = {{.text = "T_x \\_", .from = {}, .to = 0.1}, {.text = "", .from = 0.3, .to = {}}},
      .pace = {{0.0, 1e-6}, {7.5, 2.0}},
      .camera = {{.time = 0.5, .centre = {}, .follow = 1, .width = 0.1},
                 {.time = 1e9, .centre = Vec2(-1.0, 1e-7), .follow = {}, .width = {}}}};
  return scene;
}

/// The keys of unusual_scene().
const std::string kUnusual = R"(
schema = 1
title = "quotes \" ' \\ and \u007f, tab\t, line\n, é ∞"
caption = "\u001b[31m #not a comment = {}"
goal = "to see"
try_this = 'to do'
box.size = [123456.7, 2.3]
[particles]
count = 17
restitution = 0.3333333333333333
friction = inf
tangential_restitution = -0.1
inertia = 0.4
start = { layout = "lattice", temperature = 1e-300, spin_temperature = 0.7 }
[walls]
left = { kind = "driven", restitution = 0.9, drive_speed = 2.5, surface_velocity = [0.0, -1.5] }
right = { kind = "thermal", temperature = 12345678901234567890.0, surface_velocity = [0.0, 2.25] }
top = { kind = "sinusoidal", restitution = 1.5, stroke = 0.05, frequency = 2.0, phase = 0.5, surface_velocity = [-3.0, 0.0] }
[walls.bottom]
kind = "sawtooth"
restitution = 0.25
friction = 0.1
stroke = 0.1
frequency = 333333333.3333333
phase = -0.3
surface_velocity = [0.75, 0.0]
[gravity]
acceleration = [0.1, -0.3333333333333333]
[bulk_drive]
interval = 0.05
kick_speed = 0.12
kick_spin = 0.3
law = "momentum"
[collapse]
contact_time = 1e-6
[measure]
burn_in = 0.0
duration = 1e308
series_interval = 5e-324
fields = ["velocity", "temperature_y", "density"]
cells = [3, 7]
profile_axis = "y"
estimator = "snapshot"
interval = 0.3
kernel = "gaussian"
width = 123456.7
observables = ["velocity_autocorrelation", "radial_distribution", "mean_squared_displacement",
  "velocity_distribution", "wall_hits", "clusters", "bond_order", "wall_power",
  "plane_current", "local_density", "spin_distribution", "probe", "collision_counts",
  "radial_distribution_profile", "collisions", "free_flights"]
radial_distribution = { interval = 0.7, range = 1.1, bins = 17 }
mean_squared_displacement = { interval = 0.3, longest = 2e6, lags = 2 }
velocity_autocorrelation = { interval = 0.2, longest = 0.2, lags = 999 }
clusters = { interval = 8.0, range = 1.01 }
bond_order = { interval = 2.5, longest = 9.0, lags = 3, range = 1.6 }
spin_distribution = { interval = 3.5, range = 7.0, bins = 5 }
wall_power = { interval = 0.4 }
plane_current = { interval = 0.6, axis = "y", position = 0.25 }
local_density = { interval = 0.9, cell = 2.2 }
probe = { interval = 0.45, lower = [0.0, 1e-3], upper = [0.3333333333333333, 0.2] }
collision_counts = { interval = 5.5 }
radial_distribution_profile = { interval = 2.25, range = 1.2, bins = 19, axis = "y", slabs = 7 }
[measure.velocity_distribution]
interval = 1e-3
range = 0.1
bins = 3
lower = [0.25, 0.5]
upper = [7.0, 1.5]
[view]
colour_by = "spin"
field = "temperature_x"
window = 0.125
estimator = "snapshot"
interval = 0.03
speed = 1e-7
palette = "inferno"
range = [-1.5, 2.0]
opacity = 1e-9
field_palette = "cividis"
field_style = "cells"
field_range = "locked"
arrows = "heat_flux"
theme = "projector"
background = "#000aff"
grid = true
tiling = true
overlay = false
overlay_hides = ["scale_bar", "time", "captions"]
plots = ["heat_flux_profile", "energy", "velocities"]
trails = 0.75
tracer = { particle = 41, time = 0.3 }
card = 1e-3
captions = [{ text = 'T_x \_', to = 0.1 }, { text = "", from = 0.3 }]
pace = [{ time = 0.0, factor = 1e-6 }, { time = 7.5, factor = 2.0 }]
lecture = { sliders = ["restitution"], plot = "energy" }
camera = [{ time = 0.5, follow = 1, width = 0.1 }, { time = 1e9, centre = [-1.0, 1e-7] }]
)";

}  // namespace

TEST_CASE("Scene file: a short scene has the defaults") {
  Scene expected;
  expected.particles.count = 10;
  CHECK(scene_to_toml(parse_scene(kParticles, "s.toml")) == scene_to_toml(expected));
}

TEST_CASE("Scene file: every key is read and written at its place") {
  const std::string written = scene_to_toml(unusual_scene());
  for (const KeyDifference& key : differences(kUnusual, written, "s.toml")) {
    FAIL_CHECK(key.key << " = " << key.now);
  }
  CHECK(scene_to_toml(parse_scene(kUnusual, "s.toml")) == written);
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

TEST_CASE("Scene file: further words are the choices of their names") {
  const auto scene_with = [](const std::string& line) {
    return parse_scene("particles = { count = 3, friction = 0.5 }\n" + line, "s.toml");
  };
  const auto view_with = [&](const std::string& line) { return scene_with("view." + line).view; };
  CHECK(view_with("colour_by = 'none'").colour_by == ColourBy::None);
  CHECK(view_with("colour_by = 'speed'").colour_by == ColourBy::Speed);
  CHECK(view_with("colour_by = 'velocity_x'").colour_by == ColourBy::VelocityX);
  CHECK(view_with("colour_by = 'velocity_y'").colour_by == ColourBy::VelocityY);
  CHECK(says(refusal_of([&] { view_with("colour_by = 'diameter'"); }), "have no species"));
  CHECK(view_with("palette = 'viridis'").palette == Palette::Viridis);
  CHECK(view_with("palette = 'cividis'").palette == Palette::Cividis);
  CHECK(view_with("arrows = 'velocity'").arrows == Quantity::Velocity);
  CHECK(view_with("theme = 'dark'").theme == Theme::Dark);
  CHECK(view_with("theme = 'light'").theme == Theme::Light);
  CHECK(view_with("range = 'auto'").range.kind == ColourRange::Auto);
  CHECK(scene_with("measure.profile_axis = 'x'").measure.profile_axis == Axis::X);
  CHECK(parse_scene("particles = { count = 3, start.layout = 'random' }", "s.toml")
            .particles.start.layout == Layout::Random);
  CHECK(scene_with("walls = { left = { kind = 'static' }, right = { kind = 'static' } }")
            .walls[kLeft]
            ->kind == WallKind::Static);
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
  CHECK(fields(R"(["density", "density"])") == std::vector{Field(Quantity::Density)});
  CHECK(fields(R"(["temperature_y"])") == std::vector{Field(Quantity::Temperature, 1)});
  CHECK(fields(R"(["temperature"])") == std::vector{Field(Quantity::Temperature),
                                                    Field(Quantity::Temperature, 0),
                                                    Field(Quantity::Temperature, 1)});
  // Each can be read as it is written.
  for (const auto& [name, field] : measured_names(2)) {
    if (of_species_alone(field.quantity)) continue;
    Scene scene = parse_scene(kParticles + "friction = 0.5\n", "s.toml");
    scene.measure.fields = fields("[\"" + name + "\"]");
    CHECK(std::ranges::find(scene.measure.fields, field) != scene.measure.fields.end());
    CHECK(parse_scene(scene_to_toml(scene), "s.toml").measure.fields == scene.measure.fields);
  }
}

TEST_CASE("Scene file: a scene as JSON has the keys of the file, and infinity as a text") {
  const std::string json = scene_to_json(parse_scene(kUnusual, "s.toml"));
  CAPTURE(json);
  for (const char* part :
       {R"({"schema": 1, "title": "quotes \" ' \\ and )", R"(, tab\u0009, line\u000a, é ∞", )",
        R"("caption": "\u001b[31m #not a comment = {}", )",
        R"("box": {"size": [123456.7, 2.3]}, "particles": {"count": 17, )",
        R"("friction": "inf", "tangential_restitution": -0.1, )",
        R"("spin_temperature": 0.7}}, "walls": {"left": {"kind": "driven", )",
        R"("fields": ["velocity", "temperature_y", "density"], "cells": [3, 7], )",
        R"("grid": true, "tiling": true, "overlay": false, )",
        R"("captions": [{"text": "T_x \\_", "to": 0.1}, {"text": "", "from": 0.3}], )"}) {
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

  const Override mistakes[] = {{"particles.restitution", "2"},
                               {"particles.restitutoin", "1"},
                               {"particles.count", "many"},
                               {"particles.count", "10000"},
                               {"walls.top.kind", "static"},
                               {"particles..count", "1"},
                               {"#", "1"},
                               {"", "1"}};
  for (const Override& mistake : mistakes) {
    CAPTURE(mistake.key);
    CHECK(refusal(text, {mistake}).starts_with("--set " + mistake.key + ": "));
  }
}

TEST_CASE("Scene file: a file is found by path or name, or the reason why not is given") {
  CHECK(load_scene("vibrated").title == "Vibrated box");
  CHECK(load_scene("vibrated.toml", {{"particles.count", "7"}}).particles.count == 7);
  for (const std::string name : {"vibratd", "scenes/vibrated.toml"}) {
    CHECK(load_refusal(name).starts_with(name + ": "));
    CHECK(says(load_refusal(name), "'vibrated'"));
  }
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
  CHECK(embedded_scenes().size() == 33);
  for (const EmbeddedFile& file : embedded_scenes()) {
    CAPTURE(file.name);
    const Scene scene = load_scene(std::string(file.name));
    CHECK(!scene.title.empty());
    CHECK(!scene.caption.empty());
    CHECK(!scene.goal.empty());
    CHECK(!scene.try_this.empty());
    CHECK(scene.particles.count > 0);
    CHECK(!scene.measure.fields.empty());
    CHECK(scene_to_toml(parse_scene(scene_to_toml(scene), "s.toml")) == scene_to_toml(scene));
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
