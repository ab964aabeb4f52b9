#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/dynamics/simulation.h"
#include "engine/vec.h"

namespace clatter {

/// Sums and averages of one species over one window of time.
template <int D>
struct SpeciesWindow {
  Vec<D> temperature = Vec<D>::Zero();  ///< T_k: exact time averages of <m v_k^2>
  double spin_temperature = 0.0;        ///< exact time average of <I omega^2> per component
  Vec<D> position = Vec<D>::Zero();     ///< exact time average of <r_k>; along walled axes only
  double walls_in = 0.0;                ///< energy input of the walls
  double bulk_in = 0.0;                 ///< energy input of kicks of bulk driving

  template <class Archive>
  void visit(Archive& io) {
    auto& [temperature, spin_temperature, position, walls_in, bulk_in] = *this;
    io(temperature, spin_temperature, position, walls_in, bulk_in);
  }
};

/// Sums over the collisions between two species in one window of time.
struct PairWindow {
  double collisions = 0.0;
  double elasticised = 0.0;  ///< of these, made elastic by the TC model
  double dissipated = 0.0;   ///< energy lost, > 0

  template <class Archive>
  void visit(Archive& io) {
    auto& [collisions, elasticised, dissipated] = *this;
    io(collisions, elasticised, dissipated);
  }
};

/// Sums and averages of all species over one window of time.
template <int D>
struct SpeciesTotalsWindow {
  double duration = 0.0;
  std::vector<SpeciesWindow<D>> species;  ///< [S]
  std::vector<PairWindow> pairs;          ///< [S (S + 1)/2], see pair_index

  template <class Archive>
  void visit(Archive& io) {
    auto& [duration, species, pairs] = *this;
    io(duration, species, pairs);
  }
};

/// The share of each species in the totals of a mixture (see Totals). The sums over species and
/// pairs are the totals.
template <int D>
class SpeciesTotals : public Observer<D> {
 public:
  /// Watches a simulation of a mixture from now on.
  explicit SpeciesTotals(const Simulation<D>& simulation);

  void on_collision(const PairCollision<D>& collision) override;
  void on_wall(const WallCollision<D>& collision) override;
  void on_kick(const Kick<D>& kick) override;
  void on_base_moved(double shift) override;
  void before_laws(const Model<D>& next) override;
  void on_laws() override;

  /// The sums since the last call, or since the start.
  SpeciesTotalsWindow<D> close_window();

  /// Visits the members that a checkpoint keeps. The continued simulation must be at the same time.
  template <class Archive>
  void visit(Archive& io) {
    auto& [simulation, counts, species, changes, window_start, window] = *this;
    io(counts, species, changes, window_start, window);
    io.require(species.size() == simulation.model().species->count());
  }

 private:
  /// Motion of one species as a whole, and its integrals over time in this window.
  struct Motion {
    double time = 0.0;                     // of the sums, on the base
    double mass = 0.0;                     // sum m
    Vec<D> squares = Vec<D>::Zero();       // sum m v_k^2
    Vec<D> momentum = Vec<D>::Zero();      // sum m v_k
    double cross = 0.0;                    // sum m v_x v_y
    Vec<D> flow = Vec<D>::Zero();          // sum v_k
    Vec<D> place = Vec<D>::Zero();         // sum r_k
    double spin_squares = 0.0;             // sum I omega^2
    Vec<D> squares_time = Vec<D>::Zero();  // integrals
    Vec<D> place_time = Vec<D>::Zero();
    double spin_squares_time = 0.0;

    template <class Archive>
    void visit(Archive& io) {
      auto& [time, mass, squares, momentum, cross, flow, place, spin_squares, squares_time,
             place_time, spin_squares_time] = *this;
      io(time, mass, squares, momentum, cross, flow, place, spin_squares, squares_time, place_time,
         spin_squares_time);
    }
  };

  void take_stock();
  void integrate(std::size_t species, double time);
  void change(const ParticleChange<D>& particle, double time);
  void start_window();

  const Simulation<D>& simulation_;
  std::vector<std::size_t> counts_;
  std::vector<Motion> species_;
  std::uint64_t changes_ = 0;  // of particles since the last stock
  double window_start_;
  SpeciesTotalsWindow<D> window_;
};

extern template class SpeciesTotals<2>;
extern template class SpeciesTotals<3>;

}  // namespace clatter
