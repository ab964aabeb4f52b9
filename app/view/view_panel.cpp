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
  if (view.shows_averages()) {
    changed |= controls.number({.key = "view.window",
                                .name = "Averaged over",
                                .help = "How far back in time the heatmap reaches",
                                .low = 0.1,
                                .high = 100.0,
                                .logarithmic = true,
                                .format = "%.2f"},
                               view.window, session.opened().view.window);
  }
  int palette = index_of(view.palette, kPalettes);
  changed |= controls.choice("view.palette", "Palette", "Both are fit for the colour-blind",
                             words_of(kPalettes), palette);
  view.palette = kPalettes[static_cast<std::size_t>(palette)].value;
  changed |= controls.toggle("view.overlay", "Title, figures and scales",
                             "What films write on the picture", view.overlay);
  if (changed) session.set_view(view);
  ImGui::Spacing();
}

}  // namespace clatter
