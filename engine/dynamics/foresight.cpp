#include "engine/dynamics/foresight.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "engine/dynamics/cell_of.h"
#include "engine/dynamics/certificate.h"
#include "engine/dynamics/in_parallel.h"
#include "engine/dynamics/prefetch.h"

namespace clatter {

// Growth of the halo of a tile that is redone.
static constexpr double kGrowth = 1.5;

template <int D>
Foresight<D>::Foresight(const Model<D>& model, const Boundary<D>& boundary,
                        const GrainArray& grains, std::size_t particles, int threads,
                        const TileSizes& sizes)
    : model_(model),
      grains_(grains),
      grid_sizes_(grid_sizes<D>(model, grains)),
      sizes_(sizes),
      halo_(sizes.halo * model.diameter),
      block_of_(particles),
      order_(particles),
      strayed_(particles) {
  constexpr double kInBlock = 32.0;  // particles
  ends_.particles.resize(particles);
  ends_.fit(model, particles);
  const auto count = static_cast<double>(particles);
  const double volume = model.box.prod() / count;  // of a particle
  edge_ = std::pow(sizes.particles * volume, 1.0 / D);
  const double block = std::pow(kInBlock * volume, 1.0 / D);
  tile_counts_ = count_tiles(threads);
  int blocks = 1;
  for (int axis = 0; axis < D; ++axis) {
    const double side = model.box[axis];
    block_counts_[axis] = std::max(tile_counts_[axis], static_cast<int>(side / block));
    block_widths_[axis] = side / block_counts_[axis];
    cut_[axis] = tile_counts_[axis] > 1 ? 1.0 : 0.0;
    blocks *= block_counts_[axis];
  }
  first_.resize(static_cast<std::size_t>(blocks) + 1);
  for (int number = 0; number < tile_counts_.prod(); ++number) {
    Tile& added = tiles_.emplace_back();
    int rest = number;
    for (int axis = 0; axis < D; ++axis) {
      const int tiles = tile_counts_[axis];
      const int at = rest % tiles;
      rest /= tiles;
      added.from[axis] = at * block_counts_[axis] / tiles;
      added.to[axis] = (at + 1) * block_counts_[axis] / tiles;
    }
  }
  for (int k = 0; k < threads; ++k) benches_.push_back(std::make_unique<Bench>(model, boundary));
}

// The numbers of tiles along the axes.
template <int D>
IntVec<D> Foresight<D>::count_tiles(int threads) const {
  IntVec<D> counts;
  int longest = 0;
  for (int axis = 0; axis < D; ++axis) {
    const double side = model_.box[axis];
    counts[axis] = std::max(1, static_cast<int>(std::lround(side / edge_)));
    // Halos must have room to grow before they meet across a periodic border.
    const double room = 0.5 * (side - side / counts[axis]) - 2.0 * model_.diameter;
    if (model_.periodic(axis) && room < kGrowth * halo_) counts[axis] = 1;
    if (counts[axis] > counts[longest]) longest = axis;
  }
  // One more along an axis may give all threads the same number of tiles. An axis that is not cut
  // may lack the room.
  IntVec<D> more = counts;
  if (counts[longest] > 1) ++more[longest];
  return counts.prod() % threads != 0 && more.prod() % threads == 0 ? more : counts;
}

template <int D>
void Foresight<D>::restart(double time) {
  ends_.fit(model_, ends_.particles.size());  // laws may have changed
  end_ = time;
  fresh_ = true;
  window_.reset();
  events_.clear();
}

// A counting sort of the numbers of all particles by block, ascending in each block.
template <int D>
void Foresight<D>::sort_into_blocks(const ParticleStates<D>& gas) {
  const std::size_t count = gas.particles.size(), blocks = first_.size() - 1;
  const std::size_t parts = benches_.size();
  const auto part = [&](std::size_t k) { return count * k / parts; };
  IntVec<D> strides;
  int stride = 1;
  for (int axis = 0; axis < D; ++axis) {
    strides[axis] = stride;
    stride *= block_counts_[axis];
  }
  const Domain<D> domain = model_.domain();
  in_parallel(parts, parts, [&](std::size_t k, std::size_t) {
    auto& counts = benches_[k]->offsets;
    counts.assign(blocks, 0);
    for (std::size_t i = part(k); i < part(k + 1); ++i) {
      const Vec<D> place = domain.wrapped(gas.particles[i].flight.at(end_, model_.gravity));
      const auto block =
          static_cast<std::uint32_t>(cell_of<D>(place, block_widths_, block_counts_).dot(strides));
      block_of_[i] = block;
      ++counts[block];
    }
  });
  std::uint32_t sum = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    first_[block] = sum;
    for (std::size_t k = 0; k < parts; ++k) {
      sum += std::exchange(benches_[k]->offsets[block], sum);
    }
  }
  first_[blocks] = sum;
  in_parallel(parts, parts, [&](std::size_t k, std::size_t) {
    auto& offsets = benches_[k]->offsets;
    for (std::size_t i = part(k); i < part(k + 1); ++i) {
      order_[offsets[block_of_[i]]++] = static_cast<std::uint32_t>(i);
    }
  });
}

