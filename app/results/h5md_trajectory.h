#pragma once

#include <string>

#include "app/results/trajectory_file.h"
#include "engine/system/growing_file.h"

namespace clatter {

/// A trajectory in the H5MD structure, version 1.1, with exact numbers. Frames are collected in
/// FILE.records until the trajectory is complete.
template <int D>
class H5mdTrajectory final : public TrajectoryFile<D> {
 public:
  /// See open_trajectory(). A complete file is continued, too.
  H5mdTrajectory(const std::filesystem::path& path, const Model<D>& model,
                 TrajectoryParticles particles, std::uint64_t bytes);

  void add(const TrajectoryFrame<D>& frame) override;
  std::uint64_t bytes() const override { return records_->bytes(); }
  void sync() override { records_->sync(); }
  void finish() override;

 private:
  std::filesystem::path path_;
  Model<D> model_;
  TrajectoryParticles particles_;
  std::optional<GrowingFile> records_;
};

extern template class H5mdTrajectory<2>;
extern template class H5mdTrajectory<3>;

}  // namespace clatter
