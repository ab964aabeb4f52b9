#include "engine/dynamics/cell_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <type_traits>

namespace clatter {

// Smallest width of a cell without the overhangs of both neighbours, in diameters. It exceeds a
// diameter by more than any rounding of positions.
static constexpr double kMinWidth = 1.01;
static constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Numbers of cells along each axis, so that cells are nearly cubes. The shortest edge comes first:
// a narrow box then gets more cells along its long edges.
template <int D>
static IntVec<D> choose_counts(const Vec<D>& box, double diameter, double cells) {
  std::array<int, D> axes;
  std::iota(axes.begin(), axes.end(), 0);
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return box[a] < box[b]; });
  cells = std::max(1.0, cells);
  double volume = box.prod();
  IntVec<D> counts;
  for (int k = 0; k < D; ++k) {
    const double length = box[axes[k]];
    const double edge = std::max(std::pow(volume / cells, 1.0 / (D - k)), kMinWidth * diameter);
    const double count = std::max(1.0, std::floor(length / edge));
    counts[axes[k]] = static_cast<int>(count);
    cells = std::max(1.0, cells / count);
    volume /= length;
  }
  return counts;
}

namespace {

// Cells along each axis.
template <int D>
struct CellLayout {
  IntVec<D> counts;
  Vec<D> widths, overhangs;

  // Two particles whose cells are more than n cells apart along an axis have a distance of at least
  // n widths without the overhangs of both.
  int reach(double base, double diameter) const {
    constexpr double kMargin = 1.005;  // more than any rounding of positions
    if (diameter <= base) return 1;
    const Vec<D> ways = Vec<D>::Constant(0.5 * kMargin * (diameter + base)) + 2.0 * overhangs;
    return std::max(1, static_cast<int>(std::ceil(ways.cwiseQuotient(widths).maxCoeff())));
  }
};

}  // namespace

template <int D>
static CellLayout<D> lay_cells(const Vec<D>& extent, double base, double cells) {
  CellLayout<D> layout{
      .counts = choose_counts<D>(extent, base, cells), .widths = {}, .overhangs = {}};
  layout.widths = extent.cwiseQuotient(layout.counts.template cast<double>());
  layout.overhangs = 0.5 * (layout.widths - Vec<D>::Constant(kMinWidth * base)).cwiseMax(0.0);
  return layout;
}

// Largest strain of the cells of a sheared box, whose rows slide by whole cells.
static double most_strain(double width, double height) {
  constexpr double kUsual = 0.5, kLeastRange = 0.25;
  return std::max(kUsual, 0.5 * width / height + kLeastRange);
}

// The same in a sheared box. Along x, particles that touch are up to sqrt(1 + s^2) diameters apart
// in cells of the strain s.
template <int D>
static CellLayout<D> lay_sheared_cells(const Vec<D>& extent, double base, double cells) {
  constexpr double kUsualStretch = 1.12;
  Vec<D> shorter = extent;
  shorter[0] /= kUsualStretch;
  CellLayout<D> layout = lay_cells<D>(shorter, base, cells);
  for (int& count = layout.counts[0];; --count) {
    layout.widths[0] = extent[0] / count;
    const double stretch = std::hypot(1.0, most_strain(layout.widths[0], extent[1]));
    const double room = layout.widths[0] - kMinWidth * stretch * base;
    layout.overhangs[0] = 0.5 * std::max(0.0, room);
    if (room >= 0.0 || count == 1) return layout;
  }
}

// Whether a periodic box has so many cells that no particle touches another one through two images
// on its lists.
template <int D>
static bool is_wide(const CellLayout<D>& layout, const Subdomain<D>& subdomain,
                    const GridSizes& sizes) {
  const int reach = layout.reach(sizes.base, sizes.largest);
  for (int axis = 0; axis < D; ++axis) {
    if (subdomain.ends[static_cast<std::size_t>(2 * axis)] != End::Periodic) continue;
    const int others = layout.counts[axis] - 1;
    const double contact = kMinWidth * sizes.largest + 2.0 * layout.overhangs[axis];
    if (reach > others || contact > others * layout.widths[axis]) return false;
  }
  return true;
}

template <int D>
CellGrid<D>::CellGrid(const Subdomain<D>& subdomain, const GridSizes& sizes, double cells) {
  reset(subdomain, sizes, cells);
}