// The core of a tile and its halo. Opposite halos must not meet across a periodic border.
template <int D>
Subdomain<D> Foresight<D>::subdomain_of(Tile& tile) const {
  Subdomain<D> whole = whole_box<D>(model_), part = whole;
  tile.width = kNever;
  for (int axis = 0; axis < D; ++axis) {
    if (cut_[axis] == 0.0) continue;
    const double side = model_.box[axis];
    const double lower = tile.from[axis] * block_widths_[axis];
    const double upper = tile.to[axis] * block_widths_[axis];
    const double most = 0.5 * (side - (upper - lower)) - 2.0 * model_.diameter;
    const double halo = model_.periodic(axis) ? std::min(tile.halo, most) : tile.halo;
    part.lower[axis] = lower - halo;
    part.upper[axis] = upper + halo;
    for (const int end : {0, 1}) {
      const auto side_number = static_cast<std::size_t>(2 * axis + end);
      double& edge = end ? part.upper[axis] : part.lower[axis];
      const double beyond = end ? side - edge : edge;
      if (model_.periodic(axis) || beyond > 0.0) {
        part.ends[side_number] = End::Open;
        part.to_box_end[side_number] = std::max(0.0, beyond);
        tile.width = std::min(tile.width, halo);
      } else {
        edge = end ? side : 0.0;
      }
    }
  }
  return part;
}

// Collects the particles of a tile and its halo.
template <int D>
void Foresight<D>::gather(const ParticleStates<D>& gas, const Tile& tile,
                          const Subdomain<D>& subdomain, TileRecord<D>& record) const {
  constexpr std::uint32_t kAhead = 8;
  record.numbers.clear();
  record.own.clear();
  record.images.clear();
  record.strays.clear();
  IntVec<D> from = tile.from, to = tile.to;
  for (int axis = 0; axis < D; ++axis) {
    if (cut_[axis] == 0.0) continue;
    const auto block = [&](double place) {
      return static_cast<int>(std::floor(place / block_widths_[axis]));
    };
    from[axis] = block(subdomain.lower[axis]);
    to[axis] = block(subdomain.upper[axis]) + 1;
    if (!model_.periodic(axis)) {
      from[axis] = std::max(from[axis], 0);
      to[axis] = std::min(to[axis], block_counts_[axis]);
    }
  }
  const IntVec<D> extent = to - from;
  const Domain<D> domain = model_.domain();
  for (int k = 0; k < extent.prod(); ++k) {
    int rest = k, index = 0, stride = 1;
    bool own = true;
    Vec<D> boxes = Vec<D>::Zero();
    for (int axis = 0; axis < D; ++axis) {
      const int at = from[axis] + rest % extent[axis];
      rest /= extent[axis];
      own = own && at >= tile.from[axis] && at < tile.to[axis];
      const int count = block_counts_[axis];
      const int box = at < 0 ? -1 : at >= count ? 1 : 0;
      boxes[axis] = box;
      index += (at - box * count) * stride;
      stride *= count;
    }
    const std::uint32_t end = first_[static_cast<std::size_t>(index) + 1];
    for (std::uint32_t p = first_[static_cast<std::size_t>(index)]; p < end; ++p) {
      if (p + kAhead < order_.size()) prefetch(gas.particles[order_[p + kAhead]]);
      const std::uint32_t number = order_[p];
      const Vec<D> r = gas.particles[number].flight.at(end_, model_.gravity);
      const Vec<D> image = domain.image_at(r) - boxes;
      const Vec<D> home = r - domain.shift(image);
      const bool inside = ((home - subdomain.lower).array() >= 0.0).all() &&
                          ((subdomain.upper - home).array() >= 0.0).all();
      if (!own && !inside) continue;
      record.numbers.push_back(number);
      record.own.push_back(own);
      record.images.push_back(image);
      auto& stray = record.strays.emplace_back();
      for (int axis = 0; axis < D; ++axis) {
        stray.home[axis] = static_cast<float>(home[axis] - subdomain.lower[axis]);
      }
      stray.squared_way = 0.0f;
    }
  }
}

