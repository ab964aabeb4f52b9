#include "engine/laws/fixture.h"

#include <algorithm>
#include <limits>

namespace clatter {

// Whether a ray along x from a position crosses the segment between two corners. Of two segments
// that meet on the ray it crosses one if they are on both sides of the ray, and none or both
// otherwise.
static bool crosses(const Vec2& first, const Vec2& second, const Vec2& position) {
  const Vec2 a = first - position, b = second - position;
  if ((a.y() > 0.0) == (b.y() > 0.0)) return false;
  return a.x() + (b.x() - a.x()) * (a.y() / (a.y() - b.y())) > 0.0;
}

// The plates of a polygon come first, in order: each ends at the corner of the next.
static bool is_inside(const Fixture<2>& polygon, const Vec2& position) {
  bool inside = false;
  const std::size_t count = polygon.pieces.size() / 2;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2& next = polygon.pieces[(k + 1) % count].corner;
    inside = inside != crosses(polygon.pieces[k].corner, next, position);
  }
  return inside;
}

// The corners of a box come last, the lowest first.
static bool is_inside(const Fixture<3>& box, const Vec<3>& position) {
  if (box.pieces.empty()) return false;
  const Vec<3>& low = box.pieces[box.pieces.size() - 8].corner;
  const Vec<3>& high = box.pieces.back().corner;
  return (position.array() > low.array()).all() && (position.array() < high.array()).all();
}

template <int D>
double distance_from(const Fixture<D>& fixture, const Vec<D>& position) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Piece<D>& piece : fixture.pieces) {
    distance = std::min(distance, piece.distance(position));
  }
  return fixture.solid && is_inside(fixture, position) ? -distance : distance;
}

template <int D>
FixtureImages<D>::FixtureImages(const std::vector<Fixture<D>>& fixtures, const Domain<D>& domain,
                                const Vec<D>& origin)
    : fixtures_(fixtures) {
  IntVec<D> most;
  for (int axis = 0; axis < D; ++axis) most[axis] = domain.periodic[axis] ? 1 : 0;
  for (std::size_t k = 0; k < fixtures_.size(); ++k) {
    Vec<D> low = Vec<D>::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Piece<D>& piece : fixtures_[k].pieces) {
      const auto [first, last] = piece.bounds();
      low = low.cwiseMin(first);
      high = high.cwiseMax(last);
    }
    IntVec<D> image = -most;
    while (image[D - 1] <= most[D - 1]) {
      // Particles are narrower than the box.
      const Vec<D> moved = domain.shift(image.template cast<double>());
      const bool near = ((low + moved).array() < 1.5 * domain.box.array()).all() &&
                        ((high + moved).array() > -0.5 * domain.box.array()).all();
      const Vec<D> shift = origin - moved;
      if (near || most.isZero()) images_.push_back({k, shift, low - shift, high - shift});
      for (int axis = 0; ++image[axis] > most[axis] && axis < D - 1; ++axis) {
        image[axis] = -most[axis];
      }
    }
  }
}

template <int D>
bool FixtureImages<D>::differ() const {
  return std::ranges::any_of(fixtures_, [](const Fixture<D>& fixture) {
    return std::ranges::find(fixture.passes, true) != fixture.passes.end();
  });
}

template <int D>
template <class Visit>
void FixtureImages<D>::visit_near(const Vec<D>& position, double radius, std::uint32_t species,
                                  const Visit& visit) const {
  for (const auto& [number, shift, low, high] : images_) {
    const bool far =
        ((position - low).array() < -radius).any() || ((position - high).array() > radius).any();
    if (far || fixtures_[number].lets_pass(species)) continue;
    visit(number, Vec<D>(position + shift));
  }
}

template <int D>
std::optional<std::size_t> FixtureImages<D>::deepest(const Vec<D>& position, double radius,
                                                     std::uint32_t species) const {
  double deepest = 0.0;
  std::optional<std::size_t> number;
  visit_near(position, radius, species, [&](std::size_t fixture, const Vec<D>& place) {
    const double beyond = radius - distance_from(fixtures_[fixture], place);
    if (beyond > deepest) number = fixture;
    deepest = std::max(deepest, beyond);
  });
  return number;
}

template <int D>
double FixtureImages<D>::depth(const Vec<D>& position, double radius, std::uint32_t species) const {
  double deepest = 0.0;
  visit_near(position, radius, species, [&](std::size_t fixture, const Vec<D>& place) {
    deepest = std::max(deepest, radius - distance_from(fixtures_[fixture], place));
  });
  return deepest;
}

template <int D>
Vec<D> FixtureImages<D>::way_out(const Vec<D>& position, double radius,
                                 std::uint32_t species) const {
  double deepest = 0.0;
  Vec<D> way = Vec<D>::Zero();
  visit_near(position, radius, species, [&](std::size_t number, const Vec<D>& place) {
    const Fixture<D>& fixture = fixtures_[number];
    const double beyond = radius - distance_from(fixture, place);
    if (!(beyond > deepest)) return;
    deepest = beyond;
    const auto nearest = std::min_element(fixture.pieces.begin(), fixture.pieces.end(),
                                          [&](const Piece<D>& a, const Piece<D>& b) {
                                            return a.distance(place) < b.distance(place);
                                          });
    Vec<D> away = place - nearest->foot(place);
    const double length = away.norm();
    away = length > 0.0          ? Vec<D>(away / length)
           : nearest->is_plate() ? nearest->normal
                                 : Vec<D>(Vec<D>::Unit(0));
    const bool inside = beyond > radius && fixture.solid;
    way = beyond * (inside ? -away : away);
  });
  return way;
}

template double distance_from(const Fixture<2>&, const Vec2&);
template double distance_from(const Fixture<3>&, const Vec<3>&);
template class FixtureImages<2>;
template class FixtureImages<3>;

}  // namespace clatter
