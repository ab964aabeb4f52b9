#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/scene.h"

namespace clatter {

/// Visitor that lists the keys and tables that a scene file may have, with their full dotted paths.
class KeyLister {
 public:
  template <class... Rest>
  void value(std::string_view key, Rest&&...) {
    keys_.push_back(prefix_ + std::string(key));
  }

  template <class... Rest>
  void choice(std::string_view key, Rest&&...) {
    value(key);
  }

  template <class Visit>
  void table(std::string_view key, Visit visit) {
    value(key);
    const std::string outer = prefix_;
    prefix_ = keys_.back() + '.';
    visit(*this);
    prefix_ = outer;
  }

  template <class T, class Visit>
  void table(std::string_view key, const std::optional<T>&, Visit visit) {
    T any{};
    table(key, [&](KeyLister& io) { visit(io, any); });
  }

  template <class T, class Visit>
  void list(std::string_view key, const std::vector<T>&, Visit visit) {
    table(key, std::optional<T>(), visit);
  }

  /// Lists only the table, because its keys are paths of other keys.
  void settings(std::string_view key, const std::vector<Override>&) { value(key); }

  const std::vector<std::string>& keys() const { return keys_; }

 private:
  std::string prefix_;  // path of the table being visited and a dot; empty at the top
  std::vector<std::string> keys_;
};

}  // namespace clatter
