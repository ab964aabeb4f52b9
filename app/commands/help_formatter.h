#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>

namespace clatter {

/// Width of printed texts, in columns.
inline constexpr std::size_t kTextWidth = 96;

/// Breaks a text between words into lines of at most `width` columns. Keeps the line breaks of the
/// text.
std::string wrapped(const std::string& text, std::size_t width);

/// The layout of help: a label for each value, then sentences, in lines of limited width. It is the
/// same with all versions of CLI11.
class HelpFormatter final : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
};

/// The first sentence of a command's description.
std::string command_summary(const CLI::App& command);

/// The text of an option: description, allowed values, default, and the flags that it needs or
/// excludes.
std::string option_help(const CLI::Option& option);

}  // namespace clatter
