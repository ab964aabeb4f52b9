#pragma once

#include <H5Cpp.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/physics/grain.h"

namespace clatter {

using Hdf5Shape = std::vector<hsize_t>;

/// Text in UTF-8, of any length.
H5::StrType text_type();

/// A data space of this shape.
H5::DataSpace space_of(const Hdf5Shape& shape);

/// The properties of a dataset without the time of the writing: equal results have equal bytes.
H5::DSetCreatPropList dataset_properties();

/// Writes a text as an attribute.
void write_text(const H5::H5Object& object, const std::string& name, const std::string& text);

/// Writes a list of texts as an attribute.
void write_texts(const H5::H5Object& object, const std::string& name,
                 const std::vector<std::string>& texts);

/// Writes numbers as a dataset of this shape, with the attribute "units" unless `unit` is empty.
void write_dataset(const H5::Group& group, const std::string& name, const std::string& unit,
                   const std::vector<double>& values, const Hdf5Shape& shape);
/// Writes a list of numbers.
void write_dataset(const H5::Group& group, const std::string& name, const std::string& unit,
                   const std::vector<double>& values);

/// Writes what the particles of a mixture are, once: the datasets mass, diameter and species, a
/// number for each particle. That of the species is an enumeration of `names`, from 0. An empty
/// unit is not written.
void write_grains(const H5::Group& group, const std::vector<std::string>& names,
                  const std::vector<Grain>& grains, const std::string& unit_of_mass,
                  const std::string& unit_of_length);

/// Writes an HDF5 file, completely or not at all: `fill` fills it in memory. Throws RunError.
void write_hdf5(const std::filesystem::path& path,
                const std::function<void(const H5::H5File&)>& fill);

/// Writes an HDF5 file that may be larger than the memory, completely or not at all: `fill` fills
/// it on the disk. `numbers` is the size of its numbers before the compression, in bytes. Throws
/// RunError, also if the disk has less space than this.
void write_large_hdf5(const std::filesystem::path& path, std::uint64_t numbers,
                      const std::function<void(const H5::H5File&)>& fill);

/// A compressed dataset of an HDF5 file that grows by rows.
class GrowingDataset {
 public:
  /// Makes a dataset without rows. `row` is the shape of a row; empty: a number. `chunk` is the
  /// shape of a chunk, rows first.
  GrowingDataset(const H5::Group& group, const std::string& name, const H5::DataType& type,
                 const Hdf5Shape& row, const Hdf5Shape& chunk);

  /// The dataset, for attributes.
  const H5::DataSet& dataset() const { return dataset_; }
  /// Appends rows, given as consecutive numbers.
  void append(const double* numbers, hsize_t rows);

 private:
  Hdf5Shape shape_;
  H5::DataSet dataset_;
};

}  // namespace clatter
