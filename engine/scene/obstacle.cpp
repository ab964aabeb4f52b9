#include "engine/scene/obstacle.h"

#include <algorithm>
#include <array>

#include "engine/dimension.h"
#include "engine/laws/fixture.h"
#include "engine/scene/scene.h"

namespace clatter {

Wall FixtureLaw::wall() const {
  Wall wall = wall_of_species({}, of_all);
  if (of_all.temperature) {
    wall.kind = WallKind::Thermal;
  } else if (of_all.drive_speed) {
    wall.kind = WallKind::Driven;
  }
  return wall;
}

Wall FixtureLaw::wall(std::size_t species) const {
  return species < of_species.size() ? wall_of_species(wall(), of_species[species]) : wall();
}

std::string obstacle_name(const Obstacle& obstacle, std::size_t number) {
  return obstacle.name.value_or("obstacle_" + std::to_string(number + 1));
}

std::string partition_name(const Partition& partition, std::size_t number) {
  return partition.name.value_or("partition_" + std::to_string(number + 1));
}

namespace {

template <int D>
Fixture<D> with_law(const Scene& scene, std::string name, const FixtureLaw& law) {
  Fixture<D> fixture;
  fixture.name = std::move(name);
  fixture.law = law.wall();
  for (std::size_t k = 0; k < scene.species.size(); ++k) {
    fixture.of_species.push_back(law.wall(k));
  }
  return fixture;
}

template <int D>
void append(std::vector<Piece<D>>& pieces, const std::vector<Piece<D>>& more) {
  pieces.insert(pieces.end(), more.begin(), more.end());
}

std::vector<Piece<2>> polygon_pieces(const std::vector<Vec2>& corners) {
  std::vector<Piece<2>> pieces;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2& next = corners[(k + 1) % corners.size()];
    pieces.push_back(flat_piece<2>(corners[k], {next - corners[k]}));
  }
  for (const Vec2& corner : corners) pieces.push_back(ball_piece<2>(corner, 0.0));
  return pieces;
}

std::vector<Piece<2>> box_pieces(const Vec2& from, const Vec2& to) {
  return polygon_pieces({from, {to.x(), from.y()}, to, {from.x(), to.y()}});
}

// Six plates, twelve rims and eight corners.
std::vector<Piece<3>> box_pieces(const Vec<3>& from, const Vec<3>& to) {
  const Vec<3> size = to - from;
  const auto edge = [&](int axis) { return Vec<3>(size[axis] * Vec<3>::Unit(axis)); };
  // The corner whose axes are high where the bits of a number are set.
  const auto corner = [&](unsigned bits) {
    Vec<3> at = from;
    for (int axis = 0; axis < 3; ++axis) {
      if (bits >> axis & 1u) at[axis] = to[axis];
    }
    return at;
  };
  std::vector<Piece<3>> pieces;
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (const unsigned high : {0u, 1u << axis}) {
      pieces.push_back(flat_piece<3>(corner(high), {edge(a), edge(b)}));
    }
    for (const unsigned bits : {0u, 1u << a, 1u << b, 1u << a | 1u << b}) {
      pieces.push_back(flat_piece<3>(corner(bits), {edge(axis)}));
    }
  }
  for (unsigned bits = 0; bits < 8; ++bits) pieces.push_back(ball_piece<3>(corner(bits), 0.0));
  return pieces;
}

template <int D>
Fixture<D> fixture_of(const Scene& scene, const Obstacle& obstacle, std::size_t number) {
  Fixture<D> fixture = with_law<D>(scene, obstacle_name(obstacle, number), obstacle.law);
  Vec<D> centre = obstacle.centre;
  switch (obstacle.kind) {
    case ObstacleKind::Ball:
      fixture.pieces = {ball_piece<D>(obstacle.centre, obstacle.radius)};
      break;
    case ObstacleKind::Polygon:
      if constexpr (D == 2) {
        fixture.pieces = polygon_pieces(obstacle.corners);
        centre.setZero();
        for (const Vec2& corner : obstacle.corners) {
          centre += corner / static_cast<double>(obstacle.corners.size());
        }
      }
      break;
    case ObstacleKind::Box:
      fixture.pieces = box_pieces(Vec<D>(obstacle.from), Vec<D>(obstacle.to));
      centre = 0.5 * (obstacle.from + obstacle.to);
      break;
  }
  if (!obstacle.present) fixture.pieces.clear();
  fixture.solid = obstacle.kind != ObstacleKind::Ball;
  fixture.centre = centre;
  return fixture;
}