template <int D>
void CellGrid<D>::reset(const Subdomain<D>& subdomain, const GridSizes& sizes, double cells) {
  subdomain_ = subdomain;
  sizes_ = sizes;
  base_ = sizes.base;
  open_ = subdomain.open();
  slides_ = subdomain.ends[2] == End::Sliding;
  cells_ = cells;
  const Vec<D> extent = subdomain.upper - subdomain.lower;
  const auto lay = [&] {
    return slides_ ? lay_sheared_cells<D>(extent, base_, cells)
                   : lay_cells<D>(extent, base_, cells);
  };
  CellLayout<D> layout = lay();
  if (base_ < sizes.largest && !is_wide(layout, subdomain, sizes)) {
    base_ = sizes.largest;
    layout = lay();
  }
  counts_ = layout.counts;
  widths_ = layout.widths;
  overhangs_ = layout.overhangs;
  margin_ = reach_of(sizes_.largest);
  int stride = 1;
  for (int axis = 0; axis < D; ++axis) {
    const int count = counts_[axis];
    auto& borders = borders_[axis];
    borders.clear();
    for (int cell = 0; cell < count; ++cell) {
      borders.push_back(subdomain.lower[axis] + (cell * widths_[axis] - overhangs_[axis]));
      borders.push_back(subdomain.lower[axis] + ((cell + 1) * widths_[axis] + overhangs_[axis]));
    }
    strides_[axis] = stride;
    auto& places = places_[axis];
    places.assign(static_cast<std::size_t>(count + 2 * margin_), Place{});
    for (int cell = 0; cell < count; ++cell) {
      places[static_cast<std::size_t>(cell + margin_)].index =
          static_cast<std::uint32_t>(cell * stride);
    }
    const auto end = [&](int upper) {
      return subdomain.ends[static_cast<std::size_t>(2 * axis + upper)];
    };
    if (end(0) == End::Periodic || end(0) == End::Sliding) {
      // Seen from beyond the low border, the box is one length higher; from beyond the high border,
      // one length lower.
      const auto wrap = [&](unsigned bits) {
        return Neighbour{bits} << (kParticleBits<D> + 2 * axis);
      };
      for (int beyond = 1; beyond <= margin_; ++beyond) {
        const auto index_of = [&](int cell) { return static_cast<std::uint32_t>(cell * stride); };
        places[static_cast<std::size_t>(margin_ - beyond)] = {index_of(count - beyond), wrap(0b01)};
        places[static_cast<std::size_t>(margin_ + count - 1 + beyond)] = {index_of(beyond - 1),
                                                                          wrap(0b11)};
      }
    }
    if (end(0) == End::Wall) borders.front() = -kInfinity;
    if (end(1) == End::Wall) borders.back() = kInfinity;
    stride *= count;
  }
  lists_.assign(static_cast<std::size_t>(stride), List{});
  continuations_ = {};
  flow_ends_ = kNever;
}

template <int D>
void CellGrid<D>::clear() {
  lists_.assign(lists_.size(), List{});
  continuations_ = {};
}

// The strain at which the border has slid by a whole number of cells is a multiple of the width of
// a cell over the height of the box.
template <int D>
void CellGrid<D>::lay_with_flow(const Domain<D>& domain, double now) {
  if (!slides_) return;
  const double height = domain.box[1], width = widths_[0];
  const double most = most_strain(width, height);
  strain_rate_ = domain.slide / height;
  const double offset = domain.offset + domain.slide * now;
  // As far back as possible, so that the cells serve long.
  const double wanted = -std::copysign(std::max(0.0, most - 0.5 * width / height), domain.slide);
  const double cells = std::round((offset - wanted * height) / width);
  const double strain = (offset - cells * width) / height;
  const double boxes = std::round(cells / counts_[0]);
  slid_ = static_cast<int>(cells - boxes * counts_[0]);
  boxes_slid_ = static_cast<int>(boxes);
  strain_ = strain - strain_rate_ * now;
  flow_ends_ = kNever;
  if (strain_rate_ == 0.0) return;
  flow_ends_ = now + (most - std::copysign(1.0, strain_rate_) * strain) / std::fabs(strain_rate_);
}

template <int D>
IntVec<D> CellGrid<D>::cell_at(const Vec<D>& position) const {
  return cell_of<D>(position - subdomain_.lower, widths_, counts_);
}

template <int D>
int CellGrid<D>::wide_reach(double diameter) const {
  return CellLayout<D>{counts_, widths_, overhangs_}.reach(base_, diameter);
}

// Calls act(reach) with a constant for the usual reach, so that loops over lists are unrolled.
template <class Act>
[[gnu::always_inline]] static inline void with_reach(int reach, const Act& act) {
  if (reach == 1) [[likely]] {
    act(std::integral_constant<int, 1>());
  } else {
    act(reach);
  }
}

