#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "app/import/text_lines.h"
#include "app/results/particle_frame.h"

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
  kType,  ///< a whole number
  kId,
  kTime,
  kTilt,     ///< of the cell of the frame
  kIgnored,  ///< any word
  kWhole,    ///< a whole number that no quantity follows from
  kReal,     ///< a number that no quantity follows from
  kName      ///< the name of a type, which the reader of the file numbers
};

/// A table of particles in a text file: the meaning of its columns, and quantities that its reader
/// derives from them.
class ParticleTable {
 public:
  /// The values of a particle, by quantity; 0 where the table has none.
  using Row = std::array<double, kIgnored>;

  /// A table without columns.
  ParticleTable() = default;
  /// `columns` are the quantities of the columns, and `words` their names in the file. A file
  /// without a header has no names.
  explicit ParticleTable(std::vector<int> columns, std::vector<int> derived = {},
                         std::vector<std::string> words = {})
      : columns_(std::move(columns)), derived_(std::move(derived)), words_(std::move(words)) {}

  /// Whether a quantity is in a column, or derived.
  bool has(int quantity) const;

  /// Throws the error of the present line unless the columns are a state: no quantity occurs twice,
  /// vectors are complete in the plane, and there are positions, and velocities if they are needed.
  /// `velocities` is an advice how this format has them.
  void require_state(const TextLines& lines, const FrameChoice& choice,
                     const std::string& velocities) const;
  /// Throws the error of a line, that of the header, unless vectors of spheres are complete.
  void require_spheres(const TextLines& lines, int line) const;

  /// The values of the words of the present line. Throws if a column is missing or has no value of
  /// its kind.
  Row row(const TextLines& lines, const LineWords& words) const;
  /// Adds the values of a line as a particle.
  void add(ParticleFrame& frame, const Row& row, int line) const;

 private:
  void require_unique(const TextLines& lines) const;
  std::string name_of(int quantity) const;

  std::vector<int> columns_;
  std::vector<int> derived_;
  std::vector<std::string> words_;  // names of the columns; empty: none
};

/// The number of the type of a name. New names are added.
int type_of_name(std::vector<std::string>& names, std::string_view name);

/// A particle of a table, and the number of its line.
struct ParticleLine {
  ParticleTable::Row row;
  int line;
};

/// What it means that all particles of a table have the number 0.
enum class AllZero {
  NoNumbers,  ///< atoms of LAMMPS without an atom map
  Numbers     ///< they are numbers as all others
};

/// Adds the particles of a table to a frame, sorted by their numbers if they have any. Throws
/// UserError for numbers that occur twice.
void add_sorted(ParticleFrame& frame, const ParticleTable& table,
                std::vector<ParticleLine> particles, AllZero all_zero,
                const std::filesystem::path& path);

}  // namespace clatter