// The partition without its holes: the lines through the edges of all holes cut it into
// rectangles, in 2D into segments. Each hole adds its own edges, where they are inside the box.
template <int D>
std::vector<Piece<D>> partition_pieces(const Scene& scene, const Partition& partition) {
  const int across = static_cast<int>(partition.axis);
  std::array<int, D - 1> along{};
  for (int axis = 0, k = 0; axis < D; ++axis) {
    if (axis != across) along[k++] = axis;
  }
  std::array<std::vector<double>, D - 1> cuts;
  for (int k = 0; k < D - 1; ++k) {
    const double length = scene.box[along[k]];
    cuts[k] = {0.0, length};
    for (const Hole& hole : partition.holes) {
      for (const double cut : {hole.from[k], hole.to[k]}) cuts[k].push_back(cut);
    }
    std::ranges::sort(cuts[k]);
    cuts[k].erase(std::unique(cuts[k].begin(), cuts[k].end()), cuts[k].end());
  }
  const auto point = [&](const std::array<double, D - 1>& place) {
    Vec<D> at = partition.position * Vec<D>::Unit(across);
    for (int k = 0; k < D - 1; ++k) at[along[k]] = place[k];
    return at;
  };
  const auto edge = [&](int k, double length) { return Vec<D>(length * Vec<D>::Unit(along[k])); };
  std::vector<Piece<D>> pieces;
  std::array<std::size_t, D - 1> cell{};
  while (cell[D - 2] + 1 < cuts[D - 2].size()) {
    std::array<double, D - 1> low{};
    std::vector<Vec<D>> edges;
    for (int k = 0; k < D - 1; ++k) {
      low[k] = cuts[k][cell[k]];
      edges.push_back(edge(k, cuts[k][cell[k] + 1] - low[k]));
    }
    const bool open = std::ranges::any_of(partition.holes, [&](const Hole& hole) {
      bool inside = true;
      for (int k = 0; k < D - 1; ++k) {
        const double middle = 0.5 * (cuts[k][cell[k]] + cuts[k][cell[k] + 1]);
        inside = inside && middle > hole.from[k] && middle < hole.to[k];
      }
      return inside;
    });
    if (!open) pieces.push_back(flat_piece<D>(point(low), edges));
    for (int k = 0; ++cell[k] + 1 == cuts[k].size() && k < D - 2; ++k) cell[k] = 0;
  }
  const auto is_inside = [&](int k, double place) {
    return place > 0.0 && place < scene.box[along[k]];
  };
  for (const Hole& hole : partition.holes) {
    const std::array<std::vector<double>, 2> ends = {hole.from, hole.to};
    for (const std::vector<double>& first : ends) {
      if (!is_inside(0, first[0])) continue;
      if constexpr (D == 2) {
        pieces.push_back(ball_piece<2>(point({first[0]}), 0.0));
      } else {
        pieces.push_back(
            flat_piece<3>(point({first[0], hole.from[1]}), {edge(1, hole.to[1] - hole.from[1])}));
        for (const std::vector<double>& second : ends) {
          if (is_inside(1, second[1])) {
            pieces.push_back(ball_piece<3>(point({first[0], second[1]}), 0.0));
          }
        }
      }
    }
    if constexpr (D == 3) {
      for (const std::vector<double>& second : ends) {
        if (!is_inside(1, second[1])) continue;
        pieces.push_back(
            flat_piece<3>(point({hole.from[0], second[1]}), {edge(0, hole.to[0] - hole.from[0])}));
      }
    }
  }
  return pieces;
}

template <int D>
std::vector<Valve<D>> valves_of(const Partition& partition) {
  const int across = static_cast<int>(partition.axis);
  std::vector<Valve<D>> valves;
  for (const Hole& hole : partition.holes) {
    if (!hole.valve) continue;
    Vec<D> corner = partition.position * Vec<D>::Unit(across);
    std::vector<Vec<D>> edges;
    for (int axis = 0, k = 0; axis < D; ++axis) {
      if (axis == across) continue;
      corner[axis] = hole.from[k];
      edges.push_back((hole.to[k] - hole.from[k]) * Vec<D>::Unit(axis));
      ++k;
    }
    Valve<D>& valve = valves.emplace_back();
    valve.opening = flat_piece<D>(corner, edges);
    valve.faster_than = hole.valve->faster_than;
    valve.slower_than = hole.valve->slower_than;
    if (hole.valve->from) valve.from = *hole.valve->from == PartitionSide::Left ? -1 : 1;
  }
  return valves;
}

template <int D>
Fixture<D> fixture_of(const Scene& scene, const Partition& partition, std::size_t number) {
  Fixture<D> fixture = with_law<D>(scene, partition_name(partition, number), partition.law);
  fixture.plane = {static_cast<int>(partition.axis), partition.position};
  if (partition.present) {
    fixture.pieces = partition_pieces<D>(scene, partition);
    fixture.valves = valves_of<D>(partition);
  }
  for (const Species& species : scene.species) {
    fixture.passes.push_back(std::ranges::find(partition.passes, species.name) !=
                             partition.passes.end());
  }
  return fixture;
}

}  // namespace

template <int D>
std::vector<Fixture<D>> fixtures_of(const Scene& scene) {
  std::vector<Fixture<D>> fixtures;
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
    fixtures.push_back(fixture_of<D>(scene, scene.obstacles[k], k));
  }
  for (std::size_t k = 0; k < scene.partitions.size(); ++k) {
    fixtures.push_back(fixture_of<D>(scene, scene.partitions[k], k));
  }
  return fixtures;
}

template <int D>
static double free_share_of(const Scene& scene) {
  constexpr int kPoints = D == 2 ? 500 : 64;  // along each axis
  Domain<D> domain{.box = scene.box};
  for (int axis = 0; axis < D; ++axis) domain.periodic[axis] = scene.periodic(axis);
  const FixtureImages<D> fixtures(fixtures_of<D>(scene), domain);
  double free = 0.0, all = 0.0;
  IntVec<D> at = IntVec<D>::Zero();
  while (at[D - 1] < kPoints) {
    const Vec<D> share = (at.template cast<double>().array() + 0.5) / kPoints;
    free += fixtures.depth(domain.box.cwiseProduct(share), 0.0, 0) == 0.0;
    all += 1.0;
    for (int axis = 0; ++at[axis] == kPoints && axis < D - 1; ++axis) at[axis] = 0;
  }
  return free / all;
}

double free_share(const Scene& scene) {
  return with_dimension(scene.dimension(),
                        [&](auto dimension) { return free_share_of<dimension>(scene); });
}

template std::vector<Fixture<2>> fixtures_of(const Scene&);
template std::vector<Fixture<3>> fixtures_of(const Scene&);

}  // namespace clatter
