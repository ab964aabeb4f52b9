#pragma once

#include <Eigen/Geometry>
#include <type_traits>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"

namespace clatter {

/// Rotation of a disk from its start.
struct DiskRotation {
  double angle = 0.0;  ///< counterclockwise, with whole turns

  /// The rotation after a further time with a constant spin.
  DiskRotation after(const Spin<2>& spin, double duration) const;
  /// Visits all members, in order.
  template <class Archive>
  void visit(Archive& io) {
    io(angle);
  }
};

/// Rotation of a sphere from its start.
struct SphereRotation {
  Vec<4> coefficients = {0.0, 0.0, 0.0, 1.0};  ///< of a unit quaternion, real part last

  /// The quaternion.
  Eigen::Quaterniond quaternion() const { return Eigen::Quaterniond(coefficients); }
  /// The rotation after a further time with a constant angular velocity w: about w by |w| times the
  /// duration.
  SphereRotation after(const Spin<3>& spin, double duration) const;
  /// Visits all members, in order.
  template <class Archive>
  void visit(Archive& io) {
    io(coefficients);
  }
};

template <int D>
using Rotation = std::conditional_t<D == 2, DiskRotation, SphereRotation>;

/// Rotations of the particles since this observer was made. A spin changes only in the particle's
/// own events. So the rotation is exact: the rotations of all flights, one after the other.
template <int D>
class Rotations : public Observer<D> {
 public:
  /// Watches a simulation with spins from now on.
  explicit Rotations(Simulation<D>& simulation);
  /// Continues the rotations of `before` of the same simulation.
  Rotations(Simulation<D>& simulation, Rotations&& before);

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_base_moved(double shift) override;
  void on_laws() override;

  /// Continues from these rotations [N] at the simulation's time.
  void set_rotations(const std::vector<Rotation<D>>& rotations);
  /// [N] rotations at the simulation's time.
  std::vector<Rotation<D>> rotations() const;

  /// Visits the members that a checkpoint keeps. The continued simulation must be at the same time.
  template <class Archive>
  void visit(Archive& io) {
    io(turned_);
  }

 private:
  struct Turned {
    Rotation<D> rotation;
    double time = 0.0;  // of `rotation`, on the moving base

    template <class Archive>
    void visit(Archive& io) {
      io(rotation, time);
    }
  };

  void turn(const ParticleChange<D>& change, double time);

  const Simulation<D>& simulation_;
  std::vector<Turned> turned_;  // [N]
  Observation<D> observation_;
};

extern template class Rotations<2>;
extern template class Rotations<3>;

}  // namespace clatter
