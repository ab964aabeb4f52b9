#pragma once

#include <cstring>
#include <string>
#include <vector>

namespace clatter {

/// The begin of a file of VTK: XML of a type of data, with a note, which must not contain "--".
std::string vtk_head(const std::string& type, const std::string& note);

/// Arrays of a file of VTK. Their values follow the XML as raw binary data, as in files of VTK's
/// own writer: exact, NaN included.
class VtkArrays {
 public:
  /// Appends an array of doubles or integers with its values: consecutive tuples of `components`
  /// numbers. Returns its XML. An empty unit is not written.
  template <class T>
  std::string add(const std::string& name, std::size_t components, const std::vector<T>& values,
                  const std::string& unit = "") {
    std::string bytes(values.size() * sizeof(T), '\0');
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return add_bytes(type_of(T()), name, components, bytes, unit);
  }
  /// The part of the file behind the data set.
  std::string appended() const;

 private:
  static const char* type_of(double) { return "Float64"; }
  static const char* type_of(int) { return "Int32"; }
  static const char* type_of(long) { return "Int64"; }
  std::string add_bytes(const char* type, const std::string& name, std::size_t components,
                        const std::string& bytes, const std::string& unit);

  std::string data_;
};

}  // namespace clatter
