#include "app/view/mouse_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "app/plots/plot_colours.h"
#include "app/view/fixture_edits.h"
#include "app/view/style.h"
#include "engine/scene/scene_file.h"
#include "render/picking.h"
#include "render/typography/fonts.h"

namespace clatter {

namespace {

constexpr double kLeastRadius = 0.5;

bool has_circle(Tool tool) {
  return tool != Tool::Throw && !draws_fixtures(tool);
}

bool has_arrow(Tool tool) {
  return tool == Tool::Kick || tool == Tool::Throw;
}

Colour colour_of(Tool tool) {
  switch (tool) {
    case Tool::Heat:
      return kRed;
    case Tool::Cool:
      return kBlue;
    case Tool::Kick:
    case Tool::Throw:
      return accent_colour();
    case Tool::Add:
      return kGreen;
    case Tool::Ball:
    case Tool::Wall:
    case Tool::Erase:
      return kOrange;
  }
  return {};
}

// Radius that suits the box, diameters.
double usual_radius(const Scene& scene) {
  constexpr double kShare = 0.15;
  return std::max(kLeastRadius, std::stod(fmt::format("{:.2g}", kShare * scene.box.minCoeff())));
}

VecX position_of(const Snapshot& gas, std::size_t particle) {
  return gas.positions.col(static_cast<Eigen::Index>(particle));
}

// The position of the window as a place in the box, with few digits for the scene file. Of spheres
// it is as deep as the sphere there, or as the centre of the view.
VecX place_in_box(const Snapshot& gas, const WindowMap& map, ImVec2 mouse,
                  const std::optional<Slab>& slab) {
  Vec3 deep = map.eye().centre();
  if (gas.box.size() == 3) {
    const auto sphere = particle_at(gas, map.eye(), map.pixel(mouse), slab);
    if (sphere) deep = in_space(position_of(gas, *sphere));
  }
  const Vec3 world = map.world(mouse, deep);
  VecX place = gas.box;
  for (int axis = 0; axis < place.size(); ++axis) {
    const double rounded = 0.001 * std::round(1000.0 * world[axis]);
    place[axis] = std::clamp(std::stod(fmt::format("{:.3f}", rounded)), 0.0, gas.box[axis]);
  }
  return place;
}

// The particle under the mouse, or the nearest one within the reach of a hand.
std::optional<std::size_t> particle_near(const Snapshot& gas, const WindowMap& map, ImVec2 mouse,
                                         const std::optional<Slab>& slab) {
  auto found = particle_at(gas, map.eye(), map.pixel(mouse), slab);
  if (found || slab) return found;
  float reach = 1.5f * ImGui::GetFontSize();
  for (std::size_t i = 0; i < gas.count(); ++i) {
    const auto place = map.place(position_of(gas, i));
    if (!place) continue;
    const float distance = std::hypot(place->x - mouse.x, place->y - mouse.y);
    if (distance >= reach) continue;
    reach = distance;
    found = i;
  }
  return found;
}

}  // namespace

bool MouseTools::panel(const Scene& scene, Controls& controls) {
  if (!controls.group("Mouse tools")) return false;
  constexpr auto kCount = static_cast<float>(kTools.size());
  constexpr int kColumns = 4;  // of a narrow panel
  const float gap = ImGui::GetStyle().ItemSpacing.x, room = ImGui::GetContentRegionAvail().x;
  float text = 0.0f;
  for (const ToolText& tool : kTools) text += ImGui::CalcTextSize(tool.name).x;
  const float around = (room - text - (kCount - 1.0f) * gap) / kCount;
  const bool in_row = around > 0.4f * ImGui::GetFontSize();
  bool chosen = false;
  std::size_t column = 0;
  for (const ToolText& tool : kTools) {
    if (draws_fixtures(tool.tool) && scene.dimension() == 3) continue;
    if (!controls.shows(tool.key)) continue;
    if (column++ % (in_row ? kTools.size() : kColumns) > 0) ImGui::SameLine();
    const float width = in_row ? ImGui::CalcTextSize(tool.name).x + around
                               : std::floor((room + gap) / kColumns - gap);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0.0f, ImGui::GetStyle().FramePadding.y));
    if (controls.button(tool.key, tool.name, tool.help, width, tool_ == tool.tool)) {
      toggle(tool.tool);
      chosen = tool_.has_value();
    }
    ImGui::PopStyleVar();
  }
  sliders(scene, controls);
  return chosen;
}

