#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "engine/dynamics/boundary.h"
#include "engine/dynamics/grain_array.h"
#include "engine/dynamics/neighbourhood.h"
#include "engine/dynamics/particle.h"
#include "engine/laws/free_piston.h"
#include "engine/laws/model.h"

// Each hit gives the piston a new flight, so all contacts with it change. They are kept apart from
// the calendar: in a list of the particles near the piston. A particle is near while its cell or
// region reaches into the piston's zone. The zone moves with the piston in steps.

namespace clatter {

/// The motion of a free piston, and the next of its events.
template <int D>
class PistonMotion {
 public:
  /// What happens next.
  enum class Cause {
    Particle,  ///< a particle touches the piston
    Wall,      ///< the piston touches a wall, because no particle is between them
    Zone,      ///< the piston leaves the middle of its zone
  };
  /// An event of the piston.
  struct Next {
    double time = std::numeric_limits<double>::infinity();  ///< on the base
    Cause cause = Cause::Zone;
    std::uint32_t number = 0;  ///< of the particle, or the Side of the wall
  };

  /// A piston with this flight. All other arguments must outlive this object.
  PistonMotion(const PistonFlight& flight, const Model<D>& model, const Boundary<D>& boundary,
               const ParticleArray<D>& particles, const GrainArray& grains,
               const Neighbourhood<D>& near);

  /// The flight since the last hit.
  const PistonFlight& flight() const { return flight_; }
  /// Times on the base become smaller. gather() must follow.
  void move_base(double shift) { flight_.time -= shift; }
  /// Replaces the flight without its contacts. gather() must follow.
  void set_flight(const PistonFlight& flight) { flight_ = flight; }
  /// Makes the list of near particles for the present place of the piston, and predicts all events.
  /// `cell_of(particle)` returns the cell of a particle.
  template <class CellOf>
  void gather(std::size_t particles, const CellOf& cell_of, double now);
  /// Takes a new flight or cell of a particle.
  void renew(std::uint32_t particle, const IntVec<D>& cell);
  /// Replaces the flight by one that begins now, and predicts all events of the piston.
  void fly(const PistonFlight& flight);
  /// The next event.
  const Next& next() const { return next_; }

 private:
  static constexpr std::uint32_t kNotNear = std::numeric_limits<std::uint32_t>::max();

  double radius_of(std::uint32_t particle) const {
    return grains_.empty() ? 0.5 * model_.diameter : grains_.radius(particle);
  }
  bool is_near(std::uint32_t particle, const IntVec<D>& cell) const;
  void add(std::uint32_t particle);
  void remove(std::uint32_t particle);
  double contact_of(std::uint32_t particle) const;
  void find_own_events(double now);
  void choose_next();

  PistonFlight flight_;
  const Model<D>& model_;
  const Boundary<D>& boundary_;
  const ParticleArray<D>& particles_;
  const GrainArray& grains_;
  const Neighbourhood<D>& near_;
  double zone_ = 0.0;                   // middle of the zone
  std::vector<std::uint32_t> members_;  // particles near the piston
  std::vector<double> times_;           // [members] of their contacts
  std::vector<std::uint32_t> places_;   // [N] index into members_, or kNotNear
  Next own_;                            // the next event without a particle
  Next next_;
};

template <int D>
template <class CellOf>
void PistonMotion<D>::gather(std::size_t particles, const CellOf& cell_of, double now) {
  zone_ = flight_.at(now);
  members_.clear();
  times_.clear();
  places_.assign(particles, kNotNear);
  for (std::uint32_t i = 0; i < particles; ++i) {
    if (is_near(i, cell_of(i))) add(i);
  }
  find_own_events(now);
  choose_next();
}

extern template class PistonMotion<2>;
extern template class PistonMotion<3>;

}  // namespace clatter
