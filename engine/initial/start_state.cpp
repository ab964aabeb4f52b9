#include "engine/initial/start_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <deque>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "engine/dimension.h"
#include "engine/dynamics/near_particles.h"
#include "engine/dynamics/simulation.h"
#include "engine/error.h"
#include "engine/initial/gaussian_velocities.h"
#include "engine/initial/growth.h"
#include "engine/initial/mixture_state.h"
#include "engine/initial/overlap_removal.h"
#include "engine/initial/random_insertion.h"
#include "engine/physics/lattice.h"
#include "engine/physics/random.h"
#include "engine/physics/theory.h"
#include "engine/system/platform.h"
#include "engine/text.h"

namespace clatter {

// Packing fractions up to which random insertion is used: it jams at 0.547 for disks (Feder 1980)
// and 0.384 for spheres (Torquato, Uche & Stillinger 2006).
template <int D>
static constexpr double kInsertionFraction = D == 2 ? 0.54 : 0.37;
// Number of particles from which they grow.
static constexpr int kFewestGrown = 20'000;
// Above these packing fractions there is no fluid: the fluid of disks ends at 0.700 (Bernard &
// Krauth 2011), and spheres crystallise spontaneously.
template <int D>
static constexpr double kFluidFraction = D == 2 ? 0.7 : 0.54;

// The mean is not removed, because spins have no conservation law.
template <int D>
static std::vector<Spin<D>> gaussian_spins(std::size_t count, double temperature, double inertia,
                                           std::uint64_t seed, const StopRequest& stop) {
  std::vector<Spin<D>> spins(count, Spin<D>::Zero());
  if (!(temperature > 0.0)) return spins;
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    stop.check();
    Random random(seed, Stream::StartSpin, static_cast<std::uint32_t>(i), 0);
    for (double& component : spins[i]) component = random.normal();
    sum += spins[i].squaredNorm();
  }
  const double freedoms = static_cast<double>(Spin<D>::SizeAtCompileTime * count);
  const double scale = std::sqrt(freedoms * temperature / (0.25 * inertia * sum));
  for (Spin<D>& spin : spins) spin *= scale;
  return spins;
}

// The same of the particles of a mixture: each has the same mean energy, so that spins fall as the
// root of the moment of inertia.
template <int D>
static std::vector<Spin<D>> gaussian_spins(const std::vector<Grain>& grains, double temperature,
                                           std::uint64_t seed, const StopRequest& stop) {
  constexpr double kUnitInertia = 4.0;  // q = 4I/(m a^2) of I = 1, m = 1 and a = 1
  std::vector<Spin<D>> spins =
      gaussian_spins<D>(grains.size(), temperature, kUnitInertia, seed, stop);
  for (std::size_t i = 0; i < spins.size(); ++i) {
    spins[i] /= std::sqrt(grains[i].moment_of_inertia());
  }
  return spins;
}

// Whether particles differ at most in other properties.
static bool have_equal_radii(const std::vector<Grain>& grains) {
  return std::ranges::all_of(
      grains, [&](const Grain& grain) { return grain.radius == grains.front().radius; });
}

// A random choice of `count` of the sites, in random order.
template <int D>
static void choose(std::vector<Vec<D>>& sites, std::size_t count, Random& random) {
  for (std::size_t i = 0; i < count; ++i) {
    std::swap(sites[i], sites[i + random.below(sites.size() - i)]);
  }
  sites.resize(count);
}

// The global bond orders |psi_m| = |<exp(i m theta)>| over all pairs closer than 1.5 diameters.
struct BondOrders {
  double square = 0.0;      // m = 4
  double triangular = 0.0;  // m = 6
};
static BondOrders bond_orders(const Model<2>& model, const std::vector<Vec2>& positions) {
  const double reach = 1.5 * model.diameter;
  NearParticles<2> near(model.domain(), reach);
  std::complex<double> fourth = 0.0, sixth = 0.0;  // sums of these powers of exp(i theta)
  double bonds = 0.0;
  for (const Vec2& r : positions) {
    near.visit(r, [&](std::uint32_t, const Vec2& x) {
      if (x.norm() > reach) return;
      const std::complex<double> unit(x.x() / x.norm(), x.y() / x.norm());
      const std::complex<double> square = unit * unit;
      fourth += square * square;
      sixth += square * square * square;
      bonds += 1.0;
    });
    near.add(r);
  }
  if (bonds == 0.0) return {};
  return {std::abs(fourth) / bonds, std::abs(sixth) / bonds};
}

