#include "app/bench/engine.h"

#include <fmt/format.h>
#include <fmt/printf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <locale>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <vector>

#include "app/bench/tables.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/dimension.h"
#include "engine/dynamics/simulation.h"
#include "engine/error.h"
#include "engine/initial/mixture_state.h"
#include "engine/physics/lattice.h"
#include "engine/physics/theory.h"
#include "engine/run/scheduled_run.h"
#include "engine/system/platform.h"
#include "engine/system/usage.h"
#include "engine/system/write_file.h"

namespace clatter {

Scene elastic_gas(int count, double fraction, int dimension) {
  Scene scene = default_scene(dimension);
  scene.particles.count = count;
  const double volume = count * packing_fraction(dimension, 1.0) / fraction;
  scene.box.setConstant(dimension == 2 ? std::sqrt(volume) : std::cbrt(volume));
  return scene;
}

bool has_room(int count, double fraction, int dimension) {
  return with_dimension(dimension, [&](auto d) {
    return lattice_capacity(elastic_gas(count, fraction, d).template start_room<d>()) >= count;
  });
}

namespace {

using Json = nlohmann::ordered_json;

// Measures the run that `make` returns. Equilibrates for a number of collisions per particle;
// absent: the set-up alone is measured.
template <class Make>
EngineRate measure_run(int count, double fraction, std::optional<std::uint64_t> equilibration,
                       const Make& make) {
  constexpr int kRepetitions = 3;
  const auto particles = static_cast<std::uint64_t>(count);
  restart_peak_memory();
  const std::uint64_t memory_before = peak_memory_bytes();
  const double setup_began = cpu_seconds();
  const auto simulation = make();
  EngineRate result{count, fraction, std::nan(""), cpu_seconds() - setup_began, 0.0};
  if (equilibration) simulation->run_until(kNever, *equilibration * particles / 2);
  const std::uint64_t batch = std::max<std::uint64_t>(1'000'000, particles);
  for (int k = 0; equilibration && k < kRepetitions; ++k) {
    const double began = cpu_seconds();
    simulation->run_until(kNever, simulation->counts().pair_collisions + batch);
    const double rate = 1e-6 * static_cast<double>(batch) / (cpu_seconds() - began);
    result.rate = std::fmax(result.rate, rate);
  }
  constexpr double kResolved = 4.0 * 1024.0 * 1024.0;
  const auto memory = static_cast<double>(peak_memory_bytes() - memory_before);
  result.bytes_per_particle =
      memory < kResolved ? std::nan("") : memory / static_cast<double>(particles);
  return result;
}

constexpr std::uint64_t kEquilibration = 10;  // collisions of each elastic particle

EngineRate measure_engine(const Scene& scene, std::optional<std::uint64_t> equilibration) {
  return with_dimension(scene.dimension(), [&](auto dimension) {
    return measure_run(scene.particles.count, scene.packing_fraction(), equilibration,
                       [&] { return simulation_of<dimension>(scene, 1); });
  });
}

// A mixture of elastic particles in a periodic square or cube.
template <int D>
EngineRate measure_mixture(const std::vector<BenchSpecies>& species, double fraction,
                           std::optional<std::uint64_t> equilibration) {
  std::vector<Grain> grains;
  Model<D> model;
  model.diameter = 0.0;
  double volume = 0.0;
  for (std::uint32_t s = 0; s < species.size(); ++s) {
    const auto& [count, diameter, mass] = species[s];
    grains.insert(grains.end(), static_cast<std::size_t>(count),
                  {.radius = 0.5 * diameter, .mass = mass, .species = s});
    model.diameter = std::max(model.diameter, diameter);
    volume += packing_fraction(D, count * std::pow(diameter, D));
  }
  model.box.setConstant(std::pow(volume / fraction, 1.0 / D));
  if (model.box[0] < 2.0 * model.diameter) {
    throw UserError({"--species", 0, 0},
                    "the box would be narrower than two of the largest particles",
                    "choose more particles, or a smaller fraction");
  }
  model.species =
      SpeciesLaws<D>{.pairs = std::vector<PairLaw>(species.size() * species.size()),
                     .walls = std::vector<std::array<std::optional<Wall>, 2 * D>>(species.size())};
  const int count = static_cast<int>(grains.size());
  return measure_run(count, fraction, equilibration, [&] {
    State<D> state = mixture_state<D>(model, grains, 1.0, 1);
    if (state.positions.empty()) {
      throw UserError({"--species", 0, 0}, "these particles find no places at this fraction",
                      "choose a smaller fraction");
    }
    return std::make_unique<Simulation<D>>(model, std::move(state));
  });
}

// Prints the rows of a table and returns them as JSON.
Json print_rates(const std::vector<EngineCell>& cells, int dimension,
                 const std::vector<BenchSpecies>& species,
                 std::optional<std::uint64_t> equilibration, std::vector<EngineRate>& rates) {
  const bool disks = dimension == 2;
  std::fprintf(stderr, "elastic %s, periodic box; Mcoll/s: 10^6 pair collisions per CPU second\n",
               disks ? "disks" : "spheres");
  print(fmt::sprintf("%10s %6s %9s %9s %11s\n", "N", "phi", "Mcoll/s", "setup s",
                     disks ? "bytes/disk" : "bytes/sph."));
  Json json = Json::array();
  for (const auto& [count, fraction] : cells) {
    EngineRate r;
    if (species.empty()) {
      r = measure_engine(elastic_gas(count, fraction, dimension), equilibration);
    } else {
      r = with_dimension(dimension, [&, phi = fraction](auto d) {
        return measure_mixture<d>(species, phi, equilibration);
      });
    }
    r.fraction = fraction;  // the box differs by rounding
    rates.push_back(r);
    const double bytes = r.bytes_per_particle;
    print(fmt::sprintf("%10d %6.3f %9s %9.3f %11s\n", r.count, r.fraction,
                       std::isnan(r.rate) ? "-" : fmt::format("{:.3f}", r.rate).c_str(),
                       r.setup_seconds,
                       std::isnan(bytes) ? "-" : fmt::format("{:.0f}", bytes).c_str()));
    json.push_back({{"count", r.count},
                    {disks ? "area_fraction" : "volume_fraction", r.fraction},
                    {"million_collisions_per_cpu_second", r.rate},
                    {"setup_seconds", r.setup_seconds},
                    {disks ? "bytes_per_disk" : "bytes_per_sphere", bytes}});
  }
  return json;
}

Json print_inhomogeneous(int count) {
  print(fmt::sprintf("%-24s %10s %6s %9s %9s\n", "gas", "N", "phi", "Mcoll/s", "of homog."));
  Json json = Json::array();
  for (const Inhomogeneous& gas : inhomogeneous_gases(count)) {
    const double homogeneous =
        measure_engine(elastic_gas(count, gas.scene.packing_fraction()), kEquilibration).rate;
    const EngineRate r = measure_engine(gas.scene, gas.after);
    print(fmt::sprintf("%-24s %10d %6.3f %9.3f %9.2f\n", gas.name, r.count, r.fraction, r.rate,
                       r.rate / homogeneous));
    json.push_back({{"gas", gas.name},
                    {"count", r.count},
                    {"area_fraction", r.fraction},
                    {"million_collisions_per_cpu_second", r.rate},
                    {"of_homogeneous", r.rate / homogeneous}});
  }
  return json;
}

}  // namespace

Plot growth_plot(const std::vector<EngineRate>& rates) {
  Plot plot{.title = "Collision rate of the engine",
            .caption = "Elastic disks in a periodic box, one core, by area fraction phi",
            .x_name = "number of disks",
            .y_name = "million collisions per CPU second",
            .panels = {}};
  double area_fraction = 0.0;
  for (const EngineRate& rate : rates) {
    if (rate.fraction != area_fraction) {
      plot.panels.push_back({fmt::format("phi = {:g}", rate.fraction), {}});
      area_fraction = rate.fraction;
    }
    plot.panels.back().points.push_back(
        {static_cast<double>(rate.count), rate.rate, fmt::format("{:.2f}", rate.rate), false});
  }
  return plot;
}

std::vector<Inhomogeneous> inhomogeneous_gases(int count) {
  constexpr double kMeanAreaFraction = 0.1;
  Scene cooling = elastic_gas(count, kMeanAreaFraction);
  cooling.particles.restitution = 0.6;
  cooling.contact_time = 1e-6;
  Scene falling = elastic_gas(count, kMeanAreaFraction);
  falling.particles.restitution = 0.9;
  falling.contact_time = 1e-6;
  falling.walls[kTop] = Wall{};
  falling.walls[kBottom] = Wall{.restitution = 0.9};
  falling.gravity = Vec2(0.0, -0.2);
  return {{"cooled into clusters", std::move(cooling), 200},
          {"collapsed under gravity", std::move(falling), 200}};
}

std::vector<BenchSpecies> parse_species(const std::string& text) {
  constexpr int kMost = 10'000'000;
  constexpr double kLeast = 1e-3, kLargest = 1e3, kLeastMass = 1e-9, kLargestMass = 1e9;
  std::vector<BenchSpecies> species;
  std::istringstream parts(text);
  std::string part;
  do {
    std::getline(parts, part, ',');
    std::istringstream numbers(part);
    numbers.imbue(std::locale::classic());
    BenchSpecies s;
    char colon = 0, another = 0;
    const bool reads = numbers >> s.count >> colon >> s.diameter >> another >> s.mass &&
                       numbers.peek() == std::istringstream::traits_type::eof() && colon == ':' &&
                       another == ':';
    if (!reads || s.count < 1 || s.count > kMost || !(s.diameter >= kLeast) ||
        !(s.diameter <= kLargest) || !(s.mass >= kLeastMass) || !(s.mass <= kLargestMass)) {
      throw UserError({"--species", 0, 0}, "`" + part + "` is not a count, a diameter and a mass",
                      "write COUNT:DIAMETER:MASS for each species, with commas between them");
    }
    species.push_back(s);
  } while (!parts.eof());
  return species;
}

std::vector<EngineCell> engine_cells(const EngineTable& table) {
  const int dimension = table.volume_fraction ? 3 : table.dimension;
  const double fraction = table.volume_fraction.value_or(table.area_fraction);
  std::vector<EngineCell> cells;
  if (!table.species.empty()) {
    int count = 0;
    for (const BenchSpecies& species : table.species) count += species.count;
    cells = {{count, fraction}};
  } else if (table.count > 0) {
    if (!has_room(table.count, fraction, dimension)) {
      throw UserError({table.volume_fraction ? "--volume-fraction" : "--area-fraction", 0, 0},
                      "no square or cubic box holds this number of particles at this fraction",
                      "choose a smaller fraction, or another --count");
    }
    cells = {{table.count, fraction}};
  } else if (dimension == 3) {
    for (const double phi : {0.1, 0.3, 0.49}) {
      for (const int spheres : {1'372, 10'976, 87'808, 1'000'000}) cells.emplace_back(spheres, phi);
    }
  } else {
    for (const double phi : {0.1, 0.3, 0.5, 0.7}) {
      for (const int disks : {1'000, 10'000, 100'000, 1'000'000}) cells.emplace_back(disks, phi);
    }
  }
  return cells;
}

int bench_engine(const std::string& json, const EngineTable& table) {
  std::vector<EngineRate> rates;
  const Json rows =
      print_rates(engine_cells(table), table.volume_fraction ? 3 : table.dimension, table.species,
                  table.start_only ? std::nullopt : std::optional(kEquilibration), rates);
  if (!json.empty()) write_file(json, rows.dump(1) + "\n");
  return kOk;
}

std::vector<EngineCell> growth_cells(int count) {
  constexpr double kMiddle = 0.5;  // area fraction with the largest numbers
  std::vector<EngineCell> cells;
  for (const double phi : {0.01, 0.1, 0.3, kMiddle, 0.7, 0.88}) {
    for (const int disks : {100, 1'000, 10'000, 100'000, 1'000'000, 4'000'000}) {
      const int most = phi == kMiddle ? 4'000'000 : 100'000;
      const bool wanted = disks <= (count > 0 ? std::min(count, most) : most);
      if (wanted && has_room(disks, phi, 2)) cells.emplace_back(disks, phi);
    }
  }
  return cells;
}

int bench_growth(const std::string& json, const std::string& plot, int count) {
  if (!plot.empty()) require_writable_file(plot, "--plot");
  std::vector<EngineRate> rates;
  Json rows = print_rates(growth_cells(count), 2, {}, kEquilibration, rates);
  // A small gas cools into one cluster with hardly any collisions.
  for (Json& row : print_inhomogeneous(count > 0 ? std::clamp(count, 20'000, 100'000) : 100'000)) {
    rows.push_back(std::move(row));
  }
  if (!json.empty()) write_file(json, rows.dump(1) + "\n");
  if (!plot.empty()) write_plot(plot, growth_plot(rates));
  return kOk;
}

}  // namespace clatter
