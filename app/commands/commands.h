#pragma once

namespace CLI {
class App;
}

namespace clatter {

/// Each function adds one subcommand. A selected subcommand runs and stores its exit code.
void add_view_command(CLI::App& program, int& exit_code);
void add_measure_command(CLI::App& program, int& exit_code);
void add_render_command(CLI::App& program, int& exit_code);
void add_sweep_command(CLI::App& program, int& exit_code);
void add_convert_command(CLI::App& program, int& exit_code);
void add_check_command(CLI::App& program, int& exit_code);
void add_scenes_command(CLI::App& program, int& exit_code);
void add_bench_command(CLI::App& program, int& exit_code);
void add_help_command(CLI::App& program, int& exit_code);
void add_completions_command(CLI::App& program, int& exit_code);

/// Runs the program: parses the command line and runs the command. Each error becomes a message on
/// stderr and an exit code.
int run_program(int argc, const char* const* argv);

}  // namespace clatter
