#include "engine/scene/state_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "engine/scene/scene_keys.h"
#include "engine/scene/text.h"

namespace clatter {

namespace {

enum Column { kX, kY, kVx, kVy, kOmega, kColumns };
constexpr std::array<std::string_view, kColumns> kNames = {"x", "y", "vx", "vy", "omega"};
constexpr const char* kHeaderAdvice = "begin the file with the line x,y,vx,vy";

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

/// The number as far as a message needs it.
std::string three_digits(double number) {
  std::array<char, 32> digits;
  const auto [end, error] =
      std::to_chars(digits.begin(), digits.end(), number, std::chars_format::general, 3);
  return std::string(digits.begin(), end);
}

/// What stands between two commas, without the blanks about it.
struct Cell {
  std::string_view text;
  int column = 1;  // of its first letter in the line
};

/// Reads the text from top to bottom.
class Reader {
 public:
  Reader(std::string_view csv, const std::string& file, const Scene& scene)
      : rest_(csv), scene_(scene), file_(file) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  }

  State<2> read() {
    read_header();
    State<2> state;
    while (next_line()) read_particle(state);
    refuse_overlaps(state.positions);
    return state;
  }

 private:
  Place place_of(const Cell& cell) const { return {file_, number_, cell.column}; }
  bool next_line();
  std::size_t cells_in_line() const { return 1 + std::ranges::count(line_, ','); }
  template <class Visit>
  void visit_cells(const Visit& visit);
  void read_header();
  Column column_of(const Cell& cell) const;
  void read_particle(State<2>& state);
  double number_in(const Cell& cell) const;
  void check_number(const Cell& cell, Column column, double number) const;
  void check_place(const Cell& cell, int axis, double centre) const;
  void refuse_overlaps(const std::vector<Vec2>& centres) const;
  [[noreturn]] void refuse_pair(std::size_t a, std::size_t b, double distance) const;

  std::string_view rest_;
  std::string_view line_;
  const Scene& scene_;
  const std::string& file_;
  int number_ = 0;                   // of line_, from 1
  std::vector<Column> columns_;      // as they stand in the file
  std::vector<int> particle_lines_;  // [N] of each particle
};

/// Moves to the next line that counts; false at the end.
bool Reader::next_line() {
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    const std::string_view content = trimmed(line_);
    if (!content.empty() && content.front() != '#') return true;
  }
  return false;
}

/// Calls visit(cell) for the cells of line_.
template <class Visit>
void Reader::visit_cells(const Visit& visit) {
  Cell cell;
  for (std::size_t begin = 0; begin <= line_.size();) {
    const std::size_t end = std::min(line_.find(',', begin), line_.size());
    const std::string_view whole = line_.substr(begin, end - begin);
    cell.text = trimmed(whole);
    const std::size_t offset = cell.text.empty() ? 0 : cell.text.data() - whole.data();
    cell.column = static_cast<int>(begin + offset + 1);
    visit(cell);
    begin = end + 1;
  }
}

Column Reader::column_of(const Cell& cell) const {
  const auto name = std::ranges::find(kNames, cell.text);
  if (name == kNames.end()) {
    const std::vector<std::string> names(kNames.begin(), kNames.end());
    const std::string near(near_miss(cell.text, names));
    throw UserError(place_of(cell), "unknown column " + in_quotes(cell.text),
                    near.empty() ? "the columns are x, y, vx, vy and, for spins, omega"
                                 : "did you mean " + in_quotes(near) + "?");
  }
  const auto column = static_cast<Column>(name - kNames.begin());
  if (std::ranges::find(columns_, column) != columns_.end()) {
    throw UserError(place_of(cell), "a second column " + in_quotes(cell.text),
                    "remove one of them");
  }
  if (column == kOmega && !scene_.spins()) {
    throw UserError(place_of(cell), "the column \"omega\" has no meaning where nothing spins",
                    "remove the column, or make the particles or a wall rough");
  }
  return column;
}

void Reader::read_header() {
  if (!next_line()) throw UserError({file_}, "the file has no header line", kHeaderAdvice);
  visit_cells([&](const Cell& cell) { columns_.push_back(column_of(cell)); });
  for (const Column column : {kX, kY, kVx, kVy}) {
    if (std::ranges::find(columns_, column) != columns_.end()) continue;
    throw UserError(place_of(Cell{}), "the column " + in_quotes(kNames[column]) + " is missing",
                    kHeaderAdvice);
  }
}

double Reader::number_in(const Cell& cell) const {
  double number = 0.0;
  const char* const end = cell.text.data() + cell.text.size();
  const auto [stopped, error] = std::from_chars(cell.text.data(), end, number);
  if (error == std::errc() && stopped == end && std::isfinite(number)) return number;
  throw UserError(place_of(cell), in_quotes(cell.text.substr(0, 40)) + " is no finite number",
                  "write, say, -0.25 or 1.5e-3");
}

void Reader::check_number(const Cell& cell, Column column, double number) const {
  if (column == kX || column == kY) {
    check_place(cell, column == kX ? 0 : 1, number);
  } else if (std::fabs(number) > kMaxSpeed) {
    throw UserError(place_of(cell), std::string(kNames[column]) + " is " + number_text(number),
                    "give at most " + number_text(kMaxSpeed) + " either way");
  }
}

/// A centre lies in the box along a periodic axis, and else between the walls as they are at time
/// 0, one of which may then have gone out of the box.
void Reader::check_place(const Cell& cell, int axis, double centre) const {
  const std::string name(kNames[axis]);
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
                      kSideNames[side] + " wall" + (moves ? ", as that is at time 0" : ""),
                  "give a number between " + number_text(low) + " and " + number_text(high) +
                      (moves ? ", or the wall the phase that it had" : ""));
}

