#pragma once

#include <limits>

#include "engine/laws/model.h"
#include "engine/scene/observable_settings.h"

namespace clatter {

/// A region of the box with edges along the axes. A centre at an edge belongs to the region above
/// it. Centres beyond a side of the box, as at a moving wall, belong to the region at that side.
template <int D>
class Region {
 public:
  /// The region of `settings` in the box. Absent corners are at `lower` and `upper` as shares of
  /// the box.
  Region(const Model<D>& model, const RegionSettings& settings, double lower, double upper) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    lower_ = settings.lower ? Vec<D>(*settings.lower) : Vec<D>(lower * model.box);
    upper_ = settings.upper ? Vec<D>(*settings.upper) : Vec<D>(upper * model.box);
    volume_ = (upper_ - lower_).prod();
    for (int axis = 0; axis < D; ++axis) {
      if (lower_[axis] <= 0.0) lower_[axis] = -kInfinite;
      if (upper_[axis] >= model.box[axis]) upper_[axis] = kInfinite;
    }
  }

  /// Whether a centre in the box is in the region.
  bool contains(const Vec<D>& centre) const {
    return (centre.array() >= lower_.array()).all() && (centre.array() < upper_.array()).all();
  }
  /// Area or volume of the region.
  double volume() const { return volume_; }

 private:
  Vec<D> lower_, upper_;
  double volume_;
};

}  // namespace clatter