// Runs the loop of a tile to the end of the window. Returns whether it gets there. A stop request
// ends it only if the tile alone has as many collisions as a whole window should have.
template <int D>
bool Foresight<D>::finish(EventLoop<D>& loop, Limits& limits, Tile& tile) const {
  constexpr std::uint64_t kSteps = 4096;  // between two looks at the other tiles
  using Halt = typename EventLoop<D>::Halt;
  tile.base_due = false;
  for (std::uint64_t before = 0; !limits.exceeded;) {
    const Halt halt = loop.advance(window_->end, kNoLimit, loop.counts().steps() + kSteps);
    const std::uint64_t now = loop.counts().collisions();
    const auto all = static_cast<double>(limits.collisions += now - std::exchange(before, now));
    if (halt == Halt::Time) return true;
    if (halt == Halt::BaseDue) tile.base_due = true;
    const bool crowded = static_cast<double>(now * tiles_.size()) > limits.most;
    if (all > limits.most || (crowded && limits.stop.made())) limits.exceeded = true;
  }
  return false;
}

template <int D>
void Foresight<D>::run(const ParticleStates<D>& gas, Limits& limits, Tile& tile, Bench& bench) {
  if (limits.exceeded) return;
  const double end = window_->end;
  const Subdomain<D> subdomain = subdomain_of(tile);
  TileRecord<D>& record = bench.record;
  gather(gas, tile, subdomain, record);
  for (int axis = 0; axis < D; ++axis) record.cut[axis] = static_cast<float>(cut_[axis]);
  record.events.clear();
  record.keeps_events = window_->keep_events;
  record.pair_collisions = record.wall_collisions = 0;
  EventLoop<D>& loop = bench.loop;
  loop.load(gas, grains_, grid_sizes_, subdomain, record, end_, end);
  if (!finish(loop, limits, tile)) return;
  tile.pair_collisions = record.pair_collisions;
  tile.wall_collisions = record.wall_collisions;
  tile.checks = loop.checks();
  tile.events.clear();
  for (const ForeseenEvent<D>& found : record.events) {
    ForeseenEvent<D>& event = tile.events.emplace_back(found);
    event.event.particle = record.numbers[event.event.particle];
    if (event.event.partner < kPiece) event.event.partner = record.numbers[event.event.partner];
  }
  loop.skip_to(end);
  loop.note_all_strays();
  tile.copies.clear();
  tile.farthest = 0.0;
  tile.exposure = -kNever;
  std::array<float, D> lower, upper;  // of the core, from the corner of the subdomain
  for (int axis = 0; axis < D; ++axis) {
    const double corner = subdomain.lower[axis];
    lower[axis] = static_cast<float>(tile.from[axis] * block_widths_[axis] - corner);
    upper[axis] = static_cast<float>(tile.to[axis] * block_widths_[axis] - corner);
  }
  for (std::size_t k = 0; k < record.numbers.size(); ++k) {
    const auto& [home, squared_way] = record.strays[k];
    const float strayed = std::sqrt(squared_way);
    float depth = std::numeric_limits<float>::infinity(), square = 0.0f;
    for (int axis = 0; axis < D; ++axis) {
      if (cut_[axis] == 0.0) continue;
      const float below = lower[axis] - home[axis];
      const float above = home[axis] - upper[axis];
      const float out = std::max({0.0f, below, above});
      square += out * out;
      for (const int side : {0, 1}) {
        if (subdomain.ends[static_cast<std::size_t>(2 * axis + side)] == End::Open) {
          depth = std::min(depth, -(side ? above : below));
        }
      }
    }
    const std::uint32_t number = record.numbers[k];
    if (record.own[k]) {
      ends_.copy(number, loop.gas(), k);
      strayed_[number] = strayed;
      tile.farthest = std::max(tile.farthest, double{strayed});
      tile.exposure = std::max(tile.exposure, double{strayed - depth});
    } else {
      tile.copies.push_back({number, strayed, std::sqrt(square), loop.particles()[k].flight});
    }
  }
}

