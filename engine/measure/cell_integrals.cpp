#include "engine/measure/cell_integrals.h"

#include <algorithm>
#include <cmath>

namespace clatter {

CellSums& CellSums::operator+=(const CellSums& other) {
  time += other.time;
  kinetic_weight += other.kinetic_weight;
  if (rows.empty()) rows.resize(other.rows.size());
  for (std::size_t i = 0; i < other.rows.size(); ++i) rows[i] += other.rows[i];
  return *this;
}

template <int D>
CellSums block_sums(const CellSums& cells, const FieldGrid<D>& grid, const IntVec<D>& block) {
  const std::size_t size = cells.rows.size() / grid.size();
  const IntVec<D> blocks = block_counts(grid, block);
  CellSums sums{cells.time, cells.kinetic_weight,
                std::vector<double>(static_cast<std::size_t>(blocks.prod()) * size)};
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const auto place = grid.cell_of(cell);
    std::size_t row = 0;
    for (int axis = D - 1; axis >= 0; --axis) {
      row = row * static_cast<std::size_t>(blocks[axis]) +
            static_cast<std::size_t>(place[axis] / block[axis]);
    }
    for (std::size_t k = 0; k < size; ++k) sums.rows[row * size + k] += cells.rows[cell * size + k];
  }
  return sums;
}

template <int D>
CellIntegrals<D>::CellIntegrals(const Simulation<D>& simulation, const IntVec<D>& cells,
                                const MomentLayout<D>& layout, const Coarsening& coarsening)
    : simulation_(simulation),
      grid_(simulation.model(), cells),
      layout_(layout),
      estimator_(coarsening.estimator),
      dissipates_(simulation.model().dissipates()),
      window_start_(simulation.base_time()) {
  if (coarsening.gaussian_width) gaussian_.emplace(grid_, *coarsening.gaussian_width);
  sums_.rows.resize(grid_.size() * static_cast<std::size_t>(layout_.size));
}

template <int D>
void CellIntegrals<D>::add(std::size_t cell, int begin, int end, const double* numbers,
                           double weight) {
  double* const row = sums_.rows.data() + cell * static_cast<std::size_t>(layout_.size);
  for (int k = begin; k < end; ++k) row[k] += weight * numbers[k - begin];
}

template <int D>
void CellIntegrals<D>::add_kinetic(std::size_t cell, const Grain& grain, const Rates& rates,
                                   double weight) {
  add(cell, 0, layout_.common, rates.data(), weight);
  const auto species = static_cast<int>(grain.species);
  if (species >= layout_.species_count) return;
  const int begin = layout_.of_species(species);
  add(cell, begin, begin + layout_.species_size, rates.data(), weight);
}

template <int D>
template <class Visit>
void CellIntegrals<D>::spread(const Vec<D>& place, Visit&& visit) const {
  if (gaussian_) return gaussian_->at(place, visit);
  if (!simulation_.model().shear_rate) return visit(grid_.index_of(grid_.cell_at(place)), 1.0);
  visit(grid_.index_of(grid_.cell_at(simulation_.domain().wrapped(place))), 1.0);
}

template <int D>
template <class Visit>
void CellIntegrals<D>::spread(const Vec<D>& from, const Vec<D>& along, Visit&& visit) const {
  if (gaussian_) return gaussian_->along(from, along, visit);
  if (!simulation_.model().shear_rate) return grid_.cut(from, along, visit);
  // The line is a flight through images at rest.
  Domain<D> images = simulation_.domain();
  images.slide = 0.0;
  cut_at_images<D>(
      images, {from, along}, 0.0, 1.0, [&](const Flight<D>& seen, double begin, double end) {
        grid_.cut(seen.r + begin * along, (end - begin) * along,
                  [&](std::size_t cell, double share) { visit(cell, share * (end - begin)); });
      });
}

