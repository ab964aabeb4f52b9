#include "engine/scene/obstacle_checks.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/laws/fixture.h"
#include "engine/physics/lattice.h"
#include "engine/physics/theory.h"
#include "engine/scene/enum_names.h"
#include "engine/scene/scene_document.h"
#include "engine/text.h"

namespace clatter {

namespace {

/// Places of the keys of one item of a list.
class Item {
 public:
  Item(const toml::table& root, const char* list, std::size_t number, const std::string& file)
      : node_(*root[list][number].node()), file_(file) {}

  Place place(std::string_view key) const {
    const Place found = place_of(*node_.as_table(), key, file_);
    return found.line > 0 || from_override(found) ? found : place_of(node_, file_);
  }
  /// Throws if its table of species names one that the scene lacks.
  void check_species(const std::vector<std::string>& known) const {
    const toml::table* tables = (*node_.as_table())["species"].as_table();
    if (!tables) return;
    for (const auto& [name, table] : *tables) {
      if (std::ranges::find(known, name.str()) == known.end()) {
        refuse_species(place("species"), name.str(), known);
      }
    }
  }
  [[noreturn]] void refuse(std::string_view key, const std::string& problem,
                           const std::string& advice) const {
    throw UserError(place(key), problem, advice);
  }

 private:
  const toml::node& node_;
  const std::string& file_;
};

std::string point_text(const VecX& point) {
  std::string text;
  for (const double number : point) text += (text.empty() ? "(" : ", ") + number_text(number);
  return text + ')';
}

/// Throws if a body reaches no point of the box, or overlaps its own image.
void check_reach(const Scene& scene, const Item& item, const char* key, const VecX& low,
                 const VecX& high) {
  for (int axis = 0; axis < scene.dimension(); ++axis) {
    if (scene.periodic(axis) && high[axis] - low[axis] > scene.box[axis]) {
      item.refuse(key, "the obstacle overlaps its own image along a periodic axis",
                  "make it shorter than the side " + number_text(scene.box[axis]));
    }
    if (low[axis] < scene.box[axis] && high[axis] > 0.0) continue;
    item.refuse(key,
                "the obstacle is outside of the box: along " +
                    std::string(kAxes[static_cast<std::size_t>(axis)].name) + " it reaches from " +
                    number_text(low[axis]) + " to " + number_text(high[axis]),
                "place it between 0 and " + number_text(scene.box[axis]));
  }
}

double wedge(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Whether two segments have a point in common.
bool meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    const double area = wedge(q - p, r - p);
    return area > 0.0 ? 1 : area < 0.0 ? -1 : 0;
  };
  const auto on = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    return (r - p).dot(r - q) <= 0.0;
  };
  const int abc = side(a, b, c), abd = side(a, b, d), cda = side(c, d, a), cdb = side(c, d, b);
  if (abc != abd && cda != cdb && abc * abd <= 0 && cda * cdb <= 0) return true;
  return (abc == 0 && on(a, b, c)) || (abd == 0 && on(a, b, d)) || (cda == 0 && on(c, d, a)) ||
         (cdb == 0 && on(c, d, b));
}

void check_polygon(const std::vector<Vec2>& corners, const Item& item) {
  constexpr std::size_t kMostCorners = 500;
  const std::size_t count = corners.size();
  if (count < 3 || count > kMostCorners) {
    item.refuse("corners", "a polygon of " + counted(count, "corner") + " is none",
                "give 3 to " + std::to_string(kMostCorners) + " corners");
  }
  const auto at = [&](std::size_t k) { return corners[k % count]; };
  for (std::size_t i = 0; i < count; ++i) {
    if (at(i) == at(i + 1)) {
      item.refuse("corners", "the corner " + point_text(at(i)) + " comes twice in succession",
                  "remove one of the two");
    }
    // An edge must not turn back into the one before.
    const Vec2 before = at(i + 1) - at(i), after = at(i + 2) - at(i + 1);
    if (wedge(before, after) == 0.0 && before.dot(after) < 0.0) {
      item.refuse("corners", "the polygon turns back on itself at " + point_text(at(i + 1)),
                  "give its corners in order around it");
    }
    for (std::size_t j = i + 2; j < count; ++j) {
      if (i == 0 && j == count - 1) continue;
      if (!meet(at(i), at(i + 1), at(j), at(j + 1))) continue;
      item.refuse(
          "corners",
          "the edges from " + point_text(at(i)) + " and from " + point_text(at(j)) + " meet",
          "give the corners in order around the polygon");
    }
  }
}

