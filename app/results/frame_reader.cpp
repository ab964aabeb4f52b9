#include "app/results/frame_reader.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "app/results/binary_frames.h"
#include "app/results/text_frames.h"
#include "engine/error.h"
#include "engine/physics/state.h"
#include "engine/scene/text.h"

namespace clatter {

namespace {

void require_bounded_images(const ParticleFrame& frame, const std::filesystem::path& path) {
  for (const ParticleFrame::Vector& image : frame.images) {
    for (const double boxes : image) {
      if (std::fabs(boxes) <= std::numeric_limits<int>::max() && std::floor(boxes) == boxes)
        continue;
      throw UserError({path.string()}, "a periodic image is no whole number of 32 bits",
                      "give a file with smaller images");
    }
  }
}

void require_sound(const ParticleFrame& frame, const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& problem, const std::string& advice) {
    throw UserError({path.string()}, problem, advice);
  };
  if (frame.positions.size() > (frame.dimension == 2 ? kMaxParticles<2> : kMaxParticles<3>)) {
    refuse("the frame has too many particles", "give a smaller file");
  }
  const auto require_finite = [&](const std::vector<ParticleFrame::Vector>& vectors,
                                  const std::string& quantity) {
    for (std::size_t i = 0; i < vectors.size(); ++i) {
      if (std::ranges::all_of(vectors[i], [](double x) { return std::isfinite(x); })) continue;
      refuse("the " + quantity + " of particle " + std::to_string(i) + " is not finite",
             "give another frame with --frame");
    }
  };
  require_finite(frame.positions, "position");
  require_finite(frame.velocities, "velocity");
  require_finite(frame.spins, "angular velocity");
  const auto other = std::ranges::adjacent_find(frame.masses, std::not_equal_to());
  if (other != frame.masses.end()) {
    refuse("masses differ: " + number_text(*other) + " and " + number_text(*(other + 1)),
           "give particles of the same mass");
  }
  if (!std::isfinite(frame.time)) refuse("the time is not finite", "give another frame");
  for (int axis = 0; frame.box && axis < frame.dimension; ++axis) {
    const double length = frame.box->lengths[axis];
    if (!(length > 0.0) || !std::isfinite(length)) {
      refuse("an edge of the box is not a positive number", "give another file");
    }
  }
}

}  // namespace

ParticleFrame read_frame(const std::filesystem::path& path, TrajectoryFormat format,
                         std::optional<std::size_t> frame) {
  const auto read = [&] {
    switch (format) {
      case TrajectoryFormat::ExtXyz:
        return read_xyz_frame(path, frame);
      case TrajectoryFormat::LammpsDump:
        return read_dump_frame(path, frame);
      case TrajectoryFormat::Csv:
        return read_csv_frame(path, frame);
      case TrajectoryFormat::Gsd:
        return read_gsd_frame(path, frame);
      case TrajectoryFormat::H5md:
        return read_h5md_frame(path, frame);
    }
    return ParticleFrame();
  };
  ParticleFrame found = read();
  require_sound(found, path);
  found.images.resize(found.positions.size());
  wrap_into_box(found, path);
  return found;
}

void wrap_into_box(ParticleFrame& frame, const std::filesystem::path& path) {
  for (int axis = 0; frame.box && axis < frame.dimension; ++axis) {
    const double length = frame.box->lengths[axis];
    if (!frame.box->periodic[axis]) continue;
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