// A particle's contribution to the kinetic sums per time. It is averaged over a time in which the
// velocity changes uniformly by `change` and is `v` half-way. The mean of v_k v_l then is v_k v_l +
// change_k change_l / 12; products of three factors follow in the same way.
template <int D>
template <class Mass>
typename CellIntegrals<D>::Rates CellIntegrals<D>::rates_of(Mass mass, const Grain& grain,
                                                            const Vec<D>& v, const Vec<D>& change,
                                                            const Spin<D>& spin) const {
  const MomentLayout<D>& at = layout_;
  Rates rates;
  const double m = mass;
  rates[at.count] = 1.0;
  if (at.mass != at.count) rates[at.mass] = m;
  if (at.momentum >= 0) {
    for (int k = 0; k < D; ++k) rates[at.momentum + k] = m * v[k];
  }
  if (at.squares >= 0) {
    for (int k = 0; k < D; ++k) {
      rates[at.squares + k] = m * (v[k] * v[k] + change[k] * change[k] / 12.0);
    }
  }
  if (at.shears >= 0) {
    int place = at.shears;
    for (int k = 0; k < D; ++k) {
      for (int l = k + 1; l < D; ++l) {
        rates[place++] = m * (v[k] * v[l] + change[k] * change[l] / 12.0);
      }
    }
  }
  if (at.spin >= 0) {
    for (int k = 0; k < kSpinSize<D>; ++k) rates[at.spin + k] = spin[k];
  }
  if (at.spin_energy < 0 && at.energy_flux < 0) return rates;
  const double spin_energy = 0.5 * grain.moment_of_inertia() * spin.squaredNorm();
  if (at.spin_energy >= 0) rates[at.spin_energy] = spin_energy;
  if (at.energy_flux >= 0) {
    const double energy = m * (0.5 * v.squaredNorm() + change.squaredNorm() / 24.0) + spin_energy;
    const double mixed = m * v.dot(change) / 12.0;
    for (int k = 0; k < D; ++k) rates[at.energy_flux + k] = energy * v[k] + mixed * change[k];
  }
  return rates;
}

template <int D>
typename CellIntegrals<D>::Rates CellIntegrals<D>::rates_of(const Grain& grain, const Vec<D>& v,
                                                            const Vec<D>& change,
                                                            const Spin<D>& spin) const {
  const bool alike = layout_.mass == layout_.count;
  return alike ? rates_of(UnitMass(), grain, v, change, spin)
               : rates_of(grain.mass, grain, v, change, spin);
}

template <int D>
void CellIntegrals<D>::add_flight(const Grain& grain, const Flight<D>& flight, const Spin<D>& spin,
                                  double end) {
  const Vec<D>& gravity = simulation_.model().gravity;
  const double begin = std::max(flight.time, window_start_);
  const double spent = end - begin;
  if (!(spent > 0.0)) return;
  if (simulation_.model().has_gravity()) return add_fall(grain, flight, spin, begin, end);
  if (simulation_.model().shear_rate) {
    // Seen from its image, a flight is straight, and its velocity without the flow changes.
    return cut_at_images(simulation_.domain_at(0.0), flight, begin, end,
                         [&](const Flight<D>& seen, double from, double to) {
                           add_fall(grain, seen, spin, from, to);
                         });
  }
  const Rates rates = rates_of(grain, flight.v, Vec<D>::Zero(), spin);
  grid_.cut(flight.at(begin, gravity), flight.v * spent, [&](std::size_t cell, double share) {
    add_kinetic(cell, grain, rates, share * spent);
  });
}

// Adds a flight on which the velocity without the flow has an acceleration.
template <int D>
void CellIntegrals<D>::add_fall(const Grain& grain, const Flight<D>& flight, const Spin<D>& spin,
                                double begin, double end) {
  const Vec<D>& gravity = simulation_.model().gravity;
  const Vec<D> acceleration = simulation_.peculiar_acceleration(flight);
  auto cell = grid_.cell_at(flight.at(begin, gravity));
  grid_.walk(
      flight, gravity, cell, begin, end,
      [&](const auto& cell, double from, double until) {
        const double spent = until - from;
        const Vec<D> v = simulation_.peculiar_at(flight, from + 0.5 * spent);
        const Rates rates = rates_of(grain, v, spent * acceleration, spin);
        add_kinetic(grid_.index_of(cell), grain, rates, spent);
      },
      [](const auto&, double, int, int) {});
}

template <int D>
void CellIntegrals<D>::end_flight(const ParticleChange<D>& particle, double time) {
  if (estimator_ == Estimator::Exact)
    add_flight(particle.grain, particle.before, particle.spin, time);
}

// Transfer of momentum and energy along a branch vector (theory 8.4, 8.7).
template <int D>
void CellIntegrals<D>::add_transfer(const Vec<D>& from, const Vec<D>& branch,
                                    const Vec<D>& momentum, double energy) {
  std::array<double, D * D + D> numbers;
  int count = 0;
  if (layout_.transfer >= 0) {
    for (int k = 0; k < D; ++k) {
      for (int l = 0; l < D; ++l) numbers[count++] = branch[k] * momentum[l];
    }
  }
  if (layout_.energy_transfer >= 0) {
    for (int k = 0; k < D; ++k) numbers[count++] = branch[k] * energy;
  }
  if (count == 0) return;
  spread(from, branch, [&](std::size_t cell, double share) {
    add(cell, layout_.kinetic, layout_.along_branch, numbers.data(), share);
  });
}

