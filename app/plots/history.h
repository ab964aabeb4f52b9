#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "app/plots/species_theory.h"
#include "engine/live/frame.h"
#include "engine/physics/mixing.h"

namespace clatter {

/// Time averages of a gas between two frames.
struct Sample {
  double time = 0.0;                             ///< middle of the averaging interval
  VecX temperature;                              ///< [D] T_x, T_y and, for spheres, T_z
  double spin_temperature = 0.0;                 ///< 0 without spins
  double walls_in = 0.0;                         ///< power of the walls
  double bulk_in = 0.0;                          ///< power of the bulk drive
  double nudges_in = 0.0;                        ///< power of nudges
  double gravity_in = 0.0;                       ///< power of gravity
  double shear_in = 0.0;                         ///< power of the shear
  double dissipated = 0.0;                       ///< dissipated power
  double ledger_residual = 0.0;                  ///< magnitude of Totals::ledger_residual()
  double deepest_overlap = 0.0;                  ///< see RunChecks
  std::vector<double> species_temperature = {};  ///< [S] T_s, NaN: no particles; empty: no mixture
  /// Share of the particles below the divider of the scene at the end; NaN: there is none.
  double share_left = std::numeric_limits<double>::quiet_NaN();
  double piston = 0.0;  ///< place of a free piston at the end
  Mixing mixing = {};  ///< at the end, in cells of about ten particles; undefined without a mixture
};

/// Visits all members, in order, for checkpoints.
template <class Archive>
void visit(Archive& io, Sample& sample) {
  auto& [time, temperature, spin_temperature, walls_in, bulk_in, nudges_in, gravity_in, shear_in,
         dissipated, ledger_residual, deepest_overlap, species_temperature, share_left, piston,
         mixing] = sample;
  io(time, temperature, spin_temperature, walls_in, bulk_in, nudges_in, gravity_in, shear_in,
     dissipated, ledger_residual, deepest_overlap, species_temperature, share_left, piston,
     mixing.lacey, mixing.entropy, mixing.random_entropy);
}

/// Histogram of the velocities over the last seconds, with bins of equal width.
class VelocityHistogram {
 public:
  static constexpr int kClasses = 61;    ///< number of bins
  static constexpr double kReach = 5.0;  ///< half the range, in standard deviations

  /// Removes all counts.
  void clear() { weights_ = {}; }
  /// Adds all particles of a frame.
  void add(const Snapshot& snapshot);
  /// Probability density of the velocity along an axis over its standard deviation, at the middle
  /// of each bin, in a mixture of the velocity times the root of the mass. Empty bins have density
  /// 0.
  std::vector<Vec2> density(int axis) const;

  /// Visits all members, for checkpoints.
  template <class Archive>
  void visit(Archive& io) {
    io(weights_);
  }

 private:
  std::array<std::array<double, kClasses>, 3> weights_ = {};
};

/// Averages of the temperatures of the species of a mixture over frames.
class SpeciesAverages {
 public:
  /// Removes all frames.
  void clear() { *this = {}; }
  /// Adds a frame of a mixture of this number of species.
  void add(const Snapshot& snapshot, std::size_t species);
  /// T_s since the last call, NaN without particles; empty: no mixture.
  std::vector<double> take();

  /// Visits all members, for checkpoints.
  template <class Archive>
  void visit(Archive& io) {
    io(squares_, freedoms_);
  }

 private:
  std::vector<double> squares_;   // [S] sum m v^2
  std::vector<double> freedoms_;  // [S] number of velocity components
};

/// Time series for the plots. The number of samples is bounded: their spacing grows with the length
/// of the run. A look into the past adds no samples.
class History {
 public:
  static constexpr double kPerSecond = 10.0;  ///< largest number of samples per second of play

  /// Adds a frame at the head of the run. A frame of another run clears the history, and one of
  /// another future removes the samples since its beginning.
  void add(const Frame& frame);

  /// The samples in order of time.
  const std::vector<Sample>& samples() const { return samples_; }
  /// Histogram of all particles over the last seconds.
  const VelocityHistogram& velocities() const { return velocities_; }
  /// The theory of a mixture is that of this scene from now on. add() does the same.
  void predict(const std::shared_ptr<const Scene>& scene);
  /// The theory of the last scene; empty without species. The first call for a scene computes it.
  const SpeciesTheory& species_theory() const;
  /// The smallest time between later samples.
  double spacing() const { return spacing_; }

  /// Visits all members, for checkpoints.
  template <class Archive>
  void visit(Archive& io) {
    auto& [run, futures, last, spacing, samples, velocities, species, scene, theory] = *this;
    io(run, futures, last, spacing, samples, velocities, species);
  }

 private:
  void thin_out();
  void fork(const Frame& frame);

  std::uint64_t run_ = 0;
  std::uint64_t futures_ = 0;  // Frame::futures of the last frame
  Tally last_;
  double spacing_ = 0.0;  // smallest time between samples
  std::vector<Sample> samples_;
  VelocityHistogram velocities_;
  SpeciesAverages species_;
  std::shared_ptr<const Scene> scene_;  // of the theory
  mutable std::optional<SpeciesTheory> theory_;
};

}  // namespace clatter
