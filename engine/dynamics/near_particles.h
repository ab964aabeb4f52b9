#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/dynamics/cell_grid.h"
#include "engine/laws/model.h"
#include "engine/vec.h"

namespace clatter {

/// Particles at rest, to find those near a point, with their periodic images.
template <int D>
class NearParticles {
 public:
  /// No particles yet. The search finds those within `range`; `count` of them are expected.
  NearParticles(const Model<D>& model, double range, std::size_t count)
      : domain_(model.domain()), grid_(whole_box<D>(model), range, static_cast<double>(count)) {
    positions_.reserve(count);
  }

  /// Adds a particle in the box. Its number is that of the particles before it.
  void add(const Vec<D>& position) {
    grid_.insert(static_cast<std::uint32_t>(positions_.size()), grid_.cell_at(position));
    positions_.push_back(position);
  }
  /// [particles] of the box.
  const std::vector<Vec<D>>& positions() const { return positions_; }
  std::vector<Vec<D>>& positions() { return positions_; }

  /// Calls visit(particle, way) for each particle and image within the range of a point in the box,
  /// and for some beyond it. `way` goes from the point to the particle.
  template <class Visit>
  void visit(const Vec<D>& point, const Visit& visit) const {
    grid_.visit(grid_.cell_at(point), [&](std::uint32_t particle, const Vec<D>& wrap) {
      visit(particle, Vec<D>(positions_[particle] - point + domain_.shift(wrap)));
    });
  }
  /// Whether a particle is closer to a point in the box than a distance within the range.
  bool any_within(const Vec<D>& point, double distance) const {
    bool any = false;
    visit(point, [&](std::uint32_t, const Vec<D>& way) { any = any || way.norm() < distance; });
    return any;
  }

 private:
  Domain<D> domain_;
  CellGrid<D> grid_;
  std::vector<Vec<D>> positions_;
};

}  // namespace clatter
