#include "tests/window/panel_actions.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "app/view/panels.h"
#include "engine/scene/scene_file.h"
#include "tests/support/messages.h"

namespace clatter {

using nlohmann::json;

Scene uneven_disks() {
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
  view.opacity = 0.65;
  view.field_palette = FieldPalette::Inferno;
  view.field_range = {.kind = ColourRange::Given, .ends = {-4.5, 6.75}};
  view.arrows = Quantity::HeatFlux;
  view.theme = Theme::Light;
  view.grid = true;
  view.overlay = false;
  view.trails = 0.25;
  view.tracer = Tracer{7, 3.5};
  return scene;
}

Scene uneven_spheres() {
  Scene scene = uneven_disks();
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
  view.volume = 0.75;
  return scene;
}

void all_panels(Session& session, Controls& controls) {
  gas_panel(session, controls);
  box_panel(session, controls);
  view_panel(session, controls);
  accuracy_panel(session, controls);
}

json settings(const PanelDriver& driver) {
  Scene scene = driver.session().scene();
  scene.view = driver.session().view();
  return json::parse(scene_to_json(scene)).flatten();
}

Places changes(const json& before, const json& after) {
  Places places;
  for (const auto& [place, value] : after.items()) {
    if (!before.contains(place) || before.at(place) != value) places.push_back(place);
  }
  for (const auto& [place, value] : before.items()) {
    if (!after.contains(place)) places.push_back(place);
  }
  return places;
}

std::string text_of(PanelDriver& driver) {
  std::string text;
  for (const std::string& line : driver.lines()) text += line + ' ';
  return text;
}

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

void check_help(PanelDriver& driver,
                const std::vector<std::pair<std::string, std::string>>& words_of_widgets) {
  for (const auto& [widget, words] : words_of_widgets) {
    const auto [x, y, width, height] = driver.place(widget);
    CAPTURE(widget);
    driver.point_at(0.0f, 0.0f);
    CHECK_FALSE(testing::says(text_of(driver), words));
    driver.point_at(x + 0.5f * height, y + 0.5f * height);
    CHECK(testing::says(text_of(driver), words));
  }
}

void check_explained(PanelDriver& driver, const std::vector<std::string>& widgets) {
  for (const std::string& widget : widgets) {
    const auto [x, y, width, height] = driver.place(widget);
    CAPTURE(widget);
    driver.point_at(0.0f, 0.0f);
    const std::string plain = text_of(driver);
    driver.point_at(x + 0.5f * height, y + 0.5f * height);
    // A tooltip is the end of the text: what is drawn after it is not read.
    CHECK_FALSE(plain.starts_with(text_of(driver)));
  }
}

void check_lines(const std::vector<std::string>& lines, const std::vector<std::string>& expected) {
  for (std::size_t k = 0; k < std::min(lines.size(), expected.size()); ++k) {
    CHECK(lines[k] == expected[k]);
  }
  CHECK(lines.size() == expected.size());
}

}  // namespace clatter
