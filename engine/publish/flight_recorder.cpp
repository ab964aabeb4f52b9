#include "engine/publish/flight_recorder.h"

#include <algorithm>
#include <utility>

namespace clatter {

FlightRecorder::FlightRecorder(Simulation<2>& simulation, double span)
    : simulation_(simulation), span_(span), since_(simulation.base_time()) {
  simulation.add_observer(*this);
}

// Other laws may begin flights without an event.
FlightRecorder::FlightRecorder(Simulation<2>& simulation, double span, FlightRecorder&& before)
    : simulation_(simulation),
      span_(span),
      since_(std::max(before.since_, simulation.base_time() - before.span_)),
      ended_(std::move(before.ended_)) {
  const auto& flights_before = before.simulation_.particles();
  for (std::uint32_t i = 0; i < simulation.particles().size(); ++i) {
    const Flight<2>& flight = flights_before[i].flight;
    if (flight.time == simulation.particles()[i].flight.time) continue;
    ended_.push_back({i, flight, simulation.base_time(), before.simulation_.model().gravity});
  }
  simulation.add_observer(*this);
}

void FlightRecorder::on_collision(const PairCollision<2>& collision) {
  for (const ParticleChange<2>& particle : collision.particles)
    end_flight(particle, collision.time);
}

void FlightRecorder::on_wall(const WallCollision<2>& collision) {
  end_flight(collision.particle, collision.time);
}

void FlightRecorder::on_kick(const Kick<2>& kick) {
  end_flight(kick.particle, kick.time);
}

void FlightRecorder::on_base_moved(double shift) {
  since_ -= shift;
  for (Ended& flight : ended_) {
    flight.flight.time -= shift;
    flight.end -= shift;
  }
}

double FlightRecorder::reach() const {
  return std::min(span_, simulation_.base_time() - since_);
}

std::vector<FlightPiece> FlightRecorder::pieces() const {
  std::vector<FlightPiece> pieces;
  for (const Ended& flight : ended_) add_piece(pieces, flight);
  for (std::uint32_t i = 0; i < simulation_.particles().size(); ++i) {
    add_piece(pieces, {i, simulation_.particles()[i].flight, simulation_.base_time(),
                       simulation_.model().gravity});
  }
  return pieces;
}

void FlightRecorder::add_piece(std::vector<FlightPiece>& pieces, const Ended& ended) const {
  const double now = simulation_.base_time();
  const double from = std::max(ended.flight.time, now - reach());
  if (!(from < ended.end)) return;
  const Vec2 r = ended.flight.at(from, ended.gravity);
  const Vec2 boxes = simulation_.model().image_index(r);
  pieces.push_back({ended.particle, from - now, ended.end - now,
                    r - boxes.cwiseProduct(simulation_.model().box),
                    ended.flight.velocity_at(from, ended.gravity), ended.gravity});
}

void FlightRecorder::end_flight(const ParticleChange<2>& change, double time) {
  if (ended_.size() >= forget_at_) forget();
  ended_.push_back({change.particle, change.before, time, simulation_.model().gravity});
}

// Now and then only, so that each flight costs little.
void FlightRecorder::forget() {
  constexpr std::size_t kMin = 1024;
  const double oldest = simulation_.base_time() - span_;
  std::erase_if(ended_, [&](const Ended& flight) { return flight.end < oldest; });
  forget_at_ = 2 * ended_.size() + kMin;
}

}  // namespace clatter