// Whether the lattice has melted. For disks the criterion is the bond order of the square and the
// triangular lattice. For spheres it is a root mean square displacement of one diameter; `sites`
// are those of the first spheres.
static bool is_fluid(const Simulation<2>& gas, const std::vector<Vec2>&) {
  const double finite = 3.0 / std::sqrt(static_cast<double>(gas.particles().size()));
  const BondOrders orders = bond_orders(gas.model(), gas.positions());
  return orders.square < std::max(0.1, finite) && orders.triangular < std::max(0.3, finite);
}
static bool is_fluid(const Simulation<3>& gas, const std::vector<Vec<3>>& sites) {
  const Model<3>& model = gas.model();
  const Domain<3> domain = model.domain();
  double squares = 0.0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Vec<3> now = gas.particles()[i].flight.at(gas.base_time(), model.gravity);
    squares += domain.shortest(now - sites[i]).squaredNorm();
  }
  return squares > static_cast<double>(sites.size()) * model.diameter * model.diameter;
}

namespace {

// The melting of a lattice by elastic motion, until is_fluid() or for at most kRounds rounds.
template <int D>
class Melting {
 public:
  Melting(const Room<D>& room, std::vector<Vec<D>> sites, std::uint64_t seed,
          const StopRequest& stop)
      : model_(elastic(room)),
        sites_(std::move(sites)),
        gas_(typename Simulation<D>::InParts(), model_,
             {sites_, gaussian_velocities<D>(sites_.size(), 1.0, ~seed, stop)}) {
    sites_.resize(std::min(sites_.size(), kSites));
    sites_.shrink_to_fit();
  }

  // Returns false at a request to pause.
  bool advance(const StopRequest& pause) {
    if (!gas_.prepare(pause)) return false;
    for (; round_ <= kRounds; ++round_) {
      const std::uint64_t most = collisions_after(round_);
      const bool arrived =
          gas_.run_until(kLongestRound * model_.diameter * round_, most, kNoLimit, pause);
      if (!arrived && gas_.counts().collisions() < most) return false;
      if (is_fluid(gas_, sites_)) break;
    }
    return true;
  }

  // Most lattices melt in the first round.
  double progress() const {
    return std::min(1.0, static_cast<double>(gas_.counts().collisions()) /
                             static_cast<double>(collisions_after(1)));
  }

  std::vector<Vec<D>> positions() const { return gas_.positions(); }

 private:
  // Sites whose displacements are measured. The error of their mean square is below a percent.
  static constexpr std::size_t kSites = 10'000;
  static constexpr int kRounds = 10;
  static constexpr std::uint64_t kCollisionsPerRound = 20;  // per particle
  // Longest time of a round, per diameter. At T = 1 in a dense gas a round takes less than 10; a
  // lone particle never collides.
  static constexpr double kLongestRound = 100.0;

  static Model<D> elastic(const Room<D>& room) {
    Model<D> model;
    model.box = room.box;
    model.diameter = room.diameter;
    for (int side = 0; side < 2 * D; ++side) {
      if (room.walled[side / 2]) model.walls[side] = Wall{};
    }
    return model;
  }

  std::uint64_t collisions_after(int round) const {
    return kCollisionsPerRound * static_cast<std::uint64_t>(round) * gas_.particles().size() / 2;
  }

  Model<D> model_;
  std::vector<Vec<D>> sites_;  // of the first kSites particles
  Simulation<D> gas_;
  int round_ = 1;
};

}  // namespace

template <int D>
FixtureImages<D> start_fixtures(const Scene& scene, const Vec<D>& corner) {
  if (!scene.has_fixtures()) return FixtureImages<D>();
  Domain<D> domain{.box = scene.box};
  for (int axis = 0; axis < D; ++axis) domain.periodic[axis] = scene.periodic(axis);
  return FixtureImages<D>(fixtures_of<D>(scene), domain, corner);
}

// The sites of a lattice that has at least so many outside of fixtures; empty: none has.
template <int D>
static std::vector<Vec<D>> lattice_sites(const Room<D>& room, int count,
                                         const FixtureImages<D>& fixtures) {
  constexpr double kGrowth = 1.1;
  for (int wanted = count;; wanted = static_cast<int>(kGrowth * wanted) + 1) {
    std::vector<Vec<D>> sites = face_centred_lattice(room, wanted);
    if (sites.empty()) sites = primitive_lattice(room, wanted);
    if (sites.empty() || !fixtures.any()) return sites;
    std::erase_if(sites, [&](const Vec<D>& site) {
      return fixtures.depth(site, 0.5 * room.diameter, kSeesAll) > 0.0;
    });
    if (static_cast<int>(sites.size()) >= count) return sites;
  }
}

