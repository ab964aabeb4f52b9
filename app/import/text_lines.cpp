#include "app/import/text_lines.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "app/import/gzip.h"
#include "engine/error.h"
#include "engine/physics/state.h"
#include "engine/text.h"
#include "engine/whole_number.h"

namespace clatter {

LineWords words_of(std::string_view text) {
  LineWords words;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \t", begin), text.size());
    if (end > begin) words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

TextLines::TextLines(const std::filesystem::path& path, Exponents exponents)
    : path_(path), exponents_(exponents) {
  if (is_gzip(path)) {
    text_ = std::make_unique<std::istringstream>(gunzipped(path));
  } else {
    text_ = std::make_unique<std::ifstream>(path, std::ios::binary);
  }
  if (!*text_) refuse("the file cannot be read", "check its permissions");
}

bool TextLines::next() {
  if (!std::getline(*text_, line_)) return false;
  constexpr int kMostLines = std::numeric_limits<int>::max();
  if (number_ == kMostLines) {
    refuse("the file has more than " + std::to_string(kMostLines) + " lines",
           "give a file with fewer frames");
  }
  if (line_.ends_with('\r')) line_.pop_back();
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (++number_ == 1 && line_.starts_with(kByteOrderMark)) line_.erase(0, kByteOrderMark.size());
  return true;
}

void TextLines::require_next() {
  if (!next()) refuse_end();
}

std::optional<double> TextLines::number_in(std::string_view word) const {
  std::string in_c(word);
  const std::size_t digits = in_c.find_first_of("0123456789"), exponent = in_c.find_first_of("dD");
  if (exponents_ == Exponents::Fortran && exponent != in_c.npos && digits < exponent) {
    in_c[exponent] = 'e';
  }
  return signed_number<double>(in_c);
}

double TextLines::real(std::string_view word) const {
  const std::optional<double> number = number_in(word);
  if (number && std::isfinite(*number)) return *number;
  refuse(quoted_start(word) + " is no finite number", "write, say, -0.25 or 1.5e-3");
}

std::size_t TextLines::count(std::string_view word) const {
  const auto count = whole_number<std::size_t>(word);
  if (count && *count <= kMaxParticles<2>) return *count;
  refuse(quoted_start(word) + " is no number of particles",
         "give at most " + std::to_string(kMaxParticles<2>));
}

void TextLines::refuse(const std::string& problem, const std::string& advice) const {
  refuse_at(number_, problem, advice);
}

void TextLines::refuse_at(int line, const std::string& problem, const std::string& advice) const {
  throw UserError({path_.string(), line, 0}, problem, advice);
}

void TextLines::refuse_end() const {
  refuse("the file ends within a frame", "give a complete file, or an earlier frame with --frame");
}

}  // namespace clatter
