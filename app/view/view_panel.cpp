#include <imgui.h>

#include <algorithm>

#include "app/view/panels.h"
#include "engine/scene/scene_keys.h"

namespace clatter {

// A name in the person's spelling.
static std::string in_words(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

// The words for an enumeration's values.
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

// One of an enumeration's values.
template <class E, std::size_t N>
static bool choose(Controls& controls, const char* key, const char* name, const char* help,
                   const std::array<Named<E>, N>& names, E& value) {
  int chosen = index_of(value, names);
  if (!controls.choice(key, name, help, words_of(names), chosen)) return false;
  value = names[static_cast<std::size_t>(chosen)].value;
  return true;
}

// One of an enumeration's values, or none of them, in words.
template <class E, std::size_t N>
static bool choose(Controls& controls, const char* key, const char* name, const char* help,
                   const std::array<Named<E>, N>& names, const char* none,
                   std::optional<E>& value) {
  std::vector<std::string> words = words_of(names);
  words.insert(words.begin(), none);
  int chosen = value ? index_of(*value, names) + 1 : 0;
  if (!controls.choice(key, name, help, words, chosen)) return false;
  value.reset();
  if (chosen > 0) value = names[static_cast<std::size_t>(chosen) - 1].value;
  return true;
}

static bool spins_only(Field field) {
  return field == Field::Spin || field == Field::SpinTemperature;
}

static bool choose_field(const Session& session, Controls& controls, View& view) {
  std::vector<std::string> words = {"none"};
  std::vector<std::optional<Field>> fields = {std::nullopt};
  for (const auto& [name, field] : kHeatmaps) {
    if (spins_only(field) && !session.scene().spins()) continue;
    words.push_back(in_words(name));
    fields.emplace_back(field);
  }
  const auto found = std::ranges::find(fields, view.field);
  int chosen = found == fields.end() ? 0 : static_cast<int>(found - fields.begin());
  if (!controls.choice("view.field", "Heatmap", "The field below the disks, chapter 4", words,
                       chosen)) {
    return false;
  }
  view.field = fields[static_cast<std::size_t>(chosen)];
  return true;
}

void view_panel(Session& session, Controls& controls) {
  if (!group("View")) return;
  View view = session.view();
  std::vector<std::string> colours = words_of(kColourings);
  if (!session.scene().spins()) colours.pop_back();
  int colour =
      std::min(index_of(view.colour_by, kColourings), static_cast<int>(colours.size()) - 1);
  bool changed = controls.choice("view.colour_by", "Disks coloured by",
                                 "What a disk's colour shows", colours, colour);
  view.colour_by = kColourings[static_cast<std::size_t>(colour)].value;
  changed |= choose_field(session, controls, view);
  changed |= choose(controls, "view.arrows", "Arrows", "A field with a direction, chapter 4",
                    kArrows, "none", view.arrows);
  if (view.shows_averages()) {
    changed |= controls.number({.key = "view.window",
                                .name = "Averaged over",
                                .help = "How far back in time heatmap and arrows reach",
                                .low = 0.1,
                                .high = 100.0,
                                .logarithmic = true,
                                .format = "%.2f"},
                               view.window, session.opened().view.window);
  }
  changed |= choose(controls, "view.palette", "Palette", "All are fit for the colour-blind",
                    kPalettes, view.palette);
  if (view.field) {
    changed |= choose(controls, "view.field_palette", "Palette of the heatmap",
                      "Of magnitudes; fields with a sign are blue and red about zero", kPalettes,
                      "as the disks", view.field_palette);
  }
  changed |= choose(controls, "view.theme", "Theme",
                    "Colours of the picture's background and walls", kThemes, view.theme);
  changed |= controls.toggle("view.grid", "Grid", "Lines as far apart as the scale bar is long",
                             view.grid);
  changed |= controls.toggle("view.overlay", "Title, figures and scales",
                             "What films write on the picture", view.overlay);
  if (changed) session.set_view(view);
  ImGui::Spacing();
}

}  // namespace clatter
