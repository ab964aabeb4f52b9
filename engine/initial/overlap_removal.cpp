#include "engine/initial/overlap_removal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/dynamics/cell_of.h"

namespace clatter {

// A few small particles in a large box need no cells as small as they are.
template <int D>
OverlapRemoval<D>::Grid::Grid(const Vec<D>& box, double diameter, std::size_t particles) {
  const double allowed = std::max(65536.0, 4.0 * static_cast<double>(particles));
  double most = 1.0;  // cells along an axis
  while ((most + 1.0) * (most + 1.0) * (D == 2 ? 1.0 : most + 1.0) <= allowed) most += 1.0;
  std::size_t cells = 1;
  for (int axis = 0; axis < D; ++axis) {
    constexpr double kWider = 1.01;  // than the diameter
    const double fit = std::floor(box[axis] / (kWider * diameter));
    counts[axis] = static_cast<int>(std::clamp(fit, 1.0, most));
    widths[axis] = box[axis] / counts[axis];
    cells *= static_cast<std::size_t>(counts[axis]);
  }
  first.resize(cells + 1);
}

template <int D>
std::uint32_t OverlapRemoval<D>::Grid::index_of(const IntVec<D>& cell) const {
  int index = 0;
  for (int axis = D - 1; axis >= 0; --axis) index = index * counts[axis] + cell[axis];
  return static_cast<std::uint32_t>(index);
}

// The grids end with that of the smallest particle. Few sizes make few grids.
template <int D>
OverlapRemoval<D>::OverlapRemoval(const Domain<D>& domain, const std::vector<Grain>& grains,
                                  Random& random, const FixtureImages<D>& fixtures)
    : domain_(domain), fixtures_(fixtures), places_(grains.size()) {
  for (const Grain& grain : grains) {
    radii_.push_back(grain.radius);
    species_.push_back(grain.species);
  }
  const double largest = radii_.empty() ? 0.5 : *std::ranges::max_element(radii_);
  double smallest = largest;
  for (const double radius : radii_) smallest = std::min(smallest, radius);
  for (double radius = largest; grids_.empty() || radius >= smallest; radius *= 0.5) {
    grids_.emplace_back(domain.box, 2.0 * radius, radii_.size());
  }
  for (std::uint32_t i = 0; i < radii_.size(); ++i) {
    std::uint8_t level = 0;
    for (double radius = 0.5 * largest; radii_[i] <= radius && level + 1u < grids_.size();
         radius *= 0.5) {
      ++level;
    }
    levels_.push_back(level);
    grids_[level].members.push_back(i);
  }
  for (Grid& grid : grids_) {
    for (const std::uint32_t i : grid.members) place(i, random);
    sort_into_cells(grid);
  }
}

// Draws places until one is free, at most kTries times: the large particles may cover the box.
template <int D>
void OverlapRemoval<D>::place(std::uint32_t particle, Random& random) {
  constexpr int kTries = 100;
  for (int k = 0; k < kTries; ++k) {
    for (int axis = 0; axis < D; ++axis) {
      places_[particle][axis] = random.uniform() * domain_.box[axis];
    }
    keep_inside(particle);
    if (is_free(particle)) return;
  }
}

// Whether the centre is in no particle of a coarser grid, and the particle in no fixture.
template <int D>
bool OverlapRemoval<D>::is_free(std::uint32_t particle) const {
  const Vec<D>& centre = places_[particle];
  if (fixtures_.depth(centre, radii_[particle], species_[particle]) > 0.0) return false;
  for (std::size_t level = 0; level < levels_[particle]; ++level) {
    bool within = false;
    visit_near(grids_[level], centre, [&](std::uint32_t other) {
      const double radius = radii_[other];
      const double square = domain_.shortest(places_[other] - centre).squaredNorm();
      within = within || square < radius * radius;
    });
    if (within) return false;
  }
  return true;
}

template <int D>
bool OverlapRemoval<D>::advance(const StopRequest& pause) {
  constexpr int kPatience = 1000;  // sweeps without a clearly smaller overlap
  while (overlap_ > 0.0 && sweeps_ - best_sweep_ <= kPatience) {
    if (pause.made()) return false;
    for (Grid& grid : grids_) sort_into_cells(grid);
    overlap_ = sweep();
    ++sweeps_;
    if (sweeps_ == 1) first_ = overlap_;
    if (overlap_ >= 0.9 * best_) continue;
    best_ = overlap_;
    best_sweep_ = sweeps_;
  }
  return true;
}

template <int D>
double OverlapRemoval<D>::progress() const {
  if (sweeps_ == 0) return 0.0;
  return overlap_ > 0.0 ? std::max(0.0, 1.0 - overlap_ / first_) : 1.0;
}

template <int D>
std::vector<Vec<D>> OverlapRemoval<D>::take() {
  return overlap_ > 0.0 ? std::vector<Vec<D>>() : std::exchange(places_, {});
}

// A counting sort.
template <int D>
void OverlapRemoval<D>::sort_into_cells(Grid& grid) {
  std::vector<std::uint32_t> cells;
  std::ranges::fill(grid.first, 0);
  for (const std::uint32_t i : grid.members) {
    const auto cell = grid.index_of(cell_of<D>(places_[i], grid.widths, grid.counts));
    cells.push_back(cell);
    ++grid.first[cell + 1];
  }
  for (std::size_t k = 1; k < grid.first.size(); ++k) grid.first[k] += grid.first[k - 1];
  grid.order.resize(grid.members.size());
  std::vector<std::uint32_t> next(grid.first.begin(), grid.first.end() - 1);
  for (std::size_t k = 0; k < cells.size(); ++k) grid.order[next[cells[k]]++] = grid.members[k];
}

// Calls `visit` with each particle of a grid in the cell of a place and in the adjacent ones.
template <int D>
template <typename Visit>
void OverlapRemoval<D>::visit_near(const Grid& grid, const Vec<D>& place, Visit visit) const {
  if (grid.members.empty()) return;
  const IntVec<D> own = cell_of<D>(place, grid.widths, grid.counts);
  IntVec<D> step = IntVec<D>::Constant(-1);
  while (step[D - 1] <= 1) {
    IntVec<D> cell = own + step;
    bool exists = true;
    for (int axis = 0; axis < D; ++axis) {
      const int count = grid.counts[axis];
      if (cell[axis] >= 0 && cell[axis] < count) continue;
      exists = exists && domain_.periodic[axis] && count >= 3;
      cell[axis] -= cell[axis] < 0 ? -count : count;
    }
    const std::uint32_t index = exists ? grid.index_of(cell) : 0;
    const std::uint32_t end = exists ? grid.first[index + 1] : grid.first[0];
    for (std::uint32_t k = grid.first[index]; k < end; ++k) visit(grid.order[k]);
    for (int axis = 0; ++step[axis] > 1 && axis < D - 1; ++axis) step[axis] = -1;
  }
}

// Parts all pairs once: each particle from those of its grid and of coarser ones, and from
// fixtures. Returns the sum of their overlaps.
template <int D>
double OverlapRemoval<D>::sweep() {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < places_.size(); ++i) {
    if (fixtures_.any()) sum += leave_fixtures(i);
    for (std::size_t level = 0; level <= levels_[i]; ++level) {
      const bool later_only = level == levels_[i];
      visit_near(grids_[level], places_[i], [&](std::uint32_t other) {
        if (!later_only || other > i) sum += part(i, other);
      });
    }
  }
  return sum;
}

