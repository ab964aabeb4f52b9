// Time of one full prediction (all neighbours, walls, borders) on disks at rest in their cells, and
// of one contact time in vectors, by area fraction and number of disks.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

#include "engine/dynamics/cell_grid.h"
#include "engine/dynamics/prediction.h"
#include "engine/physics/contact_kernel.h"
#include "engine/physics/random.h"
#include "tests/bench/table.h"

using namespace clatter;

// Disks on a square lattice in a periodic box, with Gaussian velocities.
static LargeArray<Disk<2>> lattice(int side, double edge) {
  LargeArray<Disk<2>> disks(static_cast<std::size_t>(side * side));
  for (std::size_t i = 0; i < disks.size(); ++i) {
    Random random(1, Stream::Velocity, static_cast<std::uint32_t>(i), 0);
    const int n = static_cast<int>(i);
    disks[i].flight.r = Vec2(n % side + 0.5, n / side + 0.5) * (edge / side);
    disks[i].flight.v = {random.normal(), random.normal()};
  }
  return disks;
}

static double time_plan(int side, double area_fraction) {
  Model<2> model;
  const double edge = side * std::sqrt(std::numbers::pi / (4.0 * area_fraction));
  model.box = {edge, edge};
  const LargeArray<Disk<2>> disks = lattice(side, edge);
  CellGrid<2> grid(model, static_cast<double>(disks.size()));
  std::vector<Plan<2>> plans(disks.size());
  for (std::uint32_t i = 0; i < disks.size(); ++i) {
    plans[i].cell = grid.cell_at(disks[i].flight.r);
    grid.insert(i, plans[i].cell);
  }
  const Clock clock({0.0, 0.0});
  const Boundary<2> boundary(model, clock);
  const Prediction<2> prediction(model, boundary, disks, grid);
  const int rounds = 400000 / static_cast<int>(disks.size()) + 1;
  const double taken = bench::seconds([&] {
    for (int round = 0; round < rounds; ++round) {
      for (std::uint32_t i = 0; i < disks.size(); ++i) prediction.plan(i, 0.0, plans[i]);
    }
  });
  return taken / (static_cast<double>(rounds) * static_cast<double>(disks.size()));
}

static double time_kernel(int size) {
  std::vector<Disk<2>> disks(Candidates<2>::kCapacity + 1);
  Random random(2, Stream::Velocity, 0, 0);
  for (Disk<2>& disk : disks) {
    for (double& x : disk.flight.r) x = 6.0 * random.uniform() - 3.0;
    for (double& v : disk.flight.v) v = random.normal();
  }
  Candidates<2> candidates;
  for (int i = 0; i < size; ++i) candidates.disks[i] = static_cast<std::uint32_t>(i) + 1;
  candidates.size = size;
  const Vec2 box{100.0, 100.0};
  constexpr int kCalls = 1000000;
  const auto first_contact = first_contact_kernel<2>(false);
  const double taken = bench::seconds([&] {
    for (int call = 0; call < kCalls; ++call) {
      first_contact(disks.front().flight.r.data(), 0, candidates, box.data(), 1.0, nullptr);
    }
  });
  return taken / kCalls;
}

int main() {
  std::printf("%10s %10s %18s\n", "disks", "phi", "ns/prediction");
  for (const int side : {30, 100, 400}) {
    for (const double area_fraction : {0.1, 0.4, 0.7}) {
      std::printf("%10d %10.1f %18.1f\n", side * side, area_fraction,
                  1e9 * time_plan(side, area_fraction));
    }
  }
  std::printf("%10s %29s\n", "candidates", "ns/call of the kernel");
  for (const int size : {4, 8, 12, 16}) std::printf("%10d %29.1f\n", size, 1e9 * time_kernel(size));
}
