#include "engine/observables/free_flights.h"

#include <cmath>
#include <limits>

#include "engine/observables/bins.h"
#include "engine/observables/histogram.h"

namespace clatter {

namespace {

// Layout of the sums.
struct FlightSums {
  static constexpr std::size_t kCount = 0;
  static constexpr std::size_t kTimes = 1;
  static constexpr std::size_t kLengths = 2;
  static constexpr std::size_t kTimeBins = 3;
  static constexpr std::size_t kLengthBins = kTimeBins + LogBins::kCount;
  static constexpr std::size_t kSize = kLengthBins + LogBins::kCount;
};

}  // namespace

// The speed is sqrt(c^2 + (g s)^2), where c is the velocity across the acceleration, and s the time
// from the top of the parabola.
template <int D>
double arc_length(const Vec<D>& velocity, const Vec<D>& acceleration, double duration) {
  if ((acceleration.array() == 0.0).all()) return velocity.norm() * duration;
  const double g = acceleration.norm();
  const double along = velocity.dot(acceleration) / g;
  const double across = std::sqrt(std::fmax(0.0, velocity.squaredNorm() - along * along));
  // Twice the integral of the speed over the velocity u along the acceleration.
  const auto twice_integral = [&](double u) {
    const double speed = std::hypot(u, across);
    return across > 0.0 ? u * speed + across * across * std::asinh(u / across) : u * speed;
  };
  const double bend = g * duration;
  // The difference of the integrals would lose digits. Simpson's rule then has an error below
  // 1e-12.
  if (bend < 1e-3 * velocity.norm()) {
    const double middle = (velocity + 0.5 * duration * acceleration).norm();
    const double end = (velocity + duration * acceleration).norm();
    return duration * (velocity.norm() + 4.0 * middle + end) / 6.0;
  }
  return (twice_integral(along + bend) - twice_integral(along)) / (2.0 * g);
}

template <int D>
std::size_t FreeFlights<D>::size() const {
  return FlightSums::kSize;
}

template <int D>
std::size_t FreeFlights<D>::mean_size() const {
  return FlightSums::kTimeBins;
}

template <int D>
void FreeFlights<D>::start() {
  Observable::start();
  const std::size_t count = simulation_.particles().size();
  paths_.assign(count, {std::numeric_limits<double>::quiet_NaN()});
  observation_.emplace(simulation_, *this);
}

template <int D>
void FreeFlights<D>::save(ArchiveWriter& io) {
  Observable::save(io);
  io(paths_);
}

template <int D>
void FreeFlights<D>::restore(ArchiveReader& io) {
  Observable::restore(io);
  io(paths_);
  io.require(paths_.size() == simulation_.particles().size());
  observation_.emplace(simulation_, *this);
}

// Adds the flight that ends here. A path begins at a collision, so the flight belongs to it as a
// whole.
template <int D>
double& FreeFlights<D>::extend(const ParticleChange<D>& change, double time) {
  Path& path = paths_[change.particle];
  const Flight<D>& flight = change.before;
  path.length += arc_length<D>(simulation_.peculiar_at(flight, flight.time),
                               simulation_.peculiar_acceleration(flight), time - flight.time);
  return path.length;
}

template <int D>
void FreeFlights<D>::on_collision(const PairCollision<D>& collision) {
  for (const ParticleChange<D>& change : collision.particles) {
    const double length = extend(change, collision.time);
    Path& path = paths_[change.particle];
    const double time = collision.time - path.begin;
    path = {collision.time};
    if (std::isnan(time)) continue;
    sums_.values[FlightSums::kCount] += 1.0;
    sums_.values[FlightSums::kTimes] += time;
    sums_.values[FlightSums::kLengths] += length;
    sums_.values[FlightSums::kTimeBins + LogBins::of(time)] += 1.0;
    sums_.values[FlightSums::kLengthBins + LogBins::of(length)] += 1.0;
  }
}

template <int D>
void FreeFlights<D>::on_wall(const WallCollision<D>& collision) {
  extend(collision.particle, collision.time);
}

template <int D>
void FreeFlights<D>::on_kick(const Kick<D>& kick) {
  extend(kick.particle, kick.time);
}

template <int D>
void FreeFlights<D>::on_base_moved(double shift) {
  for (Path& path : paths_) path.begin -= shift;
}

template <int D>
ObservableResult FreeFlights<D>::result(const ObservableParts& parts) const {
  return {
      {log_histogram("free_flights.time", "t", parts.coarse, FlightSums::kTimeBins,
                     FlightSums::kCount),
       log_histogram("free_flights.path", "a", parts.coarse, FlightSums::kLengthBins,
                     FlightSums::kCount)},
      {{"free_flights.mean_time", ratio_of(parts.fine, FlightSums::kTimes, FlightSums::kCount)},
       {"free_flights.mean_path", ratio_of(parts.fine, FlightSums::kLengths, FlightSums::kCount)}}};
}

template class FreeFlights<2>;
template class FreeFlights<3>;
template double arc_length<2>(const Vec<2>&, const Vec<2>&, double);
template double arc_length<3>(const Vec<3>&, const Vec<3>&, double);

}  // namespace clatter
