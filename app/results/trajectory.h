#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/dynamics/model.h"
#include "engine/physics/state.h"
#include "engine/system/file_descriptor.h"

namespace clatter {

/// Text format of a trajectory. Its numbers read back to exactly the same bits.
enum class TrajectoryFormat {
  ExtXyz,      ///< extended XYZ: .xyz and .extxyz
  LammpsDump,  ///< text dump of LAMMPS: .lammpstrj and .dump
  Csv          ///< one line per particle and frame: .csv
};

/// The format of a file extension. Throws UserError that names `flag` for other extensions, and for
/// a device or a pipe, which cannot be continued.
TrajectoryFormat trajectory_format(const std::filesystem::path& file, const char* flag);

/// The exact state of a gas at one time.
template <int D>
struct TrajectoryFrame {
  long number = 0;    ///< from 0
  double time = 0.0;  ///< simulation time
  const Model<D>& model;
  State<D> state;
  std::vector<IntVec<D>> images;  ///< [N] periodic images, see PeriodicImages
};

/// The text before the first frame. `spins`: whether the particles have spins.
template <int D>
std::string header_text(TrajectoryFormat format, bool spins);

/// The text of a frame, with spins unless the state has none. Formats for three dimensions have
/// disks at z = 0, with angular velocities along z.
template <int D>
std::string frame_text(const TrajectoryFrame<D>& frame, TrajectoryFormat format);

/// An open trajectory file. It is written in place: it has the complete frames so far during the
/// run.
class TrajectoryFile {
 public:
  /// Opens a file with the first `bytes` bytes of its content. Throws UserError if it has fewer,
  /// and RunError if it cannot be written.
  TrajectoryFile(std::filesystem::path path, std::uint64_t bytes);

  /// Size of the complete frames.
  std::uint64_t bytes() const { return bytes_; }
  /// Appends the text of a frame. Throws RunError.
  void append(const std::string& text);
  /// Waits until the frames are on the disk. Throws RunError. After a failure every later call
  /// throws, because the system reports a lost frame once.
  void sync();
  /// Ends the file with the frames on the disk. Throws RunError.
  void close();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  FileDescriptor file_;
  std::uint64_t bytes_;
  int lost_ = 0;  // error of a failed sync; 0: none
};

}  // namespace clatter
