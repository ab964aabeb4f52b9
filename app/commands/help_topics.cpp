#include "app/commands/help_topics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "app/commands/help_formatter.h"
#include "app/system/exit_code.h"
#include "app/system/page_parts.h"
#include "engine/error.h"
#include "engine/scene/field.h"
#include "engine/scene/key_docs.h"
#include "engine/scene/scene.h"
#include "engine/system/read_file.h"
#include "engine/system/write_file.h"
#include "engine/text.h"

namespace clatter {

namespace {

// A longer list of choices follows the table of a page.
constexpr std::size_t kChoicesInTable = 8;

std::vector<std::string> commands_of(const KeyDoc& doc) {
  std::istringstream words{std::string(doc.key.commands)};
  return {std::istream_iterator<std::string>(words), {}};
}

std::string initial_of(const KeyDoc& doc, const std::string& quote) {
  if (doc.initial.empty()) return "required";
  if (doc.initial == "none") return "none";
  const std::string disks = quote + doc.initial + quote;
  if (doc.sphere_initial.empty()) return disks;
  return disks + ", for spheres " + quote + doc.sphere_initial + quote;
}

std::string values_of(const KeyDoc& doc) {
  return doc.sphere_values.empty() ? doc.values : doc.values + "; " + doc.sphere_values;
}

std::string choices_of(const KeyDoc& doc, const std::string& quote) {
  const std::string comma = quote + ", " + quote;
  const std::string disks = quote + fmt::format("{}", fmt::join(doc.choices, comma)) + quote;
  if (doc.sphere_choices.empty()) return disks;
  return disks + "; for spheres also " + quote +
         fmt::format("{}", fmt::join(doc.sphere_choices, comma)) + quote;
}

std::string meaning_of(const KeyDoc& doc) {
  return std::string(doc.key.meaning) + (doc.conditions.empty() ? "" : " " + doc.conditions);
}

// The text with an indent of `indent` spaces, except for the first line.
std::string indented(const std::string& text, std::size_t indent) {
  std::string lines;
  for (const char letter : wrapped(text, kTextWidth - indent)) {
    lines += letter;
    if (letter == '\n') lines += std::string(indent, ' ');
  }
  return lines;
}

std::string text_of(const KeyDoc& doc) {
  std::string text = doc.path() + '\n';
  const auto add = [&](const char* label, const std::string& value) {
    if (!value.empty()) text += fmt::format("  {:<9}{}\n", label, indented(value, 11));
  };
  std::string meaning = meaning_of(doc);
  std::erase(meaning, '`');
  text += "  " + indented(meaning, 2) + '\n';
  add("unit", std::string(doc.key.unit));
  add("default", initial_of(doc, ""));
  add("values", doc.choices.empty() ? values_of(doc) : choices_of(doc, ""));
  add("read by", fmt::format("{}", fmt::join(commands_of(doc), ", ")));
  if (doc.changes_live) add("changes", "in a run, by [[change]] and in the window");
  return text;
}

// "`view`, `render` and `measure`"
std::string listed(const std::vector<std::string>& commands) {
  std::string text;
  for (const std::string& command : commands) {
    const bool last = &command == &commands.back();
    text += (text.empty() ? "`" : last ? " and `" : ", `") + command + "`";
  }
  return text;
}

std::string row_of(const KeyDoc& doc, const std::vector<std::string>& table_commands) {
  const bool many = doc.choices.size() > kChoicesInTable;
  std::string meaning = meaning_of(doc);
  const std::vector<std::string> commands = commands_of(doc);
  if (commands != table_commands) meaning += " Read by " + listed(commands) + ".";
  const std::string values = many                  ? "see below"
                             : doc.choices.empty() ? values_of(doc)
                                                   : choices_of(doc, "`");
  return fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", doc.key.name, doc.key.unit,
                     initial_of(doc, "`"), values, doc.changes_live ? "yes" : "", meaning);
}

// The keys of one table as Markdown.
std::string markdown_of(const std::vector<KeyDoc>& docs) {
  // Most keys of a table have the commands of its first one.
  const std::vector<std::string> commands = commands_of(docs.front());
  std::string text = "\nRead by " + listed(commands) + ".\n\n" +
                     "| key | unit | default | values | live | meaning |\n"
                     "|---|---|---|---|---|---|\n";
  std::string lists;
  for (const KeyDoc& doc : docs) {
    text += row_of(doc, commands);
    if (doc.choices.size() <= kChoicesInTable) continue;
    lists += fmt::format("\nValues of `{}`: {}.\n", doc.key.name, choices_of(doc, "`"));
  }
  return text + lists + "\n";
}

}  // namespace

std::string key_help(const std::string& name) {
  std::string wanted = name;
  for (const char* side : kSideNames) {
    const std::string wall = std::string("walls.") + side;
    if (wanted == wall || wanted.starts_with(wall + '.')) {
      wanted.replace(0, wall.size(), "walls.SIDE");
    }
  }
  std::string text;
  std::vector<std::string> paths;
  for (const KeyDoc& doc : key_docs()) {
    paths.push_back(doc.path());
    const bool within = doc.path() == wanted || doc.path().starts_with(wanted + '.');
    if (wanted.empty() || within) text += (text.empty() ? "" : "\n") + text_of(doc);
  }
  if (text.empty()) {
    const std::string near(near_miss(wanted, paths));
    throw UserError(
        {}, "there is no key '" + name + "'",
        near.empty() ? "`clatter help keys` lists all keys" : "did you mean '" + near + "'?");
  }
  return text + "\nunits: " + kUnits + ", s: second of film\n";
}

void write_key_tables(const std::string& page) {
  std::string text = read_file(page, 1 << 20, "a page of text");
  const std::vector<KeyDoc> docs = key_docs();
  std::vector<std::string> tables;
  for (const KeyDoc& doc : docs) {
    if (std::ranges::find(tables, doc.table) == tables.end()) tables.push_back(doc.table);
  }
  for (const std::string& table : tables) {
    std::vector<KeyDoc> rows;
    std::ranges::copy_if(docs, std::back_inserter(rows),
                         [&](const KeyDoc& doc) { return doc.table == table; });
    replace_part(text, page, "keys of " + (table.empty() ? "the scene" : table), markdown_of(rows));
  }
  write_file(page, text);
}

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
