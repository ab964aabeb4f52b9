#include "app/commands/help_formatter.h"

#include <sstream>

#include "app/commands/command_tree.h"
#include "app/commands/wrapped_text.h"

namespace clatter {

namespace {

constexpr std::size_t kDescriptionColumn = 28;
constexpr std::size_t kDescriptionWidth = kTextWidth - kDescriptionColumn;

// " Needs --checkpoint.", with the flags in alphabetical order.
std::string about_others(const std::string& what, const std::set<CLI::Option*>& others) {
  std::set<std::string> names;
  for (const CLI::Option* option : others) names.insert(option->get_name());
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "" : " " + what + " " + list + ".";
}

}  // namespace

HelpFormatter::HelpFormatter() {
  column_width(kDescriptionColumn);
  label("SUBCOMMAND", "COMMAND");
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return wrapped(app->get_description(), kTextWidth) + "\n\n";
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  const std::string label = value_label(*option);
  return label.empty() ? "" : " " + label;
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return wrapped(option_help(*option), kDescriptionWidth);
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  std::ostringstream out;
  const std::string summary = wrapped(command_summary(*command), kDescriptionWidth);
  CLI::detail::format_help(out, command->get_name(), summary, kDescriptionColumn);
  return out.str();
}

std::string command_summary(const CLI::App& command) {
  const std::string text = command.get_description();
  const std::size_t end = text.find_first_of('.');
  return text.substr(0, end == std::string::npos ? end : end + 1);
}

std::string option_help(const CLI::Option& option) {
  std::string text = option.get_description();
  if (const std::string values = allowed_values(option); !values.empty()) {
    text += " Values: " + values + ".";
  }
  if (!option.get_default_str().empty()) text += " Default: " + option.get_default_str() + ".";
  if (option.get_required()) text += " Required.";
  return text + about_others("Needs", option.get_needs()) +
         about_others("Excludes", option.get_excludes());
}

}  // namespace clatter