void check_obstacle(const Scene& scene, const Obstacle& obstacle, const Item& item) {
  switch (obstacle.kind) {
    case ObstacleKind::Ball: {
      const VecX reach = VecX::Constant(scene.dimension(), obstacle.radius);
      check_reach(scene, item, "centre", obstacle.centre - reach, obstacle.centre + reach);
      break;
    }
    case ObstacleKind::Polygon: {
      if (scene.dimension() == 3) {
        item.refuse("kind", "a polygon has no meaning among spheres", "choose \"ball\" or \"box\"");
      }
      check_polygon(obstacle.corners, item);
      Vec2 low = obstacle.corners.front(), high = low;
      for (const Vec2& corner : obstacle.corners) {
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
      }
      check_reach(scene, item, "corners", low, high);
      break;
    }
    case ObstacleKind::Box:
      for (int axis = 0; axis < scene.dimension(); ++axis) {
        if (obstacle.from[axis] < obstacle.to[axis]) continue;
        item.refuse(
            "to",
            "the box ends at " + number_text(obstacle.to[axis]) + ", where it does not begin below",
            "make each number of 'to' larger than that of 'from'");
      }
      check_reach(scene, item, "from", obstacle.from, obstacle.to);
      break;
  }
}

void check_partition(const Scene& scene, const Partition& partition, const Item& item) {
  const int across = static_cast<int>(partition.axis);
  if (across >= scene.dimension()) {
    item.refuse("axis", "the box has no z axis", "choose x or y");
  }
  if (!(partition.position > 0.0 && partition.position < scene.box[across])) {
    item.refuse("position", "the partition is not inside the box",
                "place it between 0 and " + number_text(scene.box[across]));
  }
  constexpr std::size_t kMostHoles = 200;
  if (partition.holes.size() > kMostHoles) {
    item.refuse("holes", "the partition has " + counted(partition.holes.size(), "hole"),
                "give at most " + std::to_string(kMostHoles));
  }
  for (std::size_t i = 0; i < partition.holes.size(); ++i) {
    const Hole& hole = partition.holes[i];
    if (hole.valve) {
      const auto& [faster, slower, from] = *hole.valve;
      if (!faster && !slower && !from) {
        item.refuse("holes", "a valve without a condition is an open hole",
                    "give it faster_than, slower_than or from, or remove it");
      }
      if (faster && slower && !(*faster < *slower)) {
        item.refuse(
            "holes",
            "no speed is above " + number_text(*faster) + " and below " + number_text(*slower),
            "choose faster_than below slower_than");
      }
    }
    for (int axis = 0, k = 0; axis < scene.dimension(); ++axis) {
      if (axis == across) continue;
      const double from = hole.from[k], to = hole.to[k], side = scene.box[axis];
      if (!(from < to && to <= side)) {
        item.refuse("holes",
                    "a hole from " + number_text(from) + " to " + number_text(to) +
                        " is not between 0 and " + number_text(side),
                    "let it begin below its end, and end inside the box");
      }
      const bool at_face = from == 0.0 || to == side;
      if (scene.periodic(axis) && at_face && to - from < side) {
        item.refuse("holes", "a hole touches the periodic border of the box",
                    "move it inside, or let it reach from 0 to " + number_text(side));
      }
      ++k;
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Hole& other = partition.holes[j];
      bool apart = false;
      for (int k = 0; k < scene.dimension() - 1; ++k) {
        apart = apart || hole.from[k] > other.to[k] || other.from[k] > hole.to[k];
      }
      if (!apart) {
        item.refuse("holes", "two holes of the partition meet", "make one hole of the two");
      }
    }
  }
  for (const std::string& name : partition.passes) {
    if (!find_species(scene.species, name)) {
      refuse_species(item.place("passes"), name, names_of(scene.species));
    }
  }
}

}  // namespace

