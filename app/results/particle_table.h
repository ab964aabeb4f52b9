#pragma once

#include <array>
#include <utility>
#include <vector>

#include "app/results/particle_frame.h"
#include "app/results/text_lines.h"

namespace clatter {

/// The quantities of a particle in a table. Vectors have consecutive components.
enum ParticleQuantity {
  kX,
  kVx = 3,
  kImage = 6,
  kOmega = 9,
  kMomentum = 12,
  kScaled = 15,           ///< position in edges of the box
  kUnwrapped = 18,        ///< position with its periodic image
  kScaledUnwrapped = 21,  ///< the same, in edges of the box
  kRadius = 24,
  kDiameter,
  kMass,
  kId,
  kTime,
  kIgnored,  ///< any word
  kWhole,    ///< a whole number that no quantity follows from
  kReal      ///< a number that no quantity follows from
};

/// A table of particles in a text file: the meaning of its columns, and quantities that its reader
/// derives from them.
class ParticleTable {
 public:
  /// The values of a particle, by quantity; 0 where the table has none.
  using Row = std::array<double, kIgnored>;

  ParticleTable() = default;
  explicit ParticleTable(std::vector<int> columns, std::vector<int> derived = {})
      : columns_(std::move(columns)), derived_(std::move(derived)) {}

  /// Whether a quantity is in a column, or derived.
  bool has(int quantity) const;

  /// Throws the error of the present line unless the columns are a state: no quantity occurs twice,
  /// vectors are complete in the plane, and there are positions, and velocities if they are needed.
  /// `velocities` is an advice how this format has them.
  void require_state(const TextLines& lines, const FrameChoice& choice,
                     const std::string& velocities) const;
  /// Throws the error of the present line unless vectors of spheres are complete.
  void require_spheres(const TextLines& lines) const;

  /// The values of the words of the present line. Throws unless all columns have finite numbers.
  Row row(const TextLines& lines, const LineWords& words) const;
  /// Adds the values of a line as a particle.
  void add(ParticleFrame& frame, const Row& row, int line) const;

 private:
  std::vector<int> columns_;
  std::vector<int> derived_;
};

/// A particle of a table, and the number of its line.
struct ParticleLine {
  ParticleTable::Row row;
  int line;
};

/// Adds the particles of a table to a frame, sorted by their numbers. Numbers that are all 0 mean
/// nothing. Throws UserError for other numbers that occur twice.
void add_sorted(ParticleFrame& frame, const ParticleTable& table,
                std::vector<ParticleLine> particles, const std::filesystem::path& path);

}  // namespace clatter
