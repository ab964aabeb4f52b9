#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "engine/physics/flight.h"
#include "engine/physics/state.h"
#include "engine/vec.h"

namespace clatter {

// A sheared box is periodic after Lees and Edwards (theory 14). The images above along y slide
// along x, and carry the flow. Images are additive: the shift of a sum of images is the sum of
// shifts.

/// The space of a gas at an instant: a box, and its periodic images along axes without walls. An
/// image is given by whole numbers of box lengths, 0 along axes with walls.
template <int D>
struct Domain {
  Vec<D> box = Vec<D>::Zero();     ///< edge lengths
  std::array<bool, D> periodic{};  ///< by axis; false: two walls
  bool sheared = false;            ///< whether images above along y slide along x
  double slide = 0.0;              ///< velocity along x of the next image above, a/t
  double offset = 0.0;             ///< displacement along x of this image

  /// The same space after a time.
  Domain at(double time) const {
    Domain later = *this;
    later.offset += slide * time;
    return later;
  }
  /// The image that contains a position.
  [[gnu::always_inline]] Vec<D> image_at(const Vec<D>& position) const {
    if (sheared) [[unlikely]]
      return sheared_image_at(position);
    Vec<D> image = Vec<D>::Zero();
    for (int axis = 0; axis < D; ++axis) image[axis] = boxes_to(position[axis], axis);
    return image;
  }
  /// The displacement of an image from the box.
  Vec<D> shift(const Vec<D>& image) const {
    Vec<D> shift = image.cwiseProduct(box);
    if (sheared) [[unlikely]]
      shift += image[1] * offset * kAlongX<D>;
    return shift;
  }
  /// The same after a time.
  Vec<D> shift(const Vec<D>& image, double time) const {
    Vec<D> shift = image.cwiseProduct(box);
    if (sheared) [[unlikely]] {
      shift += image[1] * offset * kAlongX<D>;
      shift += velocity_x(image) * time * kAlongX<D>;
    }
    return shift;
  }
  /// The velocity of an image along x.
  double velocity_x(const Vec<D>& image) const { return sheared ? image[1] * slide : 0.0; }
  /// The place in the box of a position in any image.
  Vec<D> wrapped(const Vec<D>& position) const { return position - shift(image_at(position)); }
  /// The shortest way between the images of two points, from any way between them.
  Vec<D> shortest(Vec<D> way) const {
    if (sheared) {
      // The nearest image along y may be farther than the next, which has slid.
      const double middle = std::round(way[1] / box[1]);
      Vec<D> best = through(way, middle);
      for (const double images : {middle - 1.0, middle + 1.0}) {
        const Vec<D> other = through(way, images);
        if (other.squaredNorm() < best.squaredNorm()) best = other;
      }
      return best;
    }
    for (int axis = 0; axis < D; ++axis) {
      if (periodic[axis]) way[axis] -= box[axis] * std::round(way[axis] / box[axis]);
    }
    return way;
  }
  /// The velocity of the flow at a position, in the frame of the position's image (theory 14.1).
  Vec<D> flow(const Vec<D>& position) const {
    if (!sheared) return Vec<D>::Zero();
    return slide * (position[1] / box[1] - 0.5) * kAlongX<D>;
  }
  /// A velocity without that of the flow at a position in the same frame.
  Vec<D> peculiar(const Vec<D>& position, const Vec<D>& velocity) const {
    if (!sheared) return velocity;
    return velocity - flow(position);
  }
  /// A flight seen from an image. Its time is on the base of this domain's offset.
  Flight<D> seen_from(const Vec<D>& image, Flight<D> flight) const {
    flight.r -= shift(image, flight.time);
    flight.v -= velocity_x(image) * kAlongX<D>;
    return flight;
  }

 private:
  // The shortest of the ways through so many images along y.
  Vec<D> through(Vec<D> way, double images) const {
    way -= shift(images * Vec<D>::Unit(1));
    for (int axis = 0; axis < D; ++axis) {
      if (axis != 1 && periodic[axis]) way[axis] -= box[axis] * std::round(way[axis] / box[axis]);
    }
    return way;
  }
  double boxes_to(double place, int axis) const {
    const bool inside = place >= 0.0 && place < box[axis];
    return inside || !periodic[axis] ? 0.0 : std::floor(place / box[axis]);
  }
  Vec<D> sheared_image_at(const Vec<D>& position) const {
    Vec<D> image = Vec<D>::Zero();
    for (int axis = D - 1; axis >= 0; --axis) {
      const double slid = axis == 0 ? image[1] * offset : 0.0;
      image[axis] = boxes_to(position[axis] - slid, axis);
    }
    return image;
  }
};

/// Cuts a straight flight in a sheared box at the borders along y. Calls visit(seen, from, to) for
/// the parts between two times, in order, with the flight seen from the image in which it then is.
/// The time of the flight is on the base of the domain's offset.
template <int D, class Visit>
void cut_at_images(const Domain<D>& domain, const Flight<D>& flight, double begin, double end,
                   const Visit& visit) {
  const double height = domain.box[1], v = flight.v[1], step = v < 0.0 ? -1.0 : 1.0;
  double image = std::floor((flight.r[1] + v * (begin - flight.time)) / height);
  for (double from = begin;; image += step) {
    const double border = (image + (step > 0.0 ? 1.0 : 0.0)) * height;
    const double crossing = v != 0.0 ? flight.time + (border - flight.r[1]) / v : end;
    const double to = std::min(end, std::max(from, crossing));
    if (to > from) visit(domain.seen_from(image * Vec<D>::Unit(1), flight), from, to);
    if (!(to < end)) return;
    from = to;
  }
}

/// Adds `share` times the flow of a sheared box to the velocities of a state: -1 removes it.
template <int D>
void add_flow(State<D>& state, const Domain<D>& domain, double share) {
  if (!domain.sheared) return;
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    state.velocities[i] += share * domain.flow(state.positions[i]);
  }
}

}  // namespace clatter
