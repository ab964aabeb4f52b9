#include "app/bench/time_stepped.h"

#include <algorithm>
#include <cmath>

#include "engine/laws/model.h"
#include "engine/physics/collision.h"
#include "engine/physics/walls.h"

namespace clatter {

// The axis of the only pair of walls; -1: no such pair.
static int walled_axis(const Scene& scene) {
  const bool x = scene.walls[kLeft].has_value(), y = scene.walls[kBottom].has_value();
  if (x == y) return -1;
  return x ? 0 : 1;
}

bool TimeStepped::can_run(const Scene& scene) {
  // Least width of the box in cells of one diameter. Each pair of cells then occurs once.
  constexpr double kNarrowest = 3.0;
  const auto known = [](const std::optional<Wall>& wall) {
    return !wall || wall->kind == WallKind::Static || wall->kind == WallKind::Driven;
  };
  return walled_axis(scene) >= 0 && std::ranges::all_of(scene.walls, known) && !scene.spins() &&
         !scene.gravity && !scene.bulk_drive && !scene.contact_time && scene.changes.empty() &&
         scene.box.minCoeff() >= kNarrowest;
}

TimeStepped::TimeStepped(const Scene& scene, const State<2>& state, double step, int columns)
    : axis_(walled_axis(scene)),
      box_(scene.box),
      restitution_(scene.particles.restitution),
      walls_{*scene.walls[2 * axis_], *scene.walls[2 * axis_ + 1]},
      step_(step),
      positions_(state.positions),
      velocities_(state.velocities),
      cells_{static_cast<int>(box_.x()), static_cast<int>(box_.y())},
      starts_(static_cast<std::size_t>(cells_[0] * cells_[1]) + 1),
      sorted_(positions_.size()) {
  sums_.particles.resize(static_cast<std::size_t>(columns));
  restart_sums();
}

void TimeStepped::restart_sums() {
  const std::vector<double> zeros(sums_.particles.size());
  sums_ = {.particles = zeros, .heat_carried = zeros};
}

double TimeStepped::bytes() const {
  return static_cast<double>(positions_.size() * (2 * sizeof(Vec2) + sizeof(std::uint32_t)) +
                             starts_.size() * sizeof(int));
}

void TimeStepped::run(double time) {
  const auto steps = static_cast<std::uint64_t>(std::llround(time / step_));
  for (std::uint64_t k = 0; k < steps; ++k) {
    advance();
    hit_walls();
    sort_into_cells();
    resolve_overlaps();
    observe();
  }
}

void TimeStepped::advance() {
  const int along = 1 - axis_;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    positions_[i] += step_ * velocities_[i];
    double& place = positions_[i][along];
    place -= box_[along] * std::floor(place / box_[along]);
  }
}

void TimeStepped::hit_walls() {
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    for (int end = 0; end < 2; ++end) {
      const double inward = end == 0 ? 1.0 : -1.0;
      double& place = positions_[i][axis_];
      const double wall = end == 0 ? 0.0 : box_[axis_];
      if (inward * (place - wall) >= 0.5) continue;
      place = wall + 0.5 * inward;
      const Vec2 before = velocities_[i];
      if (inward * before[axis_] >= 0.0) continue;
      velocities_[i] =
          reflect<2>(before, inward * Vec2::Unit(axis_), walls_[end].restitution,
                     walls_[end].kind == WallKind::Driven ? walls_[end].drive_speed : 0.0);
      const double gained = velocities_[i][axis_] - before[axis_];
      sums_.wall_impulse += std::fabs(gained);
      sums_.stress -= 0.5 * inward * gained;
      add_heat(place, wall,
               0.5 * (velocities_[i].squaredNorm() - before.squaredNorm()) * (place - wall));
    }
  }
}

int TimeStepped::cell_of(const Vec2& position) const {
  std::array<int, 2> at{};
  for (int k = 0; k < 2; ++k) {
    at[k] = std::clamp(static_cast<int>(position[k] / box_[k] * cells_[k]), 0, cells_[k] - 1);
  }
  return at[1] * cells_[0] + at[0];
}

