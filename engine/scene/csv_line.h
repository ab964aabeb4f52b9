#pragma once

#include <string_view>
#include <vector>

namespace clatter {

/// Text between two commas of a CSV line, without surrounding blanks and quotes.
struct CsvCell {
  std::string_view text;
  int column = 1;  ///< of its first character in the line
};

/// The cells of a CSV line. A comma separates cells between quotes too, because names and numbers
/// have none.
std::vector<CsvCell> csv_cells(std::string_view line);

/// Whether a CSV line has no cells: it is blank, or a comment that begins with #.
bool is_csv_comment(std::string_view line);

}  // namespace clatter
