#include "app/results/vtk_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <numbers>
#include <system_error>

#include "app/results/vtk_xml.h"
#include "engine/statistics/part_sums.h"
#include "engine/system/write_file.h"
#include "engine/text.h"

namespace clatter {

namespace {

// Cells of one kind: the numbers of their points, and of their fixtures.
struct Cells {
  std::vector<long> points, ends;
  std::vector<int> fixtures;

  void add(const std::vector<long>& corners, int fixture) {
    points.insert(points.end(), corners.begin(), corners.end());
    ends.push_back(static_cast<long>(points.size()));
    fixtures.push_back(fixture);
  }
  std::string xml(const char* kind, VtkArrays& arrays) const {
    return fmt::format("      <{}>\n", kind) + arrays.add("connectivity", 1, points) +
           arrays.add("offsets", 1, ends) + fmt::format("      </{}>\n", kind);
  }
};

class Shapes {
 public:
  long point(const Vec2& place) { return point(Vec<3>(place.x(), place.y(), 0.0)); }
  long point(const Vec<3>& place) {
    places.insert(places.end(), place.begin(), place.end());
    return static_cast<long>(places.size() / 3) - 1;
  }

  // A segment.
  void add_plate(const Piece<2>& plate, int fixture) {
    const Vec2 end = plate.corner + plate.lengths[0] * plate.directions[0];
    const long first = point(plate.corner), second = point(end);
    lines.add({first, second}, fixture);
  }
  // A rectangle.
  void add_plate(const Piece<3>& plate, int fixture) {
    const Vec<3> a = plate.lengths[0] * plate.directions[0];
    const Vec<3> b = plate.lengths[1] * plate.directions[1];
    std::vector<long> corners;
    for (const Vec<3>& edge : {Vec<3>(Vec<3>::Zero()), a, Vec<3>(a + b), b}) {
      corners.push_back(point(Vec<3>(plate.corner + edge)));
    }
    polygons.add(corners, fixture);
  }
  // A regular polygon.
  void add_ball(const Piece<2>& ball, int fixture) {
    std::vector<long> corners;
    for (int k = 0; k < kParts; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kParts;
      const Vec2 normal(std::cos(angle), std::sin(angle));
      corners.push_back(point(Vec2(ball.corner + ball.radius * normal)));
    }
    polygons.add(corners, fixture);
  }
  // Four-sided parts between circles of latitude. At the poles they have two equal corners.
  void add_ball(const Piece<3>& ball, int fixture) {
    const long first = static_cast<long>(places.size() / 3);
    for (int row = 0; row <= kParts / 2; ++row) {
      const double polar = 2.0 * std::numbers::pi * row / kParts;
      for (int k = 0; k < kParts; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kParts;
        point(Vec<3>(ball.corner + ball.radius * Vec<3>(std::sin(polar) * std::cos(angle),
                                                        std::sin(polar) * std::sin(angle),
                                                        std::cos(polar))));
      }
    }
    for (long row = 0; row < kParts / 2; ++row) {
      for (long k = 0; k < kParts; ++k) {
        const long low = first + row * kParts, high = low + kParts, next = (k + 1) % kParts;
        polygons.add({low + k, high + k, high + next, low + next}, fixture);
      }
    }
  }

  std::vector<double> places;
  Cells lines, polygons;

