#include <CLI/CLI.hpp>

#include "app/commands/commands.h"
#include "app/commands/flag_checks.h"
#include "app/commands/flags.h"
#include "app/measure/measure_run.h"

namespace clatter {

void add_measure_command(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<MeasureOptions>();
  CLI::App* command = program.add_subcommand("measure",
                                             "Measure a scene. The table [measure] of the scene "
                                             "has the times and the fields. The result is "
                                             "JSON, with standard errors.");
  add_common_flags(*command, options->common);
  add_progress_flag(*command, options->common);
  add_checkpoint_flags(*command, options->checkpoints);
  add_accuracy_flags(*command, options->accuracy);
  command->add_option("--out", options->out, "File for the result. Default: stdout.")
      ->check(named_file())
      ->type_name("FILE.json");
  command
      ->add_option(
          "--csv", options->csv,
          "Folder for tables of series, profiles and maps. Tables of an earlier run are replaced.")
      ->check(named_file())
      ->type_name("DIR");
  command
      ->add_option("--vtk", options->vtk,
                   "Folder for maps of the fields, for ParaView. The file fields.vti has the "
                   "averages over the whole "
                   "time and the residuals. The file series.pvd has the averages over parts of the "
                   "time. Maps of an "
                   "earlier run are replaced.")
      ->check(named_file())
      ->type_name("DIR");
  command->add_option("--hdf5", options->hdf5, "File for all results, series, profiles and maps.")
      ->check(named_file())
      ->type_name("FILE.h5");
  command
      ->add_option("--save-state", options->save_state,
                   "File for the state at the end. A scene starts from it with "
                   "--set 'particles.start={layout=\"file\",file=\"FILE.csv\"}'.")
      ->check(named_file())
      ->type_name("FILE.csv");
  CLI::Option* trajectory =
      command
          ->add_option(
              "--trajectory", options->trajectory,
              "File for the states of all particles, at the interval --every. The extension "
              "selects the format: .xyz (extended XYZ), .lammpstrj (LAMMPS), .csv, .gsd "
              "(HOOMD-blue), .h5md (H5MD) or .vtp (ParaView).")
          ->check(named_file())
          ->type_name("FILE");
  CLI::Option* every = command
                           ->add_option("--every", options->every,
                                        "Simulation time between the states of --trajectory.")
                           ->check(positive_number())
                           ->needs(trajectory);
  trajectory->needs(every);
  CLI::Option* events =
      command
          ->add_option("--events", options->events,
                       "File for all collisions, between particles and with walls. The extension "
                       "selects the format: .h5 (HDF5) or .csv.")
          ->check(named_file())
          ->type_name("FILE");
  command
      ->add_option("--events-of", options->selection.particles,
                   "Log only collisions of these particles, numbered from 0.")
      ->delimiter(',')
      ->needs(events)
      ->type_name("N,N...");
  command
      ->add_option("--events-in", options->selection.region,
                   "Log only collisions in this region: the lower and upper limit of x, then of y, "
                   "and of z for spheres.")
      ->delimiter(',')
      ->needs(events)
      ->type_name("X0,X1,Y0,Y1...");
  command
      ->add_option("--events-share", options->selection.share,
                   "Log this share of the collisions, evenly spaced. Default: 1.")
      ->check(number_between(1e-12, 1.0))
      ->needs(events);
  CLI::Option* replicas =
      command
          ->add_option("--replicas", options->replicas,
                       "Number of runs, with consecutive seeds. The result has each run, and the "
                       "means over all runs.")
          ->check(whole_number_between(1, 100'000));
  command
      ->add_option("--threads", options->threads,
                   "Number of threads: replicas that run at once, or threads of one large gas. The "
                   "results do not depend on it. Default: the number of processors.")
      ->check(whole_number_between(1, 256));
  for (const char* other : {"--resume", "--checkpoint", "--accuracy", "--csv", "--vtk", "--hdf5",
                            "--save-state", "--trajectory", "--events"}) {
    replicas->excludes(command->get_option(other));
  }
  command->callback([options, &exit_code] { exit_code = measure(*options); });
}

}  // namespace clatter
