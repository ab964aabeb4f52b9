#include "engine/scene/key_docs.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <utility>

#include "engine/scene/key_values.h"
#include "engine/scene/key_writer.h"
#include "engine/scene/scene_keys.h"
#include "engine/scene/schedule.h"
#include "engine/text.h"

namespace clatter {

namespace {

/// A state of a key. The presence of other keys may depend on it.
struct Setting {
  std::string path;
  std::optional<std::size_t> choice;  // index of the name, or 0 for a number; absent: no value
  std::string text;                   // `kind = "driven"`
};

/// Visitor that collects the documentation of the keys and their presence.
class KeyDescriber {
 public:
  /// The key of `setting` has this state instead of its default.
  explicit KeyDescriber(Setting setting = {}) : setting_(std::move(setting)) {}

  template <class T>
  void value(const Key& key, const T& value, Limits limits = {}, Presence presence = kOptional) {
    add(key, value_text(value), presence).values = allowed_values(value, limits);
  }

  template <class T>
  void value(const Key& key, std::optional<T>& value, Limits limits,
             Presence presence = kOptional) {
    add(key, "none", presence).values = allowed_values(T{}, limits);
    offer(key, std::nullopt, "");
    offer(key, 0, "");
    if (setting()) value.emplace();
  }

  template <class E, class Names>
  void choice(const Key& key, E& chosen, const Names& names, Presence presence = kOptional) {
    add(key, value_text(std::string(name_of(chosen, names))), presence);
    choose(key, names, [&](auto value) { chosen = value; });
  }

  template <class E, class Names>
  void choice(const Key& key, std::optional<E>& chosen, const Names& names) {
    add(key, "none", kOptional);
    offer(key, std::nullopt, "");
    choose(key, names, [&](auto value) { chosen = value; });
  }

  template <class E, class Names>
  void choice(const Key& key, std::vector<E>& chosen, const Names& names) {
    add(key, "[]", kOptional);
    choose(
        key, names, [&](auto value) { chosen = {value}; }, true);
  }

  template <class Visit>
  void table(std::string_view key, Visit visit) {
    const std::string outer = table_;
    table_ += (outer.empty() ? "" : ".") + std::string(key);
    visit(*this);
    table_ = outer;
  }

  template <class T, class Visit>
  void table(std::string_view key, const std::optional<T>&, Visit visit) {
    T any{};
    table(key, [&](KeyDescriber& io) { visit(io, any); });
  }

  template <class T, class Visit>
  void list(std::string_view key, const std::vector<T>&, Visit visit) {
    table(key, std::optional<T>(), visit);
  }

  void settings(const Key& key, const std::vector<Override>&) {
    add(key, "none", kOptional).values = "a table of keys and values";
  }

  std::vector<KeyDoc> docs;
  std::map<std::string, Presence> presences;  // by path
  std::vector<Setting> offers;                // all states of keys with several states

 private:
  KeyDoc& add(const Key& key, const std::string& initial, Presence presence) {
    docs.push_back({table_, key, initial, "", "", "", {}, {}});
    presences[docs.back().path()] = presence;
    docs.back().changes_live = may_change_live(docs.back().path());
    return docs.back();
  }

  void offer(const Key& key, std::optional<std::size_t> choice, const std::string& name,
             bool in_list = false) {
    const std::string owner(key.name), quoted = in_quotes(name);
    const std::string text = in_list        ? quoted + "` in `" + owner
                             : name.empty() ? owner
                                            : owner + " = " + quoted;
    offers.push_back({docs.back().path(), choice, '`' + text + '`'});
  }

  /// The state in `setting_`, if it is of the key that was added last.
  std::optional<std::size_t> setting() const {
    return docs.back().path() == setting_.path ? setting_.choice : std::nullopt;
  }

  template <class Names, class Choose>
  void choose(const Key& key, const Names& names, Choose choose, bool in_list = false) {
    std::vector<std::string>& choices = docs.back().choices;
    std::size_t k = 0;
    for (const auto& [name, value] : names) {
      if (setting() == k) choose(value);
      offer(key, k++, std::string(name), in_list);
      if (choices.empty() || choices.back() != name) choices.emplace_back(name);
    }
  }

  Setting setting_;
  std::string table_;
};

KeyDescriber describe(int dimension, bool spins = true, Setting setting = {}) {
  SceneInput input;
  input.spins = spins;
  input.scene = default_scene(dimension);
  input.species_names = {"NAME"};
  KeyDescriber describer(std::move(setting));
  visit_scene(describer, input);
  return describer;
}

/// The states of one key, by the presence of another key.
struct States {
  std::vector<Setting> required, optional, forbidden;