 private:
  static constexpr long kParts = 48;  // of a circle
};

// The shapes of fixtures as a file of VTK PolyData: lines and polygons in 2D, surfaces in 3D. Round
// ones have flat parts. Each cell has the number of its fixture. The file contains `origin`, which
// must not contain "--".
template <int D>
std::string fixture_shapes(const std::vector<Fixture<D>>& fixtures, const std::string& origin) {
  Shapes shapes;
  for (std::size_t k = 0; k < fixtures.size(); ++k) {
    const int number = static_cast<int>(k);
    for (const Piece<D>& piece : fixtures[k].pieces) {
      if (piece.is_plate()) shapes.add_plate(piece, number);
      if (piece.radius > 0.0) shapes.add_ball(piece, number);
    }
  }
  std::vector<int> numbers = shapes.lines.fixtures;
  numbers.insert(numbers.end(), shapes.polygons.fixtures.begin(), shapes.polygons.fixtures.end());
  VtkArrays arrays;
  std::string xml = vtk_head("PolyData", origin) + "  <PolyData>\n";
  xml += fmt::format(
      "    <Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
      shapes.places.size() / 3, shapes.lines.ends.size(), shapes.polygons.ends.size());
  xml += "      <CellData Scalars=\"fixture\">\n" + arrays.add("fixture", 1, numbers) +
         "      </CellData>\n";
  xml += "      <Points>\n" + arrays.add("positions", 3, shapes.places, "a") + "      </Points>\n";
  xml += shapes.lines.xml("Lines", arrays) + shapes.polygons.xml("Polys", arrays);
  return xml + "    </Piece>\n  </PolyData>\n" + arrays.appended();
}

constexpr const char* kFieldsFile = "fields.vti";
constexpr const char* kSeriesFile = "series.pvd";
constexpr const char* kShapesFile = "fixtures.vtp";

// The names of the components of a field in the order of VTK: of a scalar, a vector, or a symmetric
// tensor. Components outside the plane are 0.
std::vector<const char*> components_of(Field field) {
  if (joint_name_of(field) == name_of(field)) return {""};
  if (field.j == Field::kNone) return {"X", "Y", "Z"};
  return {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
}

// The index of a component in this order.
std::size_t index_of(Field field) {
  if (joint_name_of(field) == name_of(field)) return 0;
  std::string axes = axes_of(field);
  std::ranges::transform(axes, axes.begin(), [](char axis) { return std::toupper(axis); });
  const std::vector<const char*> components = components_of(field);
  return std::ranges::find(components, axes) - components.begin();
}

// A field with all its components.
struct DataArray {
  std::string name;
  std::vector<const FieldMap*> components;
};

std::string name_of_array(const FieldMap& map) {
  return joint_name_of(map.field) + (map.species.empty() ? "" : '_' + map.species);
}

std::vector<DataArray> arrays_of(const FieldMaps& maps) {
  std::vector<DataArray> arrays;
  for (const FieldMap& map : maps.maps) {
    const std::string name = name_of_array(map);
    auto array = std::ranges::find(arrays, name, &DataArray::name);
    if (array == arrays.end()) array = arrays.insert(array, {name, {}});
    array->components.push_back(&map);
  }
  return arrays;
}

// Appends a block of data: its length in bytes, then all components of each cell.
void append_values(std::string& data, const DataArray& array) {
  const std::size_t stride = components_of(array.components.front()->field).size();
  const std::size_t cells = array.components.front()->values.size();
  std::vector<double> values(cells * stride);
  for (const FieldMap* component : array.components) {
    const std::size_t place = index_of(component->field);
    for (std::size_t i = 0; i < cells; ++i) values[i * stride + place] = component->values[i];
  }
  const std::uint64_t bytes = values.size() * sizeof(double);
  data.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
  data.append(reinterpret_cast<const char*>(values.data()), bytes);
}

std::string attributes_of(const DataArray& array) {
  const std::vector<const char*> components = components_of(array.components.front()->field);
  std::string text = "Name=\"" + array.name + "\"";
  if (components.size() == 1) return text;
  text += " NumberOfComponents=\"" + std::to_string(components.size()) + "\"";
  for (std::size_t k = 0; k < components.size(); ++k) {
    text += " ComponentName" + std::to_string(k) + "=\"" + components[k] + "\"";
  }
  return text;
}

// The values follow the XML as raw binary data, as in files of VTK's own writer. They are exact,
// NaN included.
std::string image_data(const FieldMaps& maps, const std::string& origin, const StopRequest& stop) {
  const auto dimension = static_cast<int>(maps.cell.size());
  std::string extent, spacing;
  for (int axis = 0; axis < 3; ++axis) {
    const bool off_plane = axis >= dimension;
    const std::string gap = axis == 0 ? "" : " ";
    extent += gap + "0 " + std::to_string(off_plane ? 0 : maps.maps.front().cells[axis]);
    spacing += gap + number_text(off_plane ? 1.0 : maps.cell[axis]);
  }
  std::string data;
  std::string xml = vtk_head("ImageData", origin) + "  <ImageData WholeExtent=\"" + extent +
                    "\" Origin=\"0 0 0\" Spacing=\"" + spacing + "\">\n" +
                    "    <FieldData>\n"
                    "      <DataArray type=\"Float64\" Name=\"time\" NumberOfTuples=\"2\" "
                    "format=\"ascii\">" +
                    number_text(maps.begin) + " " + number_text(maps.end) +
                    "</DataArray>\n    </FieldData>\n"
                    "    <Piece Extent=\"" +
                    extent + "\">\n      <CellData>\n";
  for (const DataArray& array : arrays_of(maps)) {
    stop.check();
    xml += "        <DataArray type=\"Float64\" " + attributes_of(array) +
           " format=\"appended\" offset=\"" + std::to_string(data.size()) +
           "\">\n          <InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">" +
           unit_of(array.components.front()->field.quantity, dimension) +
           "</InformationKey>\n        </DataArray>\n";
    append_values(data, array);
  }
  return xml +
         "      </CellData>\n    </Piece>\n  </ImageData>\n"
         "  <AppendedData encoding=\"raw\">_" +
         data + "</AppendedData>\n</VTKFile>\n";
}

std::string part_name(std::size_t part) {
  return fmt::format("series_{:02}.vti", part);
}

void write_series(const std::filesystem::path& folder, const std::vector<FieldMaps>& series,
                  const std::string& origin, const StopRequest& stop) {
  std::string collection = vtk_head("Collection", origin) + "  <Collection>\n";
  for (std::size_t k = 0; k < series.size(); ++k) {
    write_file(folder / part_name(k), image_data(series[k], origin, stop));
    collection += "    <DataSet timestep=\"" +
                  number_text(0.5 * (series[k].begin + series[k].end)) + "\" file=\"" +
                  part_name(k) + "\"/>\n";
  }
  write_file(folder / kSeriesFile, collection + "  </Collection>\n</VTKFile>\n");
}

// The parts of a series in a folder, from number `first` on.
std::vector<std::filesystem::path> parts_listed(const std::filesystem::path& folder,
                                                std::size_t first) {
  std::ifstream stream(folder / kSeriesFile);
  const std::string list(std::istreambuf_iterator<char>(stream), {});
  std::vector<std::filesystem::path> parts;
  for (std::size_t k = first; k < PartSums<CellSums>::kMaxParts; ++k) {
    if (list.find("file=\"" + part_name(k) + "\"") != std::string::npos) {
      parts.push_back(folder / part_name(k));
    }
  }
  return parts;
}

}  // namespace

std::vector<std::string> vtk_names() {
  std::vector<std::string> names = {kFieldsFile, kSeriesFile, kShapesFile};
  for (std::size_t k = 0; k < PartSums<CellSums>::kMaxParts; ++k) names.push_back(part_name(k));
  return names;
}

template <int D>
void write_vtk_fixtures(const std::filesystem::path& folder,
                        const std::vector<Fixture<D>>& fixtures, const std::string& origin) {
  if (!fixtures.empty()) {
    write_file(folder / kShapesFile, fixture_shapes<D>(fixtures, origin));
  } else {
    std::error_code ignored;
    std::filesystem::remove(folder / kShapesFile, ignored);
  }
}

template void write_vtk_fixtures(const std::filesystem::path&, const std::vector<Fixture<2>>&,
                                 const std::string&);
template void write_vtk_fixtures(const std::filesystem::path&, const std::vector<Fixture<3>>&,
                                 const std::string&);

void write_vtk(const std::filesystem::path& folder, const Measured& measured,
               const std::string& origin, const StopRequest& stop) {
  if (!measured.maps) return;
  // ParaView opens series_*.vti as one series, with the remaining parts of an earlier, longer one.
  std::vector<std::filesystem::path> stale = parts_listed(folder, measured.map_series.size());
  write_file(folder / kFieldsFile, image_data(*measured.maps, origin, stop));
  if (!measured.map_series.empty()) {
    write_series(folder, measured.map_series, origin, stop);
  } else if (!stale.empty()) {
    stale.insert(stale.begin(), folder / kSeriesFile);
  }
  std::error_code ignored;
  for (const std::filesystem::path& file : stale) std::filesystem::remove(file, ignored);
}

}  // namespace clatter
