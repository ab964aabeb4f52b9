#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/import/binary_frames.h"
#include "app/import/frame_order.h"
#include "app/import/vtk_file.h"
#include "app/results/trajectory.h"
#include "engine/error.h"
#include "engine/physics/state.h"
#include "engine/system/read_file.h"
#include "engine/text.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

// Names of an array of points, in lower case.
using ArrayNames = std::initializer_list<std::string_view>;

std::string in_lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// The points of a file of PolyData.
class VtpFrame {
 public:
  VtpFrame(const std::filesystem::path& path, const FrameChoice& choice)
      : path_(path), choice_(choice), file_(path, "PolyData") {
    for (const XmlElement* piece : file_.data().all("Piece")) {
      const std::size_t points = attribute_number(*piece, "NumberOfPoints");
      for (const char* cells : {"NumberOfLines", "NumberOfStrips", "NumberOfPolys"}) {
        if (attribute_number(*piece, cells) == 0) continue;
        file_.refuse(*piece, "the file has lines or surfaces", "give a file of points");
      }
      if (points > kMaxParticles<2> - particles_) {
        file_.refuse(*piece, "the file has too many particles", "give a smaller file");
      }
      particles_ += points;
      if (points > 0) pieces_.emplace_back(piece, points);
    }
  }

  // `time` is that of a list, for a file without a time.
  ParticleFrame read(double time) {
    ParticleFrame frame;
    frame.positions = vectors_of(positions());
    frame.velocities = vectors_of(numbers({"velocity", "velocities", "velo", "vel", "v"}, 3));
    frame.spins = vectors_of(numbers({"spin", "angular_velocity", "omega"}, 3));
    frame.images = vectors_of(numbers({"image"}, 3));
    frame.masses = numbers({"mass", "masses"}, 1);
    frame.diameters = diameters();
    if (frame.velocities.empty() && choice_.needs_velocities && particles_ > 0) {
      file_.refuse(file_.data(), "the velocities are missing",
                   "give the array velocity, or draw them with --temperature");
    }
    frame.rounding = rounding_;
    frame.time = field({"timevalue", "time"}, 1).value_or(std::vector{time}).front();
    read_types(frame);
    read_box(frame);
    sort(frame);
    frame.dimension = dimension_of(frame, choice_, path_);
    move_corner(frame, {});
    return frame;
  }

 private:
  // A number of an element; 0: it has none.
  std::size_t attribute_number(const XmlElement& element, const std::string& key) const {
    const std::string text = element.attribute(key);
    if (text.empty()) return 0;
    const auto number = whole_number<std::uint32_t>(text);
    if (!number) file_.refuse(element, key + " is " + quoted_start(text), "give a whole number");
    return *number;
  }

  // Numbers of an array with `rows` rows.
  std::vector<double> numbers_in(const XmlElement& array, std::size_t rows, std::size_t columns) {
    const std::size_t width =
        std::max<std::size_t>(attribute_number(array, "NumberOfComponents"), 1);
    if (width != columns) {
      file_.refuse(array,
                   "the array " + quoted_start(array.attribute("Name")) + " has " +
                       counted(width, "component") + " instead of " + std::to_string(columns),
                   "give vectors three components, and numbers one");
    }
    return file_.numbers(array, rows * columns);
  }

  // Positions, velocities and sizes of single precision are rounded.
  void note_rounding(const XmlElement& array) {
    if (array.attribute("type") != "Float32") return;
    rounding_ = 2.0 * std::numeric_limits<float>::epsilon();
  }

  std::vector<double> positions() {
    std::vector<double> all;
    for (const auto& [piece, points] : pieces_) {
      const XmlElement* const list = piece->child("Points");
      const XmlElement* const array = list == nullptr ? nullptr : list->child("DataArray");
      if (array == nullptr) file_.refuse(*piece, "the positions are missing", "give Points");
      note_rounding(*array);
      const std::vector<double> some = numbers_in(*array, points, 3);
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }

  // The array that has one of some names; null: none has.
  const XmlElement* array_in(const XmlElement* list, const std::string& kind,
                             const ArrayNames& names) const {
    const XmlElement* found = nullptr;
    if (list == nullptr) return nullptr;
    for (const XmlElement* array : list->all(kind)) {
      if (std::ranges::find(names, in_lower_case(array->attribute("Name"))) == names.end())
        continue;
      if (found != nullptr) {
        file_.refuse(*array,
                     "the arrays " + quoted_start(found->attribute("Name")) + " and " +
                         quoted_start(array->attribute("Name")) + " have one meaning",
                     "remove one of them");
      }
      found = array;
    }
    return found;
  }

  // The numbers of all particles in an array; empty: the file has none.
  std::vector<double> numbers(const ArrayNames& names, std::size_t columns) {
    std::vector<double> all;
    const XmlElement* lacking = nullptr;
    for (const auto& [piece, points] : pieces_) {
      const XmlElement* const array = array_in(piece->child("PointData"), "DataArray", names);
      if (array == nullptr) {
        lacking = piece;
        continue;
      }
      note_rounding(*array);
      const std::vector<double> some = numbers_in(*array, points, columns);
      all.insert(all.end(), some.begin(), some.end());
    }
    if (lacking != nullptr && !all.empty()) {
      file_.refuse(*lacking, "this piece lacks the array " + std::string(*names.begin()),
                   "give it in all pieces, or in none");
    }
    return all;
  }

  std::vector<double> diameters() {
    std::vector<double> diameters = numbers({"diameter", "diameters"}, 1);
    std::vector<double> radii = numbers({"radius", "radii"}, 1);
    for (double& radius : radii) radius *= 2.0;
    if (diameters.empty()) return radii;
    for (std::size_t i = 0; i < radii.size(); ++i) {
      if (std::fabs(radii[i] - diameters[i]) <= rounding_ * diameters[i]) continue;
      file_.refuse(file_.data(),
                   "the radius " + number_text(0.5 * radii[i]) + " does not fit the diameter " +
                       number_text(diameters[i]),
                   "remove one of the two arrays");
    }
    return diameters;
  }

  // The numbers of an array of the whole file; absent: there is none.
  std::optional<std::vector<double>> field(const ArrayNames& names, std::size_t count) const {
    const XmlElement* const array = array_in(file_.data().child("FieldData"), "DataArray", names);
    if (array == nullptr) return std::nullopt;
    return file_.numbers(*array, count);
  }

  void read_types(ParticleFrame& frame) {
    for (const double type : numbers({"species", "type"}, 1)) {
      if (type != std::floor(type) || !(std::fabs(type) <= std::numeric_limits<int>::max())) {
        file_.refuse(file_.data(), "a species is " + number_text(type), "give whole numbers");
      }
      frame.types.push_back(static_cast<int>(type));
    }
    const XmlElement* const list =
        array_in(file_.data().child("FieldData"), "Array", {"species_names"});
    frame.mixture = list != nullptr && !frame.types.empty();
    if (frame.types.empty()) return;
    std::map<int, std::string> names;
    if (list != nullptr) {
      for (const std::string& name : file_.texts(*list)) {
        names.emplace(static_cast<int>(names.size()), name);
      }
    }
    name_types(frame, names);
  }

  // The box of a file of clatter. Without a list of periodic axes all are, as in extended XYZ.
  void read_box(ParticleFrame& frame) const {
    const auto lengths = field({"box"}, 3);
    if (!lengths) return;
    if (const auto tilt = field({"tilt"}, 1); tilt && tilt->front() != 0.0) refuse_tilt(path_);
    frame.box.emplace();
    const std::vector<double> periodic =
        field({"periodic"}, 3).value_or(std::vector<double>(3, 1.0));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      frame.box->lengths[axis] = (*lengths)[axis];
      frame.box->periodic[axis] = periodic[axis] != 0.0;
    }
  }

