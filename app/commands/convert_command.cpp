#include "app/commands/commands.h"
#include "app/commands/flag_checks.h"
#include "app/runs/convert.h"

namespace clatter {

void add_convert_command(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = program.add_subcommand("convert",
                                             "Convert the particles of a file. The result is a "
                                             "start state, or a trajectory of one frame.");
  command
      ->add_option("in", options->in,
                   "A trajectory (.xyz, .lammpstrj, .csv, .gsd, .h5md), a start state (.csv) or a "
                   "checkpoint.")
      ->required()
      ->check(named_file())
      ->type_name("IN");
  command
      ->add_option("out", options->out,
                   "A start state (.csv), or a trajectory (.xyz, .lammpstrj, .gsd, .h5md). An "
                   "existing file is replaced.")
      ->required()
      ->check(named_file())
      ->type_name("OUT");
  command
      ->add_option("--frame", options->frame,
                   "Number of the frame of a trajectory, from 0. Default: the last.")
      ->check(whole_number_between(0, 1'000'000'000));
  command
      ->add_option("--scene", options->scene,
                   "Scene with the box of the particles, because a CSV has none.")
      ->check(named_file())
      ->type_name("SCENE");
  command->callback([options, &exit_code] { exit_code = convert(*options); });
}

}  // namespace clatter
