#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/import/xml.h"

namespace clatter {

/// A file of VTK in XML: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html. Its
/// arrays are text, or binary in base64 or raw, as they are or compressed by zlib. Every function
/// throws UserError with the file if that is malformed.
class VtkFile {
 public:
  /// Opens a file of a type of data: PolyData or Collection.
  VtkFile(const std::filesystem::path& path, const std::string& type);

  /// The element of the data, whose name is the type.
  const XmlElement& data() const { return *data_; }
  /// The numbers of a DataArray with `count` numbers.
  std::vector<double> numbers(const XmlElement& array, std::size_t count) const;
  /// The texts of an Array of strings.
  std::vector<std::string> texts(const XmlElement& array) const;

  /// Throws the error of an element, with its line in a file of text.
  [[noreturn]] void refuse(const XmlElement& element, const std::string& problem,
                           const std::string& advice) const;

 private:
  std::string bytes_of(const XmlElement& array, std::uint64_t expected) const;

  std::filesystem::path path_;
  std::string text_;
  XmlElement root_;
  const XmlElement* data_ = nullptr;
  bool swapped_ = false;     // whether the bytes of numbers have the other order
  bool compressed_ = false;  // by zlib
  std::size_t word_ = 4;     // bytes of the numbers before binary data
  std::string_view appended_;
  bool appended_in_base64_ = false;
};

}  // namespace clatter