void Reader::read_particle(State<2>& state) {
  if (cells_in_line() != columns_.size()) {
    throw UserError(place_of(Cell{}),
                    "this line has " + std::to_string(cells_in_line()) + " cells, the header has " +
                        std::to_string(columns_.size()),
                    "give every column a number");
  }
  std::array<double, kColumns> numbers{};
  std::size_t at = 0;
  visit_cells([&](const Cell& cell) {
    const Column column = columns_[at++];
    numbers[column] = number_in(cell);
    check_number(cell, column, numbers[column]);
  });
  state.positions.emplace_back(numbers[kX], numbers[kY]);
  state.velocities.emplace_back(numbers[kVx], numbers[kVy]);
  if (scene_.spins()) state.spins.push_back(Spin<2>(numbers[kOmega]));
  particle_lines_.push_back(number_);
}

void Reader::refuse_pair(std::size_t a, std::size_t b, double distance) const {
  const auto [first, second] = std::minmax(particle_lines_[a], particle_lines_[b]);
  throw UserError({file_, second, 1},
                  "the particles of lines " + std::to_string(first) + " and " +
                      std::to_string(second) + " overlap by " + three_digits(1.0 - distance) +
                      " diameters",
                  "move them apart, or remove one");
}

/// Particles sorted by cells a little wider than a diameter, so that particles that overlap lie in
/// one cell or in neighbours; memory follows the particles and not the box.
class Neighbours {
 public:
  Neighbours(const Scene& scene, const std::vector<Vec2>& centres) : scene_(scene) {
    for (int axis = 0; axis < 2; ++axis) {
      counts_[axis] = std::max<std::int64_t>(1, static_cast<std::int64_t>(scene.box[axis] / 1.01));
    }
    sorted_.reserve(centres.size());
    for (std::size_t i = 0; i < centres.size(); ++i) {
      sorted_.emplace_back(number(cell_at(centres[i])), static_cast<std::uint32_t>(i));
    }
    std::ranges::sort(sorted_);
  }

  /// Calls visit(other) for the particles about a centre, some of them more than once.
  template <class Visit>
  void visit(const Vec2& centre, const Visit& visit) const {
    const auto [x, y] = cell_at(centre);
    for (std::int64_t dy = -1; dy <= 1; ++dy) {
      for (std::int64_t dx = -1; dx <= 1; ++dx) {
        const auto cell = wrapped({x + dx, y + dy});
        if (cell) visit_cell(number(*cell), visit);
      }
    }
  }

 private:
  using Position = std::array<std::int64_t, 2>;

  Position cell_at(const Vec2& centre) const {
    Position cell;
    for (int axis = 0; axis < 2; ++axis) {
      const double share = centre[axis] / scene_.box[axis];
      cell[axis] = std::clamp<std::int64_t>(static_cast<std::int64_t>(share * counts_[axis]), 0,
                                            counts_[axis] - 1);
    }
    return cell;
  }

  std::optional<Position> wrapped(Position cell) const {
    for (int axis = 0; axis < 2; ++axis) {
      if (cell[axis] >= 0 && cell[axis] < counts_[axis]) continue;
      if (!scene_.periodic(axis)) return std::nullopt;
      cell[axis] = (cell[axis] + counts_[axis]) % counts_[axis];
    }
    return cell;
  }

  std::int64_t number(const Position& cell) const { return cell[1] * counts_[0] + cell[0]; }

  template <class Visit>
  void visit_cell(std::int64_t cell, const Visit& visit) const {
    auto entry = std::ranges::lower_bound(sorted_, std::pair{cell, std::uint32_t{0}});
    for (; entry != sorted_.end() && entry->first == cell; ++entry) visit(entry->second);
  }

  const Scene& scene_;
  Position counts_;                                             // of cells along each axis
  std::vector<std::pair<std::int64_t, std::uint32_t>> sorted_;  // [N] number of the cell, particle
};

void Reader::refuse_overlaps(const std::vector<Vec2>& centres) const {
  const Neighbours neighbours(scene_, centres);
  for (std::uint32_t i = 0; i < centres.size(); ++i) {
    neighbours.visit(centres[i], [&](std::uint32_t j) {
      if (j >= i) return;
      Vec2 x = centres[i] - centres[j];
      for (int axis = 0; axis < 2; ++axis) {
        if (!scene_.periodic(axis)) continue;
        x[axis] -= scene_.box[axis] * std::round(x[axis] / scene_.box[axis]);
      }
      const double distance = x.norm();
      if (distance < 1.0 - kStartRounding) refuse_pair(i, j, distance);
    });
  }
}

}  // namespace

State<2> parse_state(std::string_view csv, const std::string& file, const Scene& scene) {
  return Reader(csv, file, scene).read();
}

std::string state_to_csv(const State<2>& state) {
  const bool spins = !state.spins.empty();
  std::string csv = spins ? "x,y,vx,vy,omega\n" : "x,y,vx,vy\n";
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const Vec2& r = state.positions[i];
    const Vec2& v = state.velocities[i];
    csv += number_text(r.x()) + ',' + number_text(r.y()) + ',' + number_text(v.x()) + ',' +
           number_text(v.y());
    if (spins) csv += ',' + number_text(state.spins[i][0]);
    csv += '\n';
  }
  return csv;
}

}  // namespace clatter
