#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/dynamics/boundary.h"
#include "engine/dynamics/event.h"
#include "engine/dynamics/grain_array.h"
#include "engine/dynamics/neighbourhood.h"
#include "engine/dynamics/particle.h"
#include "engine/laws/model.h"
#include "engine/physics/contact.h"

namespace clatter {

template <int D>
struct Candidates;
struct FirstContact;

/// The next event of a particle: its first contact near its cell, or its exit from the cell.
template <int D>
struct Plan {
  double time = kNever;              ///< kNever: no event, for a particle at rest
  std::uint32_t partner = 0;         ///< as Event::partner
  std::uint32_t partner_flight = 0;  ///< number of the partner's flight at the prediction
  IntVec<D> image =
      IntVec<D>::Zero();  ///< box lengths to add to this particle's r minus the partner's
  IntVec<D> cell = IntVec<D>::Zero();  ///< of the particle, see Neighbourhood
};

/// Predicts the next event of a particle from stored states alone. The result has the same bits
/// with any instruction set of the processor. One thread may use an object at a time.
template <int D>
class Prediction {
 public:
  /// A particle to be planned, and its plan, whose `cell` is already the particle's cell.
  struct Request {
    std::uint32_t particle;
    Plan<D>* plan;
  };

  /// Keeps references to the model, walls, particles and near particles of a simulation, which must
  /// outlive this object. `grains` is empty if all particles are alike.
  Prediction(const Model<D>& model, const Boundary<D>& boundary, const ParticleArray<D>& particles,
             const GrainArray& grains, const Neighbourhood<D>& near);

  /// Chooses between simultaneous contacts by these original numbers of the particles, which must
  /// outlive this object. Null: by the particles' own numbers.
  void order_by(const std::uint32_t* numbers) { numbers_ = numbers; }

  /// Takes the changed laws of the model, or other grains.
  void set_laws();

  /// Plans the first contact with a particle or wall near the particle's cell, or the exit from the
  /// cell.
  void plan(const Request& request, double now) const { planners_.one(*this, {request}, now); }
  /// The same for two particles. Their cache misses overlap.
  void plan(const Request& a, const Request& b, double now) const {
    planners_.two(*this, {a, b}, now);
  }

 private:
  template <std::size_t kParticles>
  using Requests = std::array<Request, kParticles>;
  template <std::size_t kParticles>
  using Planner = void(const Prediction&, const Requests<kParticles>&, double now);
  // Functions that use the widest vectors of the processor.
  struct Planners {
    Planner<1>* one;
    Planner<2>* two;
    Planner<1>* any_one;  // for lists that are not plain, see look_at_plain_lists()
    Planner<2>* any_two;

    template <std::size_t kParticles>
    Planner<kParticles>* any() const {
      if constexpr (kParticles == 1) {
        return any_one;
      } else {
        return any_two;
      }
    }
  };
  // A planner for gravity or for none, for a mixture or for particles that are alike.
  template <bool kFalling, bool kMixed>
  static Planners widest_planners();
  // Attributes of templates take effect only at their declaration. A compiler option instead would
  // change Eigen's layouts.
  template <bool kFalling, bool kMixed, bool kPlain, std::size_t kParticles>
  static void plan_baseline(const Prediction&, const Requests<kParticles>&, double now);
  // As any_one for each. It has little code, which keeps the page small.
  static void plan_each(const Prediction&, const Requests<2>&, double now);
#if defined(__x86_64__)
  template <bool kFalling, bool kMixed, bool kPlain, std::size_t kParticles>
  [[gnu::target("avx2")]] static void plan_avx2(const Prediction&, const Requests<kParticles>&,
                                                double now);
#endif

  template <bool kFalling, bool kMixed, bool kPlain, std::size_t kParticles>
  [[gnu::always_inline]] inline void make_plans(const Requests<kParticles>& requests,
                                                double now) const;
  template <bool kFalling, bool kMixed, std::size_t kParticles>
  [[gnu::always_inline]] inline bool look_at_plain_lists(
      const Requests<kParticles>& requests) const;
  template <bool kFalling, bool kMixed, std::size_t kParticles>
  [[gnu::always_inline]] inline void look_at_lists(const Requests<kParticles>& requests) const;
  template <bool kFalling, bool kMixed, std::size_t kParticles>
  [[gnu::always_inline]] inline void look_at_first_lists(
      const Requests<kParticles>& requests) const;
  template <bool kFalling>
  [[gnu::always_inline]] inline void look_at_wide_lists(const Request& request) const;
  void offer_first(std::uint32_t particle, const Candidates<D>& near, const FirstContact& first,
                   Plan<D>& plan) const;
  [[gnu::always_inline]] inline void offer_exit(const Exit& exit, Plan<D>& plan) const;
  [[gnu::always_inline]] inline Vec<D> image_of(std::uint32_t particle, const Candidates<D>& near,
                                                int i) const;
  [[gnu::noinline]] void offer_flow_exits(const Request& request, double now) const;
  template <bool kFalling, bool kMixed, bool kShifted, std::size_t kParticles>
  [[gnu::always_inline]] inline std::array<FirstContact, kParticles> first_of(
      const std::array<std::uint32_t, kParticles>& particles,
      std::array<Candidates<D>, kParticles>& near) const;
  double radius_of(std::uint32_t particle) const {
    return grains_.empty() ? 0.5 * model_.diameter : grains_.radius(particle);
  }
  void weigh_each(std::uint32_t particle, const Candidates<D>& near, Plan<D>& plan) const;
  void offer_particle(std::uint32_t particle, const Candidates<D>& near, int i, double time,
                      Plan<D>& plan) const;
  void look_at_walls(std::uint32_t particle, double now, Plan<D>& plan) const;
  [[gnu::noinline]] void look_at_fixtures(std::uint32_t particle, Plan<D>& plan) const;
  void offer(double time, std::uint32_t particle, std::uint32_t partner, const IntVec<D>& image,
             Plan<D>& plan) const;

  const Model<D>& model_;
  const Boundary<D>& boundary_;
  const ParticleArray<D>& particles_;
  const GrainArray& grains_;
  const Neighbourhood<D>& near_;
  const std::uint32_t* numbers_ = nullptr;
  bool walled_;  // whether there are walls or fixtures
  // Lists of a particle with a reach above 1, and the images of their cells.
  mutable std::vector<std::pair<NearListView, IntVec<D>>> wide_;
  Planners planners_;
};

extern template class Prediction<2>;
extern template class Prediction<3>;

}  // namespace clatter