template <int D>
static std::vector<Vec<D>> lattice_positions(const Room<D>& room, int count, std::uint64_t seed,
                                             const FixtureImages<D>& fixtures) {
  std::vector<Vec<D>> sites = lattice_sites(room, count, fixtures);
  if (sites.empty() && count > 0) {
    throw UserError({}, "no lattice has " + std::to_string(count) + " places beside the fixtures",
                    "give fewer particles, or set particles.start.layout = \"random\"");
  }
  Random random(seed, Stream::Placement, 0, 0);
  choose<D>(sites, static_cast<std::size_t>(count), random);
  return sites;
}

// Numbers particles along rows, and rows from bottom to top. Near particles are then near in memory
// too, which makes large gases faster by a quarter.
template <int D>
static void number_by_rows(std::vector<Vec<D>>& positions) {
  constexpr double kRowHeight = 1.3;  // diameters: about that of the engine's cells
  const auto comes_first = [](const Vec<D>& a, const Vec<D>& b) {
    for (int k = D - 1; k > 0; --k) {
      const double row_a = std::floor(a[k] / kRowHeight), row_b = std::floor(b[k] / kRowHeight);
      if (row_a != row_b) return row_a < row_b;
    }
    return a[0] < b[0];
  };
  std::stable_sort(positions.begin(), positions.end(), comes_first);
}

struct StartMaker::Work {
  virtual ~Work() = default;
  virtual bool advance(const StopRequest& pause) = 0;
  virtual double progress() const = 0;
  virtual AnyState take() = 0;
};

namespace {

/// Particles without overlaps in a room, made in parts.
template <int D>
class Placement {
 public:
  /// Work for a number of particles that are alike, or for `grains`. A part of the box has a seed
  /// of its own. `corner` is that of the room in the box.
  Placement(const Room<D>& room, const Vec<D>& corner, int count, std::vector<Grain> grains,
            Layout layout, FixtureImages<D> fixtures, std::uint64_t seed, const StopRequest& stop)
      : room_(room),
        corner_(corner),
        count_(count),
        seed_(seed),
        stop_(stop),
        fixtures_(std::move(fixtures)),
        random_(seed, Stream::Placement, 0, 0),
        grains_(std::move(grains)) {
    if (layout == Layout::Lattice) {
      positions_ = lattice_positions(room_, count_, seed_, fixtures_);
    } else if (!have_equal_radii(grains_) || fixtures_.differ()) {
      begin_removal();
    } else if (fraction() <= kInsertionFraction<D>) {
      if (layout == Layout::Random && count_ >= kFewestGrown && !fixtures_.any()) {
        growth_.emplace(room_, count_, random_);
      } else {
        insertion_.emplace(room_, count_, random_, fixtures_);
      }
    } else if (fixtures_.any()) {
      begin_removal();
    }
  }

  bool advance(const StopRequest& pause) {
    if (removal_) {
      if (!removal_->advance(pause)) return false;
      positions_ = removal_->take();
      removal_.reset();
      if (positions_.empty()) {
        const bool fits = !fixtures_.any() && lattice_capacity(room_) >= count_;
        throw UserError({}, "the particles have found no places without overlaps",
                        std::string("give fewer of them, or a larger box") +
                            (fits ? ", or set particles.start.layout = \"lattice\"" : ""));
      }
    }
    if (growth_) {
      if (!growth_->advance(pause)) return false;
      positions_ = growth_->take();
      growth_.reset();
      return_unused_memory();
    }
    if (insertion_) {
      if (!insertion_->advance(pause)) return false;
      positions_ = insertion_->take();
      insertion_.reset();
      return_unused_memory();
      if (!is_complete() && fixtures_.any()) {
        begin_removal();
        return advance(pause);
      }
    }
    if (is_complete()) return true;
    if (!melting_) {
      if (sites_.empty()) {
        choose_sites();
        if (is_complete()) return true;
        if (pause.made()) return false;
      }
      melting_.emplace(room_, std::move(sites_), seed_, stop_);
      if (pause.made()) return false;
    }
    if (!melting_->advance(pause)) return false;
    positions_ = melting_->positions();
    melting_.reset();
    return_unused_memory();
    return true;
  }

