#include "engine/publish/spin_angles.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace clatter {

SpinAngles::SpinAngles(Simulation<2>& simulation)
    : simulation_(simulation),
      turned_(simulation.particles().size(), {0.0, simulation.base_time()}) {
  simulation.add_observer(*this);
}

// A change of laws keeps the spins, unless it adds or removes all of them.
SpinAngles::SpinAngles(Simulation<2>& simulation, SpinAngles&& before)
    : simulation_(simulation), turned_(std::move(before.turned_)) {
  simulation.add_observer(*this);
}

void SpinAngles::on_collision(const PairCollision<2>& collision) {
  for (const ParticleChange<2>& particle : collision.particles) turn(particle, collision.time);
}

void SpinAngles::on_wall(const WallCollision<2>& collision) {
  turn(collision.particle, collision.time);
}

void SpinAngles::on_kick(const Kick<2>& kick) {
  turn(kick.particle, kick.time);
}

void SpinAngles::on_base_moved(double shift) {
  for (Turned& turned : turned_) turned.time -= shift;
}

std::vector<double> SpinAngles::angles() const {
  std::vector<double> angles;
  angles.reserve(turned_.size());
  for (std::size_t i = 0; i < turned_.size(); ++i) {
    const auto& [angle, time] = turned_[i];
    const double now = angle + simulation_.spins()[i][0] * (simulation_.base_time() - time);
    angles.push_back(std::remainder(now, 2.0 * std::numbers::pi));
  }
  return angles;
}

void SpinAngles::turn(const ParticleChange<2>& change, double time) {
  Turned& turned = turned_[change.particle];
  turned.angle += change.spin[0] * (time - turned.time);
  turned.time = time;
}

SpinOrientations::SpinOrientations(Simulation<3>& simulation)
    : simulation_(simulation), turned_(simulation.particles().size()) {
  for (Turned& turned : turned_) turned.time = simulation.base_time();
  simulation.add_observer(*this);
}

SpinOrientations::SpinOrientations(Simulation<3>& simulation, SpinOrientations&& before)
    : simulation_(simulation), turned_(std::move(before.turned_)) {
  simulation.add_observer(*this);
}

void SpinOrientations::on_collision(const PairCollision<3>& collision) {
  for (const ParticleChange<3>& particle : collision.particles) turn(particle, collision.time);
}

void SpinOrientations::on_wall(const WallCollision<3>& collision) {
  turn(collision.particle, collision.time);
}

void SpinOrientations::on_kick(const Kick<3>& kick) {
  turn(kick.particle, kick.time);
}

void SpinOrientations::on_base_moved(double shift) {
  for (Turned& turned : turned_) turned.time -= shift;
}

std::vector<Eigen::Quaterniond> SpinOrientations::orientations() const {
  std::vector<Eigen::Quaterniond> orientations;
  orientations.reserve(turned_.size());
  for (std::size_t i = 0; i < turned_.size(); ++i) {
    orientations.push_back(turned_[i].after(simulation_.spins()[i], simulation_.base_time()));
  }
  return orientations;
}

// Normalised again, so that roundings do not grow with the number of events.
Eigen::Quaterniond SpinOrientations::Turned::after(const Vec<3>& spin, double later) const {
  const Eigen::Quaterniond before(rotation);
  const double rate = spin.norm();
  if (!(rate > 0.0)) return before;
  const Eigen::AngleAxisd turn(std::remainder(rate * (later - time), 4.0 * std::numbers::pi),
                               spin / rate);
  return (Eigen::Quaterniond(turn) * before).normalized();
}

void SpinOrientations::turn(const ParticleChange<3>& change, double time) {
  Turned& turned = turned_[change.particle];
  turned.rotation = turned.after(change.spin, time).coeffs();
  turned.time = time;
}

}  // namespace clatter
