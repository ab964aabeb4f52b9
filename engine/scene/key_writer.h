#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/enum_names.h"
#include "engine/scene/key_rules.h"
#include "engine/scene/key_table.h"

namespace clatter {

/// A value in TOML; JSON is the same except for infinity.
std::string value_text(double number);  ///< shortest text that reads back to the same bits
std::string value_text(int number);
std::string value_text(bool flag);
std::string value_text(const std::string& text);  ///< quoted, special characters escaped
std::string value_text(const std::vector<std::string>& texts);
std::string value_text(const Vec2& vector);               ///< as an array
std::string value_text(const std::vector<Vec2>& points);  ///< as an array of arrays
std::string value_text(const VecX& vector);               ///< as an array
std::string value_text(const std::vector<int>& numbers);  ///< as an array
std::string value_text(const std::vector<double>& numbers);  ///< as an array
std::string value_text(const ColourRange& range);         ///< as in the scene file
std::string value_text(const Rgb& colour);                ///< "#rrggbb", quoted

/// Visitor that writes every key of a scene. The subclasses define the syntax.
class KeyWriter {
 public:
  template <class T>
  void value(std::string_view key, const T& value, Limits = {}, Presence presence = kOptional) {
    if (presence.kind != Presence::Forbidden) write(key, value_text(value));
  }

  /// A number that may be absent.
  template <class T>
  void value(std::string_view key, const std::optional<T>& number, Limits limits,
             Presence presence = kOptional) {
    if (number) value(key, *number, limits, presence);
  }

  template <class E, class Names>
  void choice(std::string_view key, E chosen, const Names& names, Presence presence = kOptional) {
    if (presence.kind == Presence::Forbidden) return;
    write(key, value_text(std::string(name_of(chosen, names))));
  }

  template <class E, class Names>
  void choice(std::string_view key, std::optional<E> chosen, const Names& names) {
    if (chosen) choice(key, *chosen, names);
  }

  template <class E, class Names>
  void choice(std::string_view key, const std::vector<E>& chosen, const Names& names) {
    std::string list;
    std::string last;
    for (const E one : chosen) {
      const std::string name(name_of(one, names));
      if (name != last) list += (list.empty() ? "" : ", ") + value_text(name);
      last = name;
    }
    write(key, '[' + list + ']');
  }

  template <class Visit>
  void table(std::string_view key, Visit visit) {
    open(key);
    visit(*this);
    close();
  }

  template <class T, class Visit>
  void table(std::string_view key, std::optional<T>& content, Visit visit) {
    if (content) table(key, [&](KeyWriter& io) { visit(io, *content); });
  }

  template <class T, class Visit>
  void list(std::string_view key, std::vector<T>& items, Visit visit) {
    open_list(key, items.empty());
    for (T& item : items) {
      open_item();
      visit(*this, item);
      close_item();
    }
    close_list();
  }

  /// A table of keys and their values.
  virtual void settings(std::string_view key, const std::vector<Override>& settings) = 0;

 protected:
  KeyWriter() = default;
  ~KeyWriter() = default;

 private:
  virtual void write(std::string_view key, const std::string& value) = 0;
  virtual void open(std::string_view key) = 0;
  virtual void close() = 0;
  virtual void open_list(std::string_view key, bool empty) = 0;
  virtual void open_item() = 0;
  virtual void close_item() = 0;
  virtual void close_list() = 0;
};

/// Writes a scene file.
class TomlWriter final : public KeyWriter {
 public:
  /// The text written so far.
  const std::string& text() const { return text_; }
  void settings(std::string_view key, const std::vector<Override>& settings) override;

 private:
  void write(std::string_view key, const std::string& value) override;
  void open(std::string_view key) override;
  void close() override;
  void open_list(std::string_view key, bool empty) override;
  void open_item() override;
  void close_item() override;
  void close_list() override;
  std::string path() const;

  std::string text_;
  std::vector<std::string> path_;      // of the current table
  bool header_due_ = false;            // a table without own values gets no header
  bool in_item_ = false;               // tables and lists of an item of a list are inline
  // The open tables and lists of the item, the innermost last. A table of a list has no key.
  struct Inline {
    std::string key, text;
  };
  std::vector<Inline> inline_;
};

/// Writes a JSON object.
class JsonWriter final : public KeyWriter {
 public:
  /// The text written so far.
  std::string text() const { return '{' + text_ + '}'; }
  /// Writes values as strings in TOML syntax.
  void settings(std::string_view key, const std::vector<Override>& settings) override;

 private:
  void write(std::string_view key, const std::string& value) override;
  void open(std::string_view key) override;
  void close() override;
  void open_list(std::string_view key, bool empty) override;
  void open_item() override;
  void close_item() override { text_ += '}'; }
  void close_list() override;
  void begin(std::string_view key);

  std::string text_;
  std::vector<std::size_t> starts_;  // of the open objects; one without keys is removed
};

}  // namespace clatter
