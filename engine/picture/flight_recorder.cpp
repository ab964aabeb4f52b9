#include "engine/picture/flight_recorder.h"

#include <algorithm>
#include <utility>

namespace clatter {

template <int D>
FlightRecorder<D>::FlightRecorder(Simulation<D>& simulation, double span,
                                  std::optional<std::uint32_t> only)
    : simulation_(simulation),
      span_(span),
      only_(only),
      since_(simulation.base_time()),
      observation_(simulation, *this) {}

template <int D>
FlightRecorder<D>::FlightRecorder(Simulation<D>& simulation, double span, FlightRecorder&& before)
    : simulation_(simulation),
      span_(span),
      only_(before.only_),
      since_(std::max(before.since_, simulation.base_time() - before.span_)),
      ended_(std::move(before.ended_)),
      observation_(simulation, *this) {}

template <int D>
void FlightRecorder<D>::before_laws(const Model<D>& next) {
  const Model<D>& present = simulation_.model();
  if (keeps_flights<D>(present, next)) return;
  if (present.shear_rate != next.shear_rate) {
    // Places of the images of before no longer follow from the rate.
    ended_.clear();
    since_ = simulation_.base_time();
    return;
  }
  for (std::uint32_t i = 0; i < simulation_.particles().size(); ++i) {
    if (!keeps(i)) continue;
    ended_.push_back(
        {i, simulation_.particles()[i].flight, simulation_.base_time(), present.gravity});
  }
}

template <int D>
void FlightRecorder<D>::on_collision(const PairCollision<D>& collision) {
  for (const ParticleChange<D>& particle : collision.particles)
    end_flight(particle, collision.time);
}

template <int D>
void FlightRecorder<D>::on_wall(const WallCollision<D>& collision) {
  end_flight(collision.particle, collision.time);
}

template <int D>
void FlightRecorder<D>::on_kick(const Kick<D>& kick) {
  end_flight(kick.particle, kick.time);
}

template <int D>
void FlightRecorder<D>::on_base_moved(double shift) {
  since_ -= shift;
  for (Ended& flight : ended_) {
    flight.flight.time -= shift;
    flight.end -= shift;
  }
}

template <int D>
double FlightRecorder<D>::reach() const {
  return std::min(span_, simulation_.base_time() - since_);
}

template <int D>
std::vector<FlightPiece> FlightRecorder<D>::pieces() const {
  std::vector<FlightPiece> pieces;
  for (const Ended& flight : ended_) add_piece(pieces, flight);
  for (std::uint32_t i = 0; i < simulation_.particles().size(); ++i) {
    if (!keeps(i)) continue;
    add_piece(pieces, {i, simulation_.particles()[i].flight, simulation_.base_time(),
                       simulation_.model().gravity});
  }
  return pieces;
}

template <int D>
void FlightRecorder<D>::add_piece(std::vector<FlightPiece>& pieces, const Ended& ended) const {
  const double now = simulation_.base_time();
  const double from = std::max(ended.flight.time, now - reach());
  if (!(from < ended.end)) return;
  const Domain<D> domain = simulation_.domain();
  if (domain.sheared) return add_sheared_pieces(pieces, ended, from);
  const Vec<D> r = ended.flight.at(from, ended.gravity);
  pieces.push_back({ended.particle, from - now, ended.end - now, domain.wrapped(r),
                    ended.flight.velocity_at(from, ended.gravity), ended.gravity});
}

template <int D>
void FlightRecorder<D>::add_sheared_pieces(std::vector<FlightPiece>& pieces, const Ended& ended,
                                           double from) const {
  const double now = simulation_.base_time();
  const Domain<D> domain = simulation_.domain_at(0.0);
  const auto add = [&](const Flight<D>& seen, double begin, double end) {
    Vec<D> place = seen.at(begin, Vec<D>::Zero());
    for (int axis = 0; axis < D; ++axis) {
      if (axis == 1 || !domain.periodic[axis]) continue;
      place[axis] -= std::floor(place[axis] / domain.box[axis]) * domain.box[axis];
    }
    pieces.push_back({ended.particle, begin - now, end - now, place, seen.v, Vec<D>::Zero()});
  };
  cut_at_images(domain, ended.flight, from, ended.end, add);
}

template <int D>
void FlightRecorder<D>::end_flight(const ParticleChange<D>& change, double time) {
  if (!keeps(change.particle)) return;
  if (ended_.size() >= forget_at_) forget();
  ended_.push_back({change.particle, change.before, time, simulation_.model().gravity});
}

// Removes old flights. Called rarely, so that the cost per flight is small.
template <int D>
void FlightRecorder<D>::forget() {
  constexpr std::size_t kMin = 1024;
  const double oldest = simulation_.base_time() - span_;
  std::erase_if(ended_, [&](const Ended& flight) { return flight.end < oldest; });
  forget_at_ = 2 * ended_.size() + kMin;
}

template class FlightRecorder<2>;
template class FlightRecorder<3>;

}  // namespace clatter
