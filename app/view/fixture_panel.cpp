#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/view/panels.h"

namespace clatter {

namespace {

/// A fixture of a scene, with the path of its keys.
struct NamedFixture {
  std::string name, path;
  bool present;
  const FixtureLaw* law;
  const Obstacle* obstacle;    // nullptr: a partition
  const Partition* partition;  // nullptr: an obstacle
};

std::vector<NamedFixture> fixtures_in(const Scene& scene) {
  std::vector<NamedFixture> all;
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
    const Obstacle& one = scene.obstacles[k];
    const std::string name = obstacle_name(one, k);
    all.push_back({name, "obstacle." + name + '.', one.present, &one.law, &one, nullptr});
  }
  for (std::size_t k = 0; k < scene.partitions.size(); ++k) {
    const Partition& one = scene.partitions[k];
    const std::string name = partition_name(one, k);
    all.push_back({name, "partition." + name + '.', one.present, &one.law, nullptr, &one});
  }
  return all;
}

void law_sliders(const Wall& law, const Wall& usual, const std::string& path, Controls& controls) {
  const auto slider = [&](const char* key, Slider look, double value, double usual_value) {
    const std::string whole = path + key;
    look.key = whole.c_str();
    controls.law(look, value, usual_value);
  };
  if (law.kind == WallKind::Thermal) {
    slider("temperature",
           {.name = "Temperature",
            .symbol = "T_w",
            .unit = "m a²/t²",
            .help = "Of the particles that leave it",
            .high = 10.0},
           law.temperature, usual.temperature);
    return;
  }
  slider("restitution",
         {.name = "Restitution",
          .symbol = "α_w",
          .help = "Share of the normal velocity that a bounce keeps",
          .high = 1.0},
         law.restitution, usual.restitution);
  if (law.kind != WallKind::Driven) return;
  slider("drive_speed",
         {.name = "Drive speed",
          .symbol = "v_dr",
          .unit = "a/t",
          .help = "Gain in normal velocity at every bounce",
          .high = 5.0},
         law.drive_speed, usual.drive_speed);
}

void piston_controls(const Session& session, Controls& controls) {
  const Piston& piston = *session.scene().piston;
  const Piston& usual = session.opened().piston ? *session.opened().piston : piston;
  bool pinned = piston.pinned;
  if (controls.toggle("piston.pinned", "Pin the piston",
                      "Holds the piston at rest; without the mark it slides freely", pinned)) {
    controls.set({{"piston.pinned", pinned ? "false" : "true"}},
                 {{"piston.pinned", pinned ? "true" : "false"}});
  }
  const double most = std::max(20.0, 4.0 * std::fabs(usual.force));
  controls.law({.key = "piston.force",
                .name = "Force",
                .symbol = "F",
                .unit = "m a/t²",
                .help = "Constant force on the piston along its axis: a weight",
                .low = -most,
                .high = most,
                .format = "%.2f"},
               piston.force, usual.force);
  controls.law({.key = "piston.restitution",
                .name = "Restitution",
                .symbol = "α",
                .help = "Share of the normal relative velocity that a hit on the piston keeps"},
               piston.law.wall().restitution, usual.law.wall().restitution);
}

void fixture_controls(const Session& session, Controls& controls, const NamedFixture& fixture) {
  bool present = fixture.present;
  const std::string key = fixture.path + "present";
  if (controls.toggle(key.c_str(), "Is there",
                      "Without the mark particles pass. It cannot come back where one is",
                      present)) {
    controls.set({{key, present ? "false" : "true"}}, {{key, present ? "true" : "false"}});
  }
  Wall usual = fixture.law->wall();
  for (const NamedFixture& opened : fixtures_in(session.opened())) {
    if (opened.name == fixture.name) usual = opened.law->wall();
  }
  law_sliders(fixture.law->wall(), usual, fixture.path, controls);
}

}  // namespace

void fixture_panel(Session& session, Controls& controls) {
  const std::vector<NamedFixture> fixtures = fixtures_in(session.scene());
  if (fixtures.empty() && !session.scene().piston) return;
  if (!controls.group("In the box")) return;
  if (session.scene().piston) piston_controls(session, controls);
  if (controls.chooses()) {
    for (const NamedFixture& fixture : fixtures) fixture_controls(session, controls, fixture);
    return;
  }
  if (fixtures.empty()) return;
  std::vector<std::string> names;
  for (const NamedFixture& fixture : fixtures) names.push_back(fixture.name);
  int& chosen = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("fixture"), 0);
  chosen = std::min(chosen, static_cast<int>(names.size()) - 1);
  controls.choice("fixture", "Fixture", "The obstacle or partition that the controls below set",
                  names, chosen, chosen);
  fixture_controls(session, controls, fixtures[static_cast<std::size_t>(chosen)]);
}

}  // namespace clatter