void check_fixtures(const Scene& scene, const toml::table& root, const std::string& file) {
  constexpr std::size_t kMostFixtures = 2000;
  std::set<std::string> names;
  const auto check_name = [&](const std::optional<std::string>& given, const std::string& name,
                              const Item& item) {
    if (given && !is_species_name(*given)) {
      item.refuse("name", in_quotes(*given) + " cannot be a name",
                  "use up to 40 letters, digits, _ and -, without \"error\" as the last word");
    }
    if (!names.insert(name).second) {
      item.refuse("name", "a second fixture has the name " + in_quotes(name),
                  "give each a name of its own");
    }
    if (names.size() > kMostFixtures) {
      item.refuse("name", "there are more than " + std::to_string(kMostFixtures) + " fixtures",
                  "give fewer, for instance by polygons of several corners");
    }
  };
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
    const Item item(root, "obstacle", k, file);
    check_name(scene.obstacles[k].name, obstacle_name(scene.obstacles[k], k), item);
    item.check_species(names_of(scene.species));
    check_obstacle(scene, scene.obstacles[k], item);
  }
  for (std::size_t k = 0; k < scene.partitions.size(); ++k) {
    const Item item(root, "partition", k, file);
    check_name(scene.partitions[k].name, partition_name(scene.partitions[k], k), item);
    item.check_species(names_of(scene.species));
    check_partition(scene, scene.partitions[k], item);
  }
  if (!scene.has_fixtures()) return;
  constexpr std::size_t kMostPieces = 60'000;
  const std::size_t pieces = with_dimension(scene.dimension(), [&](auto dimension) {
    std::size_t sum = 0;
    for (const auto& fixture : fixtures_of<dimension>(scene))
      sum += fixture.pieces.size() + fixture.valves.size();
    return sum;
  });
  if (pieces > kMostPieces) {
    throw UserError(place_of(root, scene.obstacles.empty() ? "partition" : "obstacle", file),
                    "the fixtures have " + std::to_string(pieces) + " edges and corners",
                    "give fewer of them: at most " + std::to_string(kMostPieces));
  }
}

// Throws if numbers of particles beside a divider have no meaning or are too large.
static void check_count_left(const Scene& scene, const toml::table& root, const std::string& file) {
  const auto check = [&](const std::optional<int>& left, int count, const Place& place) {
    if (!left) return;
    if (!divider_of(scene)) {
      throw UserError(place, "'count_left' has no meaning in a box that nothing divides",
                      "remove it, or add [piston], or a [[partition]] between two walls");
    }
    if (scene.particles.start.layout == Layout::File) {
      throw UserError(place, "'count_left' has no meaning beside layout = \"file\"",
                      "remove it: the file has the positions");
    }
    if (*left <= count) return;
    throw UserError(place,
                    "of " + counted(static_cast<std::size_t>(count), "particle") + ", " +
                        std::to_string(*left) + " cannot start on one side",
                    "choose at most " + std::to_string(count));
  };
  const Place of_all = place_of(root, "particles.count_left", file);
  if (scene.particles.count_left && !scene.species.empty()) {
    throw UserError(of_all, "'particles.count_left' has no meaning beside [[species]]",
                    "give count_left to each species");
  }
  check(scene.particles.count_left, scene.particles.count, of_all);
  for (std::size_t k = 0; k < scene.species.size(); ++k) {
    check(scene.species[k].count_left, scene.species[k].count,
          Item(root, "species", k, file).place("count_left"));
  }
}