void MouseTools::sliders(const Scene& scene, Controls& controls) {
  if (!tool_ || !has_circle(*tool_)) return;
  double value = radius(scene);
  if (controls.number({.key = "tool.radius",
                       .name = "Radius",
                       .unit = "a",
                       .help = "Of the circle at the mouse",
                       .low = kLeastRadius,
                       .high = std::max(1.0, scene.box.maxCoeff()),
                       .logarithmic = true,
                       .format = "%.2f"},
                      value, usual_radius(scene))) {
    radius_ = value;
  }
  if (tool_ != Tool::Add) return;
  controls.number({.key = "tool.count",
                   .name = "Particles",
                   .help = "Number that a click adds",
                   .low = 1.0,
                   .high = 200.0,
                   .logarithmic = true,
                   .format = "%.0f"},
                  count_, kUsualCount);
  count_ = std::round(count_);
  if (scene.species.empty()) return;
  const std::vector<std::string> names = names_of(scene.species);
  species_ = std::min(species_, static_cast<int>(names.size()) - 1);
  controls.choice("tool.species", "Species", "Of the particles that a click adds", names, species_,
                  0);
}

double MouseTools::radius(const Scene& scene) const {
  return radius_.value_or(usual_radius(scene));
}

void MouseTools::toggle(Tool tool) {
  tool_ = tool_ == tool ? std::nullopt : std::optional(tool);
  pressed_ = false;
}

const char* MouseTools::hint() const {
  if (!tool_ || pressed_) return nullptr;
  return std::ranges::find(kTools, *tool_, &ToolText::tool)->hint;
}

std::optional<MouseTools::Target> MouseTools::target_at(const Session& session,
                                                        const WindowMap& map, Tool tool) const {
  const Snapshot& gas = session.frame().snapshot;
  const std::optional<Slab>& slab = session.view().slab;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  if (tool != Tool::Throw) return Target{place_in_box(gas, map, mouse, slab)};
  const auto particle = particle_near(gas, map, mouse, slab);
  if (!particle) return std::nullopt;
  return Target{position_of(gas, *particle), particle};
}

void MouseTools::use(Session& session, const WindowMap& map, bool over) {
  const Frame& frame = session.frame();
  if (press_ && press_->run != frame.run) press_.reset();
  if (!press_) {
    target_.reset();
    if (!tool_ || !over) return;
    if (draws_fixtures(*tool_) && session.scene().dimension() == 3) return;
    target_ = target_at(session, map, *tool_);
    if (!target_ || !ImGui::IsMouseClicked(0)) return;
    press_ = Press{*tool_, frame.run, ImGui::GetIO().MousePos};
    pressed_ = true;
    if (press_->tool == Tool::Add) add(session);
  }
  constexpr float kClick = 3.0f;  // a shorter motion of the mouse is a click, window units
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  press_->dragged |= std::hypot(mouse.x - press_->place.x, mouse.y - press_->place.y) >= kClick;
  if (press_->tool == Tool::Heat || press_->tool == Tool::Cool) {
    target_ = target_at(session, map, press_->tool);
    scale(session);
  } else if (target_->particle) {
    follow(frame.snapshot);
  }
  if (!ImGui::IsMouseDown(0)) release(session, map);
}

// Moves the start of the arrow with the particle. A periodic border causes no jump.
void MouseTools::follow(const Snapshot& gas) {
  target_->place = nearest_image(gas, target_->place, position_of(gas, *target_->particle));
}

// Heats or cools at the press, and then after equal times of a gas that plays.
void MouseTools::scale(Session& session) {
  constexpr double kBetween = 0.1;  // seconds of playing
  constexpr double kFactor = 1.1;
  const Frame& frame = session.frame();
  const double time = frame.snapshot.time;
  if (press_->nudged &&
      (frame.backwards || std::fabs(time - *press_->nudged) < kBetween * frame.speed)) {
    return;
  }
  press_->nudged = time;
  const Nudge nudge{.centre = target_->place,
                    .radius = radius(session.scene()),
                    .scale = press_->tool == Tool::Heat ? kFactor : 1.0 / kFactor};
  press_->acts.push_back({.nudge = nudge});
  session.nudge(nudge);
}

// The name of the species that a click adds; empty without species.
std::string MouseTools::species_of(const Scene& scene) const {
  const auto number = static_cast<std::size_t>(species_);
  return number < scene.species.size() ? scene.species[number].name : "";
}

// Adds particles of the temperature of the gas, or of temperature 1 in a gas at rest.
void MouseTools::add(Session& session) {
  const double temperature = session.frame().snapshot.temperature;
  const Puff puff{
      .count = static_cast<int>(count_),
      .centre = target_->place,
      .radius = radius(session.scene()),
      .temperature = temperature > 0.0 ? std::stod(fmt::format("{:.3g}", temperature)) : 1.0,
      .velocity = {},
      .species = species_of(session.scene())};
  press_->acts.push_back({.puff = puff});
  session.add(puff);
}

void MouseTools::release(Session& session, const WindowMap& map) {
  Press press = *std::exchange(press_, std::nullopt);
  if (draws_fixtures(press.tool)) return edit_fixtures(session, map, press);
  if (has_arrow(press.tool)) {
    if (!press.dragged) return session.report("Drag an arrow: direction and size of the velocity");
    const VecX arrow = velocity(session.frame(), map);
    const Nudge nudge =
        press.tool == Tool::Kick
            ? Nudge{.centre = target_->place, .radius = radius(session.scene()), .add = arrow}
            : Nudge{.particle = static_cast<int>(*target_->particle), .set = arrow};
    press.acts.push_back({.nudge = nudge});
    session.nudge(nudge);
  }
  session.remember({.acts = std::move(press.acts)});
}

