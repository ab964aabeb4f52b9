#include "app/commands/manual_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "app/system/exit_code.h"

namespace clatter {

namespace {

// The text with roff escapes. A line must not begin with a control character.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char letter : text) {
    const bool at_start = escaped.empty() || escaped.back() == '\n';
    if (at_start && (letter == '.' || letter == '\'')) escaped += "\\&";
    if (letter == '\\') {
      escaped += "\\e";
    } else if (letter == '-') {
      escaped += "\\-";
    } else {
      escaped += letter;
    }
  }
  return escaped;
}

// A paragraph for each line. Lines that begin with spaces are examples.
std::string paragraphs(const std::string& text) {
  std::istringstream lines(text);
  std::string page;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(' ')) {
      page += ".RS\n.nf\n" + roff(line.substr(line.find_first_not_of(' '))) + "\n.fi\n.RE\n";
    } else {
      page += ".PP\n" + roff(line) + "\n";
    }
  }
  return page;
}

std::string entry(const std::string& tag, const std::string& text) {
  return ".TP\n" + tag + "\n" + roff(text) + "\n";
}

std::string flag_entry(const FlagInfo& flag) {
  if (flag.names.empty()) return entry("\\fI" + roff(flag.label) + "\\fR", flag.help);
  std::string tag;
  for (const std::string& name : flag.names) {
    tag += (tag.empty() ? "" : ", ") + std::string("\\fB") + roff(name) + "\\fR";
  }
  return entry(tag + (flag.label.empty() ? "" : " \\fI" + roff(flag.label) + "\\fR"), flag.help);
}

std::string section_of(const CommandInfo& command) {
  std::string page =
      fmt::format(".SS clatter {}\n", roff(fmt::format("{}", fmt::join(command.path, " "))));
  page += paragraphs(command.help);
  for (const FlagInfo& argument : command.arguments) page += flag_entry(argument);
  for (const FlagInfo& flag : command.flags) {
    const bool is_help = std::ranges::find(flag.names, "--help") != flag.names.end();
    if (!is_help) page += flag_entry(flag);
  }
  return page;
}

}  // namespace

std::string manual_page(const CommandInfo& program) {
  std::string page =
      ".\\\" Written by `clatter help --man`.\n"
      ".TH CLATTER 1 \"\" \"clatter " CLATTER_VERSION
      "\" \"User Commands\"\n"
      ".SH NAME\nclatter \\- simulate driven granular gases of hard disks and spheres\n"
      ".SH SYNOPSIS\n\\fBclatter\\fR [\\fICOMMAND\\fR] [\\fIOPTIONS\\fR]\n"
      ".SH DESCRIPTION\n";
  page += paragraphs(program.help);
  page += ".SH OPTIONS\n";
  for (const FlagInfo& flag : program.flags) page += flag_entry(flag);
  page += ".SH COMMANDS\n";
  for (const CommandInfo* command : all_commands(program)) {
    if (command != &program) page += section_of(*command);
  }
  page += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] :
       {std::pair(kOk, "Success."), std::pair(kFailed, "A run or a check failed."),
        std::pair(kWrongUse, "Wrong use, or a wrong scene."),
        std::pair(kPhysicalStop, "The physics stopped."),
        std::pair(kInterrupted, "Interrupted. The results so far are saved.")}) {
    page += entry(std::to_string(code), meaning);
  }
  return page +
         ".SH SEE ALSO\n.PP\n\\fBclatter help keys\\fR prints all keys of a scene file.\n.PP\n"
         "The guide is in \\fI/usr/share/doc/clatter/docs/guide.md\\fR.\n";
}

}  // namespace clatter
