#include "app/results/trajectory.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>

#include "app/results/three_axes.h"
#include "engine/error.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

using TextBuffer = fmt::memory_buffer;

template <class T>
void add_numbers(TextBuffer& text, std::span<const T> numbers, char separator) {
  for (const T number : numbers)
    fmt::format_to(std::back_inserter(text), "{}{}", separator, number);
}

template <class T>
void add_space(TextBuffer& text, const std::array<T, 3>& numbers) {
  add_numbers<T>(text, numbers, ' ');
}

// What a particle is.
template <int D>
Grain grain_of(const TrajectoryFrame<D>& frame, std::size_t particle) {
  return frame.particles.is_mixture() ? frame.particles.grains[particle] : frame.model.grain();
}

// The key of extended XYZ with the names of the types; empty if all particles are alike.
std::string type_names(const TrajectoryParticles& particles) {
  if (!particles.is_mixture()) return "";
  return fmt::format(" type_names=\"{}\"", fmt::join(particles.species, " "));
}

template <int D>
void add_xyz(TextBuffer& text, const TrajectoryFrame<D>& frame) {
  const Model<D>& model = frame.model;
  const auto [lx, ly, lz] = extents(model);
  const auto pbc = [&](int axis) { return is_periodic(model, axis) ? 'T' : 'F'; };
  const bool spins = !frame.state.spins.empty();
  // Disks are in the middle of their layer.
  const std::string origin = D == 2 ? fmt::format(" Origin=\"0 0 {}\"", -0.5 * lz) : "";
  fmt::format_to(std::back_inserter(text),
                 "{}\nLattice=\"{} 0 0 {} {} 0 0 0 {}\"{} pbc=\"{} {} {}\" Time={}{} "
                 "Properties=species:S:1:pos:R:3:velo:R:3{}:map_shift:I:3:radius:R:1{}\n",
                 frame.state.positions.size(), lx, frame.tilt, ly, lz, origin, pbc(0), pbc(1),
                 pbc(2), frame.time, type_names(frame.particles), spins ? ":omega:R:3" : "",
                 frame.particles.is_mixture() ? ":type:I:1:masses:R:1" : "");
  for (std::size_t i = 0; i < frame.state.positions.size(); ++i) {
    text.push_back('X');
    add_space(text, in_space(frame.state.positions[i]));
    add_space(text, in_space(frame.state.velocities[i]));
    if (spins) add_space(text, in_space(frame.state.spins[i]));
    add_space(text, in_space(frame.images[i]));
    const Grain grain = grain_of(frame, i);
    const auto out = std::back_inserter(text);
    fmt::format_to(out, " {}", grain.radius);
    if (frame.particles.is_mixture()) fmt::format_to(out, " {} {}", grain.species + 1, grain.mass);
    text.push_back('\n');
  }
}

template <int D>
void add_dump(TextBuffer& text, const TrajectoryFrame<D>& frame) {
  const Model<D>& model = frame.model;
  const bool spins = !frame.state.spins.empty();
  const std::array<double, 3> box = extents(model);
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS{}",
                 frame.number, frame.state.positions.size(),
                 frame.particles.sheared ? " xy xz yz" : "");
  for (int axis = 0; axis < 3; ++axis) {
    fmt::format_to(out, " {}", is_periodic(model, axis) ? "pp" : "ff");
  }
  const double depth = D == 2 ? 0.5 * box[2] : 0.0;  // disks are in the middle of their layer
  // The bounds of a tilted box are those of the rectangle around it.
  const double left = std::min(0.0, frame.tilt), right = box[0] + std::max(0.0, frame.tilt);
  const std::string xy = frame.particles.sheared ? fmt::format(" {}", frame.tilt) : "";
  const char* const none = frame.particles.sheared ? " 0" : "";
  fmt::format_to(out, "\n{} {}{}\n0 {}{}\n{} {}{}\n", left, right, xy, box[1], none, 0.0 - depth,
                 box[2] - depth, none);
  const bool mixture = frame.particles.is_mixture();
  fmt::format_to(out, "ITEM: ATOMS id type radius{} x y z ix iy iz vx vy vz{}\n",
                 mixture ? " mass" : "", spins ? " omegax omegay omegaz" : "");
  for (std::size_t i = 0; i < frame.state.positions.size(); ++i) {
    const Grain grain = grain_of(frame, i);
    fmt::format_to(out, "{} {} {}", i + 1, grain.species + 1, grain.radius);
    if (mixture) fmt::format_to(out, " {}", grain.mass);
    add_space(text, in_space(frame.state.positions[i]));
    add_space(text, in_space(frame.images[i]));
    add_space(text, in_space(frame.state.velocities[i]));
    if (spins) add_space(text, in_space(frame.state.spins[i]));
    text.push_back('\n');
  }
}

