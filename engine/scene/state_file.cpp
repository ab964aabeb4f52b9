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
#include "engine/text.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

// The columns of a state: D coordinates, D velocities, and the components of the spin.
template <int D>
constexpr int kSpinColumn = 2 * D;
template <int D>
constexpr int kColumns = kSpinColumn<D> + Spin<D>::SizeAtCompileTime;
template <int D>
constexpr std::array<std::string_view, kColumns<D>> kNames;
template <>
constexpr std::array<std::string_view, kColumns<2>> kNames<2> = {"x", "y", "vx", "vy", "omega"};
template <>
constexpr std::array<std::string_view, kColumns<3>> kNames<3> = {
    "x", "y", "z", "vx", "vy", "vz", "omega_x", "omega_y", "omega_z"};

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
    refuse_overlaps(state.positions);
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
  void check_place(const CsvCell& cell, int axis, double centre) const;
  void refuse_overlaps(const std::vector<Vec<D>>& centres) const;
  [[noreturn]] void refuse_pair(std::size_t a, std::size_t b, double distance) const;

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
                        ? "the columns are " + names_of<D>(0, kSpinColumn<D>) +
                              " and, for spins, " + names_of<D>(kSpinColumn<D>, kColumns<D>)
                        : "did you mean " + in_quotes(near) + "?");
  }
  const auto column = static_cast<int>(name - kNames<D>.begin());
  if (std::ranges::find(columns_, column) != columns_.end()) {
    throw UserError(place_of(cell), "a second column " + in_quotes(cell.text),
                    "remove one of them");
  }
  if (column >= kSpinColumn<D> && !scene_.spins()) {
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
}

template <int D>
double Reader<D>::number_in(const CsvCell& cell) const {
  if (const std::optional<double> number = finite_number(cell.text)) return *number;
  throw UserError(place_of(cell), quoted_start(cell.text) + " is no finite number",
                  "write, say, -0.25 or 1.5e-3");
}

template <int D>
void Reader<D>::check_number(const CsvCell& cell, int column, double number) const {
  if (column < D) {
    check_place(cell, column, number);
  } else if (std::fabs(number) > kMaxSpeed) {
    throw UserError(place_of(cell), std::string(kNames<D>[column]) + " is " + number_text(number),
                    "give at most " + number_text(kMaxSpeed) + " either way");
  }
}

/// Throws unless a centre is in the box along a periodic axis, or between the walls at their
/// positions of time 0. A moving wall may then be outside of the box.
template <int D>
void Reader<D>::check_place(const CsvCell& cell, int axis, double centre) const {
  const std::string name(kNames<D>[axis]);
  const double length = scene_.box[axis];
  if (scene_.periodic(axis)) {
    if (centre >= 0.0 && centre <= length) return;
    throw UserError(place_of(cell), name + " = " + number_text(centre) + " lies outside the box",
                    "give a number between 0 and " + number_text(length));
  }
  const Wall& near = *scene_.walls[2 * axis];
  const Wall& far = *scene_.walls[2 * axis + 1];
  const double low = 0.5 + near.start_travel();
  const double high = length - 0.5 - far.start_travel();
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
    double& number = numbers[static_cast<std::size_t>(columns_[k])];
    number = number_in(cells[k]);
    check_number(cells[k], columns_[k], number);
  }
  state.positions.emplace_back(Eigen::Map<const Vec<D>>(&numbers[0]));
  state.velocities.emplace_back(Eigen::Map<const Vec<D>>(&numbers[D]));
  if (scene_.spins()) {
    state.spins.emplace_back(Eigen::Map<const Spin<D>>(&numbers[kSpinColumn<D>]));
  }
  particle_lines_.push_back(number_);
}

template <int D>
void Reader<D>::refuse_pair(std::size_t a, std::size_t b, double distance) const {
  const auto [first, second] = std::minmax(particle_lines_[a], particle_lines_[b]);
  throw UserError({file_, second, 1},
                  fmt::format("the particles of lines {} and {} overlap by {:.3g} diameters", first,
                              second, 1.0 - distance),
                  "move them apart, or remove one");
}

template <int D>
void Reader<D>::refuse_overlaps(const std::vector<Vec<D>>& centres) const {
  NearParticles<D> near(model_of<D>(scene_, 0).domain(), 1.0);
  for (std::uint32_t i = 0; i < centres.size(); ++i) {
    near.visit(centres[i], [&](std::uint32_t j, const Vec<D>& way) {
      const double distance = way.norm();
      if (distance < 1.0 - kStartRounding) refuse_pair(i, j, distance);
    });
    near.add(centres[i]);
  }
}

}  // namespace

AnyState parse_state(std::string_view csv, const std::string& file, const Scene& scene) {
  return with_dimension(scene.dimension(), [&](auto dimension) -> AnyState {
    return Reader<dimension>(csv, file, scene).read();
  });
}

template <int D>
std::string state_to_csv(const State<D>& state) {
  const bool spins = !state.spins.empty();
  std::string csv = names_of<D>(0, spins ? kColumns<D> : kSpinColumn<D>, ",") + '\n';
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    std::string line;
    const auto add = [&](const auto& numbers) {
      for (const double number : numbers) line += (line.empty() ? "" : ",") + number_text(number);
    };
    add(state.positions[i]);
    add(state.velocities[i]);
    if (spins) add(state.spins[i]);
    csv += line + '\n';
  }
  return csv;
}

template std::string state_to_csv(const State<2>&);
template std::string state_to_csv(const State<3>&);

}  // namespace clatter
