#include "app/commands/commands.h"
#include "app/commands/flag_checks.h"
#include "app/convert/convert.h"
#include "engine/laws/limits.h"

namespace clatter {

void add_convert_command(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = program.add_subcommand("convert",
                                             "Convert the particles of a file. The result is a "
                                             "start state, or a trajectory of one frame.");
  command
      ->add_option(
          "in", options->in,
          "A trajectory (.xyz, .lammpstrj, .csv, .gsd, .h5md, .vtp, .vtp.series, .pvd), a start "
          "state (.csv), a data file of LAMMPS (.data, .lmp, data.NAME) or a checkpoint. Text may "
          "be compressed by gzip (.gz).")
      ->required()
      ->check(named_file())
      ->type_name("IN");
  command
      ->add_option(
          "out", options->out,
          "A start state (.csv), or a trajectory (.xyz, .lammpstrj, .gsd, .h5md, .vtp). An "
          "existing file is replaced.")
      ->required()
      ->check(named_file())
      ->type_name("OUT");
  command
      ->add_option("--frame", options->choice.frame,
                   "Number of the frame of a trajectory, from 0. Default: the last.")
      ->check(whole_number_between(0, 1'000'000'000));
  command
      ->add_option(
          "--scene", options->scene,
          "Scene with the box and the species of the particles of a CSV, or of a .vtp without a "
          "box.")
      ->check(named_file())
      ->type_name("SCENE");
  command
      ->add_option("--scale", options->choice.scale,
                   "Diameter of the particles, or of one species, in the lengths of the file. It "
                   "becomes the unit of length: positions, box and velocities are divided by it. "
                   "Default: 1.")
      ->check(positive_number())
      ->type_name("LENGTH");
  CLI::Option* const temperature =
      command
          ->add_option("--temperature", options->temperature,
                       "Draw Gaussian velocities for particles without any, with total momentum 0 "
                       "and exactly this temperature.")
          ->check(number_between(0.0, kMaxTemperature))
          ->type_name("T");
  command->add_option("--seed", options->seed, "Seed of these velocities. Default: 1.")
      ->check(seed_number())
      ->needs(temperature);
  command
      ->add_option("--dimensions", options->choice.dimension,
                   "2 makes disks, 3 makes spheres. By default particles that stay in one plane z "
                   "are disks.")
      ->check(whole_number_between(2, 3));
  command
      ->add_option("--group", options->choice.group,
                   "Name of the particles in an H5MD file with several groups.")
      ->check(named_file())
      ->type_name("NAME");
  command->callback([options, &exit_code] {
    options->choice.needs_velocities = !options->temperature;
    exit_code = convert(*options);
  });
}

}  // namespace clatter