// "PREFIXx,PREFIXy" and so on.
std::string axis_names(const std::string& prefix, int count) {
  std::string names;
  for (int k = 0; k < count; ++k) names += ',' + prefix + "xyz"[k];
  return names;
}

template <int D>
void add_csv(TextBuffer& text, const TrajectoryFrame<D>& frame) {
  const auto add = [&](const auto& vector) {
    using T = typename std::decay_t<decltype(vector)>::Scalar;
    add_numbers<T>(text, {vector.data(), static_cast<std::size_t>(vector.size())}, ',');
  };
  const bool spins = !frame.state.spins.empty();
  for (std::size_t i = 0; i < frame.state.positions.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{}", frame.time, i);
    add(frame.state.positions[i]);
    add(frame.images[i]);
    add(frame.state.velocities[i]);
    if (spins) add(frame.state.spins[i]);
    if (frame.particles.sheared) {
      fmt::format_to(std::back_inserter(text), ",{}", frame.tilt);
    }
    if (frame.particles.is_mixture()) {
      const Grain& grain = frame.particles.grains[i];
      fmt::format_to(std::back_inserter(text), ",{},{},{}", 2.0 * grain.radius, grain.mass,
                     frame.particles.species[grain.species]);
    }
    text.push_back('\n');
  }
}

}  // namespace

void require_regular(const std::filesystem::path& file, const char* flag) {
  if (!is_special(file)) return;
  throw UserError({flag, 0, 0}, file.string() + " is not a regular file",
                  "give the name of a file, not of a device or a pipe");
}

std::optional<TrajectoryFormat> find_trajectory_format(const std::filesystem::path& file) {
  const std::string extension = file.extension();
  if (extension == ".xyz" || extension == ".extxyz") return TrajectoryFormat::ExtXyz;
  if (extension == ".lammpstrj" || extension == ".dump") return TrajectoryFormat::LammpsDump;
  if (extension == ".csv") return TrajectoryFormat::Csv;
  if (extension == ".gsd") return TrajectoryFormat::Gsd;
  if (extension == ".h5md") return TrajectoryFormat::H5md;
  if (extension == ".vtp") return TrajectoryFormat::Vtp;
  return std::nullopt;
}

TrajectoryFormat trajectory_format(const std::filesystem::path& file, const char* flag) {
  require_regular(file, flag);
  if (const auto format = find_trajectory_format(file)) return *format;
  throw UserError({flag, 0, 0}, file.string() + " has no extension of a trajectory",
                  "give a name that ends in .xyz, .lammpstrj, .csv, .gsd, .h5md or .vtp");
}

template <int D>
std::string header_text(TrajectoryFormat format, const TrajectoryParticles& particles) {
  if (format != TrajectoryFormat::Csv) return "";
  const std::string spin = D == 2 ? ",omega" : axis_names("omega_", 3);
  return "time,particle" + axis_names("", D) + axis_names("image_", D) + axis_names("v", D) +
         (particles.spins ? spin : "") + (particles.sheared ? ",tilt" : "") +
         (particles.is_mixture() ? ",diameter,mass,species" : "") + '\n';
}

template std::string header_text<2>(TrajectoryFormat, const TrajectoryParticles&);
template std::string header_text<3>(TrajectoryFormat, const TrajectoryParticles&);

template <int D>
std::string frame_text(const TrajectoryFrame<D>& frame, TrajectoryFormat format) {
  TextBuffer text;
  switch (format) {
    case TrajectoryFormat::ExtXyz:
      add_xyz(text, frame);
      break;
    case TrajectoryFormat::LammpsDump:
      add_dump(text, frame);
      break;
    case TrajectoryFormat::Csv:
      add_csv(text, frame);
      break;
    case TrajectoryFormat::Gsd:
    case TrajectoryFormat::H5md:
    case TrajectoryFormat::Vtp:
      break;
  }
  return fmt::to_string(text);
}

template std::string frame_text(const TrajectoryFrame<2>&, TrajectoryFormat);
template std::string frame_text(const TrajectoryFrame<3>&, TrajectoryFormat);

}  // namespace clatter
