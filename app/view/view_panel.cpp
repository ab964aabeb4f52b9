#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/view/panels.h"
#include "engine/scene/scene_keys.h"
#include "engine/scene/text.h"
#include "render/colour_range.h"

namespace clatter {

// The names of an enumeration's values, with spaces.
template <class E, std::size_t N>
static std::vector<std::string> words_of(const std::array<Named<E>, N>& names) {
  std::vector<std::string> words;
  for (const auto& [name, value] : names) words.push_back(in_words(name));
  return words;
}

template <class E, std::size_t N>
static int index_of(E value, const std::array<Named<E>, N>& names) {
  const auto found = std::ranges::find(names, value, &Named<E>::value);
  return static_cast<int>(found - names.begin());
}

// List of an enumeration's values. Returns true if the choice changed.
template <class E, std::size_t N>
static bool choose(Controls& controls, const char* key, const char* name, const char* help,
                   const std::array<Named<E>, N>& names, E& value, E usual) {
  int chosen = index_of(value, names);
  if (!controls.choice(key, name, help, words_of(names), chosen, index_of(usual, names))) {
    return false;
  }
  value = names[static_cast<std::size_t>(chosen)].value;
  return true;
}

// List of an enumeration's values, with `none` as its first word.
template <class E, std::size_t N>
static bool choose(Controls& controls, const char* key, const char* name, const char* help,
                   const std::array<Named<E>, N>& names, const char* none, std::optional<E>& value,
                   std::optional<E> usual) {
  std::vector<std::string> words = words_of(names);
  words.insert(words.begin(), none);
  const auto place = [&](const std::optional<E>& e) { return e ? index_of(*e, names) + 1 : 0; };
  int chosen = place(value);
  if (!controls.choice(key, name, help, words, chosen, place(usual))) return false;
  value.reset();
  if (chosen > 0) value = names[static_cast<std::size_t>(chosen) - 1].value;
  return true;
}

static bool choose_colour(const Session& session, Controls& controls, View& view) {
  std::vector<std::string> colours = words_of(kColourings);
  if (!session.scene().spins()) colours.pop_back();
  const int most = static_cast<int>(colours.size()) - 1;
  int chosen = std::min(index_of(view.colour_by, kColourings), most);
  const int usual = std::min(index_of(session.opened().view.colour_by, kColourings), most);
  const bool changed =
      controls.choice("view.colour_by", "Disks coloured by",
                      "Quantity that the colour of a disk shows", colours, chosen, usual);
  view.colour_by = kColourings[static_cast<std::size_t>(chosen)].value;
  return changed;
}

static bool choose_field(const Session& session, Controls& controls, View& view) {
  std::vector<std::string> words = {"none"};
  std::vector<std::optional<Field>> fields = {std::nullopt};
  for (const auto& [name, field] : field_names(session.scene().dimension())) {
    if (of_spins(field) && !session.scene().spins()) continue;
    words.push_back(in_words(name));
    fields.emplace_back(field);
  }
  const auto place = [&](const std::optional<Field>& field) {
    const auto found = std::ranges::find(fields, field);
    return found == fields.end() ? 0 : static_cast<int>(found - fields.begin());
  };
  int chosen = place(view.field);
  if (!controls.choice("view.field", "Heatmap", "The field below the disks", words, chosen,
                       place(session.opened().view.field))) {
    return false;
  }
  view.field = fields[static_cast<std::size_t>(chosen)];
  return true;
}

// `end` is the largest magnitude in the picture, or a round number above it; 0: unknown. `signs`:
// the values have both signs.
static bool choose_range(Controls& controls, const std::string& key, const char* name,
                         ColourRange& range, const ColourRange& usual, double end, bool signs) {
  int chosen = range.kind;
  bool changed = controls.choice(key.c_str(), name,
                                 "auto follows the picture, locked keeps the first range, given is "
                                 "set by two numbers",
                                 {"auto", "locked", "given"}, chosen, usual.kind);
  if (changed) {
    const bool given = chosen == ColourRange::Given;
    if (given && usual.kind != ColourRange::Given && end > 0.0) {
      range.ends = {signs ? -end : 0.0, end};
    } else {
      range.ends = usual.ends;
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

// A round number at or above all magnitudes of a map; 0: all are zero or missing.
static double end_of(const FieldMap& map) {
  double most = 0.0;
  for (const double value : map.values) {
    if (std::isfinite(value)) most = std::max(most, std::fabs(value));
  }
  return most > 0.0 ? round_up(most) : 0.0;
}

static bool choose_heatmap(const Session& session, Controls& controls, View& view) {
  const View& usual = session.opened().view;
  bool changed = choose_field(session, controls, view);
  if (!view.field) return changed;
  changed |= choose(controls, "view.field_palette", "Palette of the heatmap",
                    "For magnitudes; signed fields are blue below zero and red above", kPalettes,
                    "as the disks", view.field_palette, usual.field_palette);
  const auto& map = session.frame().snapshot.field;
  const bool signs = map && std::ranges::any_of(map->values, [](double v) { return v < 0.0; });
  changed |= choose_range(controls, "view.field_range", "Range of the heatmap", view.field_range,
                          usual.field_range, map ? end_of(*map) : 0.0, signs);
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

double disk_colour_end(const Snapshot& snapshot) {
  return round_up(2.0 * std::sqrt(2.0 * snapshot.temperature));
}

void view_panel(Session& session, Controls& controls) {
  if (!group("View")) return;
  View view = session.view();
  const View& usual = session.opened().view;
  bool changed = choose_colour(session, controls, view);
  if (view.colour_by != ColourBy::None) {
    changed |= choose(controls, "view.palette", "Palette", "All are fit for the colour-blind",
                      kPalettes, view.palette, usual.palette);
    changed |=
        choose_range(controls, "view.range", "Range of the disks", view.range, usual.range,
                     disk_colour_end(session.frame().snapshot), view.colour_by != ColourBy::Speed);
  }
  changed |= choose_heatmap(session, controls, view);
  changed |= choose(controls, "view.arrows", "Arrows", "A field with a direction", kArrows, "none",
                    view.arrows, usual.arrows);
  changed |= choose_trails(controls, view.trails, usual.trails);
  changed |= choose(controls, "view.theme", "Theme",
                    "Colours of the picture's background and walls, and of the panels", kThemes,
                    view.theme, usual.theme);
  changed |=
      controls.toggle("view.grid", "Grid", "Its spacing is the length of the scale bar", view.grid);
  changed |= controls.toggle("view.overlay", "Title, figures and scales",
                             "Text and legends on the picture, as in films", view.overlay);
  controls.show(view, changed);
  ImGui::Spacing();
}

}  // namespace clatter
