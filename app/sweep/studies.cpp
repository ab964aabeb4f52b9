#include "app/sweep/studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/physics/theory.h"

namespace clatter {

namespace {

// A list of numbers as TOML.
std::string list_of(const std::vector<double>& numbers) {
  std::string list;
  for (const double number : numbers) {
    fmt::format_to(std::back_inserter(list), "{}{:.6g}", list.empty() ? "" : ", ", number);
  }
  return '[' + list + ']';
}

// Time in which a small change of the temperature decays, from the slope of the refined theory.
double relaxation_time(const VibratedGas& gas, double temperature) {
  constexpr double kStep = 1e-4;
  const double high = gas.temperature_change_refined(temperature * (1.0 + kStep));
  const double low = gas.temperature_change_refined(temperature * (1.0 - kStep));
  return 2.0 * kStep * temperature / (low - high);
}

}  // namespace

// Each point starts at the temperature of the theory. Its times are multiples of the relaxation
// time of a uniform gas. Strong dissipation makes clusters, which relax more slowly; weakly
// dissipative gases fluctuate so little that a shorter duration has the same error.
Study temperature_study(int dimension) {
  struct Box {
    double count, length;
  };
  const bool disks = dimension == 2;
  const double side = disks ? 25.0 : 8.0;
  const std::vector<Box> boxes =
      disks ? std::vector<Box>{{25, 20}, {50, 20}, {100, 20}, {200, 20}, {100, 40}}
            : std::vector<Box>{{32, 20}, {64, 20}, {128, 20}, {256, 20}, {128, 40}};
  const std::vector<double> restitutions = {0.5, 0.7, 0.9, 0.97, 0.99, 0.997, 0.999};
  constexpr double kBurnIn = 20.0,
                   kLongest = 30000.0;  // in relaxation times, where epsilon psi = 1
  constexpr double kExponent = 0.7, kLeast = 0.05;
  std::vector<double> alphas, counts, temperatures, burn_ins, durations, intervals;
  std::string sizes;
  for (const double alpha : restitutions) {
    for (const Box& box : boxes) {
      const VibratedGas gas{.count = box.count,
                            .length = box.length,
                            .wall_size = disks ? side : side * side,
                            .restitution = alpha,
                            .drive_speed = 1.0,
                            .dimension = dimension};
      const double temperature = gas.temperature_corrected();
      const double time = relaxation_time(gas, temperature);
      alphas.push_back(alpha);
      counts.push_back(box.count);
      temperatures.push_back(temperature);
      const double slowness = std::pow(gas.epsilon_effective() * gas.psi(), kExponent);
      burn_ins.push_back(kBurnIn * time * std::max(1.0, slowness));
      durations.push_back(kLongest * time * std::max(kLeast, slowness));
      intervals.push_back(0.1 * kBurnIn * time);
      sizes += (sizes.empty() ? "[" : ", [") + list_of({box.length, side}).substr(1);
      if (!disks) sizes.insert(sizes.size() - 1, fmt::format(", {:g}", side));
    }
  }
  Study study;
  study.sweep = fmt::format(
      R"(# The temperature of a gas between two driven walls. Each point starts at the temperature of the
# corrected theory. Burn-in and longest duration follow from its relaxation time.
scene = "vibrated"
accuracy = "0.5%"
zip = [["particles.restitution", "box.size", "particles.count", "particles.start.temperature",
        "measure.burn_in", "measure.duration", "measure.series_interval"]]

[set]
"measure.fields" = []
"measure.cells" = {}

[axes]
"particles.restitution" = {}
"box.size" = [{}]
"particles.count" = {}
"particles.start.temperature" = {}
"measure.burn_in" = {}
"measure.duration" = {}
"measure.series_interval" = {}
)",
      disks ? "[1, 1]" : "[1, 1, 1]", list_of(alphas), sizes, list_of(counts),
      list_of(temperatures), list_of(burn_ins), list_of(durations), list_of(intervals));
  const std::string x = "1/theory.epsilon_effective/theory.psi";
  study.charts = {
      {"temperature",
       {.x = x,
        .y = "temperature",
        .by = "particles.restitution",
        .log_x = true,
        .log_y = true,
        .theory = true,
        .x_label = "1/(ε ψ)",
        .y_label = "T/(m v²), with the drive speed v",
        .title = "The temperature of a vibrated gas",
        .caption = "A gas between two driven walls. Dilute gases follow one curve, dense gases are "
                   "hotter. Standard errors are at most 0.5 %."}},
      {"ratio",
       {.x = x,
        .y = "temperature/theory.temperature_refined",
        .by = "particles.restitution",
        .log_x = true,
        .theory = true,
        .x_label = "1/(ε ψ)",
        .y_label = "T/(temperature of the refined theory)",
        .title = "Where the theories of a vibrated gas hold",
        .caption =
            "Temperatures over that of the refined theory. The corrected theory has the higher "
            "density at the walls and holds for weak dissipation, on the right. Strong dissipation "
            "makes the gas cold and dense in the middle, which all three theories neglect."}}};
  return study;
}

