#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

// Each type that a checkpoint keeps has one function beside it that visits the members in order.
// Writing and reading share this function:
//   template <class Archive> void visit(Archive& io, Type& value)   for plain structs,
//   template <class Archive> void visit(Archive& io)                for classes, as a member.
// The function binds all members with a structured binding. A new member of the type does not
// compile until the function names it.

// Checkpoints. RunState and the model determine a run's future. Plans, queue and cells are rebuilt
// at a restart. Each stored type has one function visit beside it, for writing and reading
// (checkpoint/archive.h). It binds every member, so that a new member does not compile until it is
// named there. Then raise kVersion in checkpoint.cpp. The previous file is kept as FILE.previous. A
// CRC-32 covers the whole file.

namespace clatter {

/// Common base of writing and reading: descends through structs, vectors and containers to numbers.
template <class Self>
class Archive {
 public:
  /// Visits values in order.
  template <class... T>
  void operator()(T&... values) {
    (item(values), ...);
  }

 protected:
  Archive() = default;
  ~Archive() = default;

 private:
  Self& self() { return static_cast<Self&>(*this); }

  template <class T>
  void item(T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      self().number(value);
    } else if constexpr (requires { value.visit(self()); }) {
      value.visit(self());
    } else {
      visit(self(), value);
    }
  }

  void item(bool& flag) {
    std::uint8_t number = flag;
    self().number(number);
    flag = number != 0;
  }

  template <class T, int Size>
  void item(Eigen::Matrix<T, Size, 1>& vector) {
    for (T& component : vector) item(component);
  }

  template <class T, int Most>
  void item(Eigen::Matrix<T, Eigen::Dynamic, 1, Eigen::ColMajor, Most, 1>& vector) {
    auto size = static_cast<std::uint8_t>(vector.size());
    self().number(size);
    self().require(size <= Most);
    vector.resize(size);
    for (T& component : vector) item(component);
  }

  template <class T, std::size_t Size>
  void item(std::array<T, Size>& array) {
    for (T& element : array) item(element);
  }

  template <class T>
  void item(std::vector<T>& vector) {
    self().length(vector);
    for (T& element : vector) item(element);
  }

  template <class T>
  void item(std::deque<T>& deque) {
    self().length(deque);
    for (T& element : deque) item(element);
  }

  void item(std::string& text) {
    self().length(text);
    self().bytes(text.data(), text.size());
  }

  template <class T>
  void item(std::optional<T>& optional) {
    bool present = optional.has_value();
    item(present);
    if (present && !optional) optional.emplace();
    if (!present) optional.reset();
    if (present) item(*optional);
  }

  template <class... T>
  void item(std::variant<T...>& variant) {
    auto index = static_cast<std::uint8_t>(variant.index());
    self().number(index);
    self().choose(variant, index);
    std::visit([this](auto& value) { this->item(value); }, variant);
  }
};

/// Writes values as bytes: the bits of each number, little-endian.
class ArchiveWriter : public Archive<ArchiveWriter> {
 public:
  /// All bytes written so far.
  const std::string& written() const { return bytes_; }
  /// Does nothing: written values are valid.
  void require(bool) const {}

 private:
  friend Archive<ArchiveWriter>;

  template <class T>
  void number(const T& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(raw);
    bytes_.append(raw, sizeof raw);
  }
  template <class Container>
  void length(const Container& container) {
    number(static_cast<std::uint64_t>(container.size()));
  }
  void bytes(const char* from, std::size_t count) { bytes_.append(from, count); }
  template <class Variant>
  void choose(const Variant&, std::size_t) {}

  std::string bytes_;
};

/// Counts the bytes of values without reading them.
class ArchiveMeter : public Archive<ArchiveMeter> {
 public:
  /// Number of bytes of all values so far.
  std::size_t bytes() const { return bytes_; }
  /// Does nothing: values may be uninitialised.
  void require(bool) const {}

 private:
  friend Archive<ArchiveMeter>;

  template <class T>
  void number(const T&) {
    bytes_ += sizeof(T);
  }
  template <class Container>
  void length(const Container&) {
    bytes_ += sizeof(std::uint64_t);
  }
  void bytes(const char*, std::size_t count) { bytes_ += count; }
  template <class Variant>
  void choose(const Variant&, std::size_t) {}

  std::size_t bytes_ = 0;
};

/// Reads values from bytes. Throws UserError if the bytes do not fit the types of this program.
class ArchiveReader : public Archive<ArchiveReader> {
 public:
  /// Reads `bytes`, which must outlive this object. `file` is the name for errors.
  ArchiveReader(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  /// Throws UserError if bytes are left over.
  void finish() const { require(bytes_.empty()); }
  /// Throws UserError unless `sense` is true, the result of a check of read values.
  void require(bool sense) const {
    if (!sense) refuse();
  }

 private:
  friend Archive<ArchiveReader>;

  [[noreturn]] void refuse() const;

  template <class T>
  void number(T& value) {
    char raw[sizeof value];
    bytes(raw, sizeof raw);
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(raw);
    std::memcpy(&value, raw, sizeof value);
  }
  // The elements must fit into the rest of the bytes, so that a damaged length causes no huge
  // allocation: a default element has the fewest bytes. A container that already has elements has
  // its size from the scene and keeps it.
  template <class Container>
  void length(Container& container) {
    std::uint64_t size = 0;
    number(size);
    typename Container::value_type element{};
    ArchiveMeter least;
    least(element);
    if (size > bytes_.size() / least.bytes()) refuse();
    if (!container.empty() && size != container.size()) refuse();
    container.resize(size);
  }
  // Selects the variant's alternative of this index.
  template <class... T>
  void choose(std::variant<T...>& variant, std::size_t index) {
    if (index >= sizeof...(T)) refuse();
    std::size_t alternative = 0;
    ((alternative++ == index ? void(variant.template emplace<T>()) : void()), ...);
  }
  void bytes(char* to, std::size_t count) {
    if (count > bytes_.size()) refuse();
    if (count > 0) std::memcpy(to, bytes_.data(), count);
    bytes_.remove_prefix(count);
  }

  std::string_view bytes_;  // still to read
  std::string file_;
};

}  // namespace clatter
