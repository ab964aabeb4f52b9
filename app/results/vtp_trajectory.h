#pragma once

#include <string>

#include "app/results/trajectory_file.h"
#include "engine/system/growing_file.h"

namespace clatter {

/// A frame as a file of VTK PolyData: a point with a vertex for each particle, and the arrays
/// diameter, velocity, image, mass, spin where particles spin, and species in a mixture. Its
/// numbers are exact.
template <int D>
std::string vtp_text(const TrajectoryFrame<D>& frame);

/// A trajectory as files of VTK PolyData. FILE.vtp has the frames FILE_000000.vtp, FILE_000001.vtp
/// and so on, and their list FILE.vtp.series, which ParaView opens. Of the two kinds of lists this
/// one shows, between two listed times, the earlier frame: a state of the gas that has been.
template <int D>
class VtpTrajectory final : public TrajectoryFile<D> {
 public:
  /// See open_trajectory(). A new trajectory removes the frames of an earlier list.
  VtpTrajectory(const std::filesystem::path& path, std::uint64_t bytes);

  void add(const TrajectoryFrame<D>& frame) override;
  std::uint64_t bytes() const override { return bytes_; }
  void sync() override { list_->sync(); }
  void finish() override { list_->close(); }

 private:
  std::filesystem::path frame_path(long number) const;
  void remove_frames() const;

  std::filesystem::path path_;
  std::optional<GrowingFile> list_;
  std::uint64_t bytes_;  // of the list, without its end
};

extern template class VtpTrajectory<2>;
extern template class VtpTrajectory<3>;

}  // namespace clatter
