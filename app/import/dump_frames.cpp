#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/import/particle_table.h"
#include "app/import/text_frames.h"
#include "engine/text.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

class DumpFrames {
 public:
  DumpFrames(const std::filesystem::path& path, const FrameChoice& choice)
      : path_(path), choice_(choice), lines_(path) {}

  std::optional<ParticleFrame> next() {
    ParticleFrame frame;
    ParticleFrame::Vector corner = {};
    std::optional<std::size_t> particles;
    std::set<std::string> items;
    while (lines_.next()) {
      if (items.empty() && lines_.words().empty()) continue;
      const std::string item = item_of_line();
      const std::string kind = item.starts_with("BOX BOUNDS ") ? "BOX BOUNDS" : item;
      if (!items.insert(kind).second) {
        lines_.refuse("the frame has a second " + quoted_start("ITEM: " + kind),
                      "give each item once in a frame");
      }
      if (item == "TIMESTEP") {
        frame.number = next_step();
      } else if (item == "TIME") {
        frame.time = lines_.real(next_word());
      } else if (item == "UNITS") {
        lines_.require_next();
      } else if (item == "NUMBER OF ATOMS" && items.contains("TIMESTEP")) {
        particles = lines_.count(next_word());
      } else if (item.starts_with("BOX BOUNDS ")) {
        corner = read_box(frame);
      } else if (item.starts_with("ATOMS ") && items.contains("TIMESTEP") && particles &&
                 frame.box) {
        read_atoms(frame, corner, *particles);
        return frame;
      } else {
        lines_.refuse(
            "unexpected line " + quoted_start(lines_.text()),
            "give a text dump of LAMMPS with time step, number of atoms and box before the atoms");
      }
    }
    if (!items.empty()) lines_.refuse_end();
    return std::nullopt;
  }

 private:
  // The words behind ITEM: in the line, with a blank behind names of lists; empty: none.
  std::string item_of_line() const {
    const LineWords words = lines_.words();
    if (words.empty() || words.front() != "ITEM:") return "";
    std::string item;
    for (std::size_t k = 1; k < words.size(); ++k)
      item += (k > 1 ? " " : "") + std::string(words[k]);
    return item == "BOX BOUNDS" || item == "ATOMS" ? item + ' ' : item;
  }

  // The only word of the next line.
  std::string_view next_word() {
    lines_.require_next();
    const LineWords words = lines_.words();
    if (words.size() != 1) {
      lines_.refuse("this line has " + counted(words.size(), "word") + " instead of a number",
                    "give one number");
    }
    return words.front();
  }

  long next_step() {
    const std::string_view word = next_word();
    const auto step = whole_number<long>(word);
    if (step && *step >= 0) return *step;
    lines_.refuse(quoted_start(word) + " is no number of a time step", "give a whole number");
  }

