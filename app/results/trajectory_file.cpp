#include "app/results/trajectory_file.h"

#include "app/results/gsd_trajectory.h"
#include "app/results/h5md_trajectory.h"
#include "app/results/vtp_trajectory.h"
#include "engine/system/growing_file.h"

namespace clatter {

namespace {

template <int D>
class TextTrajectory final : public TrajectoryFile<D> {
 public:
  TextTrajectory(const std::filesystem::path& path, TrajectoryFormat format,
                 const TrajectoryParticles& particles, std::uint64_t bytes)
      : format_(format), file_(path, bytes) {
    if (bytes == 0) file_.append(header_text<D>(format, particles));
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
  if (format == TrajectoryFormat::H5md) return trajectory.string() + ".records";
  if (format == TrajectoryFormat::Vtp) return trajectory.string() + ".series";
  return trajectory;
}

template <int D>
std::unique_ptr<TrajectoryFile<D>> open_trajectory(const std::filesystem::path& path,
                                                   TrajectoryFormat format, const Model<D>& model,
                                                   const TrajectoryParticles& particles,
                                                   std::uint64_t bytes) {
  if (format == TrajectoryFormat::Gsd) {
    return std::make_unique<GsdTrajectory<D>>(path, particles, bytes);
  }
  if (format == TrajectoryFormat::H5md) {
    return std::make_unique<H5mdTrajectory<D>>(path, model, particles, bytes);
  }
  if (format == TrajectoryFormat::Vtp) {
    return std::make_unique<VtpTrajectory<D>>(path, bytes);
  }
  return std::make_unique<TextTrajectory<D>>(path, format, particles, bytes);
}

template std::unique_ptr<TrajectoryFile<2>> open_trajectory(const std::filesystem::path&,
                                                            TrajectoryFormat, const Model<2>&,
                                                            const TrajectoryParticles&,
                                                            std::uint64_t);
template std::unique_ptr<TrajectoryFile<3>> open_trajectory(const std::filesystem::path&,
                                                            TrajectoryFormat, const Model<3>&,
                                                            const TrajectoryParticles&,
                                                            std::uint64_t);

}  // namespace clatter
