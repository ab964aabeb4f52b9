#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"

namespace clatter {

/// Rotation angles of the disks since this observer was made. A spin changes only in the particle's
/// own events. So the angle is exact: the sum of spin times duration over its flights.
class SpinAngles : public Observer<2> {
 public:
  /// Watches a simulation with spins from now on.
  explicit SpinAngles(Simulation<2>& simulation);
  /// Continues the angles of `before`. The new simulation has the same particles at the same time.
  SpinAngles(Simulation<2>& simulation, SpinAngles&& before);

  void on_collision(const PairCollision<2>& collision) override;
  void on_wall(const WallCollision<2>& collision) override;
  void on_kick(const Kick<2>& kick) override;
  void on_base_moved(double shift) override;

  /// [N] angles at the simulation's time, counterclockwise, without whole turns: -pi..pi.
  std::vector<double> angles() const;

  /// Visits the members that a checkpoint keeps. The continued simulation must be at the same time.
  template <class Archive>
  void visit(Archive& io) {
    io(turned_);
  }

 private:
  struct Turned {
    double angle = 0.0;
    double time = 0.0;  // of `angle`, on the moving base

    template <class Archive>
    void visit(Archive& io) {
      io(angle, time);
    }
  };

  void turn(const ParticleChange<2>& change, double time);

  const Simulation<2>& simulation_;
  std::vector<Turned> turned_;  // [N]
};

/// Orientations of the spheres since this observer was made: the rotation of each from its start.
/// An angular velocity w changes only in the particle's own events. So the orientation is exact:
/// over each flight of a duration t, a rotation about w by the angle |w| t.
class SpinOrientations : public Observer<3> {
 public:
  /// Watches a simulation with spins from now on.
  explicit SpinOrientations(Simulation<3>& simulation);
  /// Continues the orientations of `before`. The new simulation has the same particles at the same
  /// time.
  SpinOrientations(Simulation<3>& simulation, SpinOrientations&& before);

  void on_collision(const PairCollision<3>& collision) override;
  void on_wall(const WallCollision<3>& collision) override;
  void on_kick(const Kick<3>& kick) override;
  void on_base_moved(double shift) override;

  /// [N] unit quaternions at the simulation's time.
  std::vector<Eigen::Quaterniond> orientations() const;

  /// Visits the members that a checkpoint keeps. The continued simulation must be at the same time.
  template <class Archive>
  void visit(Archive& io) {
    io(turned_);
  }

 private:
  struct Turned {
    Vec<4> rotation = {0.0, 0.0, 0.0, 1.0};  // coefficients of a unit quaternion, real part last
    double time = 0.0;                       // of `rotation`, on the moving base

    Eigen::Quaterniond after(const Vec<3>& spin, double later) const;
    template <class Archive>
    void visit(Archive& io) {
      io(rotation, time);
    }
  };

  void turn(const ParticleChange<3>& change, double time);

  const Simulation<3>& simulation_;
  std::vector<Turned> turned_;  // [N]
};

}  // namespace clatter
