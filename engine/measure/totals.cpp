#include "engine/measure/totals.h"

#include <cmath>
#include <utility>

namespace clatter {

template <int D>
Totals<D>::Totals(const Simulation<D>& simulation)
    : simulation_(simulation),
      energy_at_start_(energy_of_starts()),
      integrated_to_(simulation.base_time()),
      window_start_(integrated_to_) {
  fit_window();
  take_stock();
}

// A window has sums of sliding walls and of shear only if the scene has them.
template <int D>
void Totals<D>::fit_window() {
  const Model<D>& model = simulation_.model();
  if (model.shear_rate) window_.plane.resize(8);
  bool slides = false;
  model.for_walls([&](const Wall& wall) { slides = slides || wall.slides(); });
  if (slides) window_.wall_drag.resize(2 * D * D);
}

// Kinetic energy at the starts of the particles' current flights, and energy of spins. It changes
// only by events; the work of gravity on a flight is booked at the flight's end.
template <int D>
double Totals<D>::energy_of_starts() const {
  double twice = 0.0;
  simulation_.for_masses([&](const Flight<D>& flight, double mass) {
    twice += mass * simulation_.peculiar_at(flight, flight.time).squaredNorm();
  });
  return 0.5 * twice + simulation_.spin_energy();
}

// Under another inertia the same spins have another energy. Particles of a mixture keep theirs.
template <int D>
void Totals<D>::change_inertia(double before, double after) {
  if (before == after || simulation_.is_mixture()) return;
  const double gained = (after - before) / before * spin_squares_;
  energy_at_start_ += 0.5 * gained;
  spin_squares_ += gained;
}

// Sums over the particles at this time, which removes the accumulated rounding.
template <int D>
void Totals<D>::take_stock() {
  count_ = simulation_.particles().size();
  mass_ = simulation_.mass();
  squares_.setZero();
  momentum_.setZero();
  cross_ = 0.0;
  quartics_.fill(Vec<D>::Zero());
  stock_taken_ = integrated_to_;
  changes_ = 0;
  spin_squares_ = 2.0 * simulation_.spin_energy();
  simulation_.for_masses([&](const Flight<D>& flight, auto mass) {
    const double m = mass;
    const Vec<D> v = simulation_.peculiar_at(flight, integrated_to_);
    squares_ += m * v.cwiseAbs2();
    momentum_ += m * v;
    cross_ += m * v[0] * v[1];
    add_quartics(m, v, integrated_to_, 1.0);
  });
}

// Whether velocities, without that of the flow, change between events.
template <int D>
bool Totals<D>::accelerates() const {
  return simulation_.model().has_gravity() || simulation_.model().shear_rate;
}

// Adds a share, 1 or -1, of what a particle with this velocity at a time contributes.
template <int D>
void Totals<D>::add_quartics(double mass, const Vec<D>& velocity, double time, double share) {
  const double weight = share * mass * mass;
  if (!accelerates()) {
    quartics_[0] += weight * velocity.cwiseAbs2().cwiseAbs2();
    return;
  }
  const Vec<D> a = simulation_.model().gravity - rate() * velocity[1] * kAlongX<D>;
  const Vec<D> v = velocity - (time - stock_taken_) * a;
  const Vec<D> vv = v.cwiseAbs2(), va = v.cwiseProduct(a), aa = a.cwiseAbs2();
  quartics_[0] += weight * vv.cwiseAbs2();
  quartics_[1] += 4.0 * weight * vv.cwiseProduct(va);
  quartics_[2] += 6.0 * weight * va.cwiseAbs2();
  quartics_[3] += 4.0 * weight * va.cwiseProduct(aa);
  quartics_[4] += weight * aa.cwiseAbs2();
}

template <int D>
Vec<D> Totals<D>::quartics_at(double time) const {
  const double since = time - stock_taken_;
  Vec<D> sum = quartics_[4];
  for (int power = 3; power >= 0; --power) sum = since * sum + quartics_[power];
  return sum;
}

// Between events sum m v_k^2 is a parabola in time, because all particles have the same
// acceleration.
template <int D>
void Totals<D>::integrate_to(double time) {
  const double dt = time - integrated_to_;
  const Vec<D>& gravity = simulation_.model().gravity;
  const Vec<D> slope = gravity.cwiseProduct(momentum_);
  const Vec<D> curvature = mass_ * gravity.cwiseAbs2();
  integral_ += dt * (squares_ + dt * (slope + dt / 3.0 * curvature));
  squares_ += dt * (2.0 * slope + dt * curvature);
  momentum_ += dt * mass_ * gravity;
  if (simulation_.model().shear_rate) shear_to(dt);
  spin_integral_ += dt * spin_squares_;
  integrated_to_ = time;
}

// Velocities without the flow have dc_x/dt = -G c_y (theory 14.1). Adds the part of the integrals
// and sums that constant velocities do not have.
template <int D>
void Totals<D>::shear_to(double dt) {
  const double g = rate(), way = g * dt;
  integral_[0] += dt * way * (way / 3.0 * squares_[1] - cross_);
  cross_integral_ += dt * (cross_ - 0.5 * way * squares_[1]);
  squares_[0] += way * (way * squares_[1] - 2.0 * cross_);
  cross_ -= way * squares_[1];
  momentum_[0] -= way * momentum_[1];
}

// The work of the shear on a flight, -G times the integral of m c_x c_y.
template <int D>
void Totals<D>::book_shear(const Flight<D>& flight, double mass, double time) {
  const double g = rate(), dt = time - flight.time;
  const Vec<D> c = simulation_.peculiar_at(flight, flight.time);
  book(-g * mass * c[1] * dt * (c[0] - 0.5 * g * c[1] * dt));
}

template <int D>
void Totals<D>::book(double gained) {
  booked_ += gained;
  booked_sizes_ += std::fabs(gained);
}

// The work of gravity on the flight of a mass over a distance.
template <int D>
void Totals<D>::book_work(double mass, const Vec<D>& distance) {
  const double work = mass * simulation_.model().gravity.dot(distance);
  window_.gravity_in += work;
  book(work);
}

// An event ends the particle's flight and changes its velocity and spin.
template <int D>
void Totals<D>::change(const ParticleChange<D>& particle, double time) {
  const Impulse<D>& gain = particle.gain;
  ++changes_;
  add_quartics(particle.grain.mass, particle.velocity, time, -1.0);
  add_quartics(particle.grain.mass, particle.velocity_after(), time, 1.0);
  squares_ +=
      gain.momentum.cwiseProduct(gain.momentum / particle.grain.mass + 2.0 * particle.velocity);
  momentum_ += gain.momentum;
  spin_squares_ +=
      particle.grain.moment_of_inertia() * gain.spin.dot(gain.spin + 2.0 * particle.spin);
  book_work(particle.grain.mass, particle.position - particle.before.r);
  if (!simulation_.model().shear_rate) return;
  const Vec<D>&c = particle.velocity, &p = gain.momentum;
  cross_ += p[0] * c[1] + c[0] * p[1] + p[0] * p[1] / particle.grain.mass;
  book_shear(particle.before, particle.grain.mass, time);
}

template <int D>
void Totals<D>::before_laws(const Model<D>& next) {
  const Model<D>& present = simulation_.model();
  integrate_to(simulation_.base_time());
  change_inertia(present.inertia, next.inertia);
  if (keeps_flights<D>(present, next)) return;
  end_flights();
  changes_ = kDue;
}

// Accelerations may be others, and particles may have entered at rest.
template <int D>
void Totals<D>::on_laws() {
  if (is_stock_due() || simulation_.particles().size() != count_) take_stock();
  fit_window();
}

// Books the work of gravity and of the shear on all flights up to now.
template <int D>
void Totals<D>::end_flights() {
  const Vec<D>& gravity = simulation_.model().gravity;
  const double now = simulation_.base_time();
  simulation_.for_masses([&](const Flight<D>& flight, double mass) {
    book_work(mass, flight.at(now, gravity) - flight.r);
    if (simulation_.model().shear_rate) book_shear(flight, mass, now);
  });
}

template <int D>
void Totals<D>::on_collision(const PairCollision<D>& collision) {
  integrate_to(collision.time);
  for (const ParticleChange<D>& particle : collision.particles) change(particle, collision.time);
  window_.collisions += 1.0;
  window_.elasticised += collision.elasticised;
  book(collision.particles[0].energy() + collision.particles[1].energy());
  if (simulation_.model().shear_rate) {
    // The flow has different velocities at the two centres, so the shear works in a collision too.
    const Vec<D>&x = collision.separation, &momentum = collision.particles[0].gain.momentum;
    for (const int k : {0, 1, 2, 3}) window_.plane[4 + k] += x[k / 2] * momentum[k % 2];
  }
  // The gain of an elastic collision is a rounding error.
  const bool elastic = collision.elasticised || !simulation_.model().dissipates();
  if (!elastic) window_.dissipated -= collision.energy();
  window_.undissipated += collision.undissipated;
  window_.virial += collision.particles[0].gain.momentum.dot(collision.separation);
}

template <int D>
void Totals<D>::on_wall(const WallCollision<D>& collision) {
  integrate_to(collision.time);
  change(collision.particle, collision.time);
  book(collision.particle.energy());
  window_.walls_in += collision.particle.energy();
  if (!collision.at_wall()) return;
  const int axis = collision.side / 2;
  const Vec<D>& gain = collision.particle.gain.momentum;
  window_.wall_impulse[collision.side] += std::fabs(gain[axis]);
  if (window_.wall_drag.empty()) return;
  for (int along = 0; along < D; ++along) {
    if (along != axis) window_.wall_drag[D * collision.side + along] -= gain[along];
  }
}

template <int D>
void Totals<D>::on_kick(const Kick<D>& kick) {
  integrate_to(kick.time);
  change(kick.particle, kick.time);
  book(kick.particle.energy());
  double& in = kick.cause == KickCause::Nudge ? window_.nudges_in : window_.bulk_in;
  in += kick.particle.energy();
}

template <int D>
void Totals<D>::on_base_moved(double shift) {
  integrated_to_ -= shift;
  window_start_ -= shift;
  stock_taken_ -= shift;
}

template <int D>
WindowTotals<D> Totals<D>::close_window() {
  const double now = simulation_.base_time();
  integrate_to(now);
  const double count = static_cast<double>(simulation_.particles().size());
  window_.duration = now - window_start_;
  if (is_stock_due()) take_stock();
  if (count > 0.0) {
    window_.second_moment = squares_ / count;
    window_.fourth_moment = quartics_at(now) / count;
  }
  if (count > 0.0 && window_.duration > 0.0) {
    window_.temperature = integral_ / (window_.duration * count);
    window_.spin_temperature = spin_integral_ / (window_.duration * count * kSpinSize<D>);
  }
  if (!window_.plane.empty() && window_.duration > 0.0) {
    const double kinetic[] = {integral_[0], cross_integral_, cross_integral_, integral_[1]};
    for (const int k : {0, 1, 2, 3}) window_.plane[k] = kinetic[k] / window_.duration;
    window_.shear_in = -rate() * (cross_integral_ + window_.plane[6]);
  }
  const WindowTotals<D> closed = std::exchange(window_, {});
  fit_window();
  integral_.setZero();
  cross_integral_ = 0.0;
  spin_integral_ = 0.0;
  window_start_ = now;
  return closed;
}

template <int D>
double Totals<D>::ledger_residual() const {
  const double energy = energy_of_starts();
  const double scale = energy + booked_sizes_;
  return scale > 0.0 ? std::fabs(energy - energy_at_start_ - booked_) / scale : 0.0;
}

template class Totals<2>;
template class Totals<3>;

}  // namespace clatter