  double progress() const {
    if (removal_) return removal_->progress();
    if (growth_) return growth_->progress();
    if (insertion_) return static_cast<double>(insertion_->placed()) / std::max(1, count_);
    if (melting_) return melting_->progress();
    return is_complete() ? 1.0 : 0.0;
  }

  int count() const { return count_; }

  // [count] places in the box, in the order of the grains.
  std::vector<Vec<D>> take() {
    // Places of equal particles may have an order in space; the species must be anywhere. Beside a
    // membrane each place belongs to its particle.
    if (!grains_.empty() && have_equal_radii(grains_) && !fixtures_.differ()) {
      choose<D>(positions_, positions_.size(), random_);
    }
    if (grains_.empty()) number_by_rows<D>(positions_);
    for (Vec<D>& position : positions_) position += corner_;
    return std::move(positions_);
  }

 private:
  std::array<bool, D> periodic() const {
    std::array<bool, D> periodic{};
    for (int axis = 0; axis < D; ++axis) periodic[axis] = !room_.walled[axis];
    return periodic;
  }
  void begin_removal() {
    const Grain alike{.radius = 0.5 * room_.diameter};
    removal_.emplace(
        Domain<D>{.box = room_.box, .periodic = periodic()},
        grains_.empty() ? std::vector<Grain>(static_cast<std::size_t>(count_), alike) : grains_,
        random_, fixtures_);
  }
  // Packing fraction of particles that all have the largest diameter.
  double fraction() const {
    const double d = room_.diameter, cube = D == 2 ? d * d : d * d * d;
    return packing_fraction(D, count_ * cube / room_.box.prod());
  }

  bool is_complete() const { return static_cast<int>(positions_.size()) == count_; }

  // Chooses sites of a lattice, which are the positions if it does not melt.
  void choose_sites() {
    sites_ = primitive_lattice(room_, count_);
    const bool primitive = !sites_.empty();
    if (!primitive) sites_ = face_centred_lattice(room_, count_);
    choose<D>(sites_, static_cast<std::size_t>(count_), random_);
    // A square lattice fits at every density of the fluid of disks, except in narrow rooms; there
    // disks stay on their sites. A cubic lattice of spheres often does not fit, because it fills at
    // most 0.52.
    const bool melts = primitive || D == 3;
    if (!melts || fraction() > kFluidFraction<D>) positions_ = std::move(sites_);
  }

  Room<D> room_;
  Vec<D> corner_;
  int count_;
  std::uint64_t seed_;
  StopRequest stop_;
  FixtureImages<D> fixtures_;
  Random random_;
  std::vector<Grain> grains_;                    // of a mixture; empty: particles are alike
  std::optional<OverlapRemoval<D>> removal_;     // the present part of the work, or none
  std::optional<Growth<D>> growth_;              // the same
  std::optional<RandomInsertion<D>> insertion_;  // the same
  std::optional<Melting<D>> melting_;            // the same
  std::vector<Vec<D>> sites_;                    // of the lattice that will melt
  std::vector<Vec<D>> positions_;                // of the complete work
};

template <int D>
class StartWork : public StartMaker::Work {
 public:
  StartWork(const Scene& scene, std::uint64_t seed, const StopRequest& stop)
      : scene_(scene), seed_(seed), stop_(stop) {
    if (is_from_file()) return;
    grains_ = grains_of(scene_);
    if (starts_divided(scene_)) {
      place_beside_divider();
      return;
    }
    parts_.emplace_back(scene_.start_room<D>(), scene_.clear_corner(), scene_.particles.count,
                        grains_, scene_.particles.start.layout,
                        start_fixtures<D>(scene_, scene_.clear_corner()), seed_, stop_);
  }

  bool advance(const StopRequest& pause) override {
    return std::ranges::all_of(parts_, [&](Placement<D>& part) { return part.advance(pause); });
  }

  double progress() const override {
    double done = 0.0, all = 0.0;
    for (const Placement<D>& part : parts_) {
      done += part.progress() * part.count();
      all += part.count();
    }
    return all > 0.0 ? done / all : 1.0;
  }

  AnyState take() override {
    if (is_from_file()) return std::get<State<D>>(scene_.particles.start.state);
    State<D> state = beside_the_flow();
    if (scene_.shear_rate) add_flow(state, model_of<D>(scene_, seed_).domain(), 1.0);
    return state;
  }

 private:
  bool is_from_file() const { return scene_.particles.start.layout == Layout::File; }