// Moves two particles apart if they overlap. Each moves by a share like the volume of the other.
// Returns the overlap over the distance at contact.
template <int D>
double OverlapRemoval<D>::part(std::uint32_t a, std::uint32_t b) {
  constexpr double kGap = 1e-3;  // that remains, as a share of the distance at contact
  const double distance = radii_[a] + radii_[b];
  Vec<D> way = domain_.shortest(places_[b] - places_[a]);
  const double square = way.squaredNorm();
  if (square >= distance * distance) return 0.0;
  const double length = std::sqrt(square);
  way = length > 0.0 ? Vec<D>(way / length) : Vec<D>(Vec<D>::Unit(static_cast<int>(a % D)));
  const auto cube = [](double r) { return D == 2 ? r * r : r * r * r; };
  const double volume_a = cube(radii_[a]), volume_b = cube(radii_[b]);
  const double apart = (1.0 + kGap) * distance - length;
  places_[a] -= apart * volume_b / (volume_a + volume_b) * way;
  places_[b] += apart * volume_a / (volume_a + volume_b) * way;
  keep_inside(a);
  keep_inside(b);
  return std::max(1.0 - length / distance, std::numeric_limits<double>::min());
}

// Moves a particle out of the fixture that it overlaps most. Returns the overlap over its radius.
template <int D>
double OverlapRemoval<D>::leave_fixtures(std::uint32_t particle) {
  constexpr double kGap = 1e-3;  // that remains, as a share of the overlap and of the radius
  const double radius = radii_[particle];
  const Vec<D> way = fixtures_.way_out(places_[particle], radius, species_[particle]);
  const double length = way.norm();
  if (length == 0.0) return 0.0;
  places_[particle] += way * ((1.0 + kGap) + kGap * radius / length);
  keep_inside(particle);
  return length / radius;
}

template <int D>
void OverlapRemoval<D>::keep_inside(std::uint32_t particle) {
  Vec<D>& place = places_[particle];
  place = domain_.wrapped(place);
  for (int axis = 0; axis < D; ++axis) {
    if (domain_.periodic[axis]) continue;
    const double radius = radii_[particle];
    place[axis] = std::clamp(place[axis], radius, domain_.box[axis] - radius);
  }
}

template class OverlapRemoval<2>;
template class OverlapRemoval<3>;

}  // namespace clatter
