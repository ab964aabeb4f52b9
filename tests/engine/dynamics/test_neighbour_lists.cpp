#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "engine/dynamics/neighbourhood.h"
#include "engine/initial/start_state.h"
#include "engine/physics/random.h"
#include "engine/run/scheduled_run.h"
#include "tests/engine/support/gas.h"

using namespace clatter;
using testing::kAlike;

namespace {

// Particles that fly through each other, with their lists.
template <int D>
struct Ghosts {
  Model<D> model;
  std::vector<Flight<D>> flights;
  std::vector<Vec<D>> images;  // box lengths from the frames of the regions to those of the flights
  NeighbourLists<D> lists;
  std::vector<double> exits;  // [N] times
  double now = 0.0;

  Ghosts(const Model<D>& laws, std::vector<Flight<D>> ghosts)
      : model(laws),
        flights(std::move(ghosts)),
        images(flights.size(), Vec<D>::Zero()),
        lists(model, kAlike, static_cast<double>(flights.size())),
        exits(flights.size()) {
    for (std::uint32_t i = 0; i < flights.size(); ++i) lists.place(i, flights[i].r);
    for (std::uint32_t i = 0; i < flights.size(); ++i) plan(i);
  }

  void plan(std::uint32_t i) {
    exits[i] = model.has_gravity()
                   ? lists.template exit<true>(model, flights[i], images[i], i, now).time
                   : lists.template exit<false>(model, flights[i], images[i], i, now).time;
  }

  // Gives the next particle a new region. Returns false if no particle leaves its region.
  bool step() {
    const auto next = std::min_element(exits.begin(), exits.end());
    if (!(*next < kNever)) return false;
    REQUIRE(*next >= now);
    now = *next;
    const auto i = static_cast<std::uint32_t>(next - exits.begin());
    images[i] += lists.leave(model, flights[i], images[i], i, now);
    plan(i);
    return true;
  }

  Vec<D> position(std::uint32_t i) const {
    return flights[i].at(now, model.gravity) - images[i].cwiseProduct(model.box);
  }

  // Each periodic image within a diameter of a particle occurs exactly once in its list.
  int check() const {
    int touching = 0;
    for (std::uint32_t i = 0; i < flights.size(); ++i) {
      std::map<std::vector<double>, int> listed;
      lists.continuations().visit(lists.near(i), [&](std::uint32_t j, const Vec<D>& wrap) {
        std::vector<double> key(wrap.begin(), wrap.end());
        key.push_back(j);
        ++listed[key];
      });
      for (const auto& [key, times] : listed) REQUIRE(times == 1);
      for (int axis = 0; axis < D; ++axis) {
        if (model.periodic(axis)) continue;
        const double r = position(i)[axis];
        REQUIRE(r >= lists.distance_from_end(i, axis, false) - 1e-9);
        REQUIRE(model.box[axis] - r >= lists.distance_from_end(i, axis, true) - 1e-9);
      }
      for (std::uint32_t j = 0; j < flights.size(); ++j) {
        if (i == j) continue;
        for (int k = 0; k < (D == 2 ? 49 : 343); ++k) {
          Vec<D> wrap;
          bool exists = true;
          for (int axis = 0, digits = k; axis < D; ++axis, digits /= 7) {
            wrap[axis] = digits % 7 - 3;
            exists = exists && (wrap[axis] == 0.0 || model.periodic(axis));
          }
          const Vec<D> x = position(i) - position(j) - wrap.cwiseProduct(model.box);
          if (!exists || x.norm() > model.diameter) continue;
          std::vector<double> key(wrap.begin(), wrap.end());
          key.push_back(j);
          REQUIRE(listed.count(key) == 1);
          ++touching;
        }
      }
    }
    return touching;
  }
};

// A box of random size, down to the narrowest, with walled or periodic pairs of sides. The
// ghosts do not move towards walls.
template <int D>
Ghosts<D> random_ghosts(Random& random, bool falls) {
  constexpr double kEdges[] = {1.5, 1.6, 2.05, 2.5, 3.1, 4.0, 5.0, 7.3};
  Model<D> model;
  for (int axis = 0; axis < D; ++axis) {
    model.box[axis] = kEdges[random.below(std::size(kEdges))];
    if (random.below(3) == 0) model.walls[2 * axis] = model.walls[2 * axis + 1] = Wall{};
    if (falls && model.periodic(axis)) model.gravity[axis] = random.normal();
  }
  std::vector<Flight<D>> flights(2 + random.below(30));
  for (Flight<D>& flight : flights) {
    const double speed = std::pow(10.0, 4.0 * random.uniform() - 2.0);
    for (int axis = 0; axis < D; ++axis) {
      flight.r[axis] = model.box[axis] * random.uniform();
      if (model.periodic(axis)) flight.v[axis] = speed * random.normal();
    }
    if (random.below(8) == 0) flight.v.setZero();
  }
  return {model, flights};
}

template <int D>
void find_every_neighbour(std::uint32_t seed) {
  Random random(seed, Stream::Placement, 0, 0);
  int touching = 0;
  for (int i = 0; i < 150; ++i) {
    Ghosts<D> ghosts = random_ghosts<D>(random, i % 2 == 1);
    touching += ghosts.check();
    for (int step = 0; step < 60 && ghosts.step(); ++step) {
      if (step % 7 == 0) touching += ghosts.check();
    }
  }
  CHECK(touching > 10000);
}

// Spheres on a cubic lattice of some spacing in a cubic box, with thermal velocities.
std::vector<Flight<3>> lattice(int side, double spacing) {
  std::vector<Flight<3>> flights(static_cast<std::size_t>(side * side * side));
  for (std::uint32_t i = 0; i < flights.size(); ++i) {
    Random random(7, Stream::Placement, i, 0);
    const int k = static_cast<int>(i);
    flights[i].r = Vec<3>(k % side, k / side % side, k / side / side) * spacing;
    for (double& v : flights[i].v) v = random.normal();
  }
  return flights;
}

// Radius of the regions of an even gas: the distance of a particle at the middle of the box from
// its end, less that of its region.
double radius_of(const Model<3>& model, double particles) {
  NeighbourLists<3> lists(model, kAlike, particles);
  lists.place(0, 0.5 * model.box);
  return 0.5 * model.box.x() - lists.distance_from_end(0, 0, false);
}

Vec<3> wrapped(const Model<3>& model, const Vec<3>& r) {
  return model.domain().wrapped(r);
}

bool lists_it(const NeighbourLists<3>& lists, std::uint32_t particle, std::uint32_t neighbour) {
  bool listed = false;
  lists.continuations().visit(lists.near(particle), [&](std::uint32_t other, const Vec<3>&) {
    listed = listed || other == neighbour;
  });
  return listed;
}

double mean_neighbours(const Ghosts<3>& ghosts) {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < ghosts.flights.size(); ++i) {
    count += ghosts.lists.continuations().count(ghosts.lists.near(i));
  }
  return static_cast<double>(count) / static_cast<double>(ghosts.flights.size());
}

}  // namespace

