#include "app/results/text_frames.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "engine/physics/state.h"
#include "engine/scene/text.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

using Words = std::vector<std::string_view>;

// The words between blanks.
Words words_of(std::string_view text) {
  Words words;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \t", begin), text.size());
    if (end > begin) words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

// The lines of a text file.
class Lines {
 public:
  explicit Lines(const std::filesystem::path& path) : path_(path), file_(path, std::ios::binary) {
    if (!file_) refuse("the file cannot be read", "check its permissions");
  }

  // Moves to the next line; false at the end.
  bool next() {
    if (!std::getline(file_, line_)) return false;
    if (line_.ends_with('\r')) line_.pop_back();
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (++number_ == 1 && line_.starts_with(kByteOrderMark)) line_.erase(0, kByteOrderMark.size());
    return true;
  }
  const std::string& text() const { return line_; }
  // The words of the line.
  Words words() const { return words_of(line_); }
  // The cells of a line of CSV, without surrounding blanks.
  Words cells() const {
    Words cells;
    const std::string_view line = line_;
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t end = std::min(line.find(',', begin), line.size());
      std::string_view cell = line.substr(begin, end - begin);
      while (cell.starts_with(' ')) cell.remove_prefix(1);
      while (cell.ends_with(' ')) cell.remove_suffix(1);
      cells.push_back(cell);
      begin = end + 1;
    }
    return cells;
  }
  double number(std::string_view word) const {
    if (word.starts_with('+')) word.remove_prefix(1);
    double number = 0.0;
    const char* const end = word.data() + word.size();
    const auto [stopped, error] = std::from_chars(word.data(), end, number);
    if (error == std::errc() && stopped == end && std::isfinite(number)) return number;
    refuse(in_quotes(word.substr(0, 40)) + " is no finite number", "write, say, -0.25 or 1.5e-3");
  }
  std::size_t count(std::string_view word) const {
    const auto count = whole_number<std::size_t>(word);
    if (count && *count <= kMaxParticles<2>) return *count;
    refuse(in_quotes(word.substr(0, 40)) + " is no number of particles",
           "give at most " + std::to_string(kMaxParticles<2>));
  }
  [[noreturn]] void refuse(const std::string& problem, const std::string& advice) const {
    throw UserError({path_.string(), number_, 0}, problem, advice);
  }
  [[noreturn]] void refuse_end() const {
    refuse("the file ends within a frame",
           "give a complete file, or an earlier frame with --frame");
  }

 private:
  std::filesystem::path path_;
  std::ifstream file_;
  std::string line_;
  int number_ = 0;
};

// The quantities of a particle in a table, in the order of the values of a row.
enum Quantities {
  kX,
  kVx = 3,
  kImage = 6,
  kOmega = 9,
  kRadius = 12,
  kDiameter,
  kMass,
  kId,
  kTime,
  kIgnored,
  kRow
};
constexpr std::array<const char*, kIgnored> kQuantityNames = {
    "x",       "y",       "z",       "vx",     "vy",       "vz",   "image_x", "image_y", "image_z",
    "omega_x", "omega_y", "omega_z", "radius", "diameter", "mass", "id",      "time"};

// A table of particles: the meaning of its columns.
class ParticleTable {
 public:
  explicit ParticleTable(std::vector<int> columns) : columns_(std::move(columns)) {}

  bool has(int quantity) const { return std::ranges::find(columns_, quantity) != columns_.end(); }

  void require(const Lines& lines) const {
    for (int quantity = 0; quantity < kIgnored; ++quantity) {
      if (std::ranges::count(columns_, quantity) < 2) continue;
      lines.refuse(std::string("two columns are ") + kQuantityNames[quantity],
                   "remove one of them");
    }
    for (const int axis : {0, 1}) {
      if (!has(kX + axis)) lines.refuse("the positions are missing", "give the columns x and y");
      if (!has(kVx + axis))
        lines.refuse("the velocities are missing", "give the columns vx and vy");
    }
  }
  // Spheres have positions and velocities along z.
  void require_spheres(const Lines& lines) const {
    if (!has(kX + 2)) lines.refuse("the positions of spheres lack z", "give the column z");
    if (!has(kVx + 2)) lines.refuse("the velocities of spheres lack vz", "give the column vz");
  }

