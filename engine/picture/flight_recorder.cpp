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

// The parts of a straight flight in each image that it crosses.
template <int D>
void FlightRecorder<D>::add_sheared_pieces(std::vector<FlightPiece>& pieces, const Ended& ended,
                                           double from) const {
  const double now = simulation_.base_time();
  const Domain<D> domain = simulation_.domain();
  const auto& [r, v, start, number] = ended.flight;
  const double height = domain.box[1], step = v[1] < 0.0 ? -1.0 : 1.0;
  double image = std::floor((r[1] + v[1] * (from - start)) / height);
  while (from < ended.end) {
    const double border = (image + (step > 0.0 ? 1.0 : 0.0)) * height;
    const double crossing = v[1] != 0.0 ? start + (border - r[1]) / v[1] : ended.end;
    const double to = std::min(ended.end, std::max(from, crossing));
    const Domain<D> then = domain.at(from - now);
    Vec<D> place = r + v * (from - start), velocity = v;
    place -= then.shift(image * Vec<D>::Unit(1));
    place -= Vec<D>::Unit(0) * std::floor(place[0] / domain.box[0]) * domain.box[0];
    for (int axis = 2; axis < D; ++axis) {
      if (domain.periodic[axis]) {
        place[axis] -= std::floor(place[axis] / domain.box[axis]) * domain.box[axis];
      }
    }
    velocity[0] -= image * domain.slide;
    if (to > from) {
      pieces.push_back({ended.particle, from - now, to - now, place, velocity, Vec<D>::Zero()});
    }
    from = to;
    image += step;
  }
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
