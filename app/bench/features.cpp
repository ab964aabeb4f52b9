#include "app/bench/features.h"

#include <fmt/printf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string_view>

#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/live/triple_buffer.h"
#include "engine/measure/balance.h"
#include "engine/measure/cell_integrals.h"
#include "engine/observables/observables.h"
#include "engine/physics/theory.h"
#include "engine/picture/snapshot.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/enum_names.h"
#include "engine/scene/scene_file.h"
#include "engine/system/usage.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

constexpr double kAreaFraction = 0.3;
constexpr int kRounds = 7;
constexpr std::uint64_t kPerDisk = 200;  // collisions in a round

// A run of a feature. Times batches of collisions repeatedly.
class Trial {
 public:
  Trial(const Feature& feature, const Scene& scene)
      : feature_(feature), scene_(scene), simulation_(simulation_of<2>(scene, 1)) {
    equilibrate();
    if (!feature.fields.empty()) take_fields();
    if (feature.balance) {
      balance_.emplace(*simulation_, IntVec<2>(scene_.box.cast<int>()));
      simulation_->add_observer(*balance_);
    }
    if (feature.observable) take_observable(*feature.observable);
    if (feature.frames > 0.0) {
      simulation_->every(simulation_->time(), 1.0 / feature.frames, [this](double) {
        frames_.back() = snapshot_of(*simulation_);
        frames_.publish();
      });
    }
  }

  // Collisions with disks and walls, per CPU second.
  double rate(std::uint64_t batch) {
    const std::uint64_t before = collisions();
    const double began = cpu_seconds();
    simulation_->run_until(kNever, before + batch);
    if (feature_.checkpoint) put_aside();
    return static_cast<double>(collisions() - before) / (cpu_seconds() - began);
  }

 private:
  std::uint64_t collisions() const {
    return simulation_->counts().pair_collisions + simulation_->counts().wall_collisions;
  }

  void equilibrate() {
    constexpr std::uint64_t kAtFirst = 20;
    simulation_->run_until(kNever, kAtFirst * static_cast<std::uint64_t>(scene_.particles.count));
  }

  void take_fields() {
    const bool samples = feature_.snapshots.has_value();
    integrals_.emplace(*simulation_, IntVec<2>(scene_.box.cast<int>()),
                       moment_layout<2>(feature_.fields, simulation_->model().spins, false),
                       Coarsening{samples ? Estimator::Snapshot : Estimator::Exact, {}});
    simulation_->add_observer(*integrals_);
    if (samples) {
      simulation_->every(simulation_->time() + *feature_.snapshots, *feature_.snapshots,
                         [this](double) { integrals_->sample(); });
    }
  }

  // Samples are taken once per mean free time.
  void take_observable(ObservableKind kind) {
    Measure measure;
    measure.observables = {kind};
    const double interval = 1.0 / enskog_rate(kAreaFraction, 1.0);
    for (double* each :
         {&measure.radial_distribution.interval, &measure.velocity_distribution.interval,
          &measure.structure_factor.interval, &measure.clusters.interval,
          &measure.wall_power.interval, &measure.plane_current.interval,
          &measure.local_density.interval, &measure.spin_distribution.interval,
          &measure.probe.interval, &measure.collision_counts.interval,
          &measure.radial_distribution_profile.interval, &measure.mixing.interval}) {
      *each = interval;
    }
    for (TimeCorrelationSettings* settings :
         {&measure.mean_squared_displacement, &measure.velocity_autocorrelation,
          &measure.bond_order.lags_in_time}) {
      *settings = {.interval = interval, .longest = 100.0 * interval, .lags = 10};
    }
    observables_.emplace(*simulation_, measure);
    observables_->start();
    observables_->add_timers(timers_.emplace(*simulation_), simulation_->time());
  }

  void put_aside() {
    const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                       ("clatter-bench-" + std::to_string(process_number()));
    Checkpoint checkpoint{.program = "clatter " CLATTER_VERSION,
                          .command = "bench",
                          .scene = scene_to_toml(scene_),
                          .start_temperature = scene_.particles.start.temperature,
                          .seed = 1,
                          .saved = simulation_->save(),
                          .measurement = {},
                          .film = {},
                          .trajectory = {},
                          .events = {}};
    write_checkpoint(file, checkpoint);
    std::filesystem::remove(file);
    std::filesystem::remove(previous_checkpoint(file));
  }

  const Feature& feature_;
  Scene scene_;
  std::unique_ptr<Simulation<2>> simulation_;
  std::optional<CellIntegrals<2>> integrals_;
  std::optional<Balance<2>> balance_;
  std::optional<Observables<2>> observables_;
  std::optional<Timers<2>> timers_;  // of its samples
  TripleBuffer<Snapshot> frames_;
};

void add_walls(Scene& scene, Side near, const Wall& wall) {
  scene.walls[near] = scene.walls[near + 1] = wall;
}

// Weak dissipation: an undriven gas hardly changes while it is timed.
void lose_energy(Scene& scene) {
  scene.particles.restitution = 0.999;
}

