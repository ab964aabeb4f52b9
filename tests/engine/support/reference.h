#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "engine/dynamics/boundary.h"
#include "engine/dynamics/clock.h"
#include "engine/dynamics/event.h"
#include "engine/dynamics/model.h"
#include "engine/dynamics/simulation.h"
#include "engine/physics/flight.h"

namespace clatter::testing {

/// Notes when the base of a simulation's times moves. It rounds the starts of flights, so the same
/// bits need the same moves; which rule they follow is no physics.
template <int D>
class BaseMoves : public Observer<D> {
 public:
  explicit BaseMoves(Simulation<D>& simulation) : simulation_(simulation) {
    simulation.add_observer(*this);
  }
  /// Whether the base has moved right after so many collisions and kicks.
  bool after(std::uint64_t events) const { return events_.contains(events); }

  void on_base_moved(double) override {
    events_.insert(simulation_.counts().collisions() + simulation_.counts().kicks);
  }

 private:
  const Simulation<D>& simulation_;
  std::set<std::uint64_t> events_;
};

/// What Simulation does, by brute force: before every event all pairs, all images and all walls are
/// looked at, and the earliest event happens. No cells, no queue, nothing remembered between
/// events. It uses the same pure functions of physics/ and the same outcomes of collisions, and
/// moves its base when the simulation has, so that equal runs are equal to the last bit.
template <int D>
class Reference {
 public:
  /// `moves` are those of a simulation that has run as far as the reference will.
  Reference(const Model<D>& model, const State<D>& state, const BaseMoves<D>& moves);

  /// Runs until that many collisions with particles and walls have happened, or no event is left.
  void run_until_collisions(std::uint64_t collisions);

  std::uint64_t collisions() const { return particle_particle_; }
  std::uint64_t wall_hits() const { return particle_wall_; }
  std::uint64_t kicks() const { return kicks_; }
  State<D> state() const;

 private:
  struct Next {
    Event event{kNeverAgain, 0, 0};
    IntVec<D> image =
        IntVec<D>::Zero();  // added to particle's r minus partner's, event.particle lower
  };
  static constexpr double kNeverAgain = 1e300;

  Next first_before(double horizon) const;
  void weigh_pair(std::uint32_t i, std::uint32_t j, double horizon, Next& first) const;
  void weigh_walls(std::uint32_t i, Next& first) const;
  bool step();
  double next_kick() const;
  void kick();
  void collide(const Next& next);
  void hit_wall(const Event& event);
  bool within_contact_time(std::uint32_t i) const;
  Spin<D> spin(std::uint32_t i) const;
  void renew(std::uint32_t i, const Vec<D>& r, const Vec<D>& v, const Spin<D>& spin);
  Vec<D> wrapped(const Vec<D>& r) const;
  void move_base();

  Model<D> model_;
  Clock clock_;
  Boundary<D> boundary_;
  std::vector<Flight<D>> flights_;
  std::vector<Spin<D>> spins_;
  std::vector<double> last_collisions_;
  double now_ = 0.0;
  std::uint64_t particle_particle_ = 0, particle_wall_ = 0, kicks_ = 0;
  const BaseMoves<D>& moves_;
};

}  // namespace clatter::testing
