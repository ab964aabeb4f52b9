#pragma once

#include <string>

#include "app/results/hdf5_writer.h"

namespace clatter {

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