  void sort(ParticleFrame& frame) {
    const std::vector<double> ids = numbers({"id"}, 1);
    if (!ids.empty()) sort_by_id(frame, {ids.begin(), ids.end()}, path_);
  }

  std::filesystem::path path_;
  FrameChoice choice_;
  VtkFile file_;
  std::vector<std::pair<const XmlElement*, std::size_t>> pieces_;  // with points, and their number
  std::size_t particles_ = 0;
  double rounding_ = ParticleFrame().rounding;
};

// An entry of a list of files.
struct ListedFile {
  std::string name;
  double time = 0.0;
};

// The files in a list of ParaView's, in JSON.
std::vector<ListedFile> files_in_series(const std::filesystem::path& path) {
  constexpr std::size_t kLargestList = 1'000'000'000;
  const auto refuse = [&](const std::string& problem) {
    throw UserError({path.string()}, problem, "give a list of files as ParaView writes it");
  };
  const auto list =
      nlohmann::json::parse(read_file(path.string(), kLargestList, ""), nullptr, false);
  if (!list.is_object()) refuse("this is no list in JSON, or it is cut off");
  if (!list.contains("files") || !list["files"].is_array()) refuse("the list has no files");
  std::vector<ListedFile> files;
  for (const nlohmann::json& file : list["files"]) {
    if (!file.is_object() || !file.contains("name") || !file["name"].is_string() ||
        !file.contains("time") || !file["time"].is_number()) {
      refuse("entry " + std::to_string(files.size()) + " of the list has no name and time");
    }
    files.push_back({file["name"].get<std::string>(), file["time"].get<double>()});
  }
  return files;
}

// The files in a list of ParaView's, in XML. Several files of one time are parts of one picture.
std::vector<ListedFile> files_in_collection(const std::filesystem::path& path) {
  const VtkFile list(path, "Collection");
  std::vector<ListedFile> files;
  for (const XmlElement* file : list.data().all("DataSet")) {
    const auto time = signed_number<double>(file->attribute("timestep"));
    if (!time || file->attribute("file").empty()) {
      list.refuse(*file, "the entry has no file and time", "give file=... and timestep=...");
    }
    if (!files.empty() && files.back().time == *time) {
      list.refuse(*file, "the list has several files of the time " + number_text(*time),
                  "give the file of the particles instead");
    }
    files.push_back({file->attribute("file"), *time});
  }
  return files;
}

}  // namespace

ParticleFrame read_vtp_frame(const std::filesystem::path& path, const FrameChoice& choice) {
  if (choice.frame.value_or(0) > 0) refuse_frame(path, 1);
  return VtpFrame(path, choice).read(0.0);
}

ParticleFrame read_vtp_series(const std::filesystem::path& path, const FrameChoice& choice) {
  const std::vector<ListedFile> files =
      path.extension() == ".pvd" ? files_in_collection(path) : files_in_series(path);
  const std::size_t place = choice.frame.value_or(std::max<std::size_t>(files.size(), 1) - 1);
  if (place >= files.size()) refuse_frame(path, files.size());
  const std::filesystem::path file = path.parent_path() / files[place].name;
  if (find_trajectory_format(file) != TrajectoryFormat::Vtp) {
    throw UserError({path.string()}, "the list names " + quoted_start(files[place].name),
                    "give a list of files .vtp");
  }
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    throw UserError({path.string()}, "the list names " + file.string() + ", which is no file",
                    "give the list with its files");
  }
  ParticleFrame frame = VtpFrame(file, choice).read(files[place].time);
  frame.number = static_cast<long>(place);
  return frame;
}

}  // namespace clatter