template <int D>
void CellGrid<D>::insert(std::uint32_t particle, const IntVec<D>& cell, int reach) {
  with_reach(reach, [&](auto reach) {
    visit_lists<D - 1>(about(cell, reach), 0, 0, [&](std::uint32_t list, Neighbour wrap) {
      continuations_.put_on(lists_[list], particle | wrap);
    });
  });
}

template <int D>
void CellGrid<D>::sort(const std::vector<IntVec<D>>& cells, std::vector<std::uint32_t>& order,
                       std::vector<std::uint32_t>& starts) const {
  // The particles of a cell have the places from starts[index] on, up to those of the next cell.
  starts.assign(lists_.size() + 1, 0);
  for (const IntVec<D>& cell : cells) ++starts[index(cell) + 1];
  for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
  order.resize(cells.size());
  std::vector<std::uint32_t> places(starts.begin(), starts.end() - 1);
  for (std::uint32_t k = 0; k < cells.size(); ++k) order[places[index(cells[k])]++] = k;
}

template <int D>
void CellGrid<D>::fill(const std::vector<IntVec<D>>& cells, std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> starts;
  sort(cells, order, starts);
  IntVec<D> cell = IntVec<D>::Zero();
  for (List& list : lists_) {
    if (!fill_by_rows(list, cell, starts)) fill_by_cells(list, cell, starts);
    for (int axis = 0; axis < D && ++cell[axis] == counts_[axis]; ++axis) cell[axis] = 0;
  }
}

// Fills the list of a cell that has all its neighbours without a wrap. Three cells in a row hold
// successive numbers. A row is written in one piece of constant length, because the number of its
// particles is unpredictable. Returns false, and changes nothing, for other cells, and for lists or
// rows that are too long.
template <int D>
bool CellGrid<D>::fill_by_rows(List& list, const IntVec<D>& cell,
                               const std::vector<std::uint32_t>& starts) const {
  constexpr std::uint32_t kPiece = 8;
  for (int axis = 0; axis < D; ++axis) {
    if (cell[axis] == 0 || cell[axis] == counts_[axis] - 1) return false;
  }
  std::array<Neighbour, kCapacity + kPiece> neighbours;
  std::uint32_t count = 0;
  bool fits = true;
  visit_lists<D - 1>(row(cell, 0, cell[0] - 1), 0, 0, [&](std::uint32_t first, Neighbour) {
    const std::uint32_t start = starts[first], size = starts[first + 3] - start;
    for (std::uint32_t k = 0; k < kPiece; ++k) neighbours[count + k] = start + k;
    fits = fits && size <= kPiece && count + size <= kCapacity;
    count += fits ? size : 0;
  });
  if (!fits) return false;
  for (std::uint32_t k = 0; k < kCapacity; ++k) {
    list.neighbours[k] = k < count ? neighbours[k] : kNobody;
  }
  list.count = static_cast<std::uint16_t>(count);
  return true;
}

// Fills the list of any cell.
template <int D>
void CellGrid<D>::fill_by_cells(List& list, const IntVec<D>& cell,
                                const std::vector<std::uint32_t>& starts) {
  visit_lists<D - 1>(about(cell), 0, 0, [&](std::uint32_t near, Neighbour wrap) {
    // The wrap of this cell seen from there is the negative of that of there seen from here.
    constexpr Neighbour kOnes =
        D == 2 ? 0b0101u << kParticleBits<2> : 0b010101u << kParticleBits<3>;
    const Neighbour opposite = wrap ^ ((wrap & kOnes) << 1);
    for (std::uint32_t particle = starts[near]; particle < starts[near + 1]; ++particle) {
      continuations_.put_on(list, particle | opposite);
    }
  });
}

template <int D>
void CellGrid<D>::remove(std::uint32_t particle, const IntVec<D>& cell, int reach) {
  with_reach(reach, [&](auto reach) {
    visit_lists<D - 1>(about(cell, reach), 0, 0, [&](std::uint32_t list, Neighbour wrap) {
      continuations_.take_off(lists_[list], particle | wrap);
    });
  });
}

template <int D>
void CellGrid<D>::move(std::uint32_t particle, const IntVec<D>& cell, int axis, int step,
                       int reach) {
  const int next = cell[axis] + step;
  if (next < 0 || next == counts_[axis]) {
    // A particle that crosses a periodic border has another wrap in every list.
    remove(particle, cell, reach);
    insert(particle, neighbour(cell, axis, step), reach);
    return;
  }
  with_reach(reach, [&](auto reach) {
    visit_lists<D - 1>(row(cell, axis, cell[axis] - reach * step, reach), 0, 0,
                       [&](std::uint32_t list, Neighbour wrap) {
                         continuations_.take_off(lists_[list], particle | wrap);
                       });
    visit_lists<D - 1>(row(cell, axis, next + reach * step, reach), 0, 0,
                       [&](std::uint32_t list, Neighbour wrap) {
                         continuations_.put_on(lists_[list], particle | wrap);
                       });
  });
}