  // The placed particles with their velocities, without those of a sheared flow.
  State<D> beside_the_flow() {
    const Start& start = scene_.particles.start;
    if (!grains_.empty()) {
      State<D> state =
          state_at_places<D>(places_of_grains(), grains_, start.temperature, seed_, stop_);
      if (scene_.spins()) {
        state.spins = gaussian_spins<D>(state.grains, start.spin_temperature, seed_, stop_);
      }
      return state;
    }
    State<D> state;
    for (Placement<D>& part : parts_) {
      const std::vector<Vec<D>> places = part.take();
      state.positions.insert(state.positions.end(), places.begin(), places.end());
    }
    state.velocities =
        gaussian_velocities<D>(state.positions.size(), start.temperature, seed_, stop_);
    if (scene_.spins()) {
      state.spins = gaussian_spins<D>(state.positions.size(), start.spin_temperature,
                                      scene_.particles.inertia, seed_, stop_);
    }
    return state;
  }

  // The two sides of a divider are rooms of their own. The upper one has other random numbers than
  // the lower one of any seed in use.
  static constexpr std::uint64_t kOtherSide = 0x9e3779b97f4a7c15u;
  void place_beside_divider() {
    const std::size_t kinds = std::max<std::size_t>(scene_.species.size(), 1);
    std::vector<int> below(kinds);
    for (std::size_t k = 0; k < kinds; ++k) below[k] = count_left(scene_, k);
    std::array<std::vector<Grain>, 2> grains;
    for (std::size_t i = 0; i < grains_.size(); ++i) {
      const bool is_below = below[grains_[i].species]-- > 0;
      of_side_[is_below ? 0 : 1].push_back(i);
      grains[is_below ? 0 : 1].push_back(grains_[i]);
    }
    for (const int side : {0, 1}) {
      const StartSide<D> place = start_side<D>(scene_, side);
      const int count = !grains_.empty() ? static_cast<int>(grains[side].size())
                        : side == 0      ? below[0]
                                         : scene_.particles.count - below[0];
      if (count == 0) continue;
      parts_.emplace_back(place.room, place.corner, count, grains[side],
                          scene_.particles.start.layout, start_fixtures<D>(scene_, place.corner),
                          seed_ ^ kOtherSide * static_cast<std::uint64_t>(side), stop_);
      sides_.push_back(side);
    }
  }

  // [N] the places of the particles of a mixture, in their order.
  std::vector<Vec<D>> places_of_grains() {
    if (sides_.empty()) return parts_.front().take();
    std::vector<Vec<D>> places(grains_.size());
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const std::vector<Vec<D>> part = parts_[k].take();
      const std::vector<std::size_t>& numbers = of_side_[static_cast<std::size_t>(sides_[k])];
      for (std::size_t i = 0; i < part.size(); ++i) places[numbers[i]] = part[i];
    }
    return places;
  }

  Scene scene_;
  std::uint64_t seed_;
  StopRequest stop_;
  std::vector<Grain> grains_;       // of a mixture; empty: particles are alike
  std::deque<Placement<D>> parts_;  // of the box: one, or those beside a divider with particles
  std::vector<int> sides_;          // [parts] 0: below the divider, 1: above; empty without one
  std::array<std::vector<std::size_t>, 2> of_side_;  // numbers of the grains below and above
};

}  // namespace

StartMaker::StartMaker(const Scene& scene, std::uint64_t seed, const StopRequest& stop)
    : work_(with_dimension(scene.dimension(), [&](auto dimension) -> std::unique_ptr<Work> {
        return std::make_unique<StartWork<dimension()>>(scene, seed, stop);
      })) {}

StartMaker::StartMaker(StartMaker&&) noexcept = default;
StartMaker& StartMaker::operator=(StartMaker&&) noexcept = default;
StartMaker::~StartMaker() = default;

bool StartMaker::advance(const StopRequest& pause) {
  return work_->advance(pause);
}

double StartMaker::progress() const {
  return work_->progress();
}

AnyState StartMaker::take() {
  return work_->take();
}

template <int D>
State<D> start_state(const Scene& scene, std::uint64_t seed, const StopRequest& stop) {
  StartMaker maker(scene, seed, stop);
  if (!maker.advance(stop)) throw Interrupted();
  return std::get<State<D>>(maker.take());
}

template FixtureImages<2> start_fixtures(const Scene&, const Vec2&);
template FixtureImages<3> start_fixtures(const Scene&, const Vec<3>&);
template State<2> start_state(const Scene&, std::uint64_t, const StopRequest&);
template State<3> start_state(const Scene&, std::uint64_t, const StopRequest&);

}  // namespace clatter
