#pragma once

#include <doctest/doctest.h>

#include <array>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace clatter::testing {

// A scene without symmetry: rough disks in oblique gravity that changes, a periodic axis, and a
// moving wall.
inline constexpr const char* kDisks = R"(title = "T"
box.size = [8, 6]
particles = { count = 7, restitution = 0.9, tangential_restitution = 0.3 }
gravity = { acceleration = [0.05, -0.02] }
walls.bottom = { kind = "sinusoidal", stroke = 0.2, frequency = 1.0 }
walls.top = { kind = "static" }
measure = { burn_in = 1.0, duration = 20.0 }
[[change]]
time = 3.3
set = { "gravity.acceleration" = [0.3, 0.1] }
)";

inline constexpr const char* kSpheres = R"(title = "T"
box.size = [8, 6, 5]
particles = { count = 9, restitution = 0.9, friction = 0.4 }
walls.back = { kind = "driven", drive_speed = 1.5 }
walls.front = { kind = "static" }
measure = { burn_in = 1.0, duration = 20.0 }
)";

// Disks without spins, and with walls along the other axis.
inline constexpr const char* kSmoothDisks = R"(title = "T"
box.size = [7, 9]
particles = { count = 6, restitution = 0.9 }
walls.left = { kind = "driven", drive_speed = 1.5 }
walls.right = { kind = "static" }
measure = { burn_in = 1.0, duration = 20.0 }
)";

inline const std::string kRun = "clatter measure s.toml --seed 4 --quiet --out r.json ";

using Row = std::map<std::string, std::string>;

inline std::vector<std::string> words_of(const std::string& line, char separator) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; std::getline(stream, word, separator);) words.push_back(word);
  return words;
}

inline Row row_of(const std::vector<std::string>& names, const std::vector<std::string>& words) {
  REQUIRE(names.size() == words.size());
  Row row;
  for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = words[k];
  return row;
}

// The lines of a CSV table as rows.
inline std::vector<Row> rows_in(const std::string& csv) {
  const std::vector<std::string> lines = words_of(csv, '\n');
  std::vector<Row> rows;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    rows.push_back(row_of(words_of(lines[0], ','), words_of(lines[k], ',')));
  }
  return rows;
}

// The numbers of a row as a vector of three components, 0 for a column that is absent.
inline std::array<double, 3> vector_of(const Row& row, const std::string& x, const std::string& y,
                                       const std::string& z) {
  std::array<double, 3> vector{};
  const std::array<std::string, 3> names = {x, y, z};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto column = row.find(names[k]);
    if (column != row.end()) vector[k] = std::stod(column->second);
  }
  return vector;
}

inline std::array<double, 3> position_of(const Row& row) {
  return vector_of(row, "x", "y", "z");
}

inline std::array<double, 3> velocity_of(const Row& row) {
  return vector_of(row, "vx", "vy", "vz");
}

inline std::array<double, 3> image_of(const Row& row) {
  return vector_of(row, "image_x", "image_y", "image_z");
}

// The spin of a disk is along z.
inline std::array<double, 3> spin_of(const Row& row) {
  return vector_of(row, "omega_x", "omega_y", row.contains("omega") ? "omega" : "omega_z");
}

}  // namespace clatter::testing