template <int D>
Vec<D> CellGrid<D>::leave(std::uint32_t particle, IntVec<D>& cell, std::uint32_t border,
                          int reach) {
  const auto [axis, step] = crossing_of(border);
  const IntVec<D> next = neighbour(cell, axis, step);
  Vec<D> boxes = Vec<D>::Zero();
  if (next[axis] != cell[axis] + step) {
    boxes[axis] = step;
    if (slides_ && axis == 1) {
      boxes[0] = (cell[0] - step * slid_ - next[0]) / counts_[0] - step * boxes_slid_;
    }
  }
  move(particle, cell, axis, step, reach);
  cell = next;
  return boxes;
}

template <int D>
bool CellGrid<D>::fit(double particles, double near) {
  // Thresholds of the crowding: other particles near a particle per neighbouring cell, in cells for
  // the mean density. It is 1 for evenly spread points. Between kEven and kCrowded the cells stay
  // as they are (hysteresis).
  constexpr double kCellsAbout = D == 2 ? 9.0 : 27.0;
  constexpr double kEven = 9.5 / 9.0, kCrowded = 10.5 / 9.0, kWanted = 5.5 / 9.0;
  constexpr double kMax = 4.0;          // cells for each particle
  constexpr double kWorthwhile = 1.25;  // ratio of numbers of cells
  if (particles == 0.0) return false;
  const double others = near - particles;  // a particle is near itself
  const double cells = counts_.template cast<double>().prod();
  const double crowding = others * cells / (particles * particles * kCellsAbout);
  const double even = kCellsPerParticle * particles;
  const bool fine = crowding > (cells_ > even ? kEven : kCrowded);
  const double wanted = fine ? particles * std::min(crowding / kWanted, kMax) : even;
  if (std::max(wanted, cells_) < kWorthwhile * std::min(wanted, cells_)) return false;
  *this = CellGrid(subdomain_, sizes_, wanted);
  return true;
}

template <int D>
GridSizes grid_sizes(const Model<D>& model, const GrainArray& grains) {
  GridSizes best{model.diameter, model.diameter};
  // Cells of a sheared box, whose rows slide, have neighbours at a distance of one cell alone.
  if (grains.empty() || model.shear_rate) return best;
  // Particles of about the same size, and the mean size and mobility of all.
  struct Class {
    double count = 0.0, diameter = 0.0, mobility = 0.0;
  };
  constexpr double kClassesPerOctave = 8.0;
  std::map<int, Class> classes;
  const auto particles = static_cast<double>(grains.size());
  double mean = 0.0, mobility = 0.0;
  grains.for_each([&](const Grain& grain) {
    const double diameter = 2.0 * grain.radius;
    const double number = std::ceil(kClassesPerOctave * std::log2(diameter / model.diameter));
    Class& of = classes[static_cast<int>(number)];
    of.count += 1.0;
    of.diameter = std::max(of.diameter, diameter);
    of.mobility += 1.0 / grain.mass;
    mean += diameter / particles;
    mobility += 1.0 / (grain.mass * particles);
  });
  // Mean number of neighbours that a search reads; a list costs as much as some neighbours more.
  const auto cost_of = [&](double base) {
    constexpr double kPerList = 8.0;
    const CellLayout<D> layout =
        lay_cells<D>(model.box, base, CellGrid<D>::kCellsPerParticle * particles);
    const double cells = layout.counts.template cast<double>().prod();
    double on_list = 0.0, searches = 0.0, lists = 0.0;
    for (const auto& [number, of] : classes) {
      const int reach = layout.reach(base, of.diameter);
      const double rate = of.count * std::pow(of.diameter + mean, D - 1) *
                          std::sqrt(of.mobility / of.count + mobility);
      on_list += of.count * std::pow(2 * reach + 1, D) / cells;
      searches += rate;
      lists += rate * (reach == 1 ? 1.0 : std::pow(lists_along(reach), D));
    }
    return lists / searches * (kPerList + on_list);
  };
  double least = kInfinity;
  for (const auto& [number, of] : classes) {
    const double cost = cost_of(of.diameter);
    if (cost >= least) continue;
    least = cost;
    best.base = of.diameter;
  }
  return best;
}

template GridSizes grid_sizes(const Model<2>&, const GrainArray&);
template GridSizes grid_sizes(const Model<3>&, const GrainArray&);
template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace clatter
