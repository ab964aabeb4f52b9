#include "app/results/trajectory_file.h"

#include "app/results/gsd_trajectory.h"
#include "app/results/h5md_trajectory.h"
#include "engine/system/growing_file.h"

namespace clatter {

namespace {

template <int D>
class TextTrajectory final : public TrajectoryFile<D> {
 public:
  TextTrajectory(const std::filesystem::path& path, TrajectoryFormat format, bool spins,
                 std::uint64_t bytes)
      : format_(format), file_(path, bytes) {
    if (bytes == 0) file_.append(header_text<D>(format, spins));
  }

  void add(const TrajectoryFrame<D>& frame) override { file_.append(frame_text(frame, format_)); }
  std::uint64_t bytes() const override { return file_.bytes(); }
  void sync() override { file_.sync(); }
  void finish() override { file_.close(); }

 private:
  TrajectoryFormat format_;
  GrowingFile file_;
};

}  // namespace

std::filesystem::path frames_path(const std::filesystem::path& trajectory,
                                  TrajectoryFormat format) {
  if (format != TrajectoryFormat::H5md) return trajectory;
  return trajectory.string() + ".records";
}

template <int D>
std::unique_ptr<TrajectoryFile<D>> open_trajectory(const std::filesystem::path& path,
                                                   TrajectoryFormat format, const Model<D>& model,
                                                   std::size_t particles, bool spins,
                                                   std::uint64_t bytes) {
  if (format == TrajectoryFormat::Gsd) {
    return std::make_unique<GsdTrajectory<D>>(path, particles, spins, bytes);
  }
  if (format == TrajectoryFormat::H5md) {
    return std::make_unique<H5mdTrajectory<D>>(path, model, particles, spins, bytes);
  }
  return std::make_unique<TextTrajectory<D>>(path, format, spins, bytes);
}

template std::unique_ptr<TrajectoryFile<2>> open_trajectory(const std::filesystem::path&,
                                                            TrajectoryFormat, const Model<2>&,
                                                            std::size_t, bool, std::uint64_t);
template std::unique_ptr<TrajectoryFile<3>> open_trajectory(const std::filesystem::path&,
                                                            TrajectoryFormat, const Model<3>&,
                                                            std::size_t, bool, std::uint64_t);

}  // namespace clatter
