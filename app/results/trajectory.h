#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/laws/model.h"
#include "engine/physics/grain.h"
#include "engine/physics/state.h"

namespace clatter {

/// Format of a trajectory. Its numbers read back to exactly the same bits.
enum class TrajectoryFormat {
  ExtXyz,      ///< extended XYZ: .xyz and .extxyz
  LammpsDump,  ///< text dump of LAMMPS: .lammpstrj and .dump
  Csv,         ///< one line per particle and frame: .csv
  Gsd,         ///< binary file of HOOMD-blue: .gsd
  H5md,        ///< HDF5 file in the H5MD structure: .h5md
  Vtp          ///< VTK PolyData, one file per frame, and a list of them: .vtp
};

/// Throws UserError that names `flag` for a device or a pipe.
void require_regular(const std::filesystem::path& file, const char* flag);

/// The format of a file extension; absent: of no trajectory.
std::optional<TrajectoryFormat> find_trajectory_format(const std::filesystem::path& file);

/// The same. Throws UserError that names `flag` for other extensions, and for
/// a device or a pipe, which cannot be continued.
TrajectoryFormat trajectory_format(const std::filesystem::path& file, const char* flag);

/// The particles of a trajectory, the same in all frames.
struct TrajectoryParticles {
  std::size_t count = 0;
  bool spins = false;                     ///< whether frames have angular velocities
  bool sheared = false;                   ///< whether the box of frames is tilted
  std::vector<std::string> species = {};  ///< names of the species; empty: all particles are alike
  std::vector<Grain> grains = {};         ///< [N] of a mixture, otherwise empty

  /// Whether the particles have species.
  bool is_mixture() const { return !species.empty(); }
};

/// The exact state of a gas at one time.
template <int D>
struct TrajectoryFrame {
  long number = 0;    ///< from 0
  double time = 0.0;  ///< simulation time
  const Model<D>& model;
  const TrajectoryParticles& particles;
  State<D> state;
  std::vector<IntVec<D>> images;  ///< [N] periodic images, see PeriodicImages
  double tilt = 0.0;  ///< x of the edge of the box along y, within half a side; 0 without shear
};

/// The text before the first frame of a text format.
template <int D>
std::string header_text(TrajectoryFormat format, const TrajectoryParticles& particles);

/// The text of a frame in a text format, with spins unless the state has none. Formats for three
/// dimensions have disks at z = 0, with angular velocities along z. Types of LAMMPS and extended
/// XYZ are the numbers of species, from 1.
template <int D>
std::string frame_text(const TrajectoryFrame<D>& frame, TrajectoryFormat format);

}  // namespace clatter
