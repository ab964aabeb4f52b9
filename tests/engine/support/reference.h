#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <set>
#include <vector>

#include "engine/dynamics/boundary.h"
#include "engine/dynamics/clock.h"
#include "engine/dynamics/event.h"
#include "engine/dynamics/simulation.h"
#include "engine/dynamics/state_hash.h"
#include "engine/laws/model.h"
#include "engine/physics/flight.h"

namespace clatter::testing {

/// Records the moves of the time base of a simulation. A move rounds the starts of flights, so that
/// equal bits need equal moves. The rule for moves is not physics.
template <int D>
class BaseMoves : public Observer<D> {
 public:
  explicit BaseMoves(Simulation<D>& simulation) : simulation_(simulation) {
    simulation.add_observer(*this);
  }
  /// Whether the base moved right after this number of collisions and kicks.
  bool after(std::uint64_t events) const { return events_.contains(events); }

  void on_base_moved(double) override {
    events_.insert(simulation_.counts().collisions() + simulation_.counts().kicks);
  }

 private:
  const Simulation<D>& simulation_;
  std::set<std::uint64_t> events_;
};

/// A brute-force version of Simulation. Before every event it tests all pairs, all images, all
/// walls and all pieces of fixtures, and takes the earliest event. It has no cells, no queue and no
/// memory between events. It uses the same functions of physics/ for contacts and collisions, and
/// the moves of the base of the simulation. Equal runs are equal to the last bit.
template <int D>
class Reference {
 public:
  /// `moves` are the moves of a simulation over at least the same time.
  Reference(const Model<D>& model, const State<D>& state, const BaseMoves<D>& moves);

  /// Runs until this number of collisions with particles and walls, or until no event is left.
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
  void weigh_piston(std::uint32_t i, Next& first) const;
  void weigh_fixtures(std::uint32_t i, double horizon, Next& first) const;
  bool step();
  double next_kick() const;
  void kick();
  void collide(const Next& next);
  void hit_wall(const Event& event);
  void hit_fixture(const Next& next);
  void meet_valve(const Fixture<D>& fixture, const Valve<D>& valve, const Next& next);
  void hit_piston(std::uint32_t i);
  bool reflect_piston(double horizon);
  bool within_contact_time(std::uint32_t i) const;
  Spin<D> spin(std::uint32_t i) const;
  Grain grain(std::uint32_t i) const { return grains_.empty() ? model_.grain() : grains_[i]; }
  void renew(std::uint32_t i, const Vec<D>& r, const Vec<D>& v, const Spin<D>& spin);
  Vec<D> wrapped(const Vec<D>& r) const;
  double image_velocity(const Vec<D>& r) const;
  void move_base();

  Model<D> model_;
  Clock clock_;
  Boundary<D> boundary_;
  std::vector<Flight<D>> flights_;
  std::vector<Grain> grains_;
  std::vector<Spin<D>> spins_;
  std::vector<double> last_collisions_;
  PistonFlight piston_;  // of a free piston
  double now_ = 0.0;
  std::uint64_t particle_particle_ = 0, particle_wall_ = 0, kicks_ = 0;
  const BaseMoves<D>& moves_;
};

/// Runs a simulation up to so many collisions, and checks that the reference then has the same
/// counts and the same state to the last bit.
template <int D>
void run_beside_reference(Simulation<D>& simulation, const State<D>& start,
                          std::uint64_t collisions) {
  const BaseMoves<D> moves(simulation);
  Reference<D> reference(simulation.model(), start, moves);
  simulation.run_until(kNever, collisions);
  simulation.remove_observer(moves);
  reference.run_until_collisions(collisions);
  CHECK(simulation.counts().pair_collisions == reference.collisions());
  CHECK(simulation.counts().wall_collisions == reference.wall_hits());
  CHECK(simulation.state_hash() == state_hash<D>(reference.state()));
}

}  // namespace clatter::testing
