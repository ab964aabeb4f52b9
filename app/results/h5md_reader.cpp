#include "app/results/h5md_reader.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <type_traits>

#include "app/results/particle_frame.h"
#include "engine/error.h"
#include "engine/physics/state.h"
#include "engine/text.h"

namespace clatter {

namespace {

std::vector<hsize_t> shape_of(const H5::DataSet& dataset) {
  const H5::DataSpace space = dataset.getSpace();
  std::vector<hsize_t> shape(static_cast<std::size_t>(space.getSimpleExtentNdims()));
  if (!shape.empty()) space.getSimpleExtentDims(shape.data());
  return shape;
}

bool is_group(const H5::Group& parent, const std::string& name) {
  return parent.nameExists(name) && parent.childObjType(name) == H5O_TYPE_GROUP;
}

// A number of a dataset or of an attribute without dimensions.
template <class Source>
double scalar_of(const Source& source) {
  double number = 0.0;
  if constexpr (std::is_same_v<Source, H5::Attribute>) {
    source.read(H5::PredType::NATIVE_DOUBLE, &number);
  } else {
    source.read(&number, H5::PredType::NATIVE_DOUBLE);
  }
  return number;
}

// The texts of an attribute, without the blanks that may fill them.
std::vector<std::string> texts_of(const H5::Attribute& attribute) {
  const auto count = static_cast<std::size_t>(attribute.getSpace().getSimpleExtentNpoints());
  const H5::StrType type = attribute.getStrType();
  std::vector<std::string> texts;
  if (type.isVariableStr()) {
    std::vector<char*> read(count, nullptr);
    attribute.read(type, read.data());
    for (const char* text : read) texts.emplace_back(text != nullptr ? text : "");
    H5::DataSet::vlenReclaim(read.data(), type, attribute.getSpace());
  } else {
    std::string all(count * type.getSize(), '\0');
    attribute.read(type, all.data());
    for (std::size_t k = 0; k < count; ++k) {
      const std::string text = all.substr(k * type.getSize(), type.getSize());
      texts.push_back(text.substr(0, text.find('\0')));
    }
  }
  for (std::string& text : texts) text.erase(text.find_last_not_of(' ') + 1);
  return texts;
}

// The numbers of an attribute; empty: they are not whole.
std::vector<int> whole_numbers_of(const H5::Attribute& attribute) {
  if (attribute.getTypeClass() != H5T_INTEGER) return {};
  std::vector<int> numbers(static_cast<std::size_t>(attribute.getSpace().getSimpleExtentNpoints()));
  if (!numbers.empty()) attribute.read(H5::PredType::NATIVE_INT, numbers.data());
  return numbers;
}

// Whether a dataset has integers, or numbers of IEEE 754.
bool has_numbers(const H5::DataSet& dataset) {
  const H5T_class_t kind = dataset.getTypeClass();
  if (kind != H5T_FLOAT) return kind == H5T_INTEGER;
  const H5::FloatType type = dataset.getFloatType();
  return type == H5::PredType::IEEE_F64LE || type == H5::PredType::IEEE_F32LE ||
         type == H5::PredType::IEEE_F64BE || type == H5::PredType::IEEE_F32BE;
}

// Elements of one row that hold for all frames: properties of particles, and the box.
bool is_constant(const std::string& element) {
  return element == "mass" || element == "diameter" || element == "species" ||
         element == "box/edges";
}

}  // namespace

template <class Read>
auto H5mdReader::checked(const Read& read) const {
  try {
    return read();
  } catch (const H5::Exception& error) {
    refuse("the file is damaged or not H5MD: " + error.getDetailMsg(), "give a complete H5MD file");
  }
}

void H5mdReader::refuse(const std::string& problem, const std::string& advice) const {
  throw UserError({path_.string()}, problem, advice);
}

H5mdReader::H5mdReader(const std::filesystem::path& path, const std::string& group) : path_(path) {
  H5::Exception::dontPrint();
  checked([&] {
    file_ = H5::H5File(path.string(), H5F_ACC_RDONLY);
    open_group(group);
    read_shape();
  });
}

void H5mdReader::open_group(const std::string& wanted) {
  const H5::Group root = file_.openGroup("/");
  require_version();
  if (!is_group(root, "particles")) {
    refuse("the file has no group \"particles\"", "give a trajectory in H5MD");
  }
  const H5::Group all = root.openGroup("particles");
  std::vector<std::string> names;
  std::string list;
  for (hsize_t k = 0; k < all.getNumObjs(); ++k) {
    const std::string name = all.getObjnameByIdx(k);
    if (!is_group(all, name)) continue;
    list += (names.empty() ? "" : ", ") + in_quotes(name);
    names.push_back(name);
  }
  if (names.empty()) refuse("the group \"particles\" is empty", "give a file with particles");
  if (wanted.empty() && names.size() > 1) {
    refuse("the file has several groups of particles: " + list, "name one with --group");
  }
  group_ = wanted.empty() ? names.front() : wanted;
  if (std::ranges::find(names, group_) == names.end()) {
    refuse("the file has no group of particles " + in_quotes(group_), "its groups are " + list);
  }
  particles_ = all.openGroup(group_);
}

void H5mdReader::require_version() const {
  const H5::Group root = file_.openGroup("/");
  std::vector<int> version;
  if (is_group(root, "h5md") && root.openGroup("h5md").attrExists("version")) {
    version = whole_numbers_of(root.openGroup("h5md").openAttribute("version"));
  }
  if (version.size() == 2 && version[0] == 1) return;
  refuse(version.size() == 2 ? "the file has version " + std::to_string(version[0]) + " of H5MD"
                             : "the file does not say its version of H5MD",
         "give a file of version 1, with the attribute h5md/version = [1, 1]");
}

void H5mdReader::read_shape() {
  require("position");
  std::vector<hsize_t> shape = shape_of(values_of("position"));
  const bool moves = in_time("position");
  if (!moves) shape.insert(shape.begin(), 1);
  if (shape.size() != 3 || shape[2] < 2 || shape[2] > 3 || shape[1] > kMaxParticles<2>) {
    refuse("the positions do not have the shape [frame][particle][2 or 3]",
           "give a file with two or three coordinates per particle");
  }
  frames_ = shape[0];
  count_ = shape[1];
  components_ = shape[2];
}

void H5mdReader::require(const std::string& name) const {
  if (has(name)) return;
  refuse("the particles of the group " + in_quotes(group_) + " have no " + name,
         "give a file with " + name +
             (name == "velocity" ? ", or draw velocities with --temperature" : ""));
}

bool H5mdReader::has(const std::string& name) const {
  return checked([&] { return particles_.nameExists(name); });
}

bool H5mdReader::is_sampled(const std::string& name, std::size_t frame) const {
  return checked(
      [&] { return has(name) && (!in_time(name) || sampled_row(name, frame).has_value()); });
}

bool H5mdReader::is_single(const std::string& name) const {
  return checked([&] {
    const H5::DataSet values = values_of(name);
    return values.getTypeClass() == H5T_FLOAT && values.getFloatType().getSize() <= sizeof(float);
  });
}

bool H5mdReader::in_time(const std::string& element) const {
  return is_group(particles_, element);
}

H5::DataSet H5mdReader::values_of(const std::string& element) const {
  if (!in_time(element)) return particles_.openDataSet(element);
  if (!particles_.openGroup(element).nameExists("value")) {
    refuse("the quantity " + in_quotes(element) + " has no value", "give a complete file");
  }
  return particles_.openDataSet(element + "/value");
}

// Throws unless a dataset has integers, or numbers of IEEE 754.
void H5mdReader::require_numbers(const H5::DataSet& dataset, const std::string& name) const {
  const bool names_types = name == "species" && dataset.getTypeClass() == H5T_ENUM;
  if (names_types || has_numbers(dataset)) return;
  refuse("the quantity " + in_quotes(name) + " has no numbers of IEEE 754",
         "give integers or numbers of single or double precision");
}

// The steps or times of all rows of an element: a list, or an increment of rows from an offset.
std::vector<double> H5mdReader::series(const std::string& element, const std::string& name) const {
  const H5::DataSet dataset = particles_.openDataSet(element + '/' + name);
  require_numbers(dataset, element + '/' + name);
  const std::vector<hsize_t> rows = shape_of(values_of(element)), shape = shape_of(dataset);
  const hsize_t count = rows.empty() ? 0 : rows[0];
  std::vector<double> series;
  if (shape.empty()) {
    const double offset =
        dataset.attrExists("offset") ? scalar_of(dataset.openAttribute("offset")) : 0.0;
    const double increment = scalar_of(dataset);
    for (hsize_t k = 0; k < count; ++k) {
      series.push_back(offset + static_cast<double>(k) * increment);
    }
    return series;
  }
  if (shape.size() != 1 || shape[0] != count) {
    refuse("the quantity " + in_quotes(element) + " has not one " + name + " for each of its " +
               counted(count, "row"),
           "give a complete file");
  }
  series.resize(count);
  if (count > 0) dataset.read(series.data(), H5::PredType::NATIVE_DOUBLE);
  return series;
}

const H5mdReader::Steps& H5mdReader::steps_of(const std::string& element) const {
  const auto known = steps_.find(element);
  if (known != steps_.end()) return known->second;
  if (!particles_.openGroup(element).nameExists("step")) {
    refuse("the quantity " + in_quotes(element) + " has no step", "give a complete file");
  }
  Steps steps = {.values = series(element, "step")};
  steps.increase =
      std::ranges::adjacent_find(steps.values, std::greater_equal()) == steps.values.end();
  steps.of_positions =
      element == "position" || (in_time("position") && steps.values == steps_of("position").values);
  return steps_[element] = steps;
}

double H5mdReader::step(std::size_t frame) const {
  return checked([&] { return in_time("position") ? steps_of("position").values[frame] : 0.0; });
}

double H5mdReader::time(std::size_t frame) const {
  return checked([&] {
    if (!in_time("position") || !particles_.openGroup("position").nameExists("time")) return 0.0;
    if (times_.empty()) times_ = series("position", "time");
    return times_[frame];
  });
}

// The row of an element at the step of a frame; absent: it was not sampled then.
std::optional<std::size_t> H5mdReader::sampled_row(const std::string& element,
                                                   std::size_t frame) const {
  const Steps& steps = steps_of(element);
  if (steps.of_positions) return frame;
  if (steps.values.size() == 1 && is_constant(element)) return 0;
  if (!in_time("position")) return std::nullopt;
  const Steps& wanted = steps_of("position");
  if (!steps.increase || !wanted.increase) {
    refuse("the steps of the quantity " + in_quotes(element) +
               " are not those of the positions, and do not increase",
           "give steps that increase");
  }
  const double step = wanted.values[frame];
  const auto row = std::ranges::lower_bound(steps.values, step);
  if (row == steps.values.end() || *row != step) return std::nullopt;
  return static_cast<std::size_t>(row - steps.values.begin());
}

std::size_t H5mdReader::row_at(const std::string& element, std::size_t frame) const {
  if (const auto row = sampled_row(element, frame)) return *row;
  std::string advice = "give a file whose quantities have the same steps";
  for (std::size_t k = frames_; k-- > 0;) {
    if (!sampled_row(element, k)) continue;
    advice = "give a frame that has it, as --frame " + std::to_string(k);
    break;
  }
  refuse("the quantity " + in_quotes(element) + " has no value at step " +
             number_text(step(frame)) + " of frame " + std::to_string(frame),
         advice);
}

// The size of a row of an element. Throws if it claims more numbers than a frame can have.
std::size_t H5mdReader::size_of(const std::string& element,
                                const std::vector<hsize_t>& shape) const {
  constexpr hsize_t kDeflate = 1032;  // makes no data smaller than this share
  const hsize_t most = std::min<hsize_t>(kDeflate * std::filesystem::file_size(path_),
                                         hsize_t{3} * kMaxParticles<2>);
  hsize_t size = 1;
  for (const hsize_t length : shape) {
    if (size > 0 && length > most / size) {
      refuse("the quantity " + in_quotes(element) + " is too large",
             "give a file with fewer particles");
    }
    size *= length;
  }
  return size;
}

// The numbers of an element at a frame, and their shape. An element is a dataset, or a group with a
// dataset `value` whose rows have steps.
std::vector<double> H5mdReader::read_row(const std::string& element, std::size_t frame,
                                         std::vector<hsize_t>& shape) const {
  const bool moves = in_time(element);
  const H5::DataSet dataset = values_of(element);
  shape = shape_of(dataset);
  std::vector<hsize_t> offset(shape.size(), 0), count = shape;
  if (moves) {
    if (shape.empty()) refuse("the quantity " + in_quotes(element) + " has no rows", "give rows");
    count[0] = 1;
    shape.erase(shape.begin());
  }
  require_numbers(dataset, element);
  std::vector<double> numbers(size_of(element, shape));
  if (moves) offset[0] = row_at(element, frame);
  if (numbers.empty()) return numbers;
  const H5::DataSpace file = dataset.getSpace();
  if (!count.empty()) file.selectHyperslab(H5S_SELECT_SET, count.data(), offset.data());
  const H5::DataSpace memory =
      count.empty() ? H5::DataSpace() : H5::DataSpace(static_cast<int>(count.size()), count.data());
  dataset.read(numbers.data(), H5::PredType::NATIVE_DOUBLE, memory, file);
  return numbers;
}

std::vector<double> H5mdReader::vectors(const std::string& name, std::size_t frame) const {
  require(name);
  return checked([&] {
    std::vector<hsize_t> shape;
    const std::vector<double> numbers = read_row(name, frame, shape);
    if (shape != std::vector<hsize_t>{count_, components_}) {
      refuse("the quantity " + in_quotes(name) + " has another shape than the positions",
             "give one vector per particle");
    }
    return numbers;
  });
}

std::vector<double> H5mdReader::numbers(const std::string& name, std::size_t frame) const {
  return checked([&] {
    std::vector<hsize_t> shape;
    const std::vector<double> numbers = read_row(name, frame, shape);
    if (shape != std::vector<hsize_t>{count_}) {
      refuse("the quantity " + in_quotes(name) + " has not one number per particle",
             "give as many numbers as positions");
    }
    return numbers;
  });
}

std::map<int, std::string> H5mdReader::species_names() const {
  return checked([&] {
    std::map<int, std::string> names;
    const H5::DataSet values = values_of("species");
    if (values.getTypeClass() != H5T_ENUM) return names;
    const H5::EnumType type = values.getEnumType();
    // A value has the integer type of the enumeration, and is converted in place.
    const H5::DataType integer = type.getSuper();
    for (int k = 0; k < type.getNmembers(); ++k) {
      std::vector<char> value(std::max(integer.getSize(), sizeof(int)));
      type.getMemberValue(static_cast<unsigned>(k), value.data());
      integer.convert(H5::PredType::NATIVE_INT, 1, value.data(), nullptr);
      int number = 0;
      std::memcpy(&number, value.data(), sizeof(number));
      char* const name = H5Tget_member_name(type.getId(), static_cast<unsigned>(k));
      if (name == nullptr) continue;
      names[number] = name;
      H5free_memory(name);
    }
    return names;
  });
}

std::vector<std::optional<double>> H5mdReader::ids(std::size_t frame) const {
  const std::vector<double> all = numbers("id", frame);
  return checked([&] {
    const H5::DSetCreatPropList list = values_of("id").getCreatePlist();
    std::optional<double> fill;
    if (list.isFillValueDefined() == H5D_FILL_VALUE_USER_DEFINED) {
      list.getFillValue(H5::PredType::NATIVE_DOUBLE, &fill.emplace());
    }
    std::vector<std::optional<double>> ids(all.begin(), all.end());
    for (std::optional<double>& id : ids) {
      if (id == fill) id.reset();
    }
    return ids;
  });
}

void H5mdReader::require_dimension() const {
  require("box");
  checked([&] {
    const H5::Group box = particles_.openGroup("box");
    std::vector<int> dimension;
    if (box.attrExists("dimension")) dimension = whole_numbers_of(box.openAttribute("dimension"));
    if (dimension == std::vector{static_cast<int>(components_)}) return;
    refuse(dimension.size() == 1 ? "the dimension of the box is " + std::to_string(dimension[0])
                                 : "the box has no whole number as its attribute dimension",
           "give " + std::to_string(components_) + ", the number of coordinates of a particle");
  });
}

double H5mdReader::tilt(std::size_t frame) const {
  return checked([&] {
    std::vector<hsize_t> shape;
    const std::vector<double> edges = read_row("box/edges", frame, shape);
    return edges.size() == 9 ? edges[3] : 0.0;
  });
}

std::vector<double> H5mdReader::box(std::size_t frame) const {
  return checked([&] {
    if (!particles_.openGroup("box").nameExists("edges")) {
      refuse("the box has no edges", "clatter needs walls, so give box/edges along every axis");
    }
    std::vector<hsize_t> shape;
    const std::vector<double> edges = read_row("box/edges", frame, shape);
    if (shape == std::vector<hsize_t>{components_}) return edges;
    if (shape != std::vector<hsize_t>{components_, components_}) {
      refuse("the box does not have the dimension of the positions",
             "give " + std::to_string(components_) + " edges");
    }
    ParticleBox box;
    for (std::size_t k = 0; k < components_; ++k) box.lengths[k] = edges[k * (components_ + 1)];
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (k % (components_ + 1) != 0 && is_tilt(edges[k], box)) refuse_tilt(path_);
    }
    return std::vector(box.lengths.begin(), box.lengths.begin() + components_);
  });
}

std::vector<bool> H5mdReader::periodic() const {
  return checked([&] {
    const H5::Group box = particles_.openGroup("box");
    if (!box.attrExists("boundary")) {
      refuse("the box has no attribute boundary", "give periodic or none for each axis");
    }
    const H5::Attribute boundary = box.openAttribute("boundary");
    if (boundary.getTypeClass() != H5T_STRING) {
      refuse("the attribute boundary of the box is no text", "give periodic or none for each axis");
    }
    const std::vector<std::string> texts = texts_of(boundary);
    if (texts.size() != components_) {
      refuse("the attribute boundary of the box has " + counted(texts.size(), "value") +
                 " instead of " + std::to_string(components_),
             "give one for each component of the positions");
    }
    std::vector<bool> periodic;
    for (const std::string& text : texts) {
      if (text != "periodic" && text != "none") {
        refuse("the boundary " + quoted_start(text) + " of the box is unknown",
               "give periodic or none for each axis");
      }
      periodic.push_back(text == "periodic");
    }
    return periodic;
  });
}

}  // namespace clatter
