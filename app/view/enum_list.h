#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/view/controls.h"
#include "engine/scene/enum_names.h"
#include "engine/text.h"

namespace clatter {

/// The names of an enumeration's values, with spaces.
template <class E, std::size_t N>
std::vector<std::string> words_of(const std::array<Named<E>, N>& names) {
  std::vector<std::string> words;
  for (const auto& [name, value] : names) words.push_back(in_words(name));
  return words;
}

/// Index of a value among these names.
template <class E, std::size_t N>
int index_of(E value, const std::array<Named<E>, N>& names) {
  const auto found = std::ranges::find(names, value, &Named<E>::value);
  return static_cast<int>(found - names.begin());
}

/// List of an enumeration's values. Returns true if the choice changed.
template <class E, std::size_t N>
bool choose(Controls& controls, const char* key, const char* name, const char* help,
            const std::array<Named<E>, N>& names, E& value, E usual) {
  int chosen = index_of(value, names);
  if (!controls.choice(key, name, help, words_of(names), chosen, index_of(usual, names))) {
    return false;
  }
  value = names[static_cast<std::size_t>(chosen)].value;
  return true;
}

/// List of an enumeration's values, with `none` as its first word.
template <class E, std::size_t N>
bool choose(Controls& controls, const char* key, const char* name, const char* help,
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

}  // namespace clatter
