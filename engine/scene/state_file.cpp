#include "engine/scene/state_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/dimension.h"
#include "engine/dynamics/near_particles.h"
#include "engine/error.h"
#include "engine/scene/csv_line.h"
#include "engine/scene/limits.h"
#include "engine/scene/scene_document.h"
#include "engine/text.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

// The columns of a state: D coordinates, D velocities, the components of the spin, and those of
// mixtures.
template <int D>
constexpr int kSpinColumn = 2 * D;
template <int D>
constexpr int kDiameterColumn = kSpinColumn<D> + Spin<D>::SizeAtCompileTime;
template <int D>
constexpr int kMassColumn = kDiameterColumn<D> + 1;
template <int D>
constexpr int kSpeciesColumn = kDiameterColumn<D> + 2;
template <int D>
constexpr int kColumns = kDiameterColumn<D> + 3;
template <int D>
constexpr std::array<std::string_view, kColumns<D>> kNames;
template <>
constexpr std::array<std::string_view, kColumns<2>> kNames<2> = {
    "x", "y", "vx", "vy", "omega", "diameter", "mass", "species"};
template <>
constexpr std::array<std::string_view, kColumns<3>> kNames<3> = {
    "x",       "y",       "z",       "vx",       "vy",   "vz",
    "omega_x", "omega_y", "omega_z", "diameter", "mass", "species"};

// The names of the columns from `begin` to before `end`, joined.
template <int D>
std::string names_of(int begin, int end, const char* between = ", ") {
  std::string names;
  for (int k = begin; k < end; ++k) {
    names += (k > begin ? between : "") + std::string(kNames<D>[static_cast<std::size_t>(k)]);
  }
  return names;
}

template <int D>
std::string header_advice() {
  return "begin the file with the line " + names_of<D>(0, kSpinColumn<D>, ",");
}

/// Parser of a CSV text.
template <int D>
class Reader {
 public:
  Reader(std::string_view csv, const std::string& file, const Scene& scene)
      : rest_(csv), scene_(scene), file_(file) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  }

  State<D> read() {
    read_header();
    State<D> state;
    while (next_line()) read_particle(state);
    refuse_overlaps(state);
    return state;
  }

 private:
  Place place_of(const CsvCell& cell) const { return {file_, number_, cell.column}; }
  bool next_line();
  void read_header();
  int column_of(const CsvCell& cell) const;
  void read_particle(State<D>& state);
  double number_in(const CsvCell& cell) const;
  void check_number(const CsvCell& cell, int column, double number) const;
  void check_place(const CsvCell& cell, int axis, double centre, double radius) const;
  std::uint32_t species_in(const CsvCell& cell) const;
  Grain grain_of(const std::vector<CsvCell>& cells) const;
  const CsvCell* cell_of(const std::vector<CsvCell>& cells, int column) const;
  double radius_of(const State<D>& state, std::size_t particle) const;
  void refuse_overlaps(const State<D>& state) const;
  [[noreturn]] void refuse_pair(std::size_t a, std::size_t b, double overlap) const;

  std::string_view rest_;
  std::string_view line_;
  const Scene& scene_;
  const std::string& file_;
  int number_ = 0;                   // of line_, from 1
  std::vector<int> columns_;         // in the order of the file
  std::vector<int> particle_lines_;  // [N] line of each particle
};

/// Moves to the next line that is neither blank nor a comment; false at the end.
template <int D>
bool Reader<D>::next_line() {
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    if (!is_csv_comment(line_)) return true;
  }
  return false;
}

template <int D>
int Reader<D>::column_of(const CsvCell& cell) const {
  const auto name = std::ranges::find(kNames<D>, cell.text);
  if (name == kNames<D>.end()) {
    const std::vector<std::string> names(kNames<D>.begin(), kNames<D>.end());
    const std::string near(near_miss(cell.text, names));
    throw UserError(place_of(cell), "unknown column " + in_quotes(cell.text),
                    near.empty()
                        ? "the columns are " + names_of<D>(0, kSpinColumn<D>) + ", for spins " +
                              names_of<D>(kSpinColumn<D>, kDiameterColumn<D>) +
                              ", and of mixtures " + names_of<D>(kDiameterColumn<D>, kColumns<D>)
                        : "did you mean " + in_quotes(near) + "?");
  }
  const auto column = static_cast<int>(name - kNames<D>.begin());
  if (std::ranges::find(columns_, column) != columns_.end()) {
    throw UserError(place_of(cell), "a second column " + in_quotes(cell.text),
                    "remove one of them");
  }
  if (column >= kDiameterColumn<D> && scene_.species.empty()) {
    throw UserError(place_of(cell),
                    "the column " + in_quotes(cell.text) + " has no meaning without species",
                    "remove the column, or add [[species]] to the scene");
  }
  if (column >= kSpinColumn<D> && column < kDiameterColumn<D> && !scene_.spins()) {
    throw UserError(place_of(cell),
                    "the column " + in_quotes(cell.text) + " has no meaning where nothing spins",
                    "remove the column, or make the particles or a wall rough");
  }
  return column;
}

