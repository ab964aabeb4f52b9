#pragma once

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace clatter::testing {

/// A table of a measurement: its columns by name with null for nan, and the contents of its first
/// line.
struct Table {
  std::string symbols;                       ///< meaning of the letters in units
  std::map<std::string, std::string> units;  ///< by column
  nlohmann::json columns;
};

inline Table table_in(const std::string& text) {
  Table table;
  std::istringstream lines(text);
  std::string line, word;
  std::getline(lines, line);
  const std::string head = "# units, ";
  const std::size_t begin = line.find("; ");
  table.symbols = line.substr(head.size(), begin - head.size());
  for (std::istringstream words(line.substr(begin + 1)); std::getline(words, word, ',');) {
    const std::size_t colon = word.find(": ");
    table.units[word.substr(1, colon - 1)] = word.substr(colon + 2);
  }
  std::getline(lines, line);
  std::vector<std::string> names;
  for (std::istringstream words(line); std::getline(words, word, ',');) {
    names.push_back(word);
    table.columns[word] = nlohmann::json::array();
  }
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    for (const std::string& name : names) {
      std::getline(words, word, ',');
      const double number = std::stod(word);
      table.columns[name].push_back(std::isnan(number) ? nlohmann::json() : nlohmann::json(number));
    }
  }
  return table;
}

}  // namespace clatter::testing
