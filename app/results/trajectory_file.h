#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "app/results/trajectory.h"

namespace clatter {

/// A trajectory file that grows with a run.
template <int D>
class TrajectoryFile {
 public:
  virtual ~TrajectoryFile() = default;

  /// Appends a frame. Throws RunError.
  virtual void add(const TrajectoryFrame<D>& frame) = 0;
  /// Size of the complete frames, from which the file can be continued.
  virtual std::uint64_t bytes() const = 0;
  /// Waits until the frames are on the disk. Throws RunError, see GrowingFile.
  virtual void sync() = 0;
  /// Completes the file, with all frames on the disk. Throws RunError; sync() is then still
  /// possible.
  virtual void finish() = 0;
};

/// The file that collects the frames of a trajectory during the run: FILE.h5md.records,
/// FILE.vtp.series, or the trajectory itself.
std::filesystem::path frames_path(const std::filesystem::path& trajectory, TrajectoryFormat format);

/// Opens a trajectory of particles in the box of the model, with the first `bytes` bytes of its
/// frames; 0: a new file. Throws UserError if the file has fewer bytes, and RunError if it cannot
/// be written.
template <int D>
std::unique_ptr<TrajectoryFile<D>> open_trajectory(const std::filesystem::path& path,
                                                   TrajectoryFormat format, const Model<D>& model,
                                                   const TrajectoryParticles& particles,
                                                   std::uint64_t bytes);

}  // namespace clatter