template <int D>
void Reader<D>::read_header() {
  if (!next_line()) throw UserError({file_}, "the file has no header line", header_advice<D>());
  for (const CsvCell& cell : csv_cells(line_)) columns_.push_back(column_of(cell));
  for (int column = 0; column < kSpinColumn<D>; ++column) {
    if (std::ranges::find(columns_, column) != columns_.end()) continue;
    throw UserError(place_of(CsvCell{}),
                    "the column " + in_quotes(kNames<D>[column]) + " is missing",
                    header_advice<D>());
  }
  const bool named = std::ranges::find(columns_, kSpeciesColumn<D>) != columns_.end();
  if (scene_.species.size() > 1 && !named) {
    throw UserError(place_of(CsvCell{}), "the column \"species\" is missing",
                    "add it, with the name of the species of each particle");
  }
}

// The cell of a column; nullptr if the file lacks the column.
template <int D>
const CsvCell* Reader<D>::cell_of(const std::vector<CsvCell>& cells, int column) const {
  const auto found = std::ranges::find(columns_, column);
  return found == columns_.end() ? nullptr
                                 : &cells[static_cast<std::size_t>(found - columns_.begin())];
}

template <int D>
std::uint32_t Reader<D>::species_in(const CsvCell& cell) const {
  if (const auto number = find_species(scene_.species, cell.text)) {
    return static_cast<std::uint32_t>(*number);
  }
  refuse_species(place_of(cell), cell.text, clatter::names_of(scene_.species));
}

// What a particle of a mixture is. Particles of a species have its diameter, unless it has unequal
// ones, and the mass of its material without a column.
template <int D>
Grain Reader<D>::grain_of(const std::vector<CsvCell>& cells) const {
  constexpr double kRounding = 1e-9;  // of diameters in files, relative
  const CsvCell* name = cell_of(cells, kSpeciesColumn<D>);
  const std::uint32_t number = name ? species_in(*name) : 0;
  const Species& species = scene_.species[number];
  Grain grain = scene_.grain(number, 0, 1);
  if (const CsvCell* cell = cell_of(cells, kDiameterColumn<D>)) {
    const double diameter = number_in(*cell);
    const double least = species.smallest_diameter() * (1.0 - kRounding);
    const double most = species.largest_diameter() * (1.0 + kRounding);
    if (!(diameter >= least && diameter <= most)) {
      throw UserError(
          place_of(*cell),
          "a particle of the species " + in_quotes(species.name) + " has the diameter " +
              number_text(diameter),
          species.polydispersity
              ? "give a number between " + number_text(species.smallest_diameter()) + " and " +
                    number_text(species.largest_diameter())
              : "give " + number_text(species.diameter) + ", or give the species a polydispersity");
    }
    if (species.polydispersity) {
      const double ratio = diameter / (2.0 * grain.radius);
      grain.mass *= D == 2 ? ratio * ratio : ratio * ratio * ratio;
      grain.radius = 0.5 * diameter;
    }
  }
  if (const CsvCell* cell = cell_of(cells, kMassColumn<D>)) {
    const double mass = number_in(*cell);
    const bool differs = std::fabs(mass - grain.mass) > kRounding * grain.mass;
    if (!(mass >= kMinMass && mass <= kMaxMass) || (differs && !species.polydispersity)) {
      throw UserError(
          place_of(*cell),
          "a particle of the species " + in_quotes(species.name) + " has the mass " +
              number_text(mass),
          species.polydispersity
              ? "give a number between " + number_text(kMinMass) + " and " + number_text(kMaxMass)
              : "give " + number_text(grain.mass) + ", or the mass of the species in the scene");
    }
    if (species.polydispersity) grain.mass = mass;
  }
  return grain;
}

template <int D>
double Reader<D>::number_in(const CsvCell& cell) const {
  if (const std::optional<double> number = finite_number(cell.text)) return *number;
  throw UserError(place_of(cell), quoted_start(cell.text) + " is no finite number",
                  "write, say, -0.25 or 1.5e-3");
}

template <int D>
void Reader<D>::check_number(const CsvCell& cell, int column, double number) const {
  if (column >= D && std::fabs(number) > kMaxSpeed) {
    throw UserError(place_of(cell), std::string(kNames<D>[column]) + " is " + number_text(number),
                    "give at most " + number_text(kMaxSpeed) + " either way");
  }
}

