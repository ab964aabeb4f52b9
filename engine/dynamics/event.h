#pragma once

#include <cstdint>
#include <tuple>

// Events. Each particle has one plan: its first contact, or the crossing of its cell's border if
// that is earlier. The plan is the particle's only live entry in the calendar. A collision predicts
// new plans for its two particles. A plan becomes stale if its partner has another event first. The
// number of the partner's flight shows this when the plan is due. The cell of a particle depends on
// its history, but its events do not.

namespace clatter {

/// Values of Event::partner that are no particle: a piece of a fixture (kPiece + number), a wall
/// (kWall + side), the free piston, a border of the particle's cell (kCellBorder + side) or the
/// border of its region (kCellBorder). Particle numbers are smaller.
inline constexpr std::uint32_t kPiece = 0xffff0000u;
inline constexpr std::uint32_t kWall = 0xffffffe0u;
inline constexpr std::uint32_t kPiston = 0xffffffe8u;
inline constexpr std::uint32_t kCellBorder = 0xfffffff0u;

/// Border of its cell that a particle crosses: the axis, and the step along it, +1 or -1.
struct Crossing {
  int axis;
  int step;
};
inline Crossing crossing_of(std::uint32_t border) {
  const auto side = static_cast<int>(border - kCellBorder);
  return {side / 2, side % 2 ? 1 : -1};
}

/// The border of a cell's side, as Event::partner.
inline std::uint32_t border_of(int axis, bool upper) {
  return kCellBorder + static_cast<std::uint32_t>(2 * axis + upper);
}

/// The end of a particle's stay in its cell or region.
struct Exit {
  double time;           ///< infinite or NaN: never
  std::uint32_t border;  ///< as Event::partner
};

/// An entry of the event queue: a predicted event of one particle.
struct Event {
  double time = 0.0;  ///< on the moving base
  std::uint32_t particle = 0;
  std::uint32_t partner = 0;  ///< a particle, or another value as above
};

/// Total order of events: by time, then by kind (particles, fixtures and walls, cell borders), then
/// by particle numbers. Both orders of a pair are the same event. `numbers` has the original
/// numbers of the particles; null: they are the particles' own.
inline bool before(const Event& a, const Event& b, const std::uint32_t* numbers = nullptr) {
  if (a.time != b.time) return a.time < b.time;
  const auto rank = [numbers](const Event& e) {
    const int kind = e.partner < kPiece ? 0 : e.partner < kCellBorder ? 1 : 2;
    const std::uint32_t particle = numbers ? numbers[e.particle] : e.particle;
    const std::uint32_t partner = numbers && kind == 0 ? numbers[e.partner] : e.partner;
    const bool swap = kind == 0 && partner < particle;
    return std::tuple(kind, swap ? partner : particle, swap ? particle : partner);
  };
  return rank(a) < rank(b);
}

}  // namespace clatter