// Whether two flights are the same in every bit.
template <int D>
static bool same(const Flight<D>& a, const Flight<D>& b) {
  return a.number == b.number && std::memcmp(&a.time, &b.time, sizeof a.time) == 0 &&
         std::memcmp(a.r.data(), b.r.data(), sizeof(double) * D) == 0 &&
         std::memcmp(a.v.data(), b.v.data(), sizeof(double) * D) == 0;
}

// `farthest` is the longest way of all particles, and `bend` the part of a way that parabolas add.
template <int D>
void Foresight<D>::certify(Tile& tile, double farthest, double bend) const {
  // More than the rounding of distances in single precision.
  const double extent =
      (tile.to - tile.from).template cast<double>().cwiseProduct(block_widths_).dot(cut_);
  const double rounding = 1e-3 * model_.diameter + 1e-6 * extent;
  Certificate certificate(tile.width, model_.diameter + rounding, farthest);
  for (const Copy& copy : tile.copies) {
    if (same<D>(ends_.particles[copy.number].flight, copy.end)) continue;
    certificate.add_wrong_copy(copy.strayed, strayed_[copy.number], copy.distance);
  }
  tile.lack = certificate.lack(tile.exposure, bend);
}

// The speed that a wall gives to particles at rest.
static double speed_of(const Wall& wall) {
  const double along = wall.surface<3>().norm();
  if (wall.kind == WallKind::Thermal) return std::sqrt(wall.temperature) + along;
  return wall.drive_speed + std::numbers::pi * wall.stroke * wall.frequency + along;
}

// A speed that the gas has now or may soon have: the thermal one, or a fraction of the largest
// speed of particles and walls, so that a gas at equilibrium has the thermal one.
template <int D>
double Foresight<D>::speed_scale(const ParticleStates<D>& gas) const {
  constexpr double kOfFastest = 0.01, kOfWalls = 1.0 / 3.0;
  double squares = 0.0, largest = 0.0;
  for (const Particle<D>& particle : gas.particles) {
    const double square = particle.flight.velocity_at(end_, model_.gravity).squaredNorm();
    squares += square;
    largest = std::max(largest, square);
  }
  const auto count = static_cast<double>(gas.particles.size());
  double scale = std::max({std::sqrt(squares / (D * count)), kOfFastest * std::sqrt(largest),
                           std::sqrt(model_.gravity.norm() * model_.diameter)});
  model_.for_walls([&](const Wall& wall) { scale = std::max(scale, kOfWalls * speed_of(wall)); });
  return scale;
}

