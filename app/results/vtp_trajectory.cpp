#include "app/results/vtp_trajectory.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <system_error>
#include <vector>

#include "app/results/three_axes.h"
#include "app/results/vtk_xml.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

constexpr const char* kListHead = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [";
constexpr const char* kListEnd = "\n  ]\n}\n";

// The components of vectors, as numbers of type T.
template <class T, class Vectors>
std::vector<T> numbers_in_space(const Vectors& vectors) {
  std::vector<T> numbers;
  for (const auto& vector : vectors) {
    for (const auto number : in_space(vector)) numbers.push_back(static_cast<T>(number));
  }
  return numbers;
}

// The names of species, each as the codes of its letters and a zero.
std::string names_xml(const std::vector<std::string>& names) {
  std::string codes;
  for (const std::string& name : names) {
    for (const char letter : name) codes += std::to_string(static_cast<int>(letter)) + ' ';
    codes += "0 ";
  }
  return fmt::format(
      "      <Array type=\"String\" Name=\"species_names\" NumberOfTuples=\"{}\" "
      "format=\"ascii\">{}</Array>\n",
      names.size(), codes);
}

std::string number_xml(const char* name, double number) {
  return fmt::format(
      "      <DataArray type=\"Float64\" Name=\"{}\" NumberOfTuples=\"1\" "
      "format=\"ascii\">{}</DataArray>\n",
      name, number);
}

// The time, the size, the periodic axes and the tilt of the box, and the names of the species.
template <int D>
std::string fields_xml(const TrajectoryFrame<D>& frame) {
  const auto [lx, ly, lz] = extents(frame.model);
  const auto periodic = [&](int axis) { return is_periodic(frame.model, axis) ? 1 : 0; };
  return fmt::format(
             "    <FieldData>\n{}      <DataArray "
             "type=\"Float64\" Name=\"box\" NumberOfTuples=\"3\" format=\"ascii\">{} {} "
             "{}</DataArray>\n      <DataArray type=\"UInt8\" Name=\"periodic\" "
             "NumberOfTuples=\"3\" format=\"ascii\">{} {} {}</DataArray>\n",
             number_xml("TimeValue", frame.time), lx, ly, lz, periodic(0), periodic(1),
             periodic(2)) +
         (frame.particles.sheared ? number_xml("tilt", frame.tilt) : "") +
         (frame.particles.is_mixture() ? names_xml(frame.particles.species) : "") +
         "    </FieldData>\n";
}

template <int D>
std::string point_data_xml(const TrajectoryFrame<D>& frame, VtkArrays& arrays) {
  std::vector<double> diameters, masses;
  std::vector<int> species;
  for (std::size_t i = 0; i < frame.state.positions.size(); ++i) {
    const bool mixture = frame.particles.is_mixture();
    const Grain grain = mixture ? frame.particles.grains[i] : frame.model.grain();
    diameters.push_back(2.0 * grain.radius);
    masses.push_back(grain.mass);
    if (mixture) species.push_back(static_cast<int>(grain.species));
  }
  std::string xml = "      <PointData Scalars=\"diameter\" Vectors=\"velocity\">\n";
  xml += arrays.add("diameter", 1, diameters, "a");
  xml += arrays.add("velocity", 3, numbers_in_space<double>(frame.state.velocities), "a/t");
  xml += arrays.add("mass", 1, masses, "m");
  xml += arrays.add("image", 3, numbers_in_space<int>(frame.images));
  if (!frame.state.spins.empty()) {
    xml += arrays.add("spin", 3, numbers_in_space<double>(frame.state.spins), "1/t");
  }
  if (frame.particles.is_mixture()) xml += arrays.add("species", 1, species);
  return xml + "      </PointData>\n";
}

// A vertex for each particle: cells without points are not drawn.
std::string vertices_xml(std::size_t particles, VtkArrays& arrays) {
  std::vector<long> numbers(particles), ends(particles);
  std::iota(numbers.begin(), numbers.end(), 0);
  std::iota(ends.begin(), ends.end(), 1);
  return "      <Verts>\n" + arrays.add("connectivity", 1, numbers) +
         arrays.add("offsets", 1, ends) + "      </Verts>\n";
}

// The numbers between the stem and the extension of a frame's name.
bool is_frame_of(const std::filesystem::path& path, const std::string& name) {
  const std::string begin = path.stem().string() + '_', end = path.extension();
  if (!name.starts_with(begin) || !name.ends_with(end)) return false;
  const std::string number = name.substr(begin.size(), name.size() - begin.size() - end.size());
  return !number.empty() && number.find_first_not_of("0123456789") == number.npos;
}

}  // namespace

template <int D>
std::string vtp_text(const TrajectoryFrame<D>& frame) {
  const std::size_t particles = frame.state.positions.size();
  VtkArrays arrays;
  std::string xml = vtk_head("PolyData", "clatter " CLATTER_VERSION);
  xml += "  <PolyData>\n" + fields_xml(frame);
  xml += fmt::format("    <Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\">\n", particles);
  xml += point_data_xml(frame, arrays);
  xml += "      <Points>\n" +
         arrays.add("positions", 3, numbers_in_space<double>(frame.state.positions), "a") +
         "      </Points>\n";
  xml += vertices_xml(particles, arrays);
  return xml + "    </Piece>\n  </PolyData>\n" + arrays.appended();
}

template <int D>
VtpTrajectory<D>::VtpTrajectory(const std::filesystem::path& path, std::uint64_t bytes)
    : path_(path), bytes_(bytes) {
  if (bytes == 0) remove_frames();
  list_.emplace(frames_path(path, TrajectoryFormat::Vtp), bytes);
  const std::string head = bytes == 0 ? kListHead : "";
  list_->write(bytes_, head + kListEnd);
  bytes_ += head.size();
}

template <int D>
std::filesystem::path VtpTrajectory<D>::frame_path(long number) const {
  return path_.parent_path() /
         fmt::format("{}_{:06}{}", path_.stem().string(), number, path_.extension().string());
}

// The list is complete after each frame.
template <int D>
void VtpTrajectory<D>::add(const TrajectoryFrame<D>& frame) {
  const std::filesystem::path file = frame_path(frame.number);
  write_file(file, vtp_text(frame));
  const bool first = bytes_ == std::char_traits<char>::length(kListHead);
  const std::string name = nlohmann::json(file.filename().string())
                               .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const std::string line =
      fmt::format("{}\n    {{\"name\": {}, \"time\": {}}}", first ? "" : ",", name, frame.time);
  list_->write(bytes_, line + kListEnd);
  bytes_ += line.size();
}

template <int D>
void VtpTrajectory<D>::remove_frames() const {
  std::ifstream stream(frames_path(path_, TrajectoryFormat::Vtp));
  const auto list = nlohmann::json::parse(stream, nullptr, false);
  if (!list.is_object() || !list.contains("files") || !list.at("files").is_array()) return;
  for (const nlohmann::json& file : list.at("files")) {
    if (!file.is_object()) continue;
    const auto name = file.find("name");
    if (name == file.end() || !name->is_string() || !is_frame_of(path_, *name)) continue;
    std::error_code ignored;
    std::filesystem::remove(path_.parent_path() / name->template get<std::string>(), ignored);
  }
}

template std::string vtp_text(const TrajectoryFrame<2>&);
template std::string vtp_text(const TrajectoryFrame<3>&);
template class VtpTrajectory<2>;
template class VtpTrajectory<3>;

}  // namespace clatter
