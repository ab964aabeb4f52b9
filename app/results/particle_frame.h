#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/physics/grain.h"
#include "engine/scene/species.h"

namespace clatter {

/// The box of a file.
struct ParticleBox {
  std::array<double, 3> lengths = {};
  std::array<bool, 3> periodic = {};
  std::array<int, 3> lines = {};  ///< places of the edges in a text file; 0: none
};

/// A frame that was read from a file, with three components of each vector. Disks are at z = 0.
struct ParticleFrame {
  using Vector = std::array<double, 3>;

  int dimension = 3;               ///< 2: disks
  long number = 0;                 ///< in the run that wrote the file
  double time = 0.0;               ///< 0 if the file has no times
  std::optional<ParticleBox> box;  ///< absent in CSV
  std::optional<double> inertia;   ///< q = 4I/(m a^2) of particles that are alike, if known
  double rounding = 1e-9;          ///< relative error of the file's numbers that is accepted
  std::vector<Vector> positions;   ///< [N] relative to the lower corner of the box
  std::vector<Vector> velocities;  ///< [N] empty: the file has none
  std::vector<Vector> spins;       ///< [N] angular velocities; empty: none
  std::vector<Vector> images;      ///< [N] periodic images
  std::vector<double> masses;      ///< [N] empty: the file has none
  std::vector<double> diameters;   ///< [N] empty: the file has none
  std::vector<double> inertias;    ///< [N] q of each particle; empty: the file has none
  std::vector<int> types;          ///< [N] numbers of types; empty: the file has none
  std::vector<std::string> names;  ///< of the types, by number
  bool mixture = false;            ///< whether the file says that its particles have species
  std::vector<int> lines;          ///< [N] places in a text file; empty: a binary file
  std::vector<double> ids;         ///< [N] identifiers in a binary file; empty: none

  // The species that read_frame() makes of masses, diameters, inertias and types.
  std::vector<Species> species;  ///< empty: the particles are alike, of diameter and mass 1
  std::vector<Grain> grains;     ///< [N] of a mixture, otherwise empty

  /// Diameter of the largest particle; 1 if all are alike.
  double largest_diameter() const;
};

template <class Archive>
void visit(Archive& io, ParticleBox& box) {
  auto& [lengths, periodic, lines] = box;
  io(lengths, periodic, lines);
}

/// A frame as its reader leaves it: before the species are known.
template <class Archive>
void visit(Archive& io, ParticleFrame& frame) {
  auto& [dimension, number, time, box, inertia, rounding, positions, velocities, spins, images,
         masses, diameters, inertias, types, names, mixture, lines, ids, species, grains] = frame;
  io(dimension, number, time, box, inertia, rounding, positions, velocities, spins, images, masses,
     diameters, inertias, types, names, mixture, lines, ids);
}

/// Which particles of a file are wanted, and how.
struct FrameChoice {
  std::optional<std::size_t> frame;  ///< of a trajectory, from 0; absent: the last
  std::string group;                 ///< of an H5MD file; empty: the only one
  std::optional<int> dimension;      ///< 2: disks, 3: spheres; absent: that of the file
  double scale = 1.0;                ///< unit of length: the diameter in the lengths of the file
  bool needs_velocities = true;      ///< whether a file without velocities is an error
};

/// The vectors of consecutive numbers, with `components` of each.
std::vector<ParticleFrame::Vector> vectors_of(const std::vector<double>& numbers,
                                              std::size_t components = 3);

/// The first particle that is not in the plane z of particle 0, or leaves it, by more than rounding
/// of lengths of at least `scale`, or by no finite number; absent: none.
std::optional<std::size_t> first_out_of_plane(const ParticleFrame& frame, double scale);

/// The dimension of a frame in a format for three dimensions: the chosen one, or 2 if all particles
/// stay in a plane z. Without particles the dimension is 2 if the box is absent or a layer at most
/// one diameter deep. Throws UserError if disks are chosen, and the particles leave the plane.
int dimension_of(const ParticleFrame& frame, const FrameChoice& choice,
                 const std::filesystem::path& path);

/// Moves the lower corner of the box to 0, and disks to z = 0.
void move_corner(ParticleFrame& frame, const ParticleFrame::Vector& corner);

/// Replaces the types of a frame by the numbers 0, 1, 2 and so on. Each type gets the name that
/// `names` has for its former number. Without one its name is "type" and that number: type2.
void name_types(ParticleFrame& frame, const std::map<int, std::string>& names = {});

/// The number of a frame in the run that wrote it, from the number in a file; 0 if that has no
/// meaning.
long step_of(double number);

/// Throws the UserError of a particle of a frame, with its line in a text file, or with its
/// identifier or place in a binary file.
[[noreturn]] void refuse_particle(const ParticleFrame& frame, std::size_t particle,
                                  const std::filesystem::path& path, const std::string& problem,
                                  const std::string& advice);

/// Throws the UserError of a file that lacks the wanted frame. `frames` is the number of its
/// frames.
[[noreturn]] void refuse_frame(const std::filesystem::path& path, std::size_t frames);

/// Whether a component of an edge of a box, across its axis, is more than rounding.
bool is_tilt(double across, const ParticleBox& box);

/// Throws the UserError of a box that is not rectangular along the axes.
[[noreturn]] void refuse_tilt(const std::filesystem::path& path, int line = 0);

}  // namespace clatter
