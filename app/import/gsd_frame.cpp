#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/import/binary_frames.h"
#include "app/import/gsd_reader.h"
#include "engine/error.h"
#include "engine/physics/state.h"
#include "engine/text.h"

namespace clatter {

namespace {

using Numbers = std::optional<std::vector<double>>;

// A frame of the schema "hoomd". Chunks that it lacks are those of frame 0, if that has as many
// particles, or else defaults.
class GsdFrame {
 public:
  GsdFrame(const std::filesystem::path& path, const FrameChoice& choice)
      : path_(path), choice_(choice), reader_(path) {
    place_ = choice.frame.value_or(std::max<std::uint64_t>(reader_.frames(), 1) - 1);
    if (place_ >= reader_.frames()) refuse_frame(path, reader_.frames());
    first_particles_ = particles_at(0).value_or(0);
    particles_ = particles_at(place_).value_or(first_particles_);
  }

  ParticleFrame read() {
    ParticleFrame frame;
    frame.rounding = kSingle;
    frame.number = step_of(number("configuration/step", 0.0));
    frame.time = number("log/time", 0.0);
    frame.masses = sizes("particles/mass");
    frame.diameters = sizes("particles/diameter");
    read_types(frame);
    read_box(frame);
    read_positions(frame);
    read_velocities(frame);
    read_rotation(frame);
    if (const Numbers images = of_particles("particles/image", 3))
      frame.images = vectors_of(*images);
    frame.dimension = dimension(frame);
    if (frame.dimension == 2) frame.box->lengths[2] = 0.0;
    move_corner(frame, {0.0, 0.0, 0.0});
    return frame;
  }

 private:
  // Two units in the last place of single precision.
  static constexpr double kSingle = 2.0 * std::numeric_limits<float>::epsilon();

  [[noreturn]] void refuse(const std::string& problem, const std::string& advice) const {
    throw UserError({path_.string()}, problem, advice);
  }

  std::optional<std::uint64_t> particles_at(std::uint64_t place) {
    const Numbers count = reader_.numbers("particles/N", place, 1, 1);
    if (!count) return std::nullopt;
    if (!(count->front() >= 0.0 && count->front() <= kMaxParticles<2>)) {
      refuse("the number of particles is " + number_text(count->front()), "give a smaller file");
    }
    return static_cast<std::uint64_t>(count->front());
  }

  // The frame that has a chunk; absent: its numbers are defaults.
  std::optional<std::uint64_t> place_of(const std::string& chunk) {
    if (reader_.has(chunk, place_)) return place_;
    const bool per_particle =
        chunk.starts_with("particles/") || chunk.starts_with("log/particles/");
    if (per_particle && particles_ != first_particles_) return std::nullopt;
    if (reader_.has(chunk, 0)) return 0;
    return std::nullopt;
  }
  Numbers numbers(const std::string& chunk, std::uint64_t rows, std::uint64_t columns) {
    const std::optional<std::uint64_t> place = place_of(chunk);
    return place ? reader_.numbers(chunk, *place, rows, columns) : std::nullopt;
  }
  Numbers of_particles(const std::string& chunk, std::uint64_t columns) {
    return numbers(chunk, particles_, columns);
  }
  double number(const std::string& name, double otherwise) {
    const Numbers found = numbers(name, 1, 1);
    return found ? found->front() : otherwise;
  }
  std::vector<double> particle_numbers(const std::string& name, double otherwise) {
    return of_particles(name, 1).value_or(std::vector<double>(particles_, otherwise));
  }

  // Masses or diameters.
  std::vector<double> sizes(const std::string& name) {
    return exact_numbers(name, particle_numbers(name, 1.0), name, std::numeric_limits<float>::min(),
                         1);
  }

