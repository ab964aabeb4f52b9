#pragma once

#include <H5Cpp.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace clatter {

/// Reads the first group of particles of an H5MD file. Every function throws UserError if the file
/// lacks the quantity or is damaged.
class H5mdReader {
 public:
  explicit H5mdReader(const std::filesystem::path& path);

  /// Number of frames of the positions.
  std::size_t frames() const { return frames_; }
  /// Components of the positions: 2 or 3.
  std::size_t components() const { return components_; }
  /// Whether the particles have a quantity.
  bool has(const std::string& name) const;
  /// Number of a frame in the run that wrote it; 0 if the file has no steps.
  double step(std::size_t frame) const { return number("step", frame); }
  /// Time of a frame; 0 if the file has no times.
  double time(std::size_t frame) const { return number("time", frame); }
  /// Consecutive vectors of all particles, with components() numbers each.
  std::vector<double> vectors(const std::string& name, std::size_t frame) const;
  /// A number of each particle.
  std::vector<double> numbers(const std::string& name, std::size_t frame) const;
  /// Edge lengths of a box without tilt.
  std::vector<double> box(std::size_t frame) const;
  /// Whether each axis of the box is periodic.
  std::vector<bool> periodic() const;

 private:
  double number(const std::string& name, std::size_t frame) const;
  std::vector<double> row_of(const std::string& element, std::size_t frame,
                             std::vector<hsize_t>& shape) const;
  template <class Read>
  auto checked(const Read& read) const;
  [[noreturn]] void refuse(const std::string& problem, const std::string& advice) const;

  std::filesystem::path path_;
  H5::H5File file_;
  H5::Group particles_;
  std::size_t frames_ = 0;
  std::size_t count_ = 0;
  std::size_t components_ = 0;
};

}  // namespace clatter