  // Reads the box in one of its three forms. Returns its lower corner.
  ParticleFrame::Vector read_box(ParticleFrame& frame) {
    LineWords words = lines_.words();
    words.erase(words.begin(), words.begin() + 3);  // ITEM: BOX BOUNDS
    const auto begins = [&](const LineWords& names) {
      return words.size() >= names.size() && std::equal(names.begin(), names.end(), words.begin());
    };
    const bool tilted = begins({"xy", "xz", "yz"}), general = begins({"abc", "origin"});
    words.erase(words.begin(), words.begin() + (tilted ? 3 : general ? 2 : 0));
    frame.box.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      frame.box->periodic[axis] = is_periodic(words, axis);
    }
    std::array<std::vector<double>, 3> rows;
    ParticleFrame::Vector corner = {};
    std::vector<double> across;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rows[axis] = next_numbers(general ? 4 : tilted ? 3 : 2);
      frame.box->lines[axis] = lines_.number();
      corner[axis] = rows[axis][general ? 3 : 0];
      frame.box->lengths[axis] = general ? rows[axis][axis] : rows[axis][1] - rows[axis][0];
      if (tilted) across.push_back(rows[axis][2]);
      for (std::size_t other = 0; general && other < 3; ++other) {
        if (other != axis) across.push_back(rows[axis][other]);
      }
    }
    for (const double component : across) {
      if (is_tilt(component, *frame.box)) refuse_tilt(path_, lines_.number());
    }
    return corner;
  }

  // Whether the boundaries of an axis are periodic: two letters, of the lower and the upper side.
  bool is_periodic(const LineWords& words, std::size_t axis) const {
    if (words.size() != 3) {
      lines_.refuse("the kinds of boundaries are missing",
                    "write, say, pp pp ff at the end of this line");
    }
    const std::string_view word = words[axis];
    if (word == "pp") return true;
    const auto is_wall = [](char side) { return side == 'f' || side == 's' || side == 'm'; };
    if (word.size() == 2 && is_wall(word[0]) && is_wall(word[1])) return false;
    lines_.refuse(quoted_start(word) + " is no kind of boundaries",
                  "write pp for a periodic axis, and ff for walls");
  }

  std::vector<double> next_numbers(std::size_t count) {
    lines_.require_next();
    const LineWords words = lines_.words();
    if (words.size() != count) {
      lines_.refuse("this line has " + counted(words.size(), "word") + " instead of " +
                        std::to_string(count) + " numbers of the box",
                    "give both bounds, and the tilt if the header names it");
    }
    std::vector<double> numbers;
    for (const std::string_view word : words) numbers.push_back(lines_.real(word));
    return numbers;
  }

  std::vector<int> columns() const {
    static const std::map<std::string_view, int> kVectors = {{"x", kX},
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
                                                             {"xs", kScaled},
                                                             {"ys", kScaled + 1},
                                                             {"zs", kScaled + 2},
                                                             {"xu", kUnwrapped},
                                                             {"yu", kUnwrapped + 1},
                                                             {"zu", kUnwrapped + 2},
                                                             {"xsu", kScaledUnwrapped},
                                                             {"ysu", kScaledUnwrapped + 1},
                                                             {"zsu", kScaledUnwrapped + 2},
                                                             {"id", kId},
                                                             {"radius", kRadius},
                                                             {"diameter", kDiameter},
                                                             {"mass", kMass},
                                                             {"type", kType},
                                                             {"mol", kWhole},
                                                             {"proc", kWhole},
                                                             {"procp1", kWhole}};
    std::vector<int> columns;
    const LineWords words = lines_.words();
    for (std::size_t k = 2; k < words.size(); ++k) {  // behind ITEM: ATOMS
      const auto name = kVectors.find(words[k]);
      columns.push_back(name == kVectors.end() ? kIgnored : name->second);
    }
    return columns;
  }

  // LAMMPS writes atoms in any order; they are sorted by their numbers.
  void read_atoms(ParticleFrame& frame, const ParticleFrame::Vector& corner,
                  std::size_t particles) {
    const LineWords words = lines_.words();
    const ParticleTable table(columns(), {}, {words.begin() + 2, words.end()});
    const int header = lines_.number();
    table.require_state(lines_, choice_, "give the columns vx and vy");
    std::vector<ParticleLine> atoms;
    for (std::size_t i = 0; i < particles; ++i) {
      lines_.require_next();
      ParticleTable::Row row = table.row(lines_, lines_.words());
      for (int axis = 0; axis < 3; ++axis) place(table, row, axis, *frame.box, corner[axis]);
      atoms.push_back({row, lines_.number()});
    }
    add_sorted(frame, table, std::move(atoms), AllZero::NoNumbers, path_);
    name_types(frame);
    frame.dimension = dimension_of(frame, choice_, path_);
    if (frame.dimension == 3) table.require_spheres(lines_, header);
    move_corner(frame, corner);
  }

  // Sets position and periodic image along an axis from the columns that the dump has. Unwrapped
  // positions contain the image.
  void place(const ParticleTable& table, ParticleTable::Row& row, int axis, const ParticleBox& box,
             double low) const {
    const double length = box.lengths[axis];
    const std::optional<double> inside = position(table, row, kX, kScaled, axis, length, low);
    const std::optional<double> beyond =
        position(table, row, kUnwrapped, kScaledUnwrapped, axis, length, low);
    double& image = row[kImage + axis];
    row[kX + axis] = inside.value_or(beyond.value_or(0.0));
    if (!inside) image = 0.0;
    if (!inside || !beyond) return;
    if (!box.periodic[axis]) {
      image = 0.0;
    } else if (!table.has(kImage + axis)) {
      image = length > 0.0 ? std::round((*beyond - *inside) / length) : 0.0;
    }
    require_fit(*inside + image * length, *beyond, axis, length);
  }

  // The position in one of two columns, of which the second is in edges of the box.
  std::optional<double> position(const ParticleTable& table, const ParticleTable::Row& row,
                                 int quantity, int scaled, int axis, double length,
                                 double low) const {
    const double from_scaled = low + row[scaled + axis] * length;
    if (!table.has(quantity + axis)) {
      return table.has(scaled + axis) ? std::optional(from_scaled) : std::nullopt;
    }
    if (table.has(scaled + axis)) require_fit(row[quantity + axis], from_scaled, axis, length);
    return row[quantity + axis];
  }

  // Throws if two positions of a particle differ by more than the digits of LAMMPS.
  void require_fit(double one, double other, int axis, double length) const {
    constexpr double kSixDigits = 1e-5;
    const double size = std::fabs(one) + std::fabs(other) + std::fabs(length);
    if (std::fabs(one - other) <= kSixDigits * size) return;
    lines_.refuse(std::string("the positions along ") + "xyz"[axis] +
                      " contradict each other: " + number_text(one) + " and " + number_text(other),
                  "remove the columns of one of them");
  }

  std::filesystem::path path_;
  FrameChoice choice_;
  TextLines lines_;
};

}  // namespace

ParticleFrame read_dump_frame(const std::filesystem::path& path, const FrameChoice& choice) {
  return chosen_frame(DumpFrames(path, choice), path, choice);
}

}  // namespace clatter