  // The types of the particles. Only the mixtures of clatter have exact diameters: their species
  // may be a single one.
  void read_types(ParticleFrame& frame) {
    const std::string chunk = "particles/types";
    std::map<int, std::string> names;
    for (const std::string& name : reader_.texts(chunk, reader_.has(chunk, place_) ? place_ : 0)) {
      names.emplace(static_cast<int>(names.size()), name);
    }
    frame.mixture = place_of("log/particles/diameter").has_value();
    const Numbers types = of_particles("particles/typeid", 1);
    if (!types && names.empty()) return;
    for (const double type : types.value_or(std::vector<double>(particles_, 0.0))) {
      if (!(type >= 0.0 && type < std::numeric_limits<int>::max())) {
        refuse("a type of a particle is " + number_text(type), "give the numbers of types");
      }
      frame.types.push_back(static_cast<int>(type));
    }
    name_types(frame, names);
  }

  std::vector<double> zeros() const { return std::vector<double>(3 * particles_, 0.0); }

  // The frame that has the exact numbers of a chunk, or of its defaults; absent: none has.
  std::optional<std::uint64_t> place_of_exact(const std::string& log, const std::string& chunk) {
    const bool newer = reader_.has(chunk, place_) && !reader_.has(log, place_);
    return newer ? std::nullopt : place_of(log);
  }

  // The exact numbers log/NAME of `rounded`, by default vectors, which follow from a chunk or are
  // its defaults. Without exact ones the rounded. Throws if the two contradict each other: differ
  // by more than the rounding of numbers of at least a magnitude.
  std::vector<double> exact_numbers(const std::string& name, const std::vector<double>& rounded,
                                    const std::string& chunk,
                                    double magnitude = std::numeric_limits<float>::min(),
                                    std::uint64_t columns = 3) {
    const std::optional<std::uint64_t> place = place_of_exact("log/" + name, chunk);
    if (!place) return rounded;
    const bool per_particle = name.starts_with("particles/");
    const std::vector<double> exact = *reader_.numbers(
        "log/" + name, *place, per_particle ? particles_ : 3, per_particle ? columns : 1);
    for (std::size_t k = 0; k < rounded.size(); ++k) {
      const double size = std::max(std::fabs(exact[k]), magnitude);
      if (std::fabs(exact[k] - rounded[k]) <= kSingle * size) continue;
      refuse(place_of(chunk)
                 ? "the chunks log/" + name + " and " + chunk + " contradict each other"
                 : "the chunk log/" + name + " contradicts the default of the absent " + chunk,
             "remove the chunk log/" + name);
    }
    return exact;
  }

  void read_box(ParticleFrame& frame) {
    Numbers box = numbers("configuration/box", 6, 1);
    if (!box) refuse("the box is missing", "give a file with configuration/box");
    for (const std::size_t tilt : {3u, 4u, 5u}) {
      if (!(std::fabs((*box)[tilt]) <= frame.rounding)) refuse_tilt(path_);
    }
    box->resize(3);
    frame.box.emplace();
    const std::vector<double> lengths =
        exact_numbers("configuration/box", *box, "configuration/box");
    std::ranges::copy(lengths, frame.box->lengths.begin());
    if (!(lengths[2] >= 0.0) || !std::isfinite(lengths[2])) {
      refuse("the edge of the box along z is " + number_text(lengths[2]),
             "give a positive number, or 0 for disks");
    }
    frame.box->periodic = {true, true, lengths[2] > 0.0};
    const Numbers periodic = numbers("log/configuration/periodic", 3, 1);
    for (std::size_t axis = 0; periodic && axis < 3; ++axis) {
      frame.box->periodic[axis] = (*periodic)[axis] != 0.0;
    }
  }

  // Positions of the chunk are relative to the centre of the box.
  void read_positions(ParticleFrame& frame) {
    const std::string name = "particles/position";
    std::vector<double> positions = of_particles(name, 3).value_or(zeros());
    const auto& lengths = frame.box->lengths;
    for (std::size_t k = 0; k < positions.size(); ++k) positions[k] += 0.5 * lengths[k % 3];
    frame.positions = vectors_of(exact_numbers(name, positions, name, std::ranges::max(lengths)));
  }

  // HOOMD-blue omits velocities that are 0.
  void read_velocities(ParticleFrame& frame) {
    const std::string name = "particles/velocity";
    const Numbers rounded = of_particles(name, 3);
    const std::vector<double> exact = exact_numbers(name, rounded.value_or(zeros()), name);
    if (rounded || choice_.needs_velocities) frame.velocities = vectors_of(exact);
  }