template <int D>
void CellIntegrals<D>::add_dissipation(const Vec<D>& place, double energy) {
  spread(place, [&](std::size_t cell, double share) {
    add(cell, layout_.dissipation, layout_.dissipation + 1, &energy, share);
  });
}

template <int D>
void CellIntegrals<D>::add_drag(const ParticleChange<D>& particle, const Vec<D>& place) {
  const auto species = static_cast<int>(particle.grain.species);
  if (species >= layout_.drag_count) return;
  const int begin = layout_.drag + species * D;
  spread(place, [&](std::size_t cell, double share) {
    add(cell, begin, begin + D, particle.gain.momentum.data(), share);
  });
}

template <int D>
void CellIntegrals<D>::on_collision(const PairCollision<D>& collision) {
  const auto& [a, b] = collision.particles;
  end_flight(a, collision.time);
  end_flight(b, collision.time);
  // The periodic image of the partner in contact.
  const Vec<D> partner = a.position - collision.separation;
  add_transfer(partner, collision.separation, a.gain.momentum, 0.5 * (a.energy() - b.energy()));
  // Without dissipation zeta is exactly 0, not the rounding of energies that cancel.
  if (layout_.dissipation >= 0 && dissipates_ && !collision.elasticised) {
    const double lost = 0.5 * collision.energy();
    add_dissipation(a.position, lost);
    add_dissipation(partner, lost);
  }
  if (layout_.drag_count > 0 && a.grain.species != b.grain.species) {
    add_drag(a, a.position);
    add_drag(b, partner);
  }
}

// The contact point on the wall is the partner. Energy that a wall absorbs belongs to its power,
// not to the dissipation.
template <int D>
void CellIntegrals<D>::on_wall(const WallCollision<D>& collision) {
  const ParticleChange<D>& particle = collision.particle;
  end_flight(particle, collision.time);
  const Vec<D> branch = collision.branch();
  add_transfer(particle.position - branch, branch, particle.gain.momentum, particle.energy());
}

template <int D>
void CellIntegrals<D>::on_kick(const Kick<D>& kick) {
  end_flight(kick.particle, kick.time);
}

template <int D>
void CellIntegrals<D>::on_base_moved(double shift) {
  window_start_ -= shift;
}

template <int D>
void CellIntegrals<D>::on_laws() {
  dissipates_ = simulation_.model().dissipates();
}

template <int D>
void CellIntegrals<D>::sample() {
  const State<D> state = simulation_.state();
  const Domain<D> domain = simulation_.domain();
  for (std::uint32_t i = 0; i < state.positions.size(); ++i) {
    const Spin<D> spin = state.spins.empty() ? Spin<D>(Spin<D>::Zero()) : state.spins[i];
    const Grain& grain = simulation_.grain(i);
    const Vec<D> velocity = domain.peculiar(state.positions[i], state.velocities[i]);
    const Rates rates = rates_of(grain, velocity, Vec<D>::Zero(), spin);
    spread(state.positions[i],
           [&](std::size_t cell, double weight) { add_kinetic(cell, grain, rates, weight); });
  }
  sums_.kinetic_weight += 1.0;
}

template <int D>
CellSums CellIntegrals<D>::close_window() {
  const double now = simulation_.base_time();
  const double span = now - window_start_;
  if (estimator_ == Estimator::Exact) {
    const LargeArray<Spin<D>>& spins = simulation_.spins();
    for (std::uint32_t i = 0; i < simulation_.particles().size(); ++i) {
      add_flight(simulation_.grain(i), simulation_.particles()[i].flight,
                 spins.empty() ? Spin<D>(Spin<D>::Zero()) : spins[i], now);
    }
    sums_.kinetic_weight = span;
  }
  sums_.time = span;
  window_start_ = now;
  CellSums closed;
  closed.rows.resize(sums_.rows.size());
  std::swap(closed, sums_);
  return closed;
}

template CellSums block_sums(const CellSums&, const FieldGrid<2>&, const IntVec<2>&);
template CellSums block_sums(const CellSums&, const FieldGrid<3>&, const IntVec<3>&);
template class CellIntegrals<2>;
template class CellIntegrals<3>;

}  // namespace clatter
