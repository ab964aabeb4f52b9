#include "app/results/hdf5_writer.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <system_error>

#include "engine/error.h"
#include "engine/system/write_file.h"

namespace clatter {

H5::StrType text_type() {
  H5::StrType type(H5::PredType::C_S1, H5T_VARIABLE);
  type.setCset(H5T_CSET_UTF8);
  return type;
}

H5::DataSpace space_of(const Hdf5Shape& shape) {
  return H5::DataSpace(static_cast<int>(shape.size()), shape.data());
}

H5::DSetCreatPropList dataset_properties() {
  H5::DSetCreatPropList list;
  H5Pset_obj_track_times(list.getId(), false);
  return list;
}

void write_text(const H5::H5Object& object, const std::string& name, const std::string& text) {
  const char* bytes = text.c_str();
  object.createAttribute(name, text_type(), H5::DataSpace()).write(text_type(), &bytes);
}

void write_texts(const H5::H5Object& object, const std::string& name,
                 const std::vector<std::string>& texts) {
  std::vector<const char*> bytes;
  for (const std::string& text : texts) bytes.push_back(text.c_str());
  const H5::Attribute attribute =
      object.createAttribute(name, text_type(), space_of({texts.size()}));
  if (!texts.empty()) attribute.write(text_type(), bytes.data());
}

void write_dataset(const H5::Group& group, const std::string& name, const std::string& unit,
                   const std::vector<double>& values, const Hdf5Shape& shape) {
  const H5::DataSet dataset =
      group.createDataSet(name, H5::PredType::NATIVE_DOUBLE, space_of(shape), dataset_properties());
  if (!values.empty()) dataset.write(values.data(), H5::PredType::NATIVE_DOUBLE);
  if (!unit.empty()) write_text(dataset, "units", unit);
}

void write_dataset(const H5::Group& group, const std::string& name, const std::string& unit,
                   const std::vector<double>& values) {
  write_dataset(group, name, unit, values, {values.size()});
}

void write_grains(const H5::Group& group, const std::vector<std::string>& names,
                  const std::vector<Grain>& grains, const std::string& unit_of_mass,
                  const std::string& unit_of_length) {
  std::vector<double> masses, diameters;
  std::vector<std::int32_t> species;
  for (const Grain& grain : grains) {
    masses.push_back(grain.mass);
    diameters.push_back(2.0 * grain.radius);
    species.push_back(static_cast<std::int32_t>(grain.species));
  }
  write_dataset(group, "mass", unit_of_mass, masses);
  write_dataset(group, "diameter", unit_of_length, diameters);
  H5::EnumType type(H5::PredType::NATIVE_INT32);
  for (std::size_t k = 0; k < names.size(); ++k) {
    auto number = static_cast<std::int32_t>(k);
    type.insert(names[k], &number);
  }
  const H5::DataSet dataset =
      group.createDataSet("species", type, space_of({species.size()}), dataset_properties());
  if (!species.empty()) dataset.write(species.data(), type);
}

// Files in the oldest format of each object: all readers know it, and groups have no time of
// writing. From HDF5 2.0 on, the library takes the format of version 1.8 without these bounds.
static H5::FileAccPropList oldest_format() {
  H5::FileAccPropList list;
  list.setLibverBounds(H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  return list;
}

// The bytes of the file.
static std::string image_of(const std::function<void(const H5::H5File&)>& fill) {
  constexpr std::size_t kGrowth = std::size_t{1} << 20;
  H5::FileAccPropList in_memory = oldest_format();
  in_memory.setCore(kGrowth, false);
  H5::H5File file("measurement", H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, in_memory);
  fill(file);
  file.flush(H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(file.getId(), nullptr, 0);
  std::string image(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
  if (H5Fget_file_image(file.getId(), image.data(), image.size()) != size || size <= 0) {
    throw H5::FileIException("H5Fget_file_image", "no image");
  }
  return image;
}

void write_hdf5(const std::filesystem::path& path,
                const std::function<void(const H5::H5File&)>& fill) {
  try {
    H5::Exception::dontPrint();
    write_file(path, image_of(fill));
  } catch (const H5::Exception& error) {
    throw RunError("cannot make " + path.string() + ": " + error.getDetailMsg());
  }
}

// HDF5 itself crashes if a disk is full. Chunks and their index take little more space than the
// numbers.
static bool reserve(NewFile& made, std::uint64_t numbers) {
  constexpr std::uint64_t kHeads = std::uint64_t{1} << 20;
  return made.file.reserve(numbers + numbers / 64 + kHeads);
}

void write_large_hdf5(const std::filesystem::path& path, std::uint64_t numbers,
                      const std::function<void(const H5::H5File&)>& fill) {
  const std::filesystem::path target = target_of(path);
  NewFile made = new_file_beside(target);
  if (!made.file) throw RunError("cannot write " + path.string() + ": " + std::strerror(errno));
  std::error_code ignored;
  if (!reserve(made, numbers)) {
    const int error = errno;
    std::filesystem::remove(made.path, ignored);
    throw RunError("cannot write " + path.string() + ": " + std::strerror(error));
  }
  try {
    H5::Exception::dontPrint();
    H5::FileAccPropList access = oldest_format();
    H5Pset_file_locking(access.getId(), false, true);  // `made` has the lock
    H5::H5File file(made.path.string(), H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, access);
    fill(file);
    file.close();
    rename_synced(made.path, target);
  } catch (const H5::Exception& error) {
    std::filesystem::remove(made.path, ignored);
    throw RunError("cannot write " + path.string() + ": " + error.getDetailMsg());
  } catch (const RunError&) {
    std::filesystem::remove(made.path, ignored);
    throw;
  }
}

GrowingDataset::GrowingDataset(const H5::Group& group, const std::string& name,
                               const H5::DataType& type, const Hdf5Shape& row,
                               const Hdf5Shape& chunk)
    : shape_(row) {
  Hdf5Shape most = row;
  shape_.insert(shape_.begin(), 0);
  std::ranges::replace(most, hsize_t{0}, H5S_UNLIMITED);  // HDF5 has no chunks of no numbers
  most.insert(most.begin(), H5S_UNLIMITED);
  H5::DSetCreatPropList list = dataset_properties();
  list.setChunk(static_cast<int>(chunk.size()), chunk.data());
  list.setShuffle();
  list.setDeflate(1);
  const H5::DataSpace space(static_cast<int>(shape_.size()), shape_.data(), most.data());
  dataset_ = group.createDataSet(name, type, space, list);
}

void GrowingDataset::append(const double* numbers, hsize_t rows) {
  Hdf5Shape offset(shape_.size(), 0), added = shape_;
  offset[0] = shape_[0];
  added[0] = rows;
  shape_[0] += rows;
  dataset_.extend(shape_.data());
  const H5::DataSpace memory = space_of(added), file = dataset_.getSpace();
  if (memory.getSimpleExtentNpoints() == 0) return;
  file.selectHyperslab(H5S_SELECT_SET, added.data(), offset.data());
  dataset_.write(numbers, H5::PredType::NATIVE_DOUBLE, memory, file);
}

}  // namespace clatter
