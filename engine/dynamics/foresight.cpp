#include "engine/dynamics/foresight.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <thread>
#include <utility>

#include "engine/dynamics/cell_of.h"

namespace clatter {

template <int D>
Foresight<D>::Foresight(const Model<D>& model, const Boundary<D>& boundary, std::size_t particles,
                        int threads, const Sizes& sizes)
    : model_(model),
      boundary_(boundary),
      sizes_(sizes),
      halo_(sizes.halo * model.diameter),
      block_of_(particles),
      order_(particles),
      ends_(particles),
      strayed_(particles) {
  constexpr double kInBlock = 32.0;  // particles
  const auto count = static_cast<double>(particles);
  const double volume = model.box.prod() / count;  // of a particle
  const double tile = std::pow(sizes.tile * volume, 1.0 / D);
  const double block = std::pow(kInBlock * volume, 1.0 / D);
  int blocks = 1;
  for (int axis = 0; axis < D; ++axis) {
    const double side = model.box[axis];
    tile_counts_[axis] = std::max(1, static_cast<int>(std::lround(side / tile)));
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

template <int D>
void Foresight<D>::restart(double time) {
  end_ = time;
  events_.clear();
  waiting_.clear();
  at_ = 0;
}

template <int D>
void Foresight<D>::pop() {
  if (from_waiting_) {
    waiting_.pop_back();
  } else {
    ++at_;
  }
}

// Calls work(k, bench) for k = 0 ... count - 1, on all threads.
template <int D>
void Foresight<D>::in_parallel(std::size_t count,
                               const std::function<void(std::size_t, Bench&)>& work) {
  std::atomic<std::size_t> next{0};
  const auto take = [&](Bench& bench) {
    for (std::size_t k; (k = next.fetch_add(1)) < count;) work(k, bench);
  };
  std::vector<std::jthread> threads;
  for (std::size_t k = 1; k < std::min(benches_.size(), count); ++k) {
    threads.emplace_back([&, k] { take(*benches_[k]); });
  }
  take(*benches_[0]);
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
  in_parallel(parts, [&](std::size_t k, Bench&) {
    auto& counts = benches_[k]->offsets;
    counts.assign(blocks, 0);
    for (std::size_t i = part(k); i < part(k + 1); ++i) {
      const Vec<D> place = model_.wrapped(gas.particles[i].flight.at(end_, model_.gravity));
      const auto block = static_cast<std::uint32_t>(
          cell_of<D>(place, block_widths_, block_counts_).dot(strides));
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
  in_parallel(parts, [&](std::size_t k, Bench&) {
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

// Collects the particles of a tile and its halo, by ascending number, so that simultaneous events
// have the same order as in the whole gas.
template <int D>
void Foresight<D>::gather(const ParticleStates<D>& gas, const Tile& tile,
                          const Subdomain<D>& subdomain, Bench& bench) const {
  auto& unsorted = bench.unsorted;
  unsorted.clear();
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
  for (int k = 0; k < extent.prod(); ++k) {
    int rest = k, index = 0, stride = 1;
    bool own = true;
    Vec<D> boxes = Vec<D>::Zero();
    for (int axis = 0; axis < D; ++axis) {
      int at = from[axis] + rest % extent[axis];
      rest /= extent[axis];
      own = own && at >= tile.from[axis] && at < tile.to[axis];
      const int count = block_counts_[axis];
      const int box = at < 0 ? -1 : at >= count ? 1 : 0;
      boxes[axis] = box;
      index += (at - box * count) * stride;
      stride *= count;
    }
    for (std::uint32_t p = first_[static_cast<std::size_t>(index)];
         p < first_[static_cast<std::size_t>(index) + 1]; ++p) {
      const std::uint32_t number = order_[p];
      const Vec<D> r = gas.particles[number].flight.at(end_, model_.gravity);
      const Vec<D> image = model_.image_index(r) - boxes;
      const Vec<D> home = r - image.cwiseProduct(model_.box);
      const bool inside = ((home - subdomain.lower).array() >= 0.0).all() &&
                          ((subdomain.upper - home).array() >= 0.0).all();
      if (own || inside) unsorted.push_back({number, own, home, image});
    }
  }
  // A radix sort of the numbers.
  constexpr unsigned kBits = 11;
  const std::size_t size = unsorted.size();
  bench.keys.resize(size);
  bench.sorted.resize(size);
  for (std::size_t k = 0; k < size; ++k) bench.keys[k] = (std::uint64_t{unsorted[k].number} << 32) | k;
  for (unsigned shift = 32; shift < 64 && (order_.size() >> (shift - 32)) > 0; shift += kBits) {
    std::array<std::uint32_t, (1u << kBits) + 1> place{};
    const auto digit = [&](std::uint64_t key) { return (key >> shift) & ((1u << kBits) - 1); };
    for (const std::uint64_t key : bench.keys) ++place[digit(key) + 1];
    for (std::size_t k = 1; k < place.size(); ++k) place[k] += place[k - 1];
    for (const std::uint64_t key : bench.keys) bench.sorted[place[digit(key)]++] = key;
    bench.keys.swap(bench.sorted);
  }
  bench.record.members.clear();
  for (const std::uint64_t key : bench.keys) {
    bench.record.members.push_back(unsorted[static_cast<std::uint32_t>(key)]);
  }
}

template <int D>
void Foresight<D>::run(const ParticleStates<D>& gas, double end, std::uint64_t most, Tile& tile,
                       Bench& bench) {
  const Subdomain<D> subdomain = subdomain_of(tile);
  gather(gas, tile, subdomain, bench);
  TileRecord<D>& record = bench.record;
  record.cut = cut_;
  record.events.clear();
  EventLoop<D>& loop = bench.loop;
  loop.load(gas, subdomain, record, end_);
  using Halt = typename EventLoop<D>::Halt;
  Halt halt;
  do {
    halt = loop.advance(end, most, kNoLimit);
  } while (halt == Halt::BaseDue);
  tile.overrun = halt != Halt::Time;
  tile.collisions = loop.counts().collisions();
  tile.events.assign(record.events.begin(), record.events.end());
  tile.copies.clear();
  tile.farthest = 0.0;
  tile.exposure = -kNever;
  Vec<D> lower, upper;
  for (int axis = 0; axis < D; ++axis) {
    lower[axis] = tile.from[axis] * block_widths_[axis];
    upper[axis] = tile.to[axis] * block_widths_[axis];
  }
  loop.skip_to(end);
  loop.note_all_strays();
  for (std::size_t k = 0; k < record.members.size(); ++k) {
    const auto& member = record.members[k];
    const Flight<D>& flight = loop.particles()[k].flight;
    constexpr double kUp = 1.0 + 1e-6;  // covers the rounding to single precision
    const double strayed = std::sqrt(member.strayed) * kUp;
    double depth = kNever, square = 0.0;
    for (int axis = 0; axis < D; ++axis) {
      if (cut_[axis] == 0.0) continue;
      const double below = lower[axis] - member.home[axis];
      const double above = member.home[axis] - upper[axis];
      const double out = std::max({0.0, below, above});
      square += out * out;
      for (const int side : {0, 1}) {
        if (subdomain.ends[static_cast<std::size_t>(2 * axis + side)] == End::Open) {
          depth = std::min(depth, -(side ? above : below));
        }
      }
    }
    if (member.own) {
      ends_[member.number] = flight;
      strayed_[member.number] = static_cast<float>(strayed);
      tile.farthest = std::max(tile.farthest, strayed);
      tile.exposure = std::max(tile.exposure, strayed - depth);
    } else {
      tile.copies.push_back({member.number, static_cast<float>(strayed),
                             static_cast<float>(std::sqrt(square) / kUp), flight});
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

// A tile is certified if no particle that it has wrongly, or not at all, could reach one of its own
// particles. `farthest` is the longest way of all particles, and `bend` the part of a way that
// parabolas add.
template <int D>
void Foresight<D>::certify(Tile& tile, double farthest, double bend) const {
  double reach = farthest - tile.width;
  for (const Copy& copy : tile.copies) {
    if (same<D>(ends_[copy.number], copy.end)) continue;
    const double way = std::max(copy.strayed, strayed_[copy.number]);
    reach = std::max(reach, way - copy.distance);
  }
  const double contact = 1.001 * model_.diameter;
  tile.certified = reach + tile.exposure + 2.0 * bend + contact < 0.0;
}

template <int D>
bool Foresight<D>::look_ahead(const ParticleStates<D>& gas, double horizon, std::uint64_t most) {
  constexpr double kMaxHalo = 1.5;  // growth of the halo of a tile that is redone
  constexpr int kRounds = 6;
  const auto count = static_cast<double>(gas.particles.size());
  events_.clear();
  waiting_.clear();
  at_ = 0;
  const double wanted = 0.5 * sizes_.collisions * count;
  double span;
  if (rate_ > 0.0) {
    span = std::min(wanted, 1.01 * static_cast<double>(most) + 1.0) / rate_;
  } else {
    double square = 0.0;
    for (const Particle<D>& particle : gas.particles) {
      square += particle.flight.velocity_at(end_, model_.gravity).squaredNorm();
    }
    span = 0.1 * model_.diameter / std::sqrt(square / (D * count));
  }
  const double start = end_, end = std::min(horizon, start + span);
  if (!(end > start)) return false;
  const double bend = model_.gravity.norm() * (end - start) * (end - start) / 8.0;
  sort_into_blocks(gas);
  for (Tile& tile : tiles_) tile.halo = halo_;
  std::vector<std::size_t> todo(tiles_.size());
  for (std::size_t k = 0; k < todo.size(); ++k) todo[k] = k;
  ++work_.windows;
  std::size_t failed_first = 0;
  for (int round = 0; !todo.empty(); ++round) {
    if (round == kRounds) return false;
    in_parallel(todo.size(), [&](std::size_t k, Bench& bench) {
      // A tile with far more events than others may collapse.
      const auto limit = static_cast<std::uint64_t>(100.0 * sizes_.tile * sizes_.collisions);
      run(gas, end, limit, tiles_[todo[k]], bench);
    });
    work_.tiles += todo.size();
    if (round > 0) work_.redone += todo.size();
    double farthest = 0.0;
    for (const Tile& tile : tiles_) {
      if (tile.overrun) return false;
      farthest = std::max(farthest, tile.farthest);
    }
    for (const std::size_t k : todo) work_.all += tiles_[k].collisions;
    in_parallel(tiles_.size(),
                [&](std::size_t k, Bench&) { certify(tiles_[k], farthest, bend); });
    todo.clear();
    for (std::size_t k = 0; k < tiles_.size(); ++k) {
      if (tiles_[k].certified) continue;
      todo.push_back(k);
      tiles_[k].halo *= kMaxHalo;
    }
    if (round == 0) failed_first = todo.size();
  }
  // About one tile in thirty is redone at the best width.
  halo_ *= 30 * failed_first > tiles_.size() ? 1.05 : 0.99;
  merge(start, end);
  const auto found = static_cast<double>(events_.size());
  work_.own += events_.size();
  rate_ = found > 0.0 ? found / (end - start) : 0.5 * rate_;
  if (rate_ == 0.0) return false;
  end_ = end;
  return true;
}

// Joins the tiles' events in order. Each part of the window is sorted by one thread.
template <int D>
void Foresight<D>::merge(double start, double end) {
  const auto sooner = [](const ForeseenEvent<D>& a, const ForeseenEvent<D>& b) {
    return before(a.event, b.event);
  };
  std::size_t total = 0;
  for (const Tile& tile : tiles_) total += tile.events.size();
  constexpr std::size_t kInPart = 4096;
  const std::size_t parts = total / kInPart + 1;
  const auto bound = [&](std::size_t part) {
    return start + (end - start) * static_cast<double>(part) / static_cast<double>(parts);
  };
  std::vector<std::size_t> cuts((parts + 1) * tiles_.size());
  in_parallel(tiles_.size(), [&](std::size_t k, Bench&) {
    const auto& events = tiles_[k].events;
    std::size_t at = 0;
    for (std::size_t part = 0; part < parts; ++part) {
      const double from = part ? bound(part) : -kNever;
      while (at < events.size() && events[at].event.time < from) ++at;
      cuts[part * tiles_.size() + k] = at;
    }
    cuts[parts * tiles_.size() + k] = events.size();
  });
  std::vector<std::size_t> begins(parts + 1);
  for (std::size_t part = 0; part < parts; ++part) {
    std::size_t size = 0;
    for (std::size_t k = 0; k < tiles_.size(); ++k) {
      size += cuts[(part + 1) * tiles_.size() + k] - cuts[part * tiles_.size() + k];
    }
    begins[part + 1] = begins[part] + size;
  }
  events_.resize(total);
  in_parallel(parts, [&](std::size_t part, Bench&) {
    ForeseenEvent<D>* at = events_.data() + begins[part];
    ForeseenEvent<D>* const first = at;
    for (std::size_t k = 0; k < tiles_.size(); ++k) {
      const ForeseenEvent<D>* const events = tiles_[k].events.data();
      at = std::copy(events + cuts[part * tiles_.size() + k],
                     events + cuts[(part + 1) * tiles_.size() + k], at);
    }
    std::sort(first, at, sooner);
  });
  // Rounding may put an event a little before its cause, into the wrong part.
  for (std::size_t k = 1; k < total; ++k) {
    for (std::size_t at = k; at > 0 && sooner(events_[at], events_[at - 1]); --at) {
      std::swap(events_[at], events_[at - 1]);
    }
  }
}

template class Foresight<2>;
template class Foresight<3>;

}  // namespace clatter
