#include "app/import/frame_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "app/import/binary_frames.h"
#include "app/import/frame_species.h"
#include "app/import/gzip.h"
#include "app/import/text_frames.h"
#include "app/results/trajectory.h"
#include "engine/error.h"
#include "engine/physics/state.h"
#include "engine/text.h"

namespace clatter {

namespace {

// The name without the extension of gzip.
std::filesystem::path uncompressed_name(const std::filesystem::path& path) {
  return path.extension() == ".gz" ? path.parent_path() / path.stem() : path;
}

// LAMMPS names its data files data.NAME, other programs NAME.data. Names such as data.csv are those
// of trajectories.
bool is_data_file(const std::filesystem::path& path) {
  const std::filesystem::path name = uncompressed_name(path);
  const std::string extension = name.extension();
  return extension == ".data" || extension == ".lmp" ||
         (name.filename().string().starts_with("data.") && !find_trajectory_format(name));
}

// Whether a name is that of a list of files of VTK: FILE.vtp.series or FILE.pvd.
bool is_vtp_series(const std::filesystem::path& path) {
  const std::string extension = path.extension();
  return extension == ".pvd" || (extension == ".series" && path.stem().extension() == ".vtp");
}

bool is_binary(TrajectoryFormat format) {
  return format == TrajectoryFormat::Gsd || format == TrajectoryFormat::H5md ||
         format == TrajectoryFormat::Vtp;
}

void require_bounded_images(const ParticleFrame& frame, const std::filesystem::path& path) {
  for (std::size_t i = 0; i < frame.images.size(); ++i) {
    for (const double boxes : frame.images[i]) {
      if (std::fabs(boxes) <= std::numeric_limits<int>::max() && std::floor(boxes) == boxes)
        continue;
      refuse_particle(frame, i, path, "a periodic image is no whole number of 32 bits",
                      "give a file with smaller images");
    }
  }
}

void require_finite(const ParticleFrame& frame, const std::vector<ParticleFrame::Vector>& vectors,
                    const std::string& quantity, const std::filesystem::path& path) {
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    if (std::ranges::all_of(vectors[i], [](double x) { return std::isfinite(x); })) continue;
    refuse_particle(frame, i, path, "the " + quantity + " is not finite",
                    "give another frame with --frame");
  }
}

// Throws unless the box has room for the largest particle.
void require_room(const ParticleFrame& frame, const std::filesystem::path& path) {
  for (int axis = 0; frame.box && axis < 3; ++axis) {
    const double length = frame.box->lengths[axis];
    const bool flat = axis >= frame.dimension && length == 0.0;
    if (!(length > 0.0 || flat) || !std::isfinite(length)) {
      throw UserError(
          {path.string(), frame.box->lines[axis]},
          std::string("the edge of the box along ") + "xyz"[axis] + " is " + number_text(length),
          "give a positive number");
    }
    if (length > frame.largest_diameter() || axis >= frame.dimension) continue;
    const std::string extent = number_text(length) + " along " + "xyz"[axis];
    if (axis == 2) {
      const std::string problem = "the box is " + extent + ", too thin for spheres";
      const std::string advice = "give a deeper box, or disks that move in one plane z";
      const auto out = first_out_of_plane(frame, 1.0);
      if (!out) throw UserError({path.string(), frame.box->lines[axis]}, problem, advice);
      refuse_particle(frame, *out, path, problem + ", and not all particles move in one plane",
                      advice);
    }
    throw UserError({path.string(), frame.box->lines[axis]},
                    "the box is " + extent + ", not more than a diameter",
                    "give the diameter in the lengths of the file with --scale");
  }
}

void require_sound(const ParticleFrame& frame, const std::filesystem::path& path) {
  if (frame.positions.size() > (frame.dimension == 2 ? kMaxParticles<2> : kMaxParticles<3>)) {
    throw UserError({path.string()}, "the frame has too many particles", "give a smaller file");
  }
  require_finite(frame, frame.positions, "position", path);
  require_finite(frame, frame.velocities, "velocity", path);
  require_finite(frame, frame.spins, "angular velocity", path);
  if (!std::isfinite(frame.time)) {
    throw UserError({path.string()}, "the time is not finite", "give another frame with --frame");
  }
}

void divide_lengths(ParticleFrame& frame, double scale) {
  const auto divide = [&](ParticleFrame::Vector& vector) {
    for (double& component : vector) component /= scale;
  };
  std::ranges::for_each(frame.positions, divide);
  std::ranges::for_each(frame.velocities, divide);
  for (double& diameter : frame.diameters) diameter /= scale;
  if (frame.box) divide(frame.box->lengths);
}

}  // namespace

bool is_plain_text(const std::filesystem::path& path) {
  require_regular(path, "IN");
  if (is_gzip(path) || is_vtp_series(path)) return false;
  return is_data_file(path) || !is_binary(trajectory_format(uncompressed_name(path), "IN"));
}

ParticleFrame read_frame(const std::filesystem::path& path, const FrameChoice& choice,
                         const char* flag) {
  const auto read = [&] {
    require_regular(path, flag);
    const std::filesystem::path name = uncompressed_name(path);
    if (!choice.group.empty() && find_trajectory_format(name) != TrajectoryFormat::H5md) {
      throw UserError({"--group", 0, 0}, path.string() + " is no H5MD file", "omit --group");
    }
    if (is_data_file(path)) return read_data_file(path, choice);
    if (is_vtp_series(path)) return read_vtp_series(path, choice);
    const TrajectoryFormat format = trajectory_format(name, flag);
    if (is_binary(format) && path.extension() == ".gz") {
      throw UserError({flag, 0, 0}, path.string() + " is compressed",
                      "decompress it with gunzip: only text may be compressed");
    }
    switch (format) {
      case TrajectoryFormat::ExtXyz:
        return read_xyz_frame(path, choice);
      case TrajectoryFormat::LammpsDump:
        return read_dump_frame(path, choice);
      case TrajectoryFormat::Csv:
        return read_csv_frame(path, choice);
      case TrajectoryFormat::Gsd:
        return read_gsd_frame(path, choice);
      case TrajectoryFormat::H5md:
        return read_h5md_frame(path, choice);
      case TrajectoryFormat::Vtp:
        return read_vtp_frame(path, choice);
    }
    return ParticleFrame();
  };
  ParticleFrame frame = read();
  if (choice.scale != 1.0) divide_lengths(frame, choice.scale);
  sort_into_species(frame, choice.scale, path);
  require_sound(frame, path);
  require_room(frame, path);
  frame.images.resize(frame.positions.size());
  wrap_into_box(frame, path);
  return frame;
}

void wrap_into_box(ParticleFrame& frame, const std::filesystem::path& path) {
  for (int axis = 0; frame.box && axis < frame.dimension; ++axis) {
    const double length = frame.box->lengths[axis];
    if (!frame.box->periodic[axis]) {
      for (ParticleFrame::Vector& image : frame.images) image[axis] = 0.0;
      continue;
    }
    for (std::size_t i = 0; i < frame.positions.size(); ++i) {
      double& place = frame.positions[i][axis];
      if (place >= 0.0 && place <= length) continue;
      const double boxes = std::floor(place / length);
      place = std::clamp(place - boxes * length, 0.0, length);
      frame.images[i][axis] += boxes;
    }
  }
  require_bounded_images(frame, path);
}

}  // namespace clatter
