#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/view/enum_list.h"
#include "app/view/panels.h"
#include "render/colour_range.h"
#include "render/label.h"

namespace clatter {

static bool shows_in(ColourBy colour_by, const Scene& scene) {
  switch (colour_by) {
    case ColourBy::VelocityZ:
    case ColourBy::Depth:
      return scene.dimension() == 3;
    case ColourBy::Spin:
      return scene.spins();
    case ColourBy::Species:
    case ColourBy::Diameter:
      return !scene.species.empty();
    default:
      return true;
  }
}

static bool choose_colour(const Session& session, Controls& controls, View& view) {
  std::vector<std::string> words;
  std::vector<ColourBy> colours;
  for (const auto& [name, colour_by] : kColourings) {
    if (!shows_in(colour_by, session.scene())) continue;
    words.push_back(in_words(name));
    colours.push_back(colour_by);
  }
  const auto place = [&](ColourBy colour_by) {
    const auto found = std::ranges::find(colours, colour_by);
    return static_cast<int>((found == colours.end() ? colours.begin() + 1 : found) -
                            colours.begin());
  };
  const bool disks = session.scene().dimension() == 2;
  int chosen = place(view.colour_by);
  const bool changed =
      controls.choice("view.colour_by", disks ? "Disks coloured by" : "Spheres coloured by",
                      "Quantity that the colour of a particle shows", words, chosen,
                      place(session.opened().view.colour_by));
  if (changed) view.colour_by = colours[static_cast<std::size_t>(chosen)];
  return changed;
}

static bool choose_field(const Session& session, Controls& controls, View& view) {
  std::vector<std::string> words = {"none"};
  std::vector<std::optional<Field>> fields = {std::nullopt};
  const Scene& scene = session.scene();
  for (const auto& [name, field] : field_names(scene.dimension(), names_of(scene.species))) {
    if (of_spins(field) && !scene.spins()) continue;
    if (is_residual(field) && scene.shear_rate) continue;
    words.push_back(in_words(name));
    fields.emplace_back(field);
  }
  const auto place = [&](const std::optional<Field>& field) {
    const auto found = std::ranges::find(fields, field);
    return found == fields.end() ? 0 : static_cast<int>(found - fields.begin());
  };
  int chosen = place(view.field);
  const char* help = session.scene().dimension() == 2
                         ? "The field below the disks"
                         : "The field, drawn on slices of the box or as a volume";
  if (!controls.choice("view.field", "Heatmap", help, words, chosen,
                       place(session.opened().view.field), true)) {
    return false;
  }
  view.field = fields[static_cast<std::size_t>(chosen)];
  return true;
}

// `ends()` is a range of the values in the picture; without values both ends are 0.
template <class Ends>
static bool choose_range(Controls& controls, const std::string& key, const char* name,
                         ColourRange& range, const ColourRange& usual, const Ends& ends) {
  int chosen = range.kind;
  bool changed = controls.choice(key.c_str(), name,
                                 "auto follows the picture, locked keeps the first range, given is "
                                 "set by two numbers",
                                 {"auto", "locked", "given"}, chosen, usual.kind);
  if (changed) {
    range.ends = usual.ends;
    if (chosen == ColourRange::Given && usual.kind != ColourRange::Given) {
      const std::array<double, 2> shown = ends();
      if (shown[1] > 0.0) range.ends = shown;
    }
    range.kind = static_cast<ColourRange::Kind>(chosen);
  }
  if (range.kind == ColourRange::Given) {
    changed |=
        controls.ends((key + ".ends").c_str(),
                      "From and to, in the unit of the colour bar; Enter sets them", range.ends);
  }
  return changed;
}

// Round numbers around all values of a map; both 0: all are zero or missing.
static std::array<double, 2> ends_of(const FieldMap& map) {
  double most = 0.0, least = 0.0;
  for (const double value : map.values) {
    if (!std::isfinite(value)) continue;
    most = std::max(most, std::fabs(value));
    least = std::min(least, value);
  }
  const double end = most > 0.0 ? round_up(most) : 0.0;
  return {least < 0.0 ? -end : 0.0, end};
}

static bool choose_heatmap(const Session& session, Controls& controls, View& view) {
  const View& usual = session.opened().view;
  bool changed = choose_field(session, controls, view);
  if (!view.field) return changed;
  changed |= choose(controls, "view.field_palette", "Palette of the heatmap",
                    "For magnitudes; signed fields are blue below zero and red above",
                    kFieldPalettes, view.field_palette, usual.field_palette);
  changed |= choose(controls, "view.field_style", "Style of the heatmap",
                    "smooth interpolates between cells, cells shows their exact values",
                    kFieldStyles, view.field_style, usual.field_style);
  const auto& map = session.frame().snapshot.field;
  changed |= choose_range(controls, "view.field_range", "Range of the heatmap", view.field_range,
                          usual.field_range, [&] {
                            return map ? ends_of(*map) : std::array<double, 2>{0.0, 0.0};
                          });
  return changed;
}

static bool choose_trails(Controls& controls, std::optional<double>& trails,
                          const std::optional<double>& usual) {
  double time = trails.value_or(0.0);
  const bool changed = controls.number({.key = "view.trails",
                                        .name = "Trails",
                                        .unit = "t",
                                        .help = "Time over which the paths are drawn; 0: none",
                                        .high = 5.0,
                                        .format = "%.2f"},
                                       time, usual.value_or(0.0));
  trails.reset();
  if (time > 0.0) trails = time;
  return changed;
}

static bool choose_path(Controls& controls, Tracer& tracer, const std::optional<Tracer>& usual) {
  return controls.number({.key = "view.tracer.time",
                          .name = "Path of the tracer",
                          .unit = "t",
                          .help = "Time over which its path is drawn",
                          .low = 0.1,
                          .high = 1000.0,
                          .logarithmic = true,
                          .format = "%.1f"},
                         tracer.time, usual.value_or(Tracer{}).time);
}

std::array<double, 2> colour_ends(const Snapshot& snapshot, ColourBy colour_by) {
  const double most = colour_by == ColourBy::Depth ? 0.5 * snapshot.box.norm()
                                                   : 2.0 * std::sqrt(2.0 * snapshot.temperature);
  const double end = round_up(most);
  const bool signs =
      label_of(colour_by, static_cast<int>(snapshot.box.size())).sign == Sign::Either;
  return {signs ? -end : 0.0, end};
}

void view_panel(Session& session, Controls& controls) {
  if (!controls.group("View")) return;
  View view = session.view();
  const View& usual = session.opened().view;
  const bool disks = session.scene().dimension() == 2;
  bool changed = !disks && space_controls(session, controls, view);
  changed |= choose_colour(session, controls, view);
  if (has_scale(view.colour_by)) {
    changed |= choose(controls, "view.palette", "Palette", "All are fit for the colour-blind",
                      kPalettes, view.palette, usual.palette);
    changed |= choose_range(
        controls, "view.range", disks ? "Range of the disks" : "Range of the spheres", view.range,
        usual.range, [&] { return colour_ends(session.frame().snapshot, view.colour_by); });
  }
  changed |= controls.number({.key = "view.opacity",
                              .name = "Opacity",
                              .help = "Of the particles; 0: none, the heatmap alone",
                              .format = "%.2f"},
                             view.opacity, usual.opacity);
  changed |= choose_heatmap(session, controls, view);
  if (!disks && view.field) {
    changed |= choose_volume(session, controls, view);
    changed |= choose_slices(session, controls, view);
  }
  changed |= choose(controls, "view.arrows", "Arrows", "A field with a direction", kArrows, "none",
                    view.arrows, usual.arrows);
  changed |= choose_trails(controls, view.trails, usual.trails);
  if (view.tracer) changed |= choose_path(controls, *view.tracer, usual.tracer);
  changed |= choose(controls, "view.theme", "Theme",
                    "Colours of the picture's background and walls, and of the panels", kThemes,
                    view.theme, usual.theme);
  if (disks) {
    changed |= controls.toggle("view.grid", "Grid", "Its spacing is the length of the scale bar",
                               view.grid);
    const auto& walls = session.scene().walls;
    if (!walls[kLeft] || !walls[kBottom]) {
      changed |= controls.toggle("view.tiling", "Repeat beyond edges",
                                 "Faint copies of the gas and the heatmap beyond periodic edges",
                                 view.tiling);
    }
  }
  changed |= controls.toggle("view.overlay", "Title, figures and scales",
                             "Text and legends on the picture, as in films", view.overlay);
  controls.show(view, changed);
}

}  // namespace clatter