/// Throws unless a centre is in the box along a periodic axis, or between the walls at their
/// positions of time 0. A moving wall may then be outside of the box.
template <int D>
void Reader<D>::check_place(const CsvCell& cell, int axis, double centre, double radius) const {
  const std::string name(kNames<D>[axis]);
  const double length = scene_.box[axis];
  if (scene_.periodic(axis)) {
    if (centre >= 0.0 && centre <= length) return;
    throw UserError(place_of(cell), name + " = " + number_text(centre) + " lies outside the box",
                    "give a number between 0 and " + number_text(length));
  }
  const Wall& near = *scene_.walls[2 * axis];
  const Wall& far = *scene_.walls[2 * axis + 1];
  const double low = radius + near.start_travel();
  const double high = length - radius - far.start_travel();
  if (centre >= low - kStartRounding && centre <= high + kStartRounding) return;
  const int side = 2 * axis + (centre > high ? 1 : 0);
  const bool moves = scene_.walls[side]->moves();
  throw UserError(place_of(cell),
                  "at " + name + " = " + number_text(centre) + " the particle overlaps the " +
                      kSideNames[side] + " wall" + (moves ? " at time 0" : ""),
                  "give a number between " + number_text(low) + " and " + number_text(high) +
                      (moves ? ", or change the phase of the wall" : ""));
}

template <int D>
void Reader<D>::read_particle(State<D>& state) {
  const std::vector<CsvCell> cells = csv_cells(line_);
  if (cells.size() != columns_.size()) {
    throw UserError(place_of(CsvCell{}),
                    "this line has " + std::to_string(cells.size()) + " cells, the header has " +
                        std::to_string(columns_.size()),
                    "give every column a number");
  }
  std::array<double, kColumns<D>> numbers{};
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (columns_[k] >= kDiameterColumn<D>) continue;
    double& number = numbers[static_cast<std::size_t>(columns_[k])];
    number = number_in(cells[k]);
    check_number(cells[k], columns_[k], number);
  }
  if (!scene_.species.empty()) state.grains.push_back(grain_of(cells));
  for (int axis = 0; axis < D; ++axis) {
    check_place(*cell_of(cells, axis), axis, numbers[static_cast<std::size_t>(axis)],
                radius_of(state, state.positions.size()));
  }
  state.positions.emplace_back(Eigen::Map<const Vec<D>>(&numbers[0]));
  state.velocities.emplace_back(Eigen::Map<const Vec<D>>(&numbers[D]));
  if (scene_.spins()) {
    state.spins.emplace_back(Eigen::Map<const Spin<D>>(&numbers[kSpinColumn<D>]));
  }
  particle_lines_.push_back(number_);
}

template <int D>
double Reader<D>::radius_of(const State<D>& state, std::size_t particle) const {
  return state.grains.empty() ? 0.5 : state.grains[particle].radius;
}

template <int D>
void Reader<D>::refuse_pair(std::size_t a, std::size_t b, double overlap) const {
  const auto [first, second] = std::minmax(particle_lines_[a], particle_lines_[b]);
  throw UserError({file_, second, 1},
                  fmt::format("the particles of lines {} and {} overlap by {:.3g}{}", first, second,
                              overlap, scene_.species.empty() ? " diameters" : ""),
                  "move them apart, or remove one");
}

template <int D>
void Reader<D>::refuse_overlaps(const State<D>& state) const {
  const double largest = scene_.largest_diameter();
  NearParticles<D> near(model_of<D>(scene_, 0).domain(), largest);
  for (std::uint32_t i = 0; i < state.positions.size(); ++i) {
    near.visit(state.positions[i], [&](std::uint32_t j, const Vec<D>& way) {
      const double overlap = radius_of(state, i) + radius_of(state, j) - way.norm();
      if (overlap > kStartRounding * largest) refuse_pair(i, j, overlap);
    });
    near.add(state.positions[i]);
  }
}

}  // namespace

AnyState parse_state(std::string_view csv, const std::string& file, const Scene& scene) {
  return with_dimension(scene.dimension(), [&](auto dimension) -> AnyState {
    return Reader<dimension>(csv, file, scene).read();
  });
}

template <int D>
std::string state_to_csv(const State<D>& state, const std::vector<Species>& species) {
  const bool spins = !state.spins.empty();
  std::string csv = names_of<D>(0, spins ? kDiameterColumn<D> : kSpinColumn<D>, ",");
  if (!state.grains.empty()) csv += ',' + names_of<D>(kDiameterColumn<D>, kColumns<D>, ",");
  csv += '\n';
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    std::string line;
    const auto add = [&](const auto& numbers) {
      for (const double number : numbers) line += (line.empty() ? "" : ",") + number_text(number);
    };
    add(state.positions[i]);
    add(state.velocities[i]);
    if (spins) add(state.spins[i]);
    if (!state.grains.empty()) {
      const Grain& grain = state.grains[i];
      add(std::array{2.0 * grain.radius, grain.mass});
      line += ',' + species[grain.species].name;
    }
    csv += line + '\n';
  }
  return csv;
}

template std::string state_to_csv(const State<2>&, const std::vector<Species>&);
template std::string state_to_csv(const State<3>&, const std::vector<Species>&);

}  // namespace clatter
