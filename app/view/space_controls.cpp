#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/view/enum_list.h"
#include "app/view/panels.h"
#include "app/view/viewport.h"

// The controls of the view that only spheres have.

namespace clatter {

static bool choose_direction(Controls& controls, View& view) {
  if (!controls.chooses()) ImGui::TextUnformatted("View from");
  bool changed = false;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float width = (ImGui::GetContentRegionAvail().x -
                       static_cast<float>(kPresets.size() - 1) * style.ItemInnerSpacing.x) /
                      static_cast<float>(kPresets.size());
  for (const Preset& preset : kPresets) {
    const std::string key = std::string("view.from.") + preset.label;
    if (&preset != kPresets.data() && controls.shows(key)) {
      ImGui::SameLine(0.0f, style.ItemInnerSpacing.x);
    }
    // An identifier keeps the label apart from others in the panel.
    const std::string label = std::string(preset.label) + "##" + key;
    if (controls.button(key.c_str(), label.c_str(), preset.help, width)) {
      changed |= face(view, preset);
    }
  }
  return changed;
}

// A position along an axis of the box, between `low` and `high`.
static bool choose_position(Controls& controls, const char* key, const char* name, double low,
                            double high, double& position, double usual) {
  return controls.number({.key = key,
                          .name = name,
                          .unit = "a",
                          .help = "Position along its axis, in particle diameters",
                          .low = low,
                          .high = high,
                          .format = "%.1f"},
                         position, usual);
}

static bool choose_slab(const Session& session, Controls& controls, View& view) {
  constexpr double kThinnest = 0.1;
  const VecX& box = session.scene().box;
  const auto& opened = session.opened().view.slab;
  const auto axis_of = [](const std::optional<Slab>& slab) {
    return slab ? std::optional(slab->axis) : std::nullopt;
  };
  std::optional<Axis> axis = axis_of(view.slab);
  bool changed = choose(controls, "view.slab.axis", "Slab across",
                        "Only spheres, or their parts, between two planes are drawn", kAxes, "none",
                        axis, axis_of(opened));
  if (changed) {
    view.slab.reset();
    if (axis) view.slab = Slab{*axis, 0.0, 0.5 * box[static_cast<int>(*axis)]};
    if (axis && opened && opened->axis == *axis) view.slab = opened;
  }
  if (!view.slab) return changed;
  Slab& slab = *view.slab;
  const double length = box[static_cast<int>(slab.axis)];
  const Slab usual =
      opened && opened->axis == slab.axis ? *opened : Slab{slab.axis, 0.0, 0.5 * length};
  changed |= choose_position(controls, "view.slab.from", "From", 0.0, slab.to - kThinnest,
                             slab.from, usual.from);
  changed |= choose_position(controls, "view.slab.to", "To", slab.from + kThinnest,
                             std::max(length, slab.from + 2.0 * kThinnest), slab.to, usual.to);
  if (slab.from >= slab.to) slab = usual;
  return changed;
}

bool space_controls(const Session& session, Controls& controls, View& view) {
  bool changed = choose_direction(controls, view);
  changed |= controls.number({.key = "view.view_angle",
                              .name = "Angle of view",
                              .unit = "°",
                              .help = "Across the picture; 0: a parallel projection",
                              .high = 90.0,
                              .format = "%.0f"},
                             view.view_angle, session.opened().view.view_angle);
  changed |= choose_slab(session, controls, view);
  return changed;
}

bool choose_volume(const Session& session, Controls& controls, View& view) {
  return controls.number({.key = "view.volume",
                          .name = "Volume",
                          .unit = "1/a",
                          .help = "The heatmap as glowing fog: its extinction coefficient at the "
                                  "end of the colour range; 0: none",
                          .high = 5.0,
                          .format = "%.2f"},
                         view.volume, session.opened().view.volume);
}

static Slice* find_slice(std::vector<Slice>& slices, Axis axis) {
  const auto found = std::ranges::find(slices, axis, &Slice::axis);
  return found == slices.end() ? nullptr : &*found;
}

bool choose_slices(const Session& session, Controls& controls, View& view) {
  std::vector<Slice> opened = session.opened().view.slices;
  bool changed = false;
  for (const auto& named : kAxes) {
    const Axis axis = named.value;
    const std::string name(named.name);
    const double length = session.scene().box[static_cast<int>(axis)];
    const Slice* before = find_slice(opened, axis);
    const double usual = before ? before->position : 0.5 * length;
    Slice* slice = find_slice(view.slices, axis);
    bool on = slice != nullptr;
    if (controls.toggle(("view.slices." + name).c_str(), ("Slice across " + name).c_str(),
                        "Plane on which the heatmap is drawn. Without any, and without a volume, "
                        "it is the middle one across z",
                        on)) {
      changed = true;
      std::erase_if(view.slices, [axis](const Slice& other) { return other.axis == axis; });
      if (on) view.slices.push_back({axis, usual});
    } else if (slice) {
      changed |= choose_position(controls, ("view.slices." + name + ".position").c_str(),
                                 "Position", 0.0, length, slice->position, usual);
    }
  }
  return changed;
}

}  // namespace clatter
