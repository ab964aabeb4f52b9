#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace clatter {

/// The layout of help: a label for each value, then sentences, in lines of bounded length.
class HelpFormatter final : public CLI::Formatter {
 public:
  HelpFormatter();

  std::string make_description(const CLI::App* app) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

/// The first sentence about a command.
std::string command_summary(const CLI::App& command);

/// The sentences about an option: its description, allowed values, default, and the flags that it
/// needs or excludes.
std::string option_help(const CLI::Option& option);

}  // namespace clatter