Study rough_study(int dimension) {
  Study study;
  study.sweep = fmt::format(
      R"(# The ratio of spin and translational temperature of rough particles. Kicks drive the
# translation only.
scene = "{}"
replicas = 2

[set]
"measure.burn_in" = 50.0
"measure.duration" = 500.0
"measure.fields" = []
"particles.friction" = inf           # beta is then the same in all collisions

[axes]
"particles.restitution" = [0.7, 0.9, 0.98]
"particles.tangential_restitution" = {{ from = -0.9, to = 0.9, count = 13 }}
)",
      dimension == 2 ? "rough_driven" : "spheres_rough");
  study.charts = {{"ratio",
                   {.x = "particles.tangential_restitution",
                    .y = "spin_temperature/temperature",
                    .theory = true,
                    .y_label = "R = T_rot/T",
                    .title = "Collisions do not share energy equally between motion and spin",
                    .caption = "Ratio of the temperatures in a gas of rough particles. Kicks drive "
                               "the translation, and collisions drive the spins."}}};
  return study;
}

// Without kicks the gas cools, and its temperatures have a constant ratio after some collisions of
// each particle. It is measured before clusters form.
Study mixture_study(int dimension) {
  Study study;
  study.sweep = fmt::format(
      R"(# The ratio of the temperatures of two species of equal size, against the ratio of their masses: in a
# gas that cools freely, and in a gas with kicks of equal velocity for all.
scene = "two_temperatures"
replicas = 8
zip = [["bulk_drive.kick_speed", "measure.burn_in", "measure.duration"]]

[set]
"box.size" = {}
"particles.restitution" = 0.8
"species.light.count" = 100
"species.heavy.count" = 100
"species.heavy.diameter" = 1.0

[axes]
"species.heavy.mass" = {{ from = 1.0, to = 20.0, count = 7, scale = "log" }}
"bulk_drive.kick_speed" = [0.0, 0.12]
"measure.burn_in" = [20.0, 100.0]
"measure.duration" = [40.0, 500.0]
)",
      dimension == 2 ? "[30.0, 24.0]" : "[10.0, 10.0, 10.0]");
  study.charts = {{"ratio",
                   {.x = "species.heavy.mass",
                    .y = "species.heavy.temperature/species.light.temperature",
                    .by = "bulk_drive.kick_speed",
                    .log_x = true,
                    .theory = true,
                    .x_label = "mass of the heavy species over that of the light one",
                    .y_label = "T_2/T_1",
                    .title = "Two species of a granular gas have two temperatures",
                    .caption = "Without kicks the gas cools. Kicks of equal velocity give heavy "
                               "particles more energy, and flows of the gas add to it."}}};
  return study;
}

// The rate is 1. The gas begins near its steady state.
Study shear_study(int dimension) {
  const bool disks = dimension == 2;
  Study study;
  study.sweep = fmt::format(
      R"(# The temperature and the viscosity of a steady shear flow, against the restitution of the grains.
scene = "shear"
replicas = 4

[set]
"box.size" = {}
"shear.rate" = 1.0
"particles.start.temperature" = 10.0
"measure.burn_in" = 50.0
"measure.duration" = 300.0
"measure.fields" = []
"measure.cells" = {}

[axes]
"particles.restitution" = {{ from = 0.6, to = 0.98, count = 9 }}
"particles.count" = {}
)",
      disks ? "[60.0, 60.0]" : "[18.0, 18.0, 18.0]", disks ? "[1, 1]" : "[1, 1, 1]",
      disks ? "[90, 1350]" : "[220, 3350]");
  const auto chart = [](const std::string& name, const std::string& y, const std::string& label,
                        const std::string& title, const std::string& caption) {
    return StudyChart{name,
                      {.x = "particles.restitution",
                       .y = y,
                       .by = "particles.count",
                       .log_y = true,
                       .theory = true,
                       .y_label = label,
                       .title = title,
                       .caption = caption}};
  };
  study.charts = {
      chart("temperature", "temperature", "T/G²", "The temperature of a sheared gas",
            "Collisions balance the work of the shear. Grad's theory is that of a dilute gas, "
            "Enskog's that of a nearly elastic one."),
      chart("viscosity", "shear.viscosity", "viscosity/G", "The viscosity of a sheared gas",
            "The stress over the shear rate. Grad's theory is that of a dilute gas, Enskog's that "
            "of a nearly elastic one.")};
  return study;
}

// Each replica chooses one of the halves by chance, so the imbalance is the magnitude of the
// difference. Near the transition a gas needs long to split.
Study demon_study(int dimension) {
  const bool disks = dimension == 2;
  Study study;
  study.sweep = fmt::format(
      R"(# The imbalance of two compartments over a driven floor, against the restitution of the grains.
scene = "demon"
replicas = 8

[set]
{}"measure.burn_in" = 1000.0
"measure.duration" = 3000.0
"measure.fields" = []

[axes]
"particles.restitution" = {{ from = 0.65, to = 0.95, count = 13 }}
"particles.count" = {}
)",
      disks ? "" : R"("box.size" = [20.0, 24.0, 3.0]
"gravity.acceleration" = [0.0, -1.0, 0.0]
"partition.wall.holes" = [{ from = [6.0, 0.0], to = [24.0, 3.0] }]
"measure.cells" = [1, 1, 1]
)",
      disks ? "[20, 40, 60]" : "[60, 120, 180]");
  study.charts = {
      {"imbalance",
       {.x = "particles.restitution",
        .y = "compartments.imbalance",
        .by = "particles.count",
        .theory = disks,
        .y_label = "|N_left - N_right|/N",
        .title = "Maxwell's demon: a granular gas splits by itself",
        .caption =
            "Two compartments over a driven floor, with an opening between them. "
            "Below a restitution one of them takes most grains. Fewer grains lose less energy, "
            "and need a lower one."}}};
  return study;
}

}  // namespace clatter