  // The values of the current line.
  std::array<double, kRow> row(const Lines& lines, const Words& words) const {
    if (words.size() != columns_.size()) {
      lines.refuse("this line has " + std::to_string(words.size()) + " columns instead of " +
                       std::to_string(columns_.size()),
                   "give every column a value");
    }
    std::array<double, kRow> row{};
    for (std::size_t k = 0; k < words.size(); ++k) {
      if (columns_[k] != kIgnored) row[columns_[k]] = lines.number(words[k]);
    }
    const auto require_size = [&](int quantity, double size) {
      if (!has(quantity) || row[quantity] == size) return;
      lines.refuse(std::string("the ") + kQuantityNames[quantity] + " is " +
                       number_text(row[quantity]) + " instead of " + number_text(size),
                   "divide all lengths by the diameter");
    };
    require_size(kRadius, 0.5);
    require_size(kDiameter, 1.0);
    return row;
  }

  void add(ParticleFrame& frame, const std::array<double, kRow>& row) const {
    const auto vector = [&](int at) { return std::array{row[at], row[at + 1], row[at + 2]}; };
    frame.positions.push_back(vector(kX));
    frame.velocities.push_back(vector(kVx));
    if (has(kImage)) frame.images.push_back(vector(kImage));
    if (has(kOmega) || has(kOmega + 2)) frame.spins.push_back(vector(kOmega));
    if (has(kMass)) frame.masses.push_back(row[kMass]);
  }

 private:
  std::vector<int> columns_;
};

// Moves the lower corner of the box to 0. Disks stay at z = 0.
void shift(ParticleFrame& frame, const ParticleFrame::Vector& corner) {
  frame.dimension = is_flat(frame) ? 2 : 3;
  for (ParticleFrame::Vector& position : frame.positions) {
    for (int axis = 0; axis < frame.dimension; ++axis) position[axis] -= corner[axis];
  }
}

// CSV.

class CsvFrames {
 public:
  explicit CsvFrames(const std::filesystem::path& path) : lines_(path), table_({}) {
    static const std::map<std::string_view, int> kColumns = {{"x", kX},
                                                             {"y", kX + 1},
                                                             {"z", kX + 2},
                                                             {"vx", kVx},
                                                             {"vy", kVx + 1},
                                                             {"vz", kVx + 2},
                                                             {"image_x", kImage},
                                                             {"image_y", kImage + 1},
                                                             {"image_z", kImage + 2},
                                                             {"omega", kOmega + 2},
                                                             {"omega_x", kOmega},
                                                             {"omega_y", kOmega + 1},
                                                             {"omega_z", kOmega + 2},
                                                             {"time", kTime},
                                                             {"particle", kIgnored}};
    if (!next_line()) lines_.refuse("the file has no header line", "name the columns in a header");
    std::vector<int> columns;
    for (const std::string_view word : lines_.cells()) {
      const auto column = kColumns.find(word);
      if (column == kColumns.end()) {
        lines_.refuse("unknown column " + in_quotes(word.substr(0, 40)),
                      "give the columns of a start state or of a trajectory, between commas");
      }
      columns.push_back(column->second);
    }
    table_ = ParticleTable(columns);
    table_.require(lines_);
    if (is_spatial()) table_.require_spheres(lines_);
    more_ = next_line();
  }

  std::optional<ParticleFrame> next() {
    if (!more_ && (frames_ > 0 || table_.has(kTime))) return std::nullopt;
    ParticleFrame frame;
    frame.dimension = is_spatial() ? 3 : 2;
    frame.number = static_cast<long>(frames_++);
    for (bool first = true; more_; more_ = next_line(), first = false) {
      const auto row = table_.row(lines_, lines_.cells());
      if (!first && row[kTime] != frame.time) break;
      frame.time = row[kTime];
      table_.add(frame, row);
    }
    if (frames_ == 1) particles_ = frame.positions.size();
    if (frame.positions.size() < particles_ && !more_) lines_.refuse_end();
    if (frame.positions.size() != particles_) {
      lines_.refuse("the frame at time " + number_text(frame.time) + " has " +
                        std::to_string(frame.positions.size()) + " particles instead of " +
                        std::to_string(particles_),
                    "give all frames the same particles");
    }
    return frame;
  }

 private:
  bool is_spatial() const { return table_.has(kX + 2) || table_.has(kVx + 2); }
  // Skips blank lines and comments.
  bool next_line() {
    while (lines_.next()) {
      const std::size_t first = lines_.text().find_first_not_of(" \t");
      if (first != std::string::npos && lines_.text()[first] != '#') return true;
    }
    return false;
  }

  Lines lines_;
  ParticleTable table_;
  bool more_ = false;
  std::size_t frames_ = 0;
  std::size_t particles_ = 0;  // of the first frame
};

// Extended XYZ.

