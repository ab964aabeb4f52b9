// The texts and the settings of the window's panels: each name with the value of its own key.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/view/messages.h"
#include "app/view/panels.h"
#include "app/view/plot.h"
#include "app/view/top_bar.h"
#include "engine/scene/scene_file.h"
#include "tests/app/panel_driver.h"
#include "tests/support/messages.h"

namespace clatter {

using nlohmann::json;
using testing::says;

namespace {

// All sliders have different values.
Scene uneven_scene() {
  Scene scene;
  scene.box = Vec2(19.0, 23.0);
  scene.particles.count = 14;
  scene.particles.restitution = 0.81;
  scene.particles.roughness = {.friction = 0.42, .tangential_restitution = 0.53};
  scene.walls = {
      Wall{.kind = WallKind::Driven, .restitution = 0.94, .drive_speed = 1.5},
      Wall{.kind = WallKind::Static, .restitution = 0.73},
      Wall{.kind = WallKind::Thermal, .temperature = 2.5},
      Wall{.kind = WallKind::Sinusoidal, .restitution = 0.86, .stroke = 0.31, .frequency = 1.12}};
  scene.gravity = Vec2(0.15, -0.47);
  scene.bulk_drive = BulkDrive{.interval = 0.7, .kick_speed = 0.22};
  scene.contact_time = 2e-4;
  View& view = scene.view;
  view.colour_by = ColourBy::VelocityY;
  view.field = Field(Quantity::Stress, 0, 1);
  view.window = 4.0;
  view.estimator = Estimator::Snapshot;
  view.interval = 0.3;
  view.palette = Palette::Cividis;
  view.range = {.kind = ColourRange::Given, .ends = {-1.25, 3.5}};
  view.field_palette = Palette::Inferno;
  view.field_range = {.kind = ColourRange::Given, .ends = {-4.5, 6.75}};
  view.arrows = Quantity::HeatFlux;
  view.theme = Theme::Light;
  view.grid = true;
  view.overlay = false;
  view.trails = 0.25;
  return scene;
}

// The same gas as spheres, with the keys that only spheres have.
Scene uneven_spheres() {
  Scene scene = uneven_scene();
  scene.box = Vec<3>(19.0, 23.0, 21.0);
  scene.walls[kBack] = Wall{.kind = WallKind::Thermal, .temperature = 1.75};
  scene.walls[kFront] = Wall{.kind = WallKind::Driven, .restitution = 0.95, .drive_speed = 0.65};
  scene.gravity = Vec<3>(0.15, -0.47, 0.29);
  scene.measure.cells = {20, 20, 20};
  View& view = scene.view;
  view.colour_by = ColourBy::VelocityZ;
  view.field = Field(Quantity::Stress, 1, 2);
  view.view_angle = 35.0;
  view.slab = Slab{Axis::Y, 2.5, 17.5};
  view.slices = {{Axis::X, 4.5}, {Axis::Z, 6.5}};
  return scene;
}

void all_panels(Session& session, Controls& controls) {
  gas_panel(session, controls);
  box_panel(session, controls);
  view_panel(session, controls);
  accuracy_panel(session, controls);
}

// The scene as changed by the panels: values by their positions in a scene file.
json settings(const PanelDriver& driver) {
  Scene scene = driver.session().scene();
  scene.view = driver.session().view();
  return json::parse(scene_to_json(scene)).flatten();
}

std::vector<std::string> changes(const json& before, const json& after) {
  std::vector<std::string> places;
  for (const auto& [place, value] : after.items()) {
    if (!before.contains(place) || before.at(place) != value) places.push_back(place);
  }
  for (const auto& [place, value] : before.items()) {
    if (!after.contains(place)) places.push_back(place);
  }
  return places;
}

using Places = std::vector<std::string>;

struct SliderMeaning {
  const char* key;
  const char* place;  // position in the scene
  double low, high;
  const char* line;  // with its value when the scene is opened
  const char* help;  // a part of the help text
  bool logarithmic = false;
  std::size_t number = 0;  // among widgets with the same key
};

const std::vector<SliderMeaning> kSliders = {
    {"particles.restitution", "/particles/restitution", 0.0, 1.0, "Restitution α 0.810",
     "that a collision of two particles keeps"},
    {"particles.friction", "/particles/friction", 0.0, 2.0, "Friction μ 0.420", "Coulomb"},
    {"particles.tangential_restitution", "/particles/tangential_restitution", -1.0, 1.0,
     "Tangential β₀ 0.530", "rolling"},
    {"box.size", "/box/size/0", 4.0, 100.0, "Width Lx 19.0 a", "Of the box"},
    {"box.size", "/box/size/1", 4.0, 100.0, "Height Ly 23.0 a", "Of the box", false, 1},
    {"walls.left.drive_speed", "/walls/left/drive_speed", 0.0, 5.0, "Drive speed v_dr 1.500 a/t",
     "Gain in normal velocity"},
    {"walls.left.restitution", "/walls/left/restitution", 0.0, 1.1, "Restitution α_w 0.940",
     "bounce keeps"},
    {"walls.right.restitution", "/walls/right/restitution", 0.0, 1.1, "Restitution α_w 0.730",
     "bounce keeps"},
    {"walls.bottom.temperature", "/walls/bottom/temperature", 0.0, 10.0,
     "Temperature T_w 2.500 m a²/t²", "it emits"},
    {"walls.top.stroke", "/walls/top/stroke", 0.0, 4.0, "Stroke 0.310 a", "whole travel"},
    {"walls.top.frequency", "/walls/top/frequency", 0.0, 10.0, "Frequency f 1.120 1/t",
     "Periods per time"},
    {"walls.top.restitution", "/walls/top/restitution", 0.0, 1.1, "Restitution α_w 0.860",
     "bounce keeps"},
    {"gravity.acceleration", "/gravity/acceleration/0", -2.0, 2.0, "Gravity along x g_x 0.150 a/t²",
     "Acceleration"},
    {"gravity.acceleration", "/gravity/acceleration/1", -2.0, 2.0,
     "Gravity along y g_y -0.470 a/t²", "Acceleration", false, 1},
    {"bulk_drive.kick_speed", "/bulk_drive/kick_speed", 0.0, 1.0, "Kicks s 0.220 a/t",
     "Homogeneous"},
    {"view.trails", "/view/trails", 0.0, 5.0, "Trails 0.25 t", "paths are drawn"},
    {"collapse.contact_time", "/collapse/contact_time", 1e-9, 0.1, "Duration t_c 2.0e-04 t",
     "TC model", true},
    {"view.interval", "/view/interval", 0.01, 4.0, "Snapshots every 0.300 t",
     "Time between two snapshots", true},
    {"view.window", "/view/window", 0.1, 100.0, "Averaged over 4.00 t", "Averaging time", true}};

// Those that only spheres have.
const std::vector<SliderMeaning> kSphereSliders = {
    {"box.size", "/box/size/2", 4.0, 100.0, "Depth Lz 21.0 a", "Of the box", false, 2},
    {"walls.back.temperature", "/walls/back/temperature", 0.0, 10.0,
     "Temperature T_w 1.750 m a²/t²", "it emits"},
    {"walls.front.drive_speed", "/walls/front/drive_speed", 0.0, 5.0, "Drive speed v_dr 0.650 a/t",
     "Gain in normal velocity"},
    {"walls.front.restitution", "/walls/front/restitution", 0.0, 1.1, "Restitution α_w 0.950",
     "bounce keeps"},
    {"gravity.acceleration", "/gravity/acceleration/2", -2.0, 2.0, "Gravity along z g_z 0.290 a/t²",
     "Acceleration", false, 2},
    {"view.view_angle", "/view/view_angle", 0.0, 90.0, "Angle of view 35 °", "parallel"},
    {"view.slab.from", "/view/slab/from", 0.0, 17.4, "From 2.5 a", "along its axis"},
    {"view.slab.to", "/view/slab/to", 2.6, 23.0, "To 17.5 a", "along its axis"},
    {"view.slices.x.position", "/view/slices/0/position", 0.0, 19.0, "Position 4.5 a",
     "along its axis"},
    {"view.slices.z.position", "/view/slices/1/position", 0.0, 21.0, "Position 6.5 a",
     "along its axis"}};

std::string text_of(PanelDriver& driver) {
  std::string text;
  for (const std::string& line : driver.lines()) text += line + ' ';
  return text;
}

// The number in a line, as a word.
std::string number_in(const std::string& line) {
  std::istringstream words(line);
  for (std::string word; words >> word;) {
    char* end = nullptr;
    std::strtod(word.c_str(), &end);
    if (!*end) return word;
  }
  return "none";
}

// Opens a list and selects an item.
void choose(PanelDriver& driver, const std::string& key, const std::string& word) {
  for (const std::string& widget : {key, key + '.' + word}) {
    const auto [x, y, width, height] = driver.place(widget);
    driver.click(x + 0.5f * width, y + 0.5f * height);
  }
}

void tick(PanelDriver& driver, const std::string& key) {
  const auto [x, y, width, height] = driver.place(key);
  driver.click(x + 0.5f * height, y + 0.5f * height);
}

void check_lines(const std::vector<std::string>& lines, const std::vector<std::string>& expected) {
  for (std::size_t k = 0; k < std::min(lines.size(), expected.size()); ++k) {
    CHECK(lines[k] == expected[k]);
  }
  CHECK(lines.size() == expected.size());
}

}  // namespace

TEST_CASE("Panels: every name is beside the value of its own key, in its unit") {
  PanelDriver driver(uneven_scene(), all_panels);
  check_lines(driver.lines(), {"### Gas ###",
                               "Disks N 14",
                               "{ 14 }",
                               "Area fraction φ = 0.025",
                               "Restitution α 0.810",
                               "{ 0.810 }",
                               "[x] Rough disks",
                               "Friction μ 0.420",
                               "{ 0.420 }",
                               "Tangential β₀ 0.530",
                               "{ 0.530 }",
                               "### Box and walls ###",
                               "Dimension",
                               "{ 2: disks }",
                               "Width Lx 19.0 a",
                               "{ 19.0 }",
                               "Height Ly 23.0 a",
                               "{ 23.0 }",
                               "Left",
                               "{ driven }",
                               "Drive speed v_dr 1.500 a/t",
                               "{ 1.500 }",
                               "Restitution α_w 0.940",
                               "{ 0.940 }",
                               "Right",
                               "{ static }",
                               "Restitution α_w 0.730",
                               "{ 0.730 }",
                               "Bottom",
                               "{ thermal }",
                               "Temperature T_w 2.500 m a²/t²",
                               "{ 2.500 }",
                               "Top",
                               "{ sinusoidal }",
                               "Stroke 0.310 a",
                               "{ 0.310 }",
                               "Frequency f 1.120 1/t",
                               "{ 1.120 }",
                               "Restitution α_w 0.860",
                               "{ 0.860 }",
                               "Gravity along x g_x 0.150 a/t²",
                               "{ 0.150 }",
                               "Gravity along y g_y -0.470 a/t²",
                               "{ -0.470 }",
                               "Kicks s 0.220 a/t",
                               "{ 0.220 }",
                               "### View ###",
                               "Disks coloured by",
                               "{ velocity y }",
                               "Palette",
                               "{ cividis }",
                               "Range of the disks",
                               "{ given }",
                               "{ -1.25 } { 3.5 }",
                               "Heatmap",
                               "{ stress xy }",
                               "Palette of the heatmap",
                               "{ inferno }",
                               "Range of the heatmap",
                               "{ given }",
                               "{ -4.5 } { 6.75 }",
                               "Arrows",
                               "{ heat flux }",
                               "Trails 0.25 t",
                               "{ 0.25 }",
                               "Theme",
                               "{ light }",
                               "[x] Grid",
                               "[ ] Title, figures and scales",
                               "### Accuracy ###",
                               "[x] Contact time",
                               "Duration t_c 2.0e-04 t",
                               "{ 0.0002 }",
                               "CPU time x1",
                               "Not dissipated: -",
                               "Elastic collisions: -",
                               "Fields from",
                               "{ snapshot x1.1 }",
                               "Snapshots every 0.300 t",
                               "{ 0.3 }",
                               "Averaged over 4.00 t",
                               "{ 4 }"});
}

static void check_sliders(const Scene& scene, const std::vector<SliderMeaning>& sliders) {
  for (const SliderMeaning& slider : sliders) {
    CAPTURE(slider.place);
    PanelDriver driver(scene, all_panels);
    const json before = settings(driver);
    auto [x, y, width, height] = driver.place(slider.key, slider.number);
    const float middle = y + 0.5f * height;
    driver.drag(x + 0.5f * width, middle, x + 0.75f * width);
    const json after = settings(driver);
    CHECK(changes(before, after) == Places{slider.place});
    const double value = after.at(slider.place);
    if (slider.logarithmic) {
      const double decades = std::log10(slider.high / slider.low);
      CHECK(std::log10(value / slider.low) == doctest::Approx(0.75 * decades).epsilon(0.05));
    } else {
      CHECK(std::fabs(value - slider.low - 0.75 * (slider.high - slider.low)) <
            0.02 * (slider.high - slider.low));
    }
    // While the mouse is over it: its help, and the value from the opening of the scene.
    const std::string told = text_of(driver);
    CHECK(says(told, slider.help));
    CHECK(says(told, "Here: " + number_in(slider.line)));
    CHECK_FALSE(says(told, slider.line));

    // The round reset arrow above its right end.
    driver.click(x + width - 7.0f, y - 10.0f);
    CHECK(changes(before, settings(driver)).empty());
  }
}

TEST_CASE("Panels: every slider sets the value of its own key, within its range, and back") {
  check_sliders(uneven_scene(), kSliders);
}

TEST_CASE("Panels: each slider of spheres changes its key, and disks lack these sliders") {
  check_sliders(uneven_spheres(), kSliders);
  check_sliders(uneven_spheres(), kSphereSliders);
  PanelDriver disks(uneven_scene(), all_panels);
  const std::string text = text_of(disks);
  for (const char* word : {"Depth", "Back", "Front", "along z", "View from", "Angle of view",
                           "Slab", "Slice", "pheres colo", "olume"}) {
    CAPTURE(word);
    CHECK_FALSE(says(text, word));
  }
}

TEST_CASE("Panels: spheres have the names of spheres, and no grid") {
  PanelDriver driver(uneven_spheres(), all_panels);
  const std::string text = text_of(driver);
  for (const char* line :
       {"Spheres N 14", "Volume fraction 0.001", "Rough spheres", "Dimension { 3: spheres }",
        "Back { thermal }", "Front { driven }", "View from [ x ] [ y ] [ z ] [ iso ]",
        "Slab across { y }", "Spheres coloured by { velocity z }", "Range of the spheres",
        "Heatmap { stress yz }", "[x] Slice across x", "[ ] Slice across y",
        "[x] Slice across z"}) {
    CAPTURE(line);
    CHECK(says(text, line));
  }
  CHECK_FALSE(says(text, "isks"));
  CHECK_FALSE(says(text, "Grid"));
}

TEST_CASE("Panels: buttons turn the view of spheres, and boxes choose its slices") {
  PanelDriver driver(uneven_spheres(), all_panels);
  struct Direction {
    const char* button;
    double azimuth, elevation;
  };
  // From a corner all axes make the same angle with the line of sight, of cosine 1/sqrt(3).
  for (const auto& [button, azimuth, elevation] :
       {Direction{"view.from.x", 90.0, 0.0}, Direction{"view.from.y", 0.0, 90.0},
        Direction{"view.from.z", 0.0, 0.0},
        Direction{"view.from.iso", 45.0, std::asin(1.0 / std::sqrt(3.0)) * 180.0 / M_PI}}) {
    tick(driver, button);
    CHECK(settings(driver).at("/view/azimuth") == doctest::Approx(azimuth));
    CHECK(settings(driver).at("/view/elevation") == doctest::Approx(elevation));
  }
  tick(driver, "view.slices.y");
  CHECK(settings(driver).at("/view/slices/2/position") == 11.5);
  tick(driver, "view.slices.x");
  CHECK(settings(driver).at("/view/slices/0/axis") == "z");
  CHECK_FALSE(settings(driver).contains("/view/slices/2/axis"));
  choose(driver, "view.slab.axis", "none");
  CHECK_FALSE(settings(driver).contains("/view/slab/axis"));
  choose(driver, "view.slab.axis", "x");
  CHECK(settings(driver).at("/view/slab/to") == 9.5);
  choose(driver, "walls.back", "periodic");
  CHECK_FALSE(settings(driver).contains("/walls/front/kind"));
  CHECK(settings(driver).at("/walls/bottom/kind") == "thermal");
  choose(driver, "view.colour_by", "depth");
  CHECK(settings(driver).at("/view/colour_by") == "depth");
}

TEST_CASE("Panels: the dimension is chosen in a list") {
  PanelDriver driver(uneven_spheres(), all_panels);
  driver.wait_for([](const Frame& frame) { return frame.run == 1; });
  choose(driver, "dimension", "2: disks");
  driver.wait_for([](const Frame& frame) { return frame.run == 2; });
  CHECK(driver.session().frame().snapshot.positions.rows() == 2);
  CHECK(says(driver.session().message(), "removed: walls.back, walls.front"));
  const json disks = settings(driver);
  CHECK(disks.at("/particles/count") == 14);
  CHECK_FALSE(disks.contains("/box/size/2"));
  choose(driver, "dimension", "3: spheres");
  driver.wait_for([](const Frame& frame) { return frame.run == 3; });
  CHECK(settings(driver).at("/box/size/2") == settings(driver).at("/box/size/1"));
}

TEST_CASE("Panels: every word of a list sets its own key to itself") {
  struct List {
    const char* key;
    std::vector<const char*> words;
  };
  for (const auto& [key, words] :
       {List{"view.colour_by", {"none", "speed", "velocity x", "spin"}},
        List{"view.palette", {"viridis", "inferno"}},
        List{"view.field", {"density", "velocity y", "temperature x"}},
        List{"view.field_palette", {"viridis", "cividis"}}, List{"view.arrows", {"velocity"}},
        List{"view.theme", {"dark", "projector"}},
        List{"walls.left", {"static", "thermal", "sawtooth", "sinusoidal"}},
        List{"walls.right", {"driven", "thermal"}}, List{"walls.bottom", {"sawtooth"}},
        List{"walls.top", {"static"}}}) {
    for (const std::string word : words) {
      CAPTURE(key);
      CAPTURE(word);
      PanelDriver driver(uneven_scene(), all_panels);
      const json before = settings(driver);
      choose(driver, key, word);
      const json after = settings(driver);
      std::string place = '/' + std::string(key), value = word;
      std::ranges::replace(place, '.', '/');
      std::ranges::replace(value, ' ', '_');
      const bool wall = place.starts_with("/walls");
      CHECK(after.at(wall ? place + "/kind" : place) == value);
      for (const std::string& changed : changes(before, after)) {
        CHECK(changed.starts_with(place));
      }
    }
  }
}

TEST_CASE("Panels: the first item of a list removes the feature") {
  PanelDriver driver(uneven_scene(), all_panels);
  const json before = settings(driver);
  choose(driver, "view.arrows", "none");
  CHECK(changes(before, settings(driver)) == Places{"/view/arrows"});
  choose(driver, "view.field_palette", "as the disks");
  CHECK_FALSE(settings(driver).contains("/view/field_palette"));
  choose(driver, "view.field", "none");
  CHECK_FALSE(settings(driver).contains("/view/field"));
  // The opposite side becomes periodic too.
  choose(driver, "walls.bottom", "periodic");
  CHECK_FALSE(settings(driver).contains("/walls/bottom/kind"));
  CHECK_FALSE(settings(driver).contains("/walls/top/kind"));
  CHECK(settings(driver).at("/walls/left/kind") == "driven");
  CHECK(settings(driver).at("/walls/right/kind") == "static");
}

TEST_CASE("Panels: ranges are automatic, locked or given from the one number to the other") {
  struct Range {
    const char* key;
    const char* place;
  };
  for (const auto& [key, place] :
       {Range{"view.range", "/view/range"}, Range{"view.field_range", "/view/field_range"}}) {
    CAPTURE(key);
    PanelDriver driver(uneven_scene(), all_panels);
    const json before = settings(driver);
    choose(driver, key, "locked");
    CHECK(settings(driver).at(place) == "locked");
    choose(driver, key, "auto");
    for (const std::string& changed : changes(before, settings(driver))) {
      CHECK(changed.starts_with(place));
    }
    choose(driver, key, "given");
    CHECK(changes(before, settings(driver)).empty());
  }
}

TEST_CASE("Panels: every box to tick switches its own key") {
  const auto changed_by = [](const char* key) {
    PanelDriver driver(uneven_scene(), all_panels);
    const json before = settings(driver);
    tick(driver, key);
    return changes(before, settings(driver));
  };
  CHECK(changed_by("view.grid") == Places{"/view/grid"});
  CHECK(changed_by("view.overlay") == Places{"/view/overlay"});
  CHECK(changed_by("contact_time") == Places{"/collapse/contact_time"});
}

TEST_CASE("Panels: spins go with their keys, and come back with the numbers that they had") {
  Scene scene = uneven_scene();
  scene.particles.inertia = 0.45;
  scene.particles.start.spin_temperature = 0.7;
  scene.bulk_drive->kick_spin = 0.9;
  PanelDriver driver(scene, all_panels);
  const json before = settings(driver);
  tick(driver, "rough");
  CHECK(driver.session().message().empty());
  CHECK(changes(before, settings(driver)) ==
        Places{"/particles/friction", "/particles/tangential_restitution", "/bulk_drive/kick_spin",
               "/particles/inertia", "/particles/start/spin_temperature"});
  tick(driver, "rough");
  CHECK(changes(before, settings(driver)) ==
        Places{"/particles/friction", "/particles/tangential_restitution"});
}

TEST_CASE("Panels: a feature starts with its usual numbers when switched on") {
  Scene scene = uneven_scene();
  scene.particles.roughness = {};
  scene.contact_time.reset();
  scene.bulk_drive.reset();
  PanelDriver driver(scene, all_panels);
  CHECK(says(text_of(driver), "[ Kick all disks ]"));
  tick(driver, "rough");
  tick(driver, "contact_time");
  tick(driver, "bulk_drive");
  const json after = settings(driver);
  CHECK(after.at("/particles/friction") == 0.5);
  CHECK(after.at("/particles/tangential_restitution") == 0.5);
  CHECK(after.at("/collapse/contact_time") == 1e-5);
  CHECK(after.at("/bulk_drive/interval") == 0.05);
  CHECK(after.at("/bulk_drive/kick_speed") == 0.1);
  choose(driver, "walls.bottom", "sawtooth");
  CHECK(settings(driver).at("/walls/bottom/stroke") == 0.2);
  CHECK(settings(driver).at("/walls/bottom/frequency") == 2.0);
  choose(driver, "walls.right", "driven");
  CHECK(settings(driver).at("/walls/right/drive_speed") == 1.0);
  CHECK(settings(driver).at("/walls/right/restitution") == 0.73);
}

TEST_CASE("Panels: a number of disks is set once its slider is let go") {
  PanelDriver driver(uneven_scene(), all_panels);
  const json before = settings(driver);
  const auto [x, y, width, height] = driver.place("particles.count");
  driver.drag(x + 0.5f * width, y + 0.5f * height, x + 0.75f * width);
  CHECK(changes(before, settings(driver)) == Places{"/particles/count"});
  // Logarithmic, up to the largest number that fits.
  CHECK(settings(driver).at("/particles/count") > 80);
  CHECK(settings(driver).at("/particles/count") < 110);
}

TEST_CASE("Panels: a picked disk shows its state, its last and its next collision") {
  Frame frame;
  frame.snapshot.positions.resize(2, 3);
  frame.snapshot.positions << 1.25, 2.5, 3.75, 4.125, 5.25, 6.5;
  frame.snapshot.velocities.resize(2, 3);
  frame.snapshot.velocities << 0.5, -3.0, 7.0, 0.25, 4.0, 9.0;
  frame.snapshot.spins.resize(1, 3);
  frame.snapshot.spins << 0.125, -0.625, 0.75;
  frame.last_collision = ParticleCollision{.time = 11.5, .partner = {}, .side = kTop};
  frame.next_collision = ParticleCollision{.time = 12.25, .partner = 2};
  bool follows = false;
  PanelDriver driver(Scene{}, [&](Session&, Controls&) {
    particle_label(frame, 1, follows, {100.0f, 100.0f}, {{0.0f, 0.0f}, {400.0f, 400.0f}});
  });
  check_lines(driver.lines(), {"Disk 1", "place 2.50, 5.25", "velocity -3.000, 4.000",
                               "speed 5.000", "spin -0.625", "last hit t = 11.5000, top wall",
                               "next hit t = 12.2500, disk 2", "double-click to follow"});
  follows = true;
  CHECK(driver.lines().back() == "followed; Esc lets go");
}

TEST_CASE("Panels: a picked sphere shows three components") {
  Frame frame;
  frame.snapshot.positions = Vec<3>(2.5, 5.25, 7.125);
  frame.snapshot.velocities = Vec<3>(-3.0, 4.0, 12.0);
  frame.snapshot.spins = Vec<3>(-0.625, 0.5, 0.25);
  frame.last_collision = ParticleCollision{.time = 11.5, .partner = {}, .side = kFront};
  frame.next_collision = ParticleCollision{.time = 12.25, .partner = 2};
  PanelDriver driver(Scene{}, [&](Session&, Controls&) {
    particle_label(frame, 0, false, {100.0f, 100.0f}, {{0.0f, 0.0f}, {400.0f, 400.0f}});
  });
  check_lines(driver.lines(),
              {"Sphere 0", "place 2.50, 5.25, 7.12", "velocity -3.000, 4.000, 12.000",
               "speed 13.000", "spin -0.625, 0.500, 0.250", "last hit t = 11.5000, front wall",
               "next hit t = 12.2500, sphere 2", "double-click to follow"});
}

TEST_CASE("Panels: a curve of theory has its meaning beside the mouse") {
  const LivePlot plot{
      .title = "Temperature",
      .x_label = "t",
      .curves = {{.name = "refined", .colour = {}, .points = {}, .help = "Holds somewhere"}}};
  PanelDriver driver(Scene{}, [&](Session&, Controls&) { draw_plot(plot, 200.0f); });
  CHECK_FALSE(says(text_of(driver), "Holds somewhere"));
  driver.point_at(45.0f, 36.0f);  // the first name of the legend
  CHECK(says(text_of(driver), "Holds somewhere"));
}

TEST_CASE("Panels: the top bar shows the time and sets the speed in steps of the root of 2") {
  Scene scene = uneven_scene();
  scene.title = "Uneven";
  scene.view.speed = 2.0;
  PanelVisibility shown;
  PanelDriver driver(
      scene, [&](Session& session, Controls& controls) { top_bar(session, controls, shown); });
  const auto click = [&](const char* widget) {
    const auto [x, y, width, height] = driver.place(widget);
    driver.click(x + 0.5f * width, y + 0.5f * height);
  };
  const auto speed_is = [](double speed) {
    return [speed](const Frame& frame) {
      return frame.run > 0 && std::fabs(frame.speed - speed) < 1e-9;
    };
  };
  driver.wait_for(speed_is(2.0));
  CHECK(says(text_of(driver), "Uneven"));
  CHECK(says(text_of(driver), "2 /s"));
  CHECK(says(text_of(driver), "t = 0.00"));
  click("faster");
  driver.wait_for(speed_is(2.0 * std::sqrt(2.0)));
  CHECK(says(text_of(driver), "2.83 /s"));
  click("slower");
  driver.wait_for(speed_is(2.0));
  // A frame lasts 1/60 s.
  for (int k = 1; k <= 3; ++k) {
    click("frame");
    driver.wait_for(
        [&](const Frame& frame) { return std::fabs(frame.snapshot.time - k * 2.0 / 60.0) < 1e-9; });
  }
  driver.point_at(0.0f, 3000.0f);  // away from buttons, whose help would be the last text
  CHECK(says(text_of(driver), "t = 0.10"));
  click("plots");
  CHECK(shown.plots);
  click("help");
  CHECK(shown.help);
  click("gallery");
  CHECK(shown.gallery);
  CHECK(shown.lesson);
  click("lesson");
  CHECK_FALSE(shown.lesson);
}

}  // namespace clatter