static void check_piston(const Scene& scene, const toml::table& root, const std::string& file) {
  if (!scene.piston) return;
  const Piston& piston = *scene.piston;
  const auto refuse = [&](const std::string& key, const std::string& problem,
                          const std::string& advice) {
    throw UserError(place_of(root, key, file), problem, advice);
  };
  const int axis = static_cast<int>(piston.axis);
  const std::string name(kAxes[static_cast<std::size_t>(axis)].name);
  if (axis >= scene.dimension()) {
    refuse("piston.axis", "the box has no z axis", "choose x or y");
  }
  if (scene.periodic(axis)) {
    refuse("piston.axis", "the box is periodic along " + name + ", where the piston slides",
           std::string("add [walls.") + kSideNames[2 * axis] + "] and [walls." +
               kSideNames[2 * axis + 1] + "], or choose an axis with walls");
  }
  if (scene.has_fixtures()) {
    refuse(scene.obstacles.empty() ? "partition" : "obstacle",
           "the piston would meet the fixtures of the box", "remove them, or the table [piston]");
  }
  const double low = 0.5 * piston.thickness, high = scene.box[axis] - low;
  if (!(piston.position > low && piston.position < high)) {
    const bool fits = low < high;
    refuse(fits ? "piston.position" : "piston.thickness",
           fits ? "the piston is not between the walls along " + name
                : "the piston is as thick as the box along " + name,
           fits ? "place it above " + number_text(low) + " and below " + number_text(high)
                : "make it thinner, or the box longer");
  }
  if (const toml::table* tables = root["piston"]["species"].as_table()) {
    const std::vector<std::string> known = names_of(scene.species);
    for (const auto& [species, table] : *tables) {
      if (std::ranges::find(known, species.str()) != known.end()) continue;
      refuse_species(place_of(root, "piston.species." + std::string(species.str()), file),
                     species.str(), known);
    }
  }
}

// Whether the particles of one side of a divider may have room there. A lattice decides for equal
// particles, the closest packing of equal ones for a mixture.
template <int D>
static bool may_fit(const Scene& scene, const Room<D>& room, const std::vector<int>& counts) {
  if (std::ranges::all_of(counts, [](int count) { return count == 0; })) return true;
  if (room.box.minCoeff() <= room.diameter) return false;
  if (scene.species.empty()) return lattice_capacity(room) >= counts[0];
  double filled = 0.0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    filled += counts[k] * packing_fraction(D, scene.species[k].mean_power(D) / room.box.prod());
  }
  return filled <= closest_packing(D);
}

// Throws if the particles on one side of a divider have no room at the start.
template <int D>
static void check_sides(const Scene& scene, const Place& place) {
  const Divider divider = *divider_of(scene);
  const double half = 0.5 * divider.thickness;
  const double low = scene.clear_corner()[divider.axis] + half;
  const double high = low + scene.clear_box()[divider.axis] - divider.thickness;
  if (divider.position < low || divider.position > high) {
    throw UserError(place, "the motion of a wall would reach this place at the start",
                    "choose a place between " + number_text(low) + " and " + number_text(high));
  }
  for (const int side : {0, 1}) {
    std::vector<int> counts;
    for (std::size_t k = 0; k < std::max<std::size_t>(scene.species.size(), 1); ++k) {
      const int left = count_left(scene, k);
      const int count = scene.species.empty() ? scene.particles.count : scene.species[k].count;
      counts.push_back(side == 0 ? left : count - left);
    }
    if (may_fit<D>(scene, start_side<D>(scene, side).room, counts)) continue;
    const int count = std::accumulate(counts.begin(), counts.end(), 0);
    throw UserError(place,
                    counted(static_cast<std::size_t>(count), "particle") + " cannot start " +
                        (side == 0 ? "below" : "above") + " the " +
                        (scene.piston ? "piston" : "partition"),
                    "move it, change count_left, or give fewer particles");
  }
}

void check_divider(const Scene& scene, const toml::table& root, const std::string& file) {
  check_count_left(scene, root, file);
  check_piston(scene, root, file);
  if (!starts_divided(scene) || scene.particles.start.layout == Layout::File) return;
  Place place = place_of(root, "piston.position", file);
  for (std::size_t k = 0; k < scene.partitions.size() && !scene.piston; ++k) {
    if (scene.periodic(static_cast<int>(scene.partitions[k].axis))) continue;
    place = Item(root, "partition", k, file).place("position");
    break;
  }
  with_dimension(scene.dimension(), [&](auto dimension) { check_sides<dimension>(scene, place); });
}

}  // namespace clatter
