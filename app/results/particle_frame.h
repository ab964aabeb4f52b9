#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace clatter {

/// The box of a file.
struct ParticleBox {
  std::array<double, 3> lengths = {};
  std::array<bool, 3> periodic = {};
};

/// A frame that was read from a file, with three components of each vector. Disks are at z = 0.
struct ParticleFrame {
  using Vector = std::array<double, 3>;

  int dimension = 3;               ///< 2: disks
  long number = 0;                 ///< in the run that wrote the file
  double time = 0.0;               ///< 0 if the file has no times
  std::optional<ParticleBox> box;  ///< absent in CSV
  std::optional<double> inertia;   ///< q = 4I/(m a^2), if the file has it
  std::vector<Vector> positions;   ///< [N] relative to the lower corner of the box
  std::vector<Vector> velocities;  ///< [N]
  std::vector<Vector> spins;       ///< [N] angular velocities; empty: none
  std::vector<Vector> images;      ///< [N] periodic images
  std::vector<double> masses;      ///< [N] equal; empty: the file has none
};

template <class Archive>
void visit(Archive& io, ParticleBox& box) {
  auto& [lengths, periodic] = box;
  io(lengths, periodic);
}

template <class Archive>
void visit(Archive& io, ParticleFrame& frame) {
  auto& [dimension, number, time, box, inertia, positions, velocities, spins, images, masses] =
      frame;
  io(dimension, number, time, box, inertia, positions, velocities, spins, images, masses);
}

/// Whether a frame has disks: no position or velocity out of the plane z = 0. Without particles, it
/// has disks if its box is absent or a layer at most one diameter deep.
bool is_flat(const ParticleFrame& frame);

/// The number of a frame in the run that wrote it, from the number in a file; 0 if that has no
/// meaning.
long step_of(double number);

/// Throws the UserError of a file that lacks the wanted frame. `frames` is the number of its
/// frames.
[[noreturn]] void refuse_frame(const std::filesystem::path& path, std::size_t frames);

}  // namespace clatter
