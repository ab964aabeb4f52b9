#include "app/results/h5md_reader.h"

#include <algorithm>

#include "engine/error.h"
#include "engine/physics/state.h"

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

H5mdReader::H5mdReader(const std::filesystem::path& path) : path_(path) {
  H5::Exception::dontPrint();
  checked([&] {
    file_ = H5::H5File(path.string(), H5F_ACC_RDONLY);
    const H5::Group root = file_.openGroup("/");
    if (!is_group(root, "particles")) {
      refuse("the file has no group \"particles\"", "give a trajectory in H5MD");
    }
    const H5::Group all = root.openGroup("particles");
    if (all.getNumObjs() == 0) refuse("the group \"particles\" is empty", "give another file");
    particles_ = all.openGroup(all.getObjnameByIdx(0));
    if (!is_group(particles_, "position") ||
        !particles_.openGroup("position").nameExists("value")) {
      refuse("the particles have no positions that depend on time",
             "give a file with position/value");
    }
    const std::vector<hsize_t> shape = shape_of(particles_.openDataSet("position/value"));
    if (shape.size() != 3 || shape[2] < 2 || shape[2] > 3 || shape[1] > kMaxParticles<2>) {
      refuse("the positions do not have the shape [frame][particle][2 or 3]",
             "give a file with two or three coordinates per particle");
    }
    frames_ = shape[0];
    count_ = shape[1];
    components_ = shape[2];
  });
}

bool H5mdReader::has(const std::string& name) const {
  return checked([&] { return particles_.nameExists(name); });
}

// The numbers of an element at a frame, and their shape. An element is a dataset, or a group with a
// dataset `value` whose rows are the frames.
std::vector<double> H5mdReader::row_of(const std::string& element, std::size_t frame,
                                       std::vector<hsize_t>& shape) const {
  return checked([&] {
    const bool in_time = is_group(particles_, element);
    const H5::DataSet dataset = particles_.openDataSet(in_time ? element + "/value" : element);
    shape = shape_of(dataset);
    if (in_time && (shape.empty() || frame >= shape[0])) {
      refuse("the quantity \"" + element + "\" has no frame " + std::to_string(frame),
             "give a complete file");
    }
    std::vector<hsize_t> offset(shape.size(), 0), count = shape;
    if (in_time) {
      offset[0] = frame;
      count[0] = 1;
      shape.erase(shape.begin());
    }
    // Deflate makes no data smaller than a thousandth.
    constexpr hsize_t kDeflate = 1032;
    const hsize_t most = std::min<hsize_t>(kDeflate * std::filesystem::file_size(path_),
                                           hsize_t{3} * kMaxParticles<2>);
    hsize_t size = 1;
    for (const hsize_t length : shape) size = length > most ? most + 1 : size * length;
    if (size > most) refuse("the quantity \"" + element + "\" is too large", "give another file");
    std::vector<double> numbers(size);
    if (numbers.empty()) return numbers;
    const H5::DataSpace file = dataset.getSpace();
    if (!count.empty()) file.selectHyperslab(H5S_SELECT_SET, count.data(), offset.data());
    const H5::DataSpace memory = count.empty()
                                     ? H5::DataSpace()
                                     : H5::DataSpace(static_cast<int>(count.size()), count.data());
    dataset.read(numbers.data(), H5::PredType::NATIVE_DOUBLE, memory, file);
    return numbers;
  });
}

// A number of a frame: from a list, or an increment of frames from an offset.
double H5mdReader::number(const std::string& name, std::size_t frame) const {
  return checked([&] {
    const H5::Group position = particles_.openGroup("position");
    if (!position.nameExists(name)) return 0.0;
    const H5::DataSet dataset = position.openDataSet(name);
    const std::vector<hsize_t> shape = shape_of(dataset);
    double number = 0.0;
    if (shape.empty()) {
      double offset = 0.0;
      dataset.read(&number, H5::PredType::NATIVE_DOUBLE);
      if (dataset.attrExists("offset")) {
        dataset.openAttribute("offset").read(H5::PredType::NATIVE_DOUBLE, &offset);
      }
      return offset + static_cast<double>(frame) * number;
    }
    if (shape.size() != 1 || frame >= shape[0]) {
      refuse("the positions lack the " + name + " of frame " + std::to_string(frame),
             "give a complete file");
    }
    const hsize_t offset = frame, count = 1;
    const H5::DataSpace file = dataset.getSpace();
    file.selectHyperslab(H5S_SELECT_SET, &count, &offset);
    dataset.read(&number, H5::PredType::NATIVE_DOUBLE, H5::DataSpace(1, &count), file);
    return number;
  });
}

std::vector<double> H5mdReader::vectors(const std::string& name, std::size_t frame) const {
  if (!has(name)) refuse("the particles have no quantity \"" + name + "\"", "give another file");
  std::vector<hsize_t> shape;
  std::vector<double> numbers = row_of(name, frame, shape);
  if (shape != std::vector<hsize_t>{count_, components_}) {
    refuse("the quantity \"" + name + "\" has another shape than the positions",
           "give one vector per particle");
  }
  return numbers;
}

std::vector<double> H5mdReader::numbers(const std::string& name, std::size_t frame) const {
  std::vector<hsize_t> shape;
  std::vector<double> numbers = row_of(name, frame, shape);
  if (numbers.size() != count_) {
    refuse("the quantity \"" + name + "\" has not one number per particle", "give another file");
  }
  return numbers;
}

std::vector<double> H5mdReader::box(std::size_t frame) const {
  if (!has("box") || !checked([&] { return particles_.openGroup("box").nameExists("edges"); })) {
    refuse("the box has no edges", "give a file with box/edges");
  }
  std::vector<hsize_t> shape;
  const std::vector<double> edges = row_of("box/edges", frame, shape);
  if (edges.size() == components_) return edges;
  if (edges.size() != components_ * components_) {
    refuse("the box does not have the dimension of the positions", "give another file");
  }
  std::vector<double> lengths;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (k % (components_ + 1) == 0) {
      lengths.push_back(edges[k]);
    } else if (edges[k] != 0.0) {
      refuse("the box is tilted", "give a file with a rectangular box");
    }
  }
  return lengths;
}

std::vector<bool> H5mdReader::periodic() const {
  return checked([&] {
    const H5::Attribute attribute = particles_.openGroup("box").openAttribute("boundary");
    const hssize_t count = attribute.getSpace().getSimpleExtentNpoints();
    if (count != static_cast<hssize_t>(components_)) {
      refuse("the box does not have the dimension of the positions", "give another file");
    }
    const H5::StrType type = attribute.getStrType();
    std::vector<bool> periodic;
    if (type.isVariableStr()) {
      std::vector<char*> texts(components_, nullptr);
      attribute.read(type, texts.data());
      for (char* text : texts) {
        periodic.push_back(text != nullptr && std::string(text) == "periodic");
      }
      H5::DataSet::vlenReclaim(texts.data(), type, attribute.getSpace());
      return periodic;
    }
    std::string texts(components_ * type.getSize(), '\0');
    attribute.read(type, texts.data());
    for (std::size_t axis = 0; axis < components_; ++axis) {
      periodic.push_back(texts.substr(axis * type.getSize()).starts_with("periodic"));
    }
    return periodic;
  });
}

}  // namespace clatter