void TimeStepped::sort_into_cells() {
  std::ranges::fill(starts_, 0);
  for (const Vec2& position : positions_) ++starts_[cell_of(position) + 1];
  for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
  for (std::size_t i = positions_.size(); i-- > 0;) {
    sorted_[--starts_[cell_of(positions_[i]) + 1]] = static_cast<std::uint32_t>(i);
  }
  // The loop has moved each start to the start of its cell, which is one index too late.
  std::shift_left(starts_.begin(), starts_.end(), 1);
  starts_.back() = static_cast<int>(positions_.size());
}

void TimeStepped::resolve_overlaps() {
  constexpr std::array<std::array<int, 2>, 5> kHalf = {{{0, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  for (int y = 0; y < cells_[1]; ++y) {
    for (int x = 0; x < cells_[0]; ++x) {
      const int here = y * cells_[0] + x;
      for (const auto& [dx, dy] : kHalf) {
        const int beside_x = (x + dx + cells_[0]) % cells_[0], beside_y = (y + dy) % cells_[1];
        const int there = beside_y * cells_[0] + beside_x;
        for (int a = starts_[here]; a < starts_[here + 1]; ++a) {
          const int first = here == there ? a + 1 : starts_[there];
          for (int b = first; b < starts_[there + 1]; ++b) resolve(sorted_[a], sorted_[b]);
        }
      }
    }
  }
}

Vec2 TimeStepped::nearest(Vec2 separation) const {
  const int along = 1 - axis_;
  separation[along] -= box_[along] * std::round(separation[along] / box_[along]);
  return separation;
}

void TimeStepped::resolve(std::uint32_t first, std::uint32_t second) {
  const Vec2 separation = nearest(positions_[first] - positions_[second]);
  const double distance = separation.norm();
  if (distance >= 1.0 || distance == 0.0) return;
  sums_.deepest_overlap = std::max(sums_.deepest_overlap, 1.0 - distance);
  const Vec2 contact = separation / distance;
  const Vec2 push = 0.5 * (1.0 - distance) * contact;
  positions_[first] += push;
  positions_[second] -= push;
  if (contact.dot(velocities_[first] - velocities_[second]) < 0.0) bounce(first, second, contact);
}

void TimeStepped::bounce(std::uint32_t first, std::uint32_t second, const Vec2& separation) {
  Vec2& v1 = velocities_[first];
  Vec2& v2 = velocities_[second];
  const Vec2 impulse = collision_impulse<2>(separation, v1 - v2, restitution_, {});
  const double gained1 = impulse.dot(v1 + 0.5 * impulse);
  const double gained2 = -impulse.dot(v2 - 0.5 * impulse);
  v1 += impulse;
  v2 -= impulse;
  ++sums_.collisions;
  sums_.dissipated -= gained1 + gained2;
  sums_.stress -= separation[axis_] * impulse[axis_];
  const double from = positions_[first][axis_];
  add_heat(from, from - separation[axis_], 0.5 * (gained1 - gained2) * separation[axis_]);
}

int TimeStepped::column_of(double place) const {
  const auto columns = static_cast<int>(sums_.particles.size());
  return std::clamp(static_cast<int>(place / box_[axis_] * columns), 0, columns - 1);
}

// Distributes heat over the columns along a line, by the length in each column.
void TimeStepped::add_heat(double from, double to, double heat) {
  const auto [low, high] = std::minmax(from, to);
  if (low == high) return;
  const double width = box_[axis_] / static_cast<double>(sums_.particles.size());
  for (int c = column_of(low); c <= column_of(high); ++c) {
    const double inside = std::min(high, (c + 1) * width) - std::max(low, c * width);
    sums_.heat_carried[c] += heat * std::max(0.0, inside) / (high - low);
  }
}

void TimeStepped::observe() {
  sums_.time += step_;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const double square = velocities_[i].squaredNorm(), v = velocities_[i][axis_];
    const int column = column_of(positions_[i][axis_]);
    sums_.squares += step_ * square;
    sums_.stress -= step_ * v * v;
    sums_.particles[column] += step_;
    sums_.heat_carried[column] += step_ * 0.5 * square * v;
  }
}

}  // namespace clatter
