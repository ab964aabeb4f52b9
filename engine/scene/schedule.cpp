#include "engine/scene/schedule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "engine/error.h"
#include "engine/scene/key_writer.h"
#include "engine/scene/scene_document.h"
#include "engine/text.h"

namespace clatter {

bool may_change_live(std::string_view key) {
  constexpr std::array<std::string_view, 4> kOfParticles = {
      "particles.restitution", "particles.friction", "particles.tangential_restitution",
      "particles.inertia"};
  if (std::ranges::find(kOfParticles, key) != kOfParticles.end()) return true;
  if (key == "shear.rate") return true;
  for (const std::string_view table : {"gravity", "bulk_drive", "collapse"}) {
    if (key.substr(0, key.find('.')) == table) return true;
  }
  if (key.starts_with("obstacle.") || key.starts_with("partition.")) {
    return !key.ends_with(".name") && !key.ends_with(".kind") && !key.ends_with(".axis");
  }
  if (key.starts_with("piston.")) {
    constexpr std::array<std::string_view, 5> kOfPiston = {"piston.restitution", "piston.friction",
                                                           "piston.tangential_restitution",
                                                           "piston.force", "piston.pinned"};
    return key.starts_with("piston.species.") ||
           std::ranges::find(kOfPiston, key) != kOfPiston.end();
  }
  return key.starts_with("walls.") || (key.starts_with("pair.") && key != "pair.species");
}

static void require_live(const std::vector<Override>& settings) {
  for (const Override& setting : settings) {
    if (may_change_live(setting.key)) continue;
    if (setting.key.starts_with("species.")) {
      throw UserError({}, "'" + setting.key + "' cannot change while the gas moves",
                      "change laws of pairs only: larger particles would overlap, and another mass "
                      "or inertia would change the energy");
    }
    throw UserError(
        {}, "'" + setting.key + "' cannot change while the gas moves",
        "change laws only: restitution, friction, walls, obstacles, partitions, force and "
        "pinned of the piston, gravity, shear.rate, bulk_drive, collapse");
  }
}

static void require_same_grains(const Scene& before, const Scene& now) {
  if (before.species.empty() || before.particles.inertia == now.particles.inertia) return;
  throw UserError({}, "'particles.inertia' cannot change while a mixture moves",
                  "another inertia would change the energy: start again");
}

// Particles of a run know fixtures by their numbers.
static void require_same_fixtures(const Scene& before, const Scene& now) {
  const bool same = std::ranges::equal(before.obstacles, now.obstacles,
                                       [](const Obstacle& a, const Obstacle& b) {
                                         return a.name == b.name && a.kind == b.kind;
                                       }) &&
                    std::ranges::equal(before.partitions, now.partitions,
                                       [](const Partition& a, const Partition& b) {
                                         return a.name == b.name && a.axis == b.axis;
                                       });
  if (same) return;
  throw UserError({}, "a name, kind or axis of a fixture cannot change while the gas moves",
                  "give the scene a second fixture with present = false, and exchange them");
}

static void require_same_sides(const Scene& before, const Scene& now) {
  for (int axis = 0; axis < before.dimension(); ++axis) {
    if (before.periodic(axis) == now.periodic(axis)) continue;
    throw UserError({}, "walls are added or removed", "change only keys of existing walls");
  }
}

static void require_same_shear(const Scene& before, const Scene& now) {
  if (before.shear_rate.has_value() == now.shear_rate.has_value()) return;
  throw UserError({}, "[shear] is added or removed while the gas moves",
                  "start with [shear]: its rate may be 0, and can change");
}

// The partner of a contact whose keys begin with `owner`, as a wall: particles, a pair of species,
// a wall or fixture, or one as a species meets it. Absent for other keys.
static std::optional<Wall> partner_of(const Scene& laws, const std::string& owner) {
  const auto of_law = [](const PairLaw& law) {
    return Wall{.restitution = law.restitution, .roughness = law.roughness};
  };
  if (owner == "particles") return of_law({laws.particles.restitution, laws.particles.roughness});
  for (std::size_t a = 0; a < laws.species.size(); ++a) {
    const std::string& first = laws.species[a].name;
    for (std::size_t b = 0; b < laws.species.size(); ++b) {
      if (owner == "pair." + first + '.' + laws.species[b].name) return of_law(laws.pair_law(a, b));
    }
  }
  for (int side = 0; side < 2 * laws.dimension(); ++side) {
    if (!laws.walls[side]) continue;
    const std::string path = std::string("walls.") + kSideNames[side];
    if (owner == path) return laws.walls[side];
    for (std::size_t a = 0; a < laws.species.size(); ++a) {
      if (owner == path + ".species." + laws.species[a].name) return laws.wall(side, a);
    }
  }
  const auto of_fixture = [&](const std::string& path,
                              const FixtureLaw& law) -> std::optional<Wall> {
    if (owner == path) return law.wall();
    for (std::size_t a = 0; a < laws.species.size(); ++a) {
      if (owner == path + ".species." + laws.species[a].name) return law.wall(a);
    }
    return std::nullopt;
  };
  if (laws.piston) {
    if (const auto wall = of_fixture("piston", laws.piston->law)) return wall;
  }
  for (std::size_t k = 0; k < laws.obstacles.size(); ++k) {
    const std::string path = "obstacle." + obstacle_name(laws.obstacles[k], k);
    if (const auto wall = of_fixture(path, laws.obstacles[k].law)) return wall;
  }
  for (std::size_t k = 0; k < laws.partitions.size(); ++k) {
    const std::string path = "partition." + partition_name(laws.partitions[k], k);
    if (const auto wall = of_fixture(path, laws.partitions[k].law)) return wall;
  }
  return std::nullopt;
}

// The number in force of a partner's key that the scene leaves out; absent for other keys.
static std::optional<double> default_in_force(const Scene& laws, const std::string& key) {
  const std::size_t dot = key.rfind('.');
  const std::string owner = key.substr(0, dot), name = key.substr(dot + 1);
  const auto partner = partner_of(laws, owner);
  if (!partner) return std::nullopt;
  if (name == "restitution") return partner->restitution;
  if (name == "drive_speed") return partner->drive_speed;
  if (name == "temperature") return partner->temperature;
  const Roughness& rough = partner->roughness;
  if (!rough.friction && !rough.tangential_restitution) return std::nullopt;
  if (name == "friction") return rough.friction_in_force();
  if (name == "tangential_restitution") return rough.tangential_restitution_in_force();
  return std::nullopt;
}

// The number at a path; absent without one.
static std::optional<double> number_at(toml::table& root, const std::string& path) {
  const toml::node* node = node_at(root, path);
  return node ? node->value<double>() : std::nullopt;
}

// The numbers of a ramp after a share of the way from the current values to the targets.
static std::vector<Override> on_the_way(const Scene& laws, const std::vector<Override>& targets,
                                        double share) {
  toml::table now = parse_document(scene_to_toml(laws), "");
  std::vector<Override> settings;
  for (const auto& [key, value] : targets) {
    const toml::table wanted = parse_document("value = " + value, "");
    const auto given = number_at(now, key);
    const auto from = given ? given : default_in_force(laws, key);
    const auto to = wanted["value"].value<double>();
    if (!from || !to) {
      throw UserError({},
                      "'" + key + "' has no " + (to ? "number to start from" : "number to go to"),
                      "let it change without a ramp");
    }
    if (std::isinf(*from) || std::isinf(*to)) {
      throw UserError({}, "'" + key + "' has no ramp " + (std::isinf(*to) ? "to" : "from") + " inf",
                      "use a large number, or let it change without a ramp");
    }
    settings.push_back({key, value_text(*from + share * (*to - *from))});
  }
  return settings;
}

Schedule::Schedule(const Scene& scene)
    : Schedule(scene, -std::numeric_limits<double>::infinity()) {}

Schedule::Schedule(const Scene& scene, double time) : laws_(scene) {
  changes_ = std::make_shared<std::deque<Change>>(laws_.changes.begin(), laws_.changes.end());
  count_ = changes_->size();
  laws_.changes.clear();
  for (std::size_t number = 0; number < count_; ++number) plan(number, time);
}

std::vector<Change> Schedule::changes() const {
  return {changes_->begin(), changes_->begin() + static_cast<std::ptrdiff_t>(count_)};
}

Scene Schedule::scene() const {
  Scene scene = laws_;
  scene.changes = changes();
  return scene;
}

double Schedule::next() const {
  return steps_.empty() ? std::numeric_limits<double>::infinity() : steps_.front().time;
}

void Schedule::add(const Change& change) {
  if (changes_->size() > count_) {  // another copy has extended the list
    const std::vector<Change> own = changes();
    changes_ = std::make_shared<std::deque<Change>>(own.begin(), own.end());
  }
  changes_->push_back(change);
  plan(count_++, -std::numeric_limits<double>::infinity());
}

// The time of a part of a ramp, or of a change without a ramp.
static double time_of(const Change& change, int part) {
  if (!change.ramp) return change.time;
  const double share = static_cast<double>(part) / Schedule::kRampSteps;
  return change.time + share * (change.until - change.time);
}

// Puts the first step of a change after a time, if there is one.
void Schedule::plan(std::size_t number, double after) {
  const Change& change = (*changes_)[number];
  const int parts = change.ramp ? kRampSteps : 1;
  int part = 1;
  while (part <= parts && time_of(change, part) <= after) ++part;
  if (part <= parts) put({time_of(change, part), number, part});
}

void Schedule::put(const Step& step) {
  steps_.push_back(step);
  std::push_heap(steps_.begin(), steps_.end());
}

void Schedule::change_to(const std::vector<Override>& settings) {
  if (settings.empty()) return;
  require_live(settings);
  Scene changed = with_settings(laws_, settings);
  require_same_sides(laws_, changed);
  require_same_shear(laws_, changed);
  require_same_grains(laws_, changed);
  require_same_fixtures(laws_, changed);
  laws_ = std::move(changed);
}

void Schedule::advance() {
  const Step step = steps_.front();
  const Change& change = (*changes_)[step.change];
  std::pop_heap(steps_.begin(), steps_.end());
  steps_.pop_back();
  if (!change.ramp || step.part == kRampSteps) {
    change_to(change.set);
    return;
  }
  const int part = step.part + 1;
  put({time_of(change, part), step.change, part});
  // The share refers to the remaining way, so that the last step reaches the target.
  change_to(on_the_way(laws_, change.set, 1.0 / (kRampSteps - step.part + 1)));
}

// A run that halted among the events and changes of a time has this time, with rounding.
void Schedule::skip_to(double time, std::uint64_t steps) {
  constexpr double kRoundings = 4.0 * std::numeric_limits<double>::epsilon();
  while (next() <= time) {
    const bool now = next() * (1.0 + kRoundings) >= time;
    if (steps-- == 0 && now) return;
    advance();
  }
}

}  // namespace clatter