void MouseTools::edit_fixtures(Session& session, const WindowMap& map, const Press& press) {
  const Scene& scene = session.scene();
  const Vec2 from = target_->place;
  const Vec2 to = place_in_box(session.frame().snapshot, map, ImGui::GetIO().MousePos, {});
  std::optional<Scene> edited;
  if (press.tool == Tool::Erase) {
    edited = without_fixture_at(scene, to);
    if (!edited) return session.report("There is no obstacle or partition");
  } else {
    if (!press.dragged) {
      return session.report(press.tool == Tool::Ball ? "Drag from the centre of a ball to its rim"
                                                     : "Drag along the wall");
    }
    edited = press.tool == Tool::Ball ? with_ball(scene, from, to) : with_wall(scene, from, to);
  }
  const std::vector<Override> before = fixture_settings(scene), after = fixture_settings(*edited);
  if (session.set(after)) session.remember({.before = before, .after = after});
}

// The velocity whose distance in one second of playing is the length of the arrow, with few digits
// for the scene file.
VecX MouseTools::velocity(const Frame& frame, const WindowMap& map) const {
  const Vec3 from = in_space(target_->place);
  const Vec3 way = map.world(ImGui::GetIO().MousePos, from) - from;
  VecX velocity = target_->place;
  for (int axis = 0; axis < velocity.size(); ++axis) {
    velocity[axis] = std::stod(fmt::format("{:.3g}", way[axis] / frame.speed));
  }
  return velocity;
}

void MouseTools::mark(ImDrawList& list, const Frame& frame, const WindowMap& map) const {
  if (!target_ || target_->place.size() != frame.snapshot.box.size()) return;
  const Tool tool = press_ ? press_->tool : *tool_;
  const ImU32 ink = packed(colour_of(tool));
  if (draws_fixtures(tool)) {
    const auto from = map.place(target_->place);
    const ImVec2 to = ImGui::GetIO().MousePos;
    if (!press_ || !from || tool == Tool::Erase) return;
    if (tool == Tool::Ball) {
      list.AddCircle(*from, std::hypot(to.x - from->x, to.y - from->y), ink, 0, 2.5f);
    } else {
      list.AddLine(*from, to, ink, 2.5f);
    }
    return;
  }
  const Snapshot& gas = frame.snapshot;
  const bool known = target_->particle && *target_->particle < gas.count();
  const double of_particle = known ? gas.radius(*target_->particle) : 0.5 * gas.diameter;
  const double size = has_circle(tool) ? radius(*frame.scene) : of_particle;
  if (const auto outline = map.outline(target_->place, size)) {
    const auto& [centre, radius] = *outline;
    constexpr ImU32 kFaint = 0x30000000, kRgb = 0x00ffffff;
    if (has_circle(tool) && press_) list.AddCircleFilled(centre, radius, (ink & kRgb) | kFaint);
    list.AddCircle(centre, radius + (has_circle(tool) ? 0.0f : 2.0f), ink, 0, 2.5f);
  }
  if (press_ && press_->dragged && has_arrow(tool)) draw_arrow(list, frame, map, ink);
}

void MouseTools::draw_arrow(ImDrawList& list, const Frame& frame, const WindowMap& map,
                            ImU32 ink) const {
  const auto from = map.place(target_->place);
  if (!from) return;
  const ImVec2 to = ImGui::GetIO().MousePos;
  const float x = to.x - from->x, y = to.y - from->y, length = std::hypot(x, y);
  if (!(length > 0.0f)) return;
  const float unit = ImGui::GetFontSize(), head = std::min(0.9f * unit, length);
  const ImVec2 along(x / length, y / length);
  const ImVec2 neck(to.x - head * along.x, to.y - head * along.y);
  const ImVec2 side(-0.45f * head * along.y, 0.45f * head * along.x);
  const ImU32 ground = ImGui::GetColorU32(ImGuiCol_PopupBg);
  list.AddLine(*from, neck, ground, 0.4f * unit);
  list.AddLine(*from, neck, ink, 0.25f * unit);
  list.AddTriangleFilled(to, ImVec2(neck.x + side.x, neck.y + side.y),
                         ImVec2(neck.x - side.x, neck.y - side.y), ink);
  const std::string text = fmt::format("{:.3g} a/t", velocity(frame, map).norm());
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 low(to.x + 1.2f * unit, to.y - 0.5f * size.y), edge(0.4f * unit, 0.15f * unit);
  list.AddRectFilled(ImVec2(low.x - edge.x, low.y - edge.y),
                     ImVec2(low.x + size.x + edge.x, low.y + size.y + edge.y), ground, edge.x);
  list.AddText(low, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
}

}  // namespace clatter
