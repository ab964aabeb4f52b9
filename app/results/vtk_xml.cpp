#include "app/results/vtk_xml.h"

#include <bit>
#include <cstdint>

#include "engine/scene/field.h"

namespace clatter {

std::string vtk_head(const std::string& type, const std::string& note) {
  const bool little = std::endian::native == std::endian::little;
  return "<?xml version=\"1.0\"?>\n<!-- " + note + "; units, " + kUnits + " -->\n" +
         "<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"" +
         (little ? "LittleEndian" : "BigEndian") + "\" header_type=\"UInt64\">\n";
}

// A block of data is its length in bytes, then its values.
std::string VtkArrays::add_bytes(const char* type, const std::string& name, std::size_t components,
                                 const std::string& bytes, const std::string& unit) {
  const std::string xml =
      std::string("        <DataArray type=\"") + type + "\" Name=\"" + name + '"' +
      (components > 1 ? " NumberOfComponents=\"" + std::to_string(components) + '"' : "") +
      " format=\"appended\" offset=\"" + std::to_string(data_.size()) + '"';
  const std::uint64_t size = bytes.size();
  data_.append(reinterpret_cast<const char*>(&size), sizeof size);
  data_ += bytes;
  if (unit.empty()) return xml + "/>\n";
  return xml + ">\n          <InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">" +
         unit + "</InformationKey>\n        </DataArray>\n";
}

std::string VtkArrays::appended() const {
  return "  <AppendedData encoding=\"raw\">_" + data_ + "</AppendedData>\n</VTKFile>\n";
}

}  // namespace clatter