// The length of a full window now. A gas that is colder than its drive has few collisions now, and
// may have many soon.
template <int D>
double Foresight<D>::full_span(const ParticleStates<D>& gas) const {
  constexpr double kFirst = 0.1;  // diameters
  const double speed = speed_scale(gas);
  // A gas at rest has no scale of time: no window.
  if (!(speed > 0.0)) return 0.0;
  const auto count = static_cast<double>(gas.particles.size());
  const double free_path = model_.box.prod() / (count * std::pow(model_.diameter, D - 1));
  double span = std::max(kFirst * model_.diameter, sizes_.collisions * free_path) / speed;
  if (rate_ > 0.0) span = std::min(span, typical_window() / rate_);
  return std::min(span, span_ > 0.0 ? 2.0 * span_ : kFirst * model_.diameter / speed);
}

// A round with more collisions, copies included, fails. A window of the expected length has a
// quarter of them.
template <int D>
double Foresight<D>::most_collisions() const {
  constexpr double kMore = 4.0;
  double copies = 1.0;  // of each particle, with the particle itself
  for (int axis = 0; axis < D; ++axis) {
    if (cut_[axis] == 0.0) continue;
    const double core = model_.box[axis] / tile_counts_[axis];
    copies *= std::min(1.0 + 2.0 * halo_ / core, static_cast<double>(tile_counts_[axis]));
  }
  return kMore * copies * std::max(typical_window(), static_cast<double>(order_.size()));
}

// Chooses the width of the next window's halos from the widths that this window has shown to be
// sufficient. At the best width about one tile in thirty is redone.
template <int D>
void Foresight<D>::fit_halo() {
  std::vector<double> lacks;
  for (const Tile& tile : tiles_) lacks.push_back(tile.lack);
  const auto place = lacks.begin() + static_cast<std::ptrdiff_t>(29 * lacks.size() / 30);
  std::nth_element(lacks.begin(), place, lacks.end());
  constexpr double kSlowly = 0.1;
  const double wanted = halo_ + (*place > 0.0 ? 1.0 : kSlowly) * *place;
  halo_ = std::clamp(wanted, model_.diameter, std::max(edge_, model_.diameter));
}

// Begins a window. Returns whether it has a length.
template <int D>
bool Foresight<D>::begin_window(const ParticleStates<D>& gas, double horizon, double most,
                                bool keep_events) {
  const double full = end_ + full_span(gas);
  const double useful = rate_ > 0.0 ? std::min(horizon, end_ + most / rate_) : horizon;
  const double end = std::min(full, useful);
  if (!(end > end_)) return false;
  sort_into_blocks(gas);
  window_ = {.end = end,
             .is_cut = end < full,
             .keep_events = keep_events,
             .todo = std::vector<std::size_t>(tiles())};
  for (std::size_t k = 0; k < tiles(); ++k) {
    window_->todo[k] = k;
    tiles_[k].halo = halo_;
  }
  ++work_.windows;
  return true;
}

// Looks for the certificates of all tiles. Those without one run again, with wider halos.
template <int D>
void Foresight<D>::certify_all(Window& window) {
  const double span = window.end - end_;
  const double bend = model_.gravity.norm() * span * span / 8.0;
  double farthest = 0.0;
  for (const Tile& tile : tiles_) farthest = std::max(farthest, tile.farthest);
  in_parallel(benches_.size(), tiles(),
              [&](std::size_t k, std::size_t) { certify(tiles_[k], farthest, bend); });
  for (std::size_t k = 0; k < tiles(); ++k) {
    Tile& tile = tiles_[k];
    if (tile.lack < 0.0) continue;
    window.todo.push_back(k);
    tile.halo = std::max(kGrowth * tile.halo, tile.halo + 1.2 * tile.lack);
  }
  if (window.rounds++ == 0 && !window.is_cut) fit_halo();
}

