#include "app/import/particle_table.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/error.h"
#include "engine/text.h"
#include "engine/whole_number.h"

namespace clatter {

bool ParticleTable::has(int quantity) const {
  return std::ranges::find(columns_, quantity) != columns_.end() ||
         std::ranges::find(derived_, quantity) != derived_.end();
}

// The name of a quantity in this file. That of an absent component is like those of the others, as
// in "vx" and "vy".
std::string ParticleTable::name_of(int quantity) const {
  for (std::size_t k = 0; k < words_.size(); ++k) {
    if (columns_[k] / 3 != quantity / 3) continue;
    return words_[k].substr(0, words_[k].size() - 1) + "xyz"[quantity % 3];
  }
  return "";
}

void ParticleTable::require_unique(const TextLines& lines) const {
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    if (columns_[k] >= kIgnored) continue;
    const auto first = std::ranges::find(columns_, columns_[k]) - columns_.begin();
    const std::string &one = words_[static_cast<std::size_t>(first)], &other = words_[k];
    if (static_cast<std::size_t>(first) == k) continue;
    lines.refuse(one == other ? "two columns are " + one
                              : "the columns " + one + " and " + other + " have one meaning",
                 "remove one of them");
  }
}

void ParticleTable::require_state(const TextLines& lines, const FrameChoice& choice,
                                  const std::string& velocities) const {
  require_unique(lines);
  for (const int axis : {0, 1}) {
    const bool placed = has(kX + axis) || has(kScaled + axis) || has(kUnwrapped + axis) ||
                        has(kScaledUnwrapped + axis);
    if (!placed) lines.refuse("the positions are missing", "give the columns x and y");
  }
  for (const int vector : {+kVx, +kImage}) {
    for (const int axis : {0, 1}) {
      if (has(vector + axis) || !has(vector + 1 - axis)) continue;
      lines.refuse("the column " + name_of(vector + axis) + " is missing",
                   "give all components, or none");
    }
  }
  if (choice.needs_velocities && !has(kVx)) {
    lines.refuse("the velocities are missing", velocities + ", or draw them with --temperature");
  }
}

void ParticleTable::require_spheres(const TextLines& lines, int line) const {
  const bool placed =
      has(kX + 2) || has(kScaled + 2) || has(kUnwrapped + 2) || has(kScaledUnwrapped + 2);
  if (!placed) lines.refuse_at(line, "the positions of spheres lack z", "give the column z");
  if (has(kVx) && !has(kVx + 2)) {
    lines.refuse_at(line, "the velocities of spheres lack vz", "give the column vz");
  }
  for (const int axis : {0, 1, 2}) {
    if (has(kImage) && !has(kImage + axis)) {
      lines.refuse_at(line, "the periodic images of spheres lack z",
                      "give all components, or none");
    }
    if (!has(kOmega + axis) && (has(kOmega) || has(kOmega + 1) || has(kOmega + 2))) {
      lines.refuse_at(line, "the angular velocities of spheres need three components",
                      "give all components, or none");
    }
  }
}

ParticleTable::Row ParticleTable::row(const TextLines& lines, const LineWords& words) const {
  if (words.size() != columns_.size()) {
    lines.refuse("this line has " + counted(words.size(), "column") + " instead of " +
                     std::to_string(columns_.size()),
                 "give every column a value");
  }
  Row row{};
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (columns_[k] < kIgnored) row[columns_[k]] = lines.real(words[k]);
    if (columns_[k] == kReal) lines.real(words[k]);
    const bool no_type = columns_[k] == kType && !signed_number<int>(words[k]);
    if (no_type || (columns_[k] == kWhole && !whole_number<long long>(words[k]))) {
      lines.refuse(quoted_start(words[k]) + " is no whole number",
                   "give every column a value of its kind");
    }
  }
  if (row[kId] != std::floor(row[kId])) {
    lines.refuse("the number of the particle is " + number_text(row[kId]), "give whole numbers");
  }
  const double diameter = row[kDiameter];
  if (has(kDiameter) && has(kRadius) &&
      !(std::fabs(2.0 * row[kRadius] - diameter) <= 1e-9 * diameter)) {
    lines.refuse("the radius " + number_text(row[kRadius]) + " does not fit the diameter " +
                     number_text(diameter),
                 "remove one of the two columns");
  }
  return row;
}

void ParticleTable::add(ParticleFrame& frame, const Row& row, int line) const {
  const auto vector = [&](int at) { return std::array{row[at], row[at + 1], row[at + 2]}; };
  frame.positions.push_back(vector(kX));
  frame.images.push_back(vector(kImage));
  if (has(kVx)) frame.velocities.push_back(vector(kVx));
  if (has(kOmega) || has(kOmega + 1) || has(kOmega + 2)) frame.spins.push_back(vector(kOmega));
  if (has(kType)) frame.types.push_back(static_cast<int>(row[kType]));
  if (has(kMass)) frame.masses.push_back(row[kMass]);
  if (has(kDiameter)) {
    frame.diameters.push_back(row[kDiameter]);
  } else if (has(kRadius)) {
    frame.diameters.push_back(2.0 * row[kRadius]);
  }
  frame.lines.push_back(line);
}

int type_of_name(std::vector<std::string>& names, std::string_view name) {
  const auto known = std::ranges::find(names, name);
  const auto number = static_cast<int>(known - names.begin());
  if (known == names.end()) names.emplace_back(name);
  return number;
}

void add_sorted(ParticleFrame& frame, const ParticleTable& table,
                std::vector<ParticleLine> particles, AllZero all_zero,
                const std::filesystem::path& path) {
  const auto number = [](const ParticleLine& each) { return each.row[kId]; };
  const auto is_numbered = [&](const ParticleLine& each) { return number(each) != 0.0; };
  if (table.has(kId) &&
      (all_zero == AllZero::Numbers || std::ranges::any_of(particles, is_numbered))) {
    std::ranges::stable_sort(particles, {}, number);
    const auto twice = std::ranges::adjacent_find(particles, {}, number);
    if (twice != particles.end()) {
      throw UserError({path.string(), std::next(twice)->line},
                      "the particle " + number_text(number(*twice)) + " occurs twice",
                      "give each particle its own number");
    }
  }
  for (const auto& [row, line] : particles) table.add(frame, row, line);
}

}  // namespace clatter
