#include "app/commands/help_formatter.h"

#include <sstream>

#include "app/commands/command_tree.h"

namespace clatter {

std::string wrapped(const std::string& text, std::size_t width) {
  std::string lines;
  std::istringstream paragraphs(text);
  for (std::string paragraph; std::getline(paragraphs, paragraph);) {
    if (!lines.empty()) lines += '\n';
    // A line that begins with a space is an example.
    if (paragraph.starts_with(' ')) {
      lines += paragraph;
      continue;
    }
    std::istringstream words(paragraph);
    std::size_t column = 0;
    for (std::string word; words >> word; column += word.size()) {
      const bool breaks = column > 0 && column + 1 + word.size() > width;
      if (column > 0) lines += breaks ? '\n' : ' ';
      column = breaks ? 0 : column + (column > 0 ? 1 : 0);
      lines += word;
    }
  }
  return lines;
}

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

// A name, and its text of one or more lines in a second column.
std::string in_columns(const std::string& name, const std::string& text) {
  const std::string indented(kDescriptionColumn, ' ');
  std::string out = "  " + name;
  if (out.size() >= kDescriptionColumn) out += '\n';
  out.append(out.back() == '\n' ? kDescriptionColumn : kDescriptionColumn - out.size(), ' ');
  for (const char c : text) {
    out += c;
    if (c == '\n') out += indented;
  }
  return out + '\n';
}

}  // namespace

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode) const {
  std::string usage = "Usage: " + name, positionals, options;
  if (!app->get_options().empty()) usage += " [OPTIONS]";
  for (const CLI::Option* option : app->get_options()) {
    const bool positional = option->get_positional();
    if (positional) usage += ' ' + make_option_usage(option);
    (positional ? positionals : options) +=
        in_columns(make_option_name(option, positional) + make_option_opts(option),
                   wrapped(option_help(*option), kDescriptionWidth));
  }
  std::string commands;
  for (const CLI::App* command : app->get_subcommands({})) {
    if (commands.empty()) commands = '\n' + command->get_group() + ":\n";
    commands +=
        in_columns(command->get_name(), wrapped(command_summary(*command), kDescriptionWidth));
  }
  if (!commands.empty()) {
    const bool optional = app->get_require_subcommand_min() == 0;
    usage += optional ? " [COMMAND]" : " COMMAND";
  }
  if (!positionals.empty()) positionals = "\nPositionals:\n" + positionals;
  return wrapped(app->get_description(), kTextWidth) + "\n\n" + usage + '\n' + positionals +
         "\nOptions:\n" + options + commands + '\n';
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  const std::string label = value_label(*option);
  return label.empty() ? "" : " " + label;
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
