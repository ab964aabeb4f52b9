#pragma once

#include <optional>
#include <vector>

#include "engine/dynamics/simulation.h"
#include "engine/observables/observable.h"

namespace clatter {

/// Distributions of the times and lengths of the paths of particles between two collisions with
/// particles (theory 11.1). Walls and kicks bend a path and do not end it. Tables
/// "free_flights.time" and "free_flights.path", means "free_flights.mean_time" and "..mean_path".
template <int D>
class FreeFlights final : public Observable, public Observer<D> {
 public:
  explicit FreeFlights(Simulation<D>& simulation) : simulation_(simulation) {}

  std::size_t size() const override;
  std::size_t mean_size() const override;
  void start() override;
  ObservableResult result(const ObservableParts& parts) const override;
  void save(ArchiveWriter& io) override;
  void restore(ArchiveReader& io) override;

 private:
  // The path of a particle since its last collision.
  struct Path {
    double begin;         // time on the base; NaN before the first collision
    double length = 0.0;  // up to the start of the present flight
  };
  template <class Archive>
  friend void visit(Archive& io, Path& path) {
    auto& [begin, length] = path;
    io(begin, length);
  }

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_base_moved(double shift) override;
  double& extend(const ParticleChange<D>& change, double time);

  Simulation<D>& simulation_;
  std::vector<Path> paths_;                    // [N]
  std::optional<Observation<D>> observation_;  // present after the start
};

/// Length of a flight of constant acceleration: the integral of |v + g t| from 0 to `duration`.
template <int D>
double arc_length(const Vec<D>& velocity, const Vec<D>& acceleration, double duration);

extern template class FreeFlights<2>;
extern template class FreeFlights<3>;
extern template double arc_length<2>(const Vec<2>&, const Vec<2>&, double);
extern template double arc_length<3>(const Vec<3>&, const Vec<3>&, double);

}  // namespace clatter