// Runs the tiles of the window until all have a certificate.
template <int D>
typename Foresight<D>::Outcome Foresight<D>::run_rounds(const ParticleStates<D>& gas,
                                                        const StopRequest& stop) {
  constexpr int kRounds = 6;
  constexpr double kWidest = 2.0;  // edges of a tile
  std::vector<std::size_t>& todo = window_->todo;
  while (!todo.empty() && window_->rounds < kRounds) {
    // Tiles that are mostly halo do not pay.
    if (std::ranges::any_of(todo, [&](std::size_t k) { return tiles_[k].halo > kWidest * edge_; }))
      return Outcome::Failed;
    Limits limits{stop, most_collisions()};
    const std::size_t count = in_parallel(
        benches_.size(), todo.size(),
        [&](std::size_t k, std::size_t thread) {
          run(gas, limits, tiles_[todo[k]], *benches_[thread]);
        },
        stop);
    work_.all += limits.collisions;
    if (limits.exceeded) {
      constexpr double kShorter = 1.0 / 16.0;
      span_ = kShorter * (window_->end - end_);
      return Outcome::Failed;
    }
    work_.tiles += count;
    if (window_->rounds > 0) work_.redone += count;
    todo.erase(todo.begin(), todo.begin() + static_cast<std::ptrdiff_t>(count));
    if (!todo.empty()) return Outcome::Paused;
    certify_all(*window_);
  }
  return todo.empty() ? Outcome::Done : Outcome::Failed;
}

// Runs the next window, or the rest of the interrupted one if it suits, up to `horizon` at most.
template <int D>
typename Foresight<D>::Outcome Foresight<D>::run_window(const ParticleStates<D>& gas,
                                                        double horizon, double most,
                                                        bool keep_events, const StopRequest& stop) {
  const bool goes_on = window_ && window_->keep_events == keep_events && window_->end <= horizon;
  if (!goes_on && !begin_window(gas, horizon, most, keep_events)) return Outcome::Failed;
  const Outcome outcome = run_rounds(gas, stop);
  if (outcome == Outcome::Failed) window_.reset();
  return outcome;
}

// Ends a window whose tiles all have a certificate, and notes its rate of collisions. After a cut
// window the next one may be full again.
template <int D>
void Foresight<D>::note_window() {
  const double end = window_->end, span = end - end_;
  span_ = window_->is_cut ? std::max(span_, span) : span;
  window_.reset();
  std::uint64_t found = 0;
  for (const Tile& tile : tiles_) found += tile.pair_collisions + tile.wall_collisions;
  work_.own += found;
  rate_ = std::max(static_cast<double>(found) / span, 0.5 * rate_);
  end_ = end;
  fresh_ = false;
}

template <int D>
typename Foresight<D>::Outcome Foresight<D>::look_ahead(const ParticleStates<D>& gas,
                                                        double horizon, std::uint64_t most,
                                                        const StopRequest& stop) {
  constexpr double kMore = 1.01;  // than the expected part of `most`
  const double start = end_;
  const Outcome outcome =
      run_window(gas, horizon, kMore * static_cast<double>(most) + 1.0, true, stop);
  if (outcome != Outcome::Done) return outcome;
  note_window();
  std::vector<std::span<const ForeseenEvent<D>>> lists;
  for (const Tile& tile : tiles_) lists.emplace_back(tile.events);
  events_.join(lists, start, end_, benches_.size());
  return outcome;
}

template <int D>
typename Foresight<D>::Outcome Foresight<D>::advance(EventLoop<D>& gas, double horizon,
                                                     std::uint64_t most, const StopRequest& stop) {
  const Outcome outcome = run_window(gas.gas(), horizon, static_cast<double>(most), false, stop);
  if (outcome != Outcome::Done) return outcome;
  std::uint64_t pairs = 0, walls = 0;
  RunChecks checks;
  bool base_due = false;
  for (const Tile& tile : tiles_) {
    base_due = base_due || tile.base_due;
    pairs += tile.pair_collisions;
    walls += tile.wall_collisions;
    checks.deepest_overlap = std::max(checks.deepest_overlap, tile.checks.deepest_overlap);
    checks.clock_steps_back = std::max(checks.clock_steps_back, tile.checks.clock_steps_back);
  }
  if (base_due || pairs + walls >= most) {
    window_.reset();
    return Outcome::Failed;
  }
  note_window();
  gas.adopt(ends_, end_, pairs, walls, checks);
  return outcome;
}

template class Foresight<2>;
template class Foresight<3>;

}  // namespace clatter