void shake(Scene& scene) {
  scene.particles.restitution = 0.9;
  add_walls(scene, kLeft, {.kind = WallKind::Driven, .drive_speed = 1.0});
}

void make_rough(Scene& scene) {
  scene.particles.roughness = {.friction = std::numeric_limits<double>::infinity(),
                               .tangential_restitution = 1.0};
}

void close_box(Scene& scene) {
  add_walls(scene, kLeft, {});
  add_walls(scene, kBottom, {});
}

// Two species that differ in name only.
void split_species(Scene& scene) {
  scene.species.resize(2);
  scene.species[0].name = "one";
  scene.species[1].name = "other";
  scene.species[0].count = scene.particles.count / 2;
  scene.species[1].count = scene.particles.count - scene.species[0].count;
}

// A feature that an observable adds, with the walls, spins or species that it needs.
Feature with_observable(std::string_view name, ObservableKind kind) {
  Feature feature{.name = std::string(name), .add = [](Scene&) {}, .observable = kind};
  if (kind == ObservableKind::WallHits || kind == ObservableKind::WallPower) {
    feature.name += ", four walls";
    feature.add = close_box;
  } else if (kind == ObservableKind::SpinDistribution) {
    feature.name += ", rough";
    feature.add = make_rough;
  } else if (kind == ObservableKind::Mixing) {
    feature.name += ", two species";
    feature.add = split_species;
  }
  return feature;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

std::vector<Feature> features() {
  const auto nothing = [](Scene&) {};
  const std::vector<Field> temperature = {Quantity::Temperature};
  std::vector<Field> all = all_fields(2);
  std::erase_if(all, [](Field field) {
    return field.part != Part::Total || of_spins(field) || is_residual(field);
  });
  std::vector<Feature> rows = {
      {"bare", nothing},
      {"bare again", nothing},
      {"inelastic", lose_energy},
      {"inelastic, driven walls", shake},
      {"inelastic, moving walls",
       [](Scene& scene) {
         scene.particles.restitution = 0.9;
         add_walls(scene, kLeft, {.kind = WallKind::Sawtooth, .stroke = 0.1, .frequency = 5.0});
       }},
      {"inelastic, bulk drive",
       [](Scene& scene) {
         scene.particles.restitution = 0.9;
         scene.bulk_drive = BulkDrive{.interval = 0.05, .kick_speed = 0.12};
       }},
      {"walls on four sides", close_box},
      {"gravity",
       [](Scene& scene) {
         add_walls(scene, kBottom, {});
         scene.gravity = Vec2(0.0, -0.02);
       }},
      {"rough", make_rough},
      {"t_c",
       [](Scene& scene) {
         lose_energy(scene);
         scene.contact_time = 1e-6;
       }},
      {"fields exact", nothing, temperature},
      {"fields exact, all", nothing, all},
      {"fields snapshot 1", nothing, temperature, 1.0},
      {"balance", nothing, {}, {}, 0.0, true},
      {"60 frames a time unit", nothing, {}, {}, 60.0},
      {"checkpoint each round", nothing, {}, {}, 0.0, false, true}};
  for (const auto& [name, kind] : kObservables) rows.push_back(with_observable(name, kind));
  return rows;
}

int bench_features(const std::string& json, int count) {
  Scene bare;
  bare.particles.count = count > 0 ? count : 1000;
  bare.box.setConstant(std::sqrt(bare.particles.count * 0.25 * std::numbers::pi / kAreaFraction));
  const auto batch = kPerDisk * static_cast<std::uint64_t>(bare.particles.count);
  std::fprintf(stderr,
               "%d disks, phi = %g; %d rounds of %llu collisions each, interleaved; rate: "
               "collisions with disks and walls per CPU second, relative to the bare run (elastic, "
               "periodic) of the same round, median\n",
               bare.particles.count, kAreaFraction, kRounds,
               static_cast<unsigned long long>(batch));

  const std::vector<Feature> added = features();
  std::vector<std::unique_ptr<Trial>> trials;
  for (const Feature& feature : added) {
    Scene scene = bare;
    feature.add(scene);
    trials.push_back(std::make_unique<Trial>(feature, scene));
  }
  std::vector<std::vector<double>> rates(added.size()), ratios(added.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t k = 0; k < trials.size(); ++k) {
      rates[k].push_back(trials[k]->rate(batch));
      ratios[k].push_back(rates[k].back() / rates[0].back());
    }
  }

  print(fmt::sprintf("%-32s %9s %7s\n", "with", "Mcoll/s", "rate"));
  auto rows = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < added.size(); ++k) {
    const double rate = 1e-6 * median(rates[k]), ratio = median(ratios[k]);
    print(fmt::sprintf("%-32s %9.3f %7.3f\n", added[k].name.c_str(), rate, ratio));
    rows.push_back({{"feature", added[k].name},
                    {"million_collisions_per_cpu_second", rate},
                    {"rate_over_bare", ratio}});
  }
  if (!json.empty()) write_file(json, rows.dump(1) + "\n");
  return kOk;
}

}  // namespace clatter
