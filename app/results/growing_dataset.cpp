#include "app/results/growing_dataset.h"

#include <algorithm>

namespace clatter {

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