  void add(const Setting& setting, Presence presence) {
    const bool is_forbidden = presence.kind == Presence::Forbidden;
    (presence.kind == Presence::Required ? required
     : is_forbidden                      ? forbidden
                                         : optional)
        .push_back(setting);
  }

  bool vary() const {
    return (required.empty() ? 0 : 1) + (optional.empty() ? 0 : 1) + (forbidden.empty() ? 0 : 1) >
           1;
  }
};

std::string with(const std::vector<Setting>& settings) {
  std::string text = settings.front().choice ? "with " : "without ";
  for (const Setting& setting : settings) {
    if (&setting != &settings.front()) text += " or ";
    text += setting.text;
  }
  return text;
}

std::string condition(const States& states) {
  const auto& [required, optional, forbidden] = states;
  if (!required.empty()) {
    return " Required " + with(required) +
           (optional.empty() && !forbidden.empty() ? ", not allowed otherwise." : ".");
  }
  if (forbidden.empty()) return "";
  return forbidden.size() <= optional.size() ? " Not allowed " + with(forbidden) + "."
                                             : " Allowed " + with(optional) + " only.";
}

/// Adds the conditions under which keys are required or forbidden.
void add_conditions(std::vector<KeyDoc>& docs) {
  std::map<std::string, std::map<std::string, States>> states;  // by key and deciding key
  for (const Setting& setting : describe(2).offers) {
    for (const auto& [path, presence] : describe(2, true, setting).presences) {
      states[path][setting.path].add(setting, presence);
    }
  }
  const std::map<std::string, Presence> smooth = describe(2, false).presences;
  for (KeyDoc& doc : docs) {
    bool always_required = true;
    States needed;  // by either of several keys, and forbidden without them
    for (const auto& [decider, found] : states[doc.path()]) {
      if (!found.optional.empty()) always_required = false;
      if (!found.vary()) continue;
      if (found.optional.empty()) {
        needed.required.insert(needed.required.end(), found.required.begin(), found.required.end());
        needed.forbidden = found.forbidden;
      } else {
        doc.conditions += condition(found);
      }
    }
    doc.conditions += condition(needed);
    if (always_required) doc.initial.clear();
    const auto presence = smooth.find(doc.path());
    if (presence != smooth.end() &&
        std::string_view(presence->second.reason) == kNotWithoutSpins.reason) {
      doc.conditions += " It " + std::string(kNotWithoutSpins.reason) + ".";
    }
    if (!doc.conditions.empty()) doc.conditions.erase(0, 1);
  }
}

/// Adds the keys that only spheres have, and the differences of common keys for spheres.
void add_spheres(std::vector<KeyDoc>& docs) {
  const std::vector<KeyDoc> spheres = describe(3).docs;
  auto next = docs.end();  // the key that follows in a file
  for (auto sphere = spheres.rbegin(); sphere != spheres.rend(); ++sphere) {
    const auto same = std::ranges::find(docs, sphere->path(), &KeyDoc::path);
    if (same == docs.end()) {
      next = docs.insert(next, *sphere);
      continue;
    }
    next = same;
    if (sphere->initial != same->initial) same->sphere_initial = sphere->initial;
    if (sphere->values != same->values) same->sphere_values = sphere->values;
    std::ranges::copy_if(sphere->choices, std::back_inserter(same->sphere_choices),
                         [&](const std::string& name) {
                           return std::ranges::find(same->choices, name) == same->choices.end();
                         });
  }
}

/// Keeps the keys of one wall, as the tables walls.SIDE and walls.SIDE.species.NAME.
void join_walls(std::vector<KeyDoc>& docs) {
  const std::string first = std::string("walls.") + kSideNames[0];
  std::erase_if(docs, [&](const KeyDoc& doc) {
    return doc.table.starts_with("walls.") && !doc.table.starts_with(first);
  });
  for (KeyDoc& doc : docs) {
    if (doc.table.starts_with(first)) doc.table.replace(0, first.size(), "walls.SIDE");
  }
}

}  // namespace

std::vector<KeyDoc> key_docs() {
  std::vector<KeyDoc> docs = describe(2).docs;
  add_conditions(docs);
  add_spheres(docs);
  join_walls(docs);
  return docs;
}

}  // namespace clatter