class XyzFrames {
 public:
  explicit XyzFrames(const std::filesystem::path& path) : lines_(path) {}

  std::optional<ParticleFrame> next() {
    do {
      if (!lines_.next()) return std::nullopt;
    } while (lines_.words().empty());
    const std::size_t particles = lines_.count(lines_.words().front());
    if (!lines_.next()) lines_.refuse_end();
    ParticleFrame frame;
    frame.number = frames_++;
    const ParticleFrame::Vector corner = read_head(frame);
    const ParticleTable table = read_columns();
    for (std::size_t i = 0; i < particles; ++i) {
      if (!lines_.next()) lines_.refuse_end();
      table.add(frame, table.row(lines_, lines_.words()));
    }
    shift(frame, corner);
    return frame;
  }

 private:
  // The value of a key in the head; empty: absent.
  std::string value_of(const std::string& key) const {
    const std::string head = ' ' + lines_.text();
    const std::size_t place = head.find(' ' + key + '=');
    if (place == head.npos) return "";
    const std::string rest = head.substr(place + key.size() + 2);
    return rest.starts_with('"') ? rest.substr(1, rest.find('"', 1) - 1)
                                 : rest.substr(0, rest.find(' '));
  }

  std::vector<double> numbers_of(const std::string& text) const {
    std::vector<double> numbers;
    for (const std::string_view word : words_of(text)) numbers.push_back(lines_.number(word));
    return numbers;
  }

  // Reads time and box. Returns the lower corner of the box.
  ParticleFrame::Vector read_head(ParticleFrame& frame) const {
    const std::string time = value_of("Time"), periodic = value_of("pbc");
    if (!time.empty()) frame.time = lines_.number(time);
    const std::vector<double> lattice = numbers_of(value_of("Lattice"));
    if (lattice.size() != 9)
      lines_.refuse("the box is missing", "give Lattice=\"...\" nine numbers");
    frame.box.emplace();
    for (std::size_t k = 0; k < 9; ++k) {
      if (k % 4 == 0) {
        frame.box->lengths[k / 4] = lattice[k];
      } else if (lattice[k] != 0.0) {
        lines_.refuse("the box is tilted", "give a rectangular box");
      }
    }
    const Words flags = words_of(periodic);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Without the key a box is periodic.
      frame.box->periodic[axis] =
          flags.size() != 3 || flags[axis] == "T" || flags[axis] == "1" || flags[axis] == "True";
    }
    const std::vector<double> origin = numbers_of(value_of("Origin"));
    if (origin.size() == 3) return {origin[0], origin[1], origin[2]};
    return {};
  }

  ParticleTable read_columns() const {
    static const std::map<std::string, int> kNames = {
        {"pos", kX},       {"velo", kVx},       {"vel", kVx},    {"map_shift", kImage},
        {"omega", kOmega}, {"radius", kRadius}, {"mass", kMass}, {"masses", kMass}};
    std::string rest = value_of("Properties") + ':';
    std::vector<std::string> parts;
    for (std::size_t end = 0; (end = rest.find(':')) != rest.npos; rest.erase(0, end + 1)) {
      parts.push_back(rest.substr(0, end));
    }
    std::vector<int> columns;
    for (std::size_t k = 0; k + 2 < parts.size(); k += 3) {
      const auto name = kNames.find(parts[k]);
      const auto width = whole_number<int>(parts[k + 2]);
      const int wanted = name == kNames.end() ? 0 : name->second >= kRadius ? 1 : 3;
      if (!width || *width < 1 || *width > 100 || (wanted > 0 && *width != wanted)) {
        lines_.refuse("the property " + in_quotes(parts[k].substr(0, 40)) + " has a wrong width",
                      "give vectors three columns");
      }
      for (int c = 0; c < *width; ++c) columns.push_back(wanted > 0 ? name->second + c : kIgnored);
    }
    ParticleTable table(columns);
    table.require(lines_);
    return table;
  }

  Lines lines_;
  long frames_ = 0;
};

// Text dumps of LAMMPS.

class DumpFrames {
 public:
  explicit DumpFrames(const std::filesystem::path& path) : lines_(path) {}