  // The moments of inertia about z, and of spheres about all axes; absent: the particles do not
  // rotate, because all moments are 0.
  Numbers moments_of_inertia() {
    const Numbers moments = of_particles("particles/moment_inertia", 3);
    const auto is_zero = [](double moment) { return moment == 0.0; };
    if (!moments || std::ranges::all_of(*moments, is_zero)) return std::nullopt;
    std::vector<double> about_z;
    for (std::size_t k = 2; k < moments->size(); k += 3) about_z.push_back((*moments)[k]);
    for (std::size_t k = 0; k < moments->size(); ++k) {
      const double moment = (*moments)[k], z = about_z[k / 3];
      const bool flat = k % 3 < 2 && moment == 0.0;
      if (z > 0.0 && (flat || std::fabs(moment - z) <= kSingle * z)) continue;
      refuse("the moments of inertia are not those of disks or spheres",
             "give each particle the same moment about all axes, or about z alone");
    }
    return about_z;
  }

  // The angular momentum L in space is half the product of the quaternions angmom and the conjugate
  // of orientation.
  void read_rotation(ParticleFrame& frame) {
    const std::string log = "particles/angular_velocity", chunk = "particles/angmom";
    const Numbers moments = moments_of_inertia();
    if (!moments) {
      exact_numbers(log, zeros(), "particles/moment_inertia");
      return;
    }
    for (std::size_t i = 0; i < particles_; ++i) {
      const double diameter = frame.diameters[i];
      frame.inertias.push_back(4.0 * (*moments)[i] / (frame.masses[i] * diameter * diameter));
    }
    const Numbers momenta = of_particles(chunk, 4);
    if (!momenta) {
      exact_numbers(log, zeros(), chunk);
      return;
    }
    const Numbers orientations = of_particles("particles/orientation", 4);
    std::vector<double> spins;
    for (std::size_t i = 0; i < particles_; ++i) {
      const double* const p = &(*momenta)[4 * i];
      const std::array<double, 4> unit = {1.0, 0.0, 0.0, 0.0};
      const double* const q = orientations ? &(*orientations)[4 * i] : unit.data();
      const double twice = 2.0 * (*moments)[i];
      spins.push_back((p[1] * q[0] - p[0] * q[1] - p[2] * q[3] + p[3] * q[2]) / twice);
      spins.push_back((p[2] * q[0] - p[0] * q[2] - p[3] * q[1] + p[1] * q[3]) / twice);
      spins.push_back((p[3] * q[0] - p[0] * q[3] - p[1] * q[2] + p[2] * q[1]) / twice);
    }
    frame.spins = vectors_of(exact_numbers(log, spins, chunk));
  }

  // Older files have no number of dimensions, and a box without extent along z.
  int dimension(const ParticleFrame& frame) {
    FrameChoice choice = choice_;
    const Numbers dimensions = numbers("configuration/dimensions", 1, 1);
    const double depth = frame.box->lengths[2];
    if (dimensions && dimensions->front() != 2.0 && dimensions->front() != 3.0) {
      refuse("the number of dimensions is " + number_text(dimensions->front()), "give 2 or 3");
    }
    const bool flat = dimensions ? dimensions->front() == 2.0 : depth == 0.0;
    const bool thin = !dimensions && depth <= choice.scale * (1.0 + frame.rounding);
    if (flat && !choice.dimension) choice.dimension = 2;
    if (!flat && !thin && !choice.dimension) choice.dimension = 3;
    return dimension_of(frame, choice, path_);
  }

  std::filesystem::path path_;
  FrameChoice choice_;
  GsdReader reader_;
  std::uint64_t place_ = 0;
  std::uint64_t particles_ = 0, first_particles_ = 0;
};

}  // namespace

ParticleFrame read_gsd_frame(const std::filesystem::path& path, const FrameChoice& choice) {
  return GsdFrame(path, choice).read();
}

}  // namespace clatter
