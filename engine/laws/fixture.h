#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/laws/domain.h"
#include "engine/laws/wall.h"
#include "engine/physics/piece.h"
#include "engine/vec.h"

namespace clatter {

/// A plane at right angles to an axis.
struct AxisPlane {
  int axis = 0;
  double position = 0.0;
};

/// An opening that particles pass by their speed and side. It acts when their centres reach its
/// plane: it lets them pass unchanged, or reflects them elastically.
template <int D>
struct Valve {
  Piece<D> opening;                   ///< a plate
  std::optional<double> faster_than;  ///< least speed that passes; absent: any
  std::optional<double> slower_than;  ///< speed that no longer passes; absent: any
  int from = 0;  ///< side that lets pass, along the axis: -1 the lower, 1 the upper, 0 both

  /// Whether a particle passes that comes from a side, -1 or 1, with a speed.
  bool passes(int side, double speed) const {
    return (from == 0 || from == side) && !(speed < faster_than.value_or(0.0)) &&
           !(slower_than && speed >= *slower_than);
  }
};

/// A body at rest in the box: an obstacle or a partition.
template <int D>
struct Fixture {
  std::string name;                ///< for results and messages
  std::vector<Piece<D>> pieces;    ///< all that particles touch
  bool solid = false;              ///< whether its pieces are those of a polygon or a box
  std::optional<Vec<D>> centre;    ///< about which torques are; absent: none
  std::optional<AxisPlane> plane;  ///< of a partition
  Wall law;                        ///< static, driven or thermal
  std::vector<Wall> of_species;    ///< [S] the law for each species; empty: all have `law`
  std::vector<bool> passes;        ///< [S] whether a species does not see it; empty: all see it
  std::vector<Valve<D>> valves;    ///< in holes of a partition

  /// The law for a species, by its number.
  const Wall& law_for(std::uint32_t species) const {
    return of_species.empty() ? law : of_species[species];
  }
  /// Whether particles touch this one and another at the same places.
  bool has_shape_of(const Fixture& other) const {
    const auto same = [](const Valve<D>& a, const Valve<D>& b) { return a.opening == b.opening; };
    return pieces == other.pieces && passes == other.passes &&
           std::ranges::equal(valves, other.valves, same);
  }
  /// Whether a species does not see it.
  bool lets_pass(std::uint32_t species) const { return species < passes.size() && passes[species]; }
};

/// In place of a species: one that sees all fixtures.
inline constexpr std::uint32_t kSeesAll = 0xffffffffu;

/// Distance of a position from the surface of a fixture, negative inside.
template <int D>
double distance_from(const Fixture<D>& fixture, const Vec<D>& position);

/// The fixtures of a gas, with all periodic images that reach into the box.
template <int D>
class FixtureImages {
 public:
  /// `origin` is the place in the box of positions that are 0.
  explicit FixtureImages(const std::vector<Fixture<D>>& fixtures = {}, const Domain<D>& domain = {},
                         const Vec<D>& origin = Vec<D>::Zero());

  /// Whether there are any.
  bool any() const { return !images_.empty(); }
  /// Whether a fixture does not exist for some species.
  bool differ() const;
  /// The number of the fixture that a particle at a position in the box overlaps most; absent:
  /// none.
  std::optional<std::size_t> deepest(const Vec<D>& position, double radius,
                                     std::uint32_t species) const;
  /// Depth by which a particle at a position in the box overlaps a fixture that its species sees;
  /// 0: none.
  double depth(const Vec<D>& position, double radius, std::uint32_t species) const;
  /// The way by which such a particle leaves the fixture that it overlaps most; 0: none.
  Vec<D> way_out(const Vec<D>& position, double radius, std::uint32_t species) const;

 private:
  struct Image {
    std::size_t fixture;
    Vec<D> shift;      // added to positions
    Vec<D> low, high;  // bounds, in the frame of the positions
  };
  template <class Visit>
  void visit_near(const Vec<D>& position, double radius, std::uint32_t species,
                  const Visit& visit) const;

  std::vector<Fixture<D>> fixtures_;
  std::vector<Image> images_;
};

extern template class FixtureImages<2>;
extern template class FixtureImages<3>;

}  // namespace clatter