  std::optional<ParticleFrame> next() {
    ParticleFrame frame;
    ParticleFrame::Vector corner = {};
    std::optional<std::size_t> particles;
    while (lines_.next()) {
      const std::string item = lines_.text();
      if (item == "ITEM: TIMESTEP") {
        frame.number = step_of(next_number());
      } else if (item == "ITEM: TIME") {
        frame.time = next_number();
      } else if (item == "ITEM: UNITS") {
        if (!lines_.next()) lines_.refuse_end();
      } else if (item == "ITEM: NUMBER OF ATOMS") {
        if (!lines_.next()) lines_.refuse_end();
        particles = lines_.count(lines_.text());
      } else if (item.starts_with("ITEM: BOX BOUNDS")) {
        corner = read_box(frame);
      } else if (item.starts_with("ITEM: ATOMS") && particles && frame.box) {
        const ParticleTable table = read_atoms(frame, *particles);
        shift(frame, corner);
        if (frame.dimension == 3) table.require_spheres(lines_);
        return frame;
      } else {
        lines_.refuse("unexpected line " + in_quotes(item.substr(0, 40)),
                      "give a text dump of LAMMPS with box and number of atoms");
      }
      begun_ = true;
    }
    if (begun_) lines_.refuse_end();
    return std::nullopt;
  }

 private:
  double next_number() {
    if (!lines_.next()) lines_.refuse_end();
    return lines_.number(lines_.text());
  }

  ParticleFrame::Vector read_box(ParticleFrame& frame) {
    const Words words = lines_.words();
    if (words.size() > 6) lines_.refuse("the box is tilted", "give a rectangular box");
    if (words.size() < 6) {
      lines_.refuse("the kinds of boundaries are missing", "write, say, ITEM: BOX BOUNDS pp pp ff");
    }
    frame.box.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      frame.box->periodic[axis] = words[3 + axis] == "pp";
    }
    ParticleFrame::Vector corner = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!lines_.next()) lines_.refuse_end();
      const Words bounds = lines_.words();
      if (bounds.size() != 2) lines_.refuse("this line has not two bounds", "give both bounds");
      corner[axis] = lines_.number(bounds[0]);
      frame.box->lengths[axis] = lines_.number(bounds[1]) - corner[axis];
    }
    return corner;
  }

  // LAMMPS writes atoms in any order; they are sorted by their numbers.
  ParticleTable read_atoms(ParticleFrame& frame, std::size_t particles) {
    static const std::map<std::string_view, int> kNames = {{"id", kId},
                                                           {"x", kX},
                                                           {"y", kX + 1},
                                                           {"z", kX + 2},
                                                           {"vx", kVx},
                                                           {"vy", kVx + 1},
                                                           {"vz", kVx + 2},
                                                           {"ix", kImage},
                                                           {"iy", kImage + 1},
                                                           {"iz", kImage + 2},
                                                           {"omegax", kOmega},
                                                           {"omegay", kOmega + 1},
                                                           {"omegaz", kOmega + 2},
                                                           {"radius", kRadius},
                                                           {"diameter", kDiameter},
                                                           {"mass", kMass}};
    std::vector<int> columns;
    const Words words = lines_.words();
    for (std::size_t k = 2; k < words.size(); ++k) {
      const auto name = kNames.find(words[k]);
      columns.push_back(name == kNames.end() ? kIgnored : name->second);
    }
    const ParticleTable table(columns);
    table.require(lines_);
    std::vector<std::array<double, kRow>> rows;
    for (std::size_t i = 0; i < particles; ++i) {
      if (!lines_.next()) lines_.refuse_end();
      rows.push_back(table.row(lines_, lines_.words()));
    }
    std::ranges::stable_sort(rows, {}, [](const auto& row) { return row[kId]; });
    for (const auto& row : rows) table.add(frame, row);
    begun_ = false;
    return table;
  }

  Lines lines_;
  bool begun_ = false;  // whether a frame has begun
};

template <class Frames>
ParticleFrame frame_of(const std::filesystem::path& path, std::optional<std::size_t> wanted) {
  Frames frames(path);
  std::optional<ParticleFrame> last;
  for (std::size_t number = 0;; ++number) {
    std::optional<ParticleFrame> frame = frames.next();
    if (!frame && (wanted || !last)) refuse_frame(path, number);
    if (!frame) return *last;
    if (wanted == number) return *frame;
    last = std::move(frame);
  }
}

}  // namespace

ParticleFrame read_csv_frame(const std::filesystem::path& path, std::optional<std::size_t> wanted) {
  return frame_of<CsvFrames>(path, wanted);
}

ParticleFrame read_xyz_frame(const std::filesystem::path& path, std::optional<std::size_t> wanted) {
  return frame_of<XyzFrames>(path, wanted);
}

ParticleFrame read_dump_frame(const std::filesystem::path& path,
                              std::optional<std::size_t> wanted) {
  return frame_of<DumpFrames>(path, wanted);
}

}  // namespace clatter
