#pragma once

#include <H5Cpp.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace clatter {

/// Reads a group of particles of an H5MD file, version 1: https://www.nongnu.org/h5md/h5md.html.
/// The frames are those of the positions. Other quantities are looked up at the step of a frame.
/// Every function throws UserError if the file lacks the quantity or is damaged.
class H5mdReader {
 public:
  /// Opens a group of particles; empty: the only one.
  explicit H5mdReader(const std::filesystem::path& path, const std::string& group = "");

  /// Number of frames of the positions.
  std::size_t frames() const { return frames_; }
  /// Components of the positions: 2 or 3.
  std::size_t components() const { return components_; }
  /// Whether the particles have a quantity.
  bool has(const std::string& name) const;
  /// Whether the particles have a quantity that was sampled at the step of a frame.
  bool is_sampled(const std::string& name, std::size_t frame) const;
  /// Whether a quantity has single precision.
  bool is_single(const std::string& name) const;
  /// Number of a frame in the run that wrote it; 0 if the positions do not depend on time.
  double step(std::size_t frame) const;
  /// Time of a frame; 0 if the file has no times.
  double time(std::size_t frame) const;
  /// Consecutive vectors of all particles, with components() numbers each.
  std::vector<double> vectors(const std::string& name, std::size_t frame) const;
  /// A number of each particle.
  std::vector<double> numbers(const std::string& name, std::size_t frame) const;
  /// The names of the types in the quantity species, by number; empty: it has no names.
  std::map<int, std::string> species_names() const;
  /// The identifiers of all particles of a frame; absent: a place without a particle.
  std::vector<std::optional<double>> ids(std::size_t frame) const;
  /// Throws unless the box has as many dimensions as the positions have components.
  void require_dimension() const;
  /// The x component of the edge along y of a box in three dimensions; 0 without edge vectors.
  double tilt(std::size_t frame) const;
  /// Edge lengths of a box without tilt.
  std::vector<double> box(std::size_t frame) const;
  /// Whether each axis of the box is periodic.
  std::vector<bool> periodic() const;

 private:
  // The steps of the rows of an element that depends on time.
  struct Steps {
    std::vector<double> values;
    bool increase = false;      // whether each step is larger than the one before
    bool of_positions = false;  // whether the positions have the same steps
  };

  void open_group(const std::string& wanted);
  void read_shape();
  void require(const std::string& name) const;
  void require_version() const;
  bool in_time(const std::string& element) const;
  H5::DataSet values_of(const std::string& element) const;
  void require_numbers(const H5::DataSet& dataset, const std::string& name) const;
  std::vector<double> series(const std::string& element, const std::string& name) const;
  const Steps& steps_of(const std::string& element) const;
  std::optional<std::size_t> sampled_row(const std::string& element, std::size_t frame) const;
  std::size_t row_at(const std::string& element, std::size_t frame) const;
  std::vector<double> read_row(const std::string& element, std::size_t frame,
                               std::vector<hsize_t>& shape) const;
  std::size_t size_of(const std::string& element, const std::vector<hsize_t>& shape) const;
  template <class Read>
  auto checked(const Read& read) const;
  [[noreturn]] void refuse(const std::string& problem, const std::string& advice) const;

  std::filesystem::path path_;
  H5::H5File file_;
  H5::Group particles_;
  std::string group_;
  std::size_t frames_ = 0;
  std::size_t count_ = 0;
  std::size_t components_ = 0;
  mutable std::map<std::string, Steps> steps_;  // that have been read
  mutable std::vector<double> times_;           // of the positions, or not read
};

}  // namespace clatter
