#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <regex>
#include <sstream>
#include <system_error>

#include "app/commands/command_tree.h"
#include "app/commands/commands.h"
#include "app/commands/help_formatter.h"
#include "app/system/commit.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/error.h"
#include "engine/stop_request.h"
#include "engine/text.h"

namespace clatter {

static int report(const char* message, int code) {
  std::fprintf(stderr, "clatter: %s\n", message);
  return code;
}

// The error of CLI11 would not list the commands.
static void require_command(const CLI::App& parent, const std::string& word, const char* what) {
  if (!word.starts_with('-')) find_command(parent, word, what);
}

// Adds the default command to the arguments: `view` without a command, `engine` to `bench` without
// a table, and `start` to `sweep` with a file.
static std::vector<const char*> with_commands(int argc, const char* const* argv,
                                              const CLI::App& program) {
  std::vector<const char*> words(argv, argv + argc);
  if (argc < 2) words.push_back("view");
  const std::string_view command = words[1], next = argc < 3 ? "" : words[2];
  const bool asks_help = next == "-h" || next == "--help";
  const bool is_flag = next.starts_with('-') && !asks_help;
  if (command == "bench" && (next.empty() || is_flag)) words.insert(words.begin() + 2, "engine");
  const bool names_inner =
      std::ranges::any_of(program.get_subcommand("sweep")->get_subcommands({}),
                          [next](const CLI::App* inner) { return inner->get_name() == next; });
  if (command == "sweep" && !names_inner && !asks_help) words.insert(words.begin() + 2, "start");
  return words;
}

// The words of CLI11 for the number and the form of values, in those of the program.
static std::string plain(std::string text) {
  static const std::regex twice(": At [Mm]ost 1 required but received (\\d+)$");
  static const std::regex missing(": 1 required (.*) missing$");
  static const std::regex wrong("^Could not convert: (\\S+) = ([^]*)$");
  text = std::regex_replace(text, twice, " is given $1 times; give it once");
  text = std::regex_replace(text, missing, ": the value is missing; give $1");
  return std::regex_replace(text, wrong, "$1: the value '$2' is wrong");
}

// An unknown flag is often the misspelt one of a missing argument, so it comes first.
static std::string failure_text(const CLI::App& program, const CLI::Error& error) {
  std::string text = plain(error.what());
  const std::vector<std::string> unknown = program.remaining(true);
  const auto flag =
      std::ranges::find_if(unknown, [](const std::string& word) { return word.starts_with('-'); });
  if (flag != unknown.end()) text = "there is no flag " + *flag;
  return "clatter: " + printable(text) + "; `clatter help COMMAND` lists the flags\n";
}

static std::string version_text() {
  const std::string commit(kCommit);
  return "clatter " CLATTER_VERSION + (commit.empty() ? "" : " (commit " + commit + ")");
}

int run_program(int argc, const char* const* argv) {
  int exit_code = kOk;
  try {
    CLI::App program(
        "Simulate driven granular gases of hard disks and spheres. Explore, film and measure "
        "them.\n"
        "Without a command the program opens a window.\n"
        "Without a display, begin with these commands:\n"
        "  clatter scenes\n"
        "  clatter render vibrated --out vibrated.mp4",
        "clatter");
    program.formatter(std::make_shared<HelpFormatter>());
    program.set_help_flag("-h,--help", "Print this help.");
    program.set_version_flag("--version", version_text(), "Print the version and the commit.");
    program.require_subcommand(1);
    program.failure_message(
        [](const CLI::App* app, const CLI::Error& error) { return failure_text(*app, error); });
    add_view_command(program, exit_code);
    add_render_command(program, exit_code);
    add_measure_command(program, exit_code);
    add_sweep_command(program, exit_code);
    add_convert_command(program, exit_code);
    add_check_command(program, exit_code);
    add_scenes_command(program, exit_code);
    add_bench_command(program, exit_code);
    add_help_command(program, exit_code);
    add_completions_command(program, exit_code);
    for (CLI::App* command : program.get_subcommands({})) {
      command->group("Commands");
      for (CLI::App* inner : command->get_subcommands({})) {
        inner->group(command->get_name() == "bench"   ? "Tables"
                     : command->get_name() == "sweep" ? "Commands"
                                                      : "Topics");
      }
    }
    const std::vector<const char*> words = with_commands(argc, argv, program);
    require_command(program, words[1], "command");
    if (words[1] == std::string_view("bench")) {
      require_command(*program.get_subcommand("bench"), words[2], "table");
    }
    try {
      program.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::ParseError& error) {
      std::ostringstream help, mistake;
      const bool is_help = program.exit(error, help, mistake) == 0;
      std::fputs(mistake.str().c_str(), stderr);
      print(help.str());
      return is_help ? kOk : kWrongUse;
    }
  } catch (const Interrupted&) {
    return report("interrupted before the run began; nothing was saved", kInterrupted);
  } catch (const UserError& error) {
    return report(error.what(), kWrongUse);
  } catch (const PhysicalStop& error) {
    return report(error.what(), kPhysicalStop);
  } catch (const std::filesystem::filesystem_error& error) {
    // For example, another process has removed the current folder.
    const std::string text = "cannot use " + error.path1().string() + ": " + error.code().message();
    return report(text.c_str(), kFailed);
  } catch (const std::system_error& error) {
    const std::string text =
        "cannot start a thread: " + error.code().message() +
        "; end other programs, or raise the limits of the shell (ulimit -u, -v)";
    return report(text.c_str(), kFailed);
  } catch (const std::bad_alloc&) {
    return report("out of memory; give the scene fewer disks or cells", kFailed);
  } catch (const std::exception& error) {
    return report(error.what(), kFailed);
  }
  return exit_code;
}

}  // namespace clatter
