#pragma once

#include "app/results/gsd_file.h"
#include "app/results/trajectory_file.h"

namespace clatter {

/// A trajectory in the schema of HOOMD-blue. Its quantities have single precision, and positions
/// are relative to the centre of the box. Chunks log/... have the exact numbers.
template <int D>
class GsdTrajectory final : public TrajectoryFile<D> {
 public:
  /// See open_trajectory().
  GsdTrajectory(const std::filesystem::path& path, TrajectoryParticles particles,
                std::uint64_t bytes);

  void add(const TrajectoryFrame<D>& frame) override;
  std::uint64_t bytes() const override { return file_.bytes(); }
  void sync() override { file_.sync(); }
  void finish() override { file_.close(); }

 private:
  TrajectoryParticles particles_;
  GsdFile file_;
};

extern template class GsdTrajectory<2>;
extern template class GsdTrajectory<3>;

}  // namespace clatter
