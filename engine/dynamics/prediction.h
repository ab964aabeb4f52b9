#pragma once

#include <array>
#include <cstdint>

#include "engine/dynamics/boundary.h"
#include "engine/dynamics/cell_grid.h"
#include "engine/dynamics/event.h"
#include "engine/dynamics/large_array.h"
#include "engine/dynamics/model.h"
#include "engine/dynamics/particle.h"
#include "engine/physics/contact.h"

namespace clatter {

template <int D>
struct Candidates;
struct FirstContact;

/// What a particle in its cell will do next: its first contact there, or leave the cell.
template <int D>
struct Plan {
  double time = kNever;              ///< kNever: it rests, and nothing comes near
  std::uint32_t partner = 0;         ///< as in an Event
  std::uint32_t partner_flight = 0;  ///< number of the partner's flight that the contact is with
  IntVec<D> image =
      IntVec<D>::Zero();  ///< box lengths to add to this particle's r minus the partner's
  IntVec<D> cell = IntVec<D>::Zero();
};

/// Finds what a particle will do next, from stored states alone; the same to the bit whatever
/// instructions the processor has.
template <int D>
class Prediction {
 public:
  /// A particle to be planned anew, and the plan, whose cell is that of the particle.
  struct Request {
    std::uint32_t particle;
    Plan<D>* plan;
  };

  /// Looks at the model, the walls, the particles and the grid of a simulation, which outlive it.
  Prediction(const Model<D>& model, const Boundary<D>& boundary,
             const LargeArray<Particle<D>>& particles, const CellGrid<D>& grid);

  /// The first contact with any particle or wall about the particle's cell, or its way out of the
  /// cell.
  void plan(const Request& request, double now) const { planners_.one(*this, {request}, now); }
  /// The same for two particles, neither of which waits for what the other looks at.
  void plan(const Request& a, const Request& b, double now) const {
    planners_.two(*this, {a, b}, now);
  }

 private:
  template <std::size_t kParticles>
  using Requests = std::array<Request, kParticles>;
  template <std::size_t kParticles>
  using Planner = void(const Prediction&, const Requests<kParticles>&, double now);
  // With the widest vectors that the processor has.
  struct Planners {
    Planner<1>* one;
    Planner<2>* two;
    Planner<1>* any;  // for lists that are not plain, see look_at_plain_lists()
  };
  template <bool kFalling>
  static Planners widest_planners();
  // Attributes of templates count only where these are declared. No compiler option in their place:
  // Eigen's layouts would follow it.
  template <bool kFalling, bool kPlain, std::size_t kParticles>
  static void plan_baseline(const Prediction&, const Requests<kParticles>&, double now);
#if defined(__x86_64__)
  template <bool kFalling, bool kPlain, std::size_t kParticles>
  [[gnu::target("avx2")]] static void plan_avx2(const Prediction&, const Requests<kParticles>&,
                                                double now);
#endif

  template <bool kFalling, bool kPlain, std::size_t kParticles>
  [[gnu::always_inline]] inline void make_plans(const Requests<kParticles>& requests,
                                                double now) const;
  template <bool kFalling, std::size_t kParticles>
  [[gnu::always_inline]] inline bool look_at_plain_lists(
      const Requests<kParticles>& requests) const;
  template <bool kFalling>
  [[gnu::always_inline]] inline void look_at_lists(const Request& request) const;
  template <bool kFalling>
  [[gnu::always_inline]] inline void look_at_borders(std::uint32_t particle, double now,
                                                     Plan<D>& plan) const;
  [[gnu::always_inline]] inline void look_at_border_falling(std::uint32_t particle, double now,
                                                            int axis, Plan<D>& plan) const;
  [[gnu::always_inline]] inline void offer_border(double time, int axis, bool upper,
                                                  Plan<D>& plan) const;
  [[gnu::always_inline]] inline Vec<D> image_of(std::uint32_t particle, const Candidates<D>& near,
                                                int i) const;
  template <bool kFalling, bool kShifted, std::size_t kParticles>
  [[gnu::always_inline]] inline std::array<FirstContact, kParticles> first_of(
      const std::array<std::uint32_t, kParticles>& particles,
      std::array<Candidates<D>, kParticles>& near) const;
  void weigh_each(std::uint32_t particle, const Candidates<D>& near, Plan<D>& plan) const;
  void offer_particle(std::uint32_t particle, const Candidates<D>& near, int i, double time,
                      Plan<D>& plan) const;
  void look_at_walls(std::uint32_t particle, double now, Plan<D>& plan) const;
  void offer(double time, std::uint32_t particle, std::uint32_t partner, const IntVec<D>& image,
             Plan<D>& plan) const;

  const Model<D>& model_;
  const Boundary<D>& boundary_;
  const LargeArray<Particle<D>>& particles_;
  const CellGrid<D>& grid_;
  bool walled_;  // whether there are walls
  Planners planners_;
  std::array<double, 2 * D> reach_;  // from the box's edge: where the side's wall can be touched
};

extern template class Prediction<2>;
extern template class Prediction<3>;

}  // namespace clatter