TEST_CASE("NeighbourLists: every image within one diameter is found exactly once") {
  find_every_neighbour<2>(70);
  find_every_neighbour<3>(71);
}

TEST_CASE("NeighbourLists: of two neighbours each is listed by the other, at any rounding") {
  // Regions that just meet or just do not, at random places relative to the cells.
  Random random(72, Stream::Placement, 0, 0);
  Model<3> model;
  model.box.setConstant(30.0);
  const double reach = 1.01 + 2.0 * radius_of(model, 10000.0);
  int met = 0, unequal = 0;
  constexpr int kPairs = 400000;
  for (int i = 0; i < kPairs; i += 1000) {
    NeighbourLists<3> lists(model, kAlike, 10000.0);
    for (std::uint32_t k = 0; k < 1000; k += 2) {
      // Positions along x of one pair for each row of the box.
      const Vec<3> r(5.0 + 10.0 * random.uniform(), 30.0 * random.uniform(),
                     30.0 * random.uniform());
      Vec<3> way(random.normal(), random.normal(), random.normal());
      way *= reach * (1.0 + 3e-7 * (random.uniform() - 0.5)) / way.norm();
      lists.place(k, wrapped(model, r));
      lists.place(k + 1, wrapped(model, r + way));
      const bool first = lists_it(lists, k, k + 1), second = lists_it(lists, k + 1, k);
      unequal += first != second;
      met += first;
    }
  }
  CHECK(unequal == 0);
  CHECK(met > kPairs / 20);
  CHECK(met < kPairs / 2 - kPairs / 20);
}

TEST_CASE("NeighbourLists: lists are short, also in a cluster") {
  Model<3> model;
  model.box.setConstant(10.0 * 1.05);
  Ghosts<3> even(model, lattice(10, 1.05));
  CHECK(mean_neighbours(even) < 30.0);
  for (int step = 0; step < 20000; ++step) even.step();
  CHECK(mean_neighbours(even) > 8.0);
  CHECK(mean_neighbours(even) < 24.0);

  // The same spheres in a corner of a box with 1000 times the volume. Regions for the mean density
  // would list nearly all spheres.
  model.box.setConstant(100.0 * 1.05);
  std::vector<Flight<3>> crowd = lattice(10, 1.05);
  for (Flight<3>& flight : crowd) flight.v *= 1e-3;
  Ghosts<3> cluster(model, crowd);
  CHECK(mean_neighbours(cluster) > 400.0);
  for (int step = 0; step < 60000; ++step) cluster.step();
  CHECK(mean_neighbours(cluster) < 40.0);
}

TEST_CASE("Neighbourhood: a dilute gas in a wide, flat box needs no cells of a dense one") {
  Model<3> model;
  model.box = {3.0, 1e6, 1e6};
  Neighbourhood<3> near(model, kAlike, 100.0);
  CHECK(near.place(7, {1.0, 2.0, 3.0}).minCoeff() >= 0);
}

TEST_CASE("Neighbourhood: dense spheres in a box of hardly a diameter do not miss each other") {
  Scene scene = default_scene(3);
  scene.box = Vec<3>{1.0001, 1.05, 2.1};
  scene.particles.count = 2;
  REQUIRE(scene.packing_fraction() > 0.45);
  State<3> state = start_state<3>(scene, 1);
  state.velocities = {Vec<3>(1.0, 0.3, 0.2), Vec<3>(-0.8, 0.4, -0.3)};
  Simulation<3> simulation(model_of<3>(scene, 1), state);
  CHECK(simulation.run_until(1000.0, kNoLimit, 1000000));
  CHECK(simulation.counts().pair_collisions > 1000);
  CHECK(simulation.checks().deepest_overlap < 1e-9);
}
