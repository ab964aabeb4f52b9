#include "engine/scene/csv_line.h"

#include <algorithm>

namespace clatter {

static std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == text.npos) return text.substr(text.size());
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

static std::string_view without_quotes(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.starts_with('"') && text.ends_with('"');
  return quoted ? text.substr(1, text.size() - 2) : text;
}

std::vector<CsvCell> csv_cells(std::string_view line) {
  std::vector<CsvCell> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string_view text = without_quotes(without_blanks(line.substr(begin, end - begin)));
    const std::size_t first = text.empty() ? begin : text.data() - line.data();
    cells.push_back({text, static_cast<int>(first + 1)});
    begin = end + 1;
  }
  return cells;
}

bool is_csv_comment(std::string_view line) {
  const std::string_view text = without_blanks(line);
  return text.empty() || text.front() == '#';
}

}  // namespace clatter
