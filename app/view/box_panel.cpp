#include <imgui.h>

#include <algorithm>

#include "app/view/panels.h"
#include "engine/scene/gas_keys.h"
#include "engine/scene/key_writer.h"

namespace clatter {

namespace {

std::string inline_table(Wall wall, int dimension) {
  TomlWriter writer;
  visit_wall(writer, wall, dimension);
  std::string lines = writer.text();
  lines.pop_back();
  for (std::size_t at = 0; (at = lines.find('\n', at)) != std::string::npos;) {
    lines.replace(at, 1, ", ");
  }
  return "{ " + lines + " }";
}

std::string inline_table(const std::array<std::optional<Wall>, 6>& walls, int dimension) {
  std::string all;
  for (std::size_t side = 0; side < walls.size(); ++side) {
    if (!walls[side]) continue;
    all += (all.empty() ? "" : ", ") + std::string(kSideNames[side]) + " = " +
           inline_table(*walls[side], dimension);
  }
  return "{ " + all + " }";
}

// A wall of another kind, with the parameters that both kinds have.
Wall wall_of(WallKind kind, const Wall& before) {
  Wall wall{.kind = kind, .surface_velocity = before.surface_velocity};
  if (kind != WallKind::Thermal && before.kind != WallKind::Thermal) {
    wall.restitution = before.restitution;
    wall.roughness = before.roughness;
  }
  if (kind == WallKind::Driven) wall.drive_speed = 1.0;
  if (wall.moves()) {
    wall.stroke = 0.2;
    wall.frequency = 2.0;
  }
  return wall;
}

constexpr std::array<const char*, 6> kSideTitles = {"Left", "Right", "Bottom",
                                                    "Top",  "Back",  "Front"};

void wall_numbers(const Wall& wall, const std::optional<Wall>& opened, const std::string& path,
                  Controls& controls) {
  const Wall usual = opened && opened->kind == wall.kind ? *opened : wall_of(wall.kind, wall);
  const auto slider = [&](const char* key, Slider look, double value, double usual_value) {
    const std::string whole = path + '.' + key;
    look.key = whole.c_str();
    controls.law(look, value, usual_value);
  };
  switch (wall.kind) {
    case WallKind::Driven:
      slider("drive_speed",
             {.name = "Drive speed",
              .symbol = "v_dr",
              .unit = "a/t",
              .help = "Gain in normal velocity at every "
                      "bounce: the limit of a saw-tooth of vanishing stroke",
              .high = 5.0},
             wall.drive_speed, usual.drive_speed);
      break;
    case WallKind::Thermal:
      slider("temperature",
             {.name = "Temperature",
              .symbol = "T_w",
              .unit = "m a²/t²",
              .help = "Of the particles that it emits",
              .high = 10.0},
             wall.temperature, usual.temperature);
      return;
    case WallKind::Sawtooth:
    case WallKind::Sinusoidal:
      slider("stroke",
             {.name = "Stroke",
              .unit = "a",
              .help = "Its whole travel, in particle diameters",
              .high = 4.0},
             wall.stroke, usual.stroke);
      slider("frequency",
             {.name = "Frequency",
              .symbol = "f",
              .unit = "1/t",
              .help = "Periods per time unit",
              .high = 10.0},
             wall.frequency, usual.frequency);
      break;
    case WallKind::Static:
      break;
  }
  slider("restitution",
         {.name = "Restitution",
          .symbol = "α_w",
          .help = "Share of the normal velocity that a "
                  "bounce keeps; above 1 a bounce adds energy",
          .high = 1.1},
         wall.restitution, usual.restitution);
}

// The velocity of a surface along a wall across the axis `normal`.
void surface_velocity(const Wall& wall, const Wall& usual, int normal, int dimension,
                      const std::string& path, Controls& controls) {
  constexpr std::array<const char*, 3> kNames = {"Slide along x", "Slide along y", "Slide along z"};
  constexpr std::array<const char*, 3> kSymbols = {"u_x", "u_y", "u_z"};
  const std::string key = path + ".surface_velocity";
  const auto vector = [&](const Wall& of) {
    return VecX(Eigen::Map<const Vec<3>>(of.surface_velocity.data()).head(dimension));
  };
  for (int axis = 0; axis < dimension; ++axis) {
    if (axis == normal) continue;
    controls.component({.key = key.c_str(),
                        .name = kNames[static_cast<std::size_t>(axis)],
                        .symbol = kSymbols[static_cast<std::size_t>(axis)],
                        .unit = "a/t",
                        .help = "Velocity of the surface, which drags the particles that touch it",
                        .low = -5.0,
                        .high = 5.0},
                       vector(wall), axis, vector(usual));
  }
}

// Kind of wall at a side, or periodic, with its parameters.
void side_panel(Session& session, Controls& controls, std::size_t side) {
  const Scene& scene = session.scene();
  const int dimension = scene.dimension();
  const std::string path = std::string("walls.") + kSideNames[side];
  std::vector<std::string> words = {"periodic"};
  for (const auto& [name, kind] : kWallKinds) words.emplace_back(name);
  const auto& wall = scene.walls[side];
  const auto& opened = session.opened().walls[side];
  int chosen = wall ? static_cast<int>(wall->kind) + 1 : 0;
  const int usual = opened ? static_cast<int>(opened->kind) + 1 : 0;
  if (controls.choice(path.c_str(), kSideTitles[side],
                      "Wall at this side; periodic also applies to the opposite side", words,
                      chosen, usual)) {
    if (wall && chosen > 0) {
      const Wall other =
          opened && chosen == usual ? *opened : wall_of(static_cast<WallKind>(chosen - 1), *wall);
      controls.set({{path, inline_table(*wall, dimension)}},
                   {{path, inline_table(other, dimension)}});
      return;
    }
    auto walls = scene.walls;
    for (const std::size_t each : {side, side ^ 1u}) {
      walls[each].reset();
      if (chosen > 0) walls[each] = wall_of(static_cast<WallKind>(chosen - 1), Wall{});
    }
    controls.set({{"walls", inline_table(scene.walls, dimension)}},
                 {{"walls", inline_table(walls, dimension)}});
    return;
  }
  if (!wall) return;
  const bool indents = !controls.chooses();
  if (indents) ImGui::Indent();
  wall_numbers(*wall, opened, path, controls);
  if (wall->kind == WallKind::Thermal || wall->roughness.any()) {
    surface_velocity(*wall, opened.value_or(Wall{}), static_cast<int>(side / 2), dimension, path,
                     controls);
  }
  if (indents) ImGui::Unindent();
}

void bulk_drive(Session& session, Controls& controls) {
  const auto& drive = session.scene().bulk_drive;
  const BulkDrive usual = session.opened().bulk_drive.value_or(BulkDrive{0.05, 0.1, 0.0});
  if (!drive) {
    const std::string kicks = "{ interval = " + value_text(usual.interval) + ", kick_speed = ";
    if (controls.button("bulk_drive",
                        session.scene().dimension() == 2 ? "Kick all disks" : "Kick all spheres",
                        "Homogeneous driving: all particles get random kicks at equal intervals")) {
      controls.set({{"bulk_drive", kicks + "0.0 }"}},
                   {{"bulk_drive", kicks + value_text(usual.kick_speed) + " }"}});
    }
    return;
  }
  controls.law({.key = "bulk_drive.kick_speed",
                .name = "Kicks",
                .symbol = "s",
                .unit = "a/t",
                .help = "Homogeneous driving: standard deviation of a kick per component"},
               drive->kick_speed, usual.kick_speed);
}

// Switches between disks and spheres. Returns true if it did.
bool choose_dimension(Session& session, Controls& controls) {
  const int now = session.scene().dimension() - 2;
  int chosen = now;
  if (!controls.choice("dimension", "Dimension",
                       "Starts the gas as disks or as spheres of the same number. The depth of the "
                       "box becomes its height. The box is scaled so that the filled share stays, "
                       "up to 0.4",
                       {"2: disks", "3: spheres"}, chosen, now)) {
    return false;
  }
  session.switch_dimension();
  return true;
}

}  // namespace

void box_panel(Session& session, Controls& controls) {
  if (!controls.group("Box and walls") || choose_dimension(session, controls)) return;
  constexpr std::array<const char*, 3> kSizes = {"Width", "Height", "Depth"};
  constexpr std::array<const char*, 3> kLengths = {"Lx", "Ly", "Lz"};
  constexpr std::array<const char*, 3> kGravities = {"Gravity along x", "Gravity along y",
                                                     "Gravity along z"};
  constexpr std::array<const char*, 3> kAccelerations = {"g_x", "g_y", "g_z"};
  const Scene& scene = session.scene();
  const Scene& usual = session.opened();
  const int dimension = scene.dimension();
  for (int axis = 0; axis < dimension; ++axis) {
    const double longest = std::max(100.0, 2.0 * usual.box[axis]);
    controls.component(
        {.key = "box.size",
         .name = kSizes[axis],
         .symbol = kLengths[axis],
         .unit = "a",
         .help = scene.species.empty()
                     ? "Of the box, in particle diameters; particles that no longer fit are removed"
                     : "Of the box, in units of length. The gas starts again",
         .low = 4.0,
         .high = longest,
         .format = "%.1f"},
        scene.box, axis, usual.box, false);
  }
  for (std::size_t side = 0; side < static_cast<std::size_t>(2 * dimension); ++side) {
    // A periodic axis is listed once.
    if (side % 2 == 1 && !scene.walls[side]) continue;
    side_panel(session, controls, side);
  }
  if (scene.shear_rate) {
    controls.law({.key = "shear.rate",
                  .name = "Shear rate",
                  .symbol = "G",
                  .unit = "1/t",
                  .help = "Velocity gradient of the flow along x",
                  .low = -1.0},
                 *scene.shear_rate, usual.shear_rate.value_or(0.0));
  }
  const auto gravity_of = [&](const Scene& which) -> VecX {
    if (which.gravity) return *which.gravity;
    return VecX::Zero(dimension);
  };
  for (int axis = 0; axis < dimension && !scene.shear_rate; ++axis) {
    controls.component({.key = "gravity.acceleration",
                        .name = kGravities[axis],
                        .symbol = kAccelerations[axis],
                        .unit = "a/t²",
                        .help = "Acceleration of every particle",
                        .low = -2.0,
                        .high = 2.0},
                       gravity_of(scene), axis, gravity_of(usual));
  }
  bulk_drive(session, controls);
}

}  // namespace clatter
