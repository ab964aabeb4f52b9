#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/results/particle_table.h"
#include "app/results/text_frames.h"
#include "engine/scene/text.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

constexpr int kType = kReal + 1;  // columns of data files alone
constexpr int kDensity = kReal + 2;

// The columns of the section Atoms, by atom style.
const std::map<std::string_view, std::vector<int>> kStyles = {
    {"atomic", {kId, kType, kX, kX + 1, kX + 2}},
    {"charge", {kId, kType, kReal, kX, kX + 1, kX + 2}},
    {"bond", {kId, kWhole, kType, kX, kX + 1, kX + 2}},
    {"angle", {kId, kWhole, kType, kX, kX + 1, kX + 2}},
    {"molecular", {kId, kWhole, kType, kX, kX + 1, kX + 2}},
    {"full", {kId, kWhole, kType, kReal, kX, kX + 1, kX + 2}},
    {"dipole", {kId, kType, kReal, kX, kX + 1, kX + 2, kReal, kReal, kReal}},
    {"sphere", {kId, kType, kDiameter, kDensity, kX, kX + 1, kX + 2}},
    {"bpm/sphere", {kId, kWhole, kType, kDiameter, kDensity, kX, kX + 1, kX + 2}}};

// Whether the particles depend on a section.
bool is_read(std::string_view section) {
  return section == "Atoms" || section == "Velocities" || section == "Masses" ||
         section == "Atom Type Labels";
}

// Whether a section belongs to molecules, to other bodies or to force fields.
bool is_skipped(std::string_view section) {
  static const std::set<std::string_view> kNames = {
      "Ellipsoids", "Lines", "Triangles", "Bodies", "Bonds", "Angles", "Dihedrals", "Impropers"};
  return kNames.contains(section) || section.ends_with(" Coeffs") ||
         (section.ends_with(" Type Labels") && !is_read(section));
}

// Whether a keyword of the header counts what these sections have.
bool is_other_count(std::string_view keyword) {
  static const std::set<std::string_view> kWords = {
      "bonds", "angles", "dihedrals", "impropers", "ellipsoids", "lines", "triangles", "bodies"};
  return kWords.contains(keyword) || keyword.ends_with(" types") || keyword.starts_with("extra ");
}

std::string joined(const LineWords& words, std::size_t begin) {
  std::string text;
  for (std::size_t k = begin; k < words.size(); ++k) {
    text += (k > begin ? " " : "") + std::string(words[k]);
  }
  return text;
}

class DataFile {
 public:
  DataFile(const std::filesystem::path& path, const FrameChoice& choice)
      : path_(path), choice_(choice), lines_(path) {}

  ParticleFrame read() {
    if (!lines_.next()) lines_.refuse("the file is empty", "give a data file of LAMMPS");
    read_header();
    while (more_) {
      const std::string section = joined(content_, 0);
      const std::string style = comment_;
      if (!is_read(section) && !is_skipped(section)) {
        lines_.refuse("unknown section " + in_quotes(section.substr(0, 40)),
                      "give the sections of a data file of LAMMPS");
      }
      lines_.require_next();
      if (!lines_.words().empty()) {
        lines_.refuse("this line is not blank",
                      "leave the line behind the name of a section blank");
      }
      if (section == "Atoms") {
        read_atoms(style);
      } else if (section == "Velocities") {
        read_velocities();
      } else if (section == "Masses") {
        read_types(masses_);
      } else if (section == "Atom Type Labels") {
        read_types(labels_);
      } else {
        skip_section();
        continue;
      }
      more_ = next_line();
    }
    return frame();
  }

 private:
  // Moves to the next line with content, which it separates from the comment; false at the end.
  bool next_line() {
    while (lines_.next()) {
      const std::string_view line = lines_.text();
      const std::size_t comment = std::min(line.find('#'), line.size());
      content_ = words_of(line.substr(0, comment));
      comment_ = joined(words_of(line.substr(std::min(comment + 1, line.size()))), 0);
      if (!content_.empty()) return true;
    }
    return false;
  }
  void require_line() {
    if (!next_line()) lines_.refuse_end();
  }

  // Reads lines of values and a keyword, up to the first line without values.
  void read_header() {
    while ((more_ = next_line())) {
      std::vector<double> values;
      for (const std::string_view word : content_) {
        if (!lines_.number_in(word)) break;
        values.push_back(lines_.real(word));
      }
      if (values.empty()) return;
      read_header_line(values, joined(content_, values.size()));
    }
  }

  void read_header_line(const std::vector<double>& values, const std::string& keyword) {
    static const std::map<std::string_view, int> kBounds = {
        {"xlo xhi", 0}, {"ylo yhi", 1}, {"zlo zhi", 2}};
    const auto require = [&](std::size_t count) {
      if (values.size() == count) return;
      lines_.refuse(keyword + " has " + counted(values.size(), "number") + " instead of " +
                        std::to_string(count),
                    "give them before the keyword");
    };
    if (const auto bounds = kBounds.find(keyword); bounds != kBounds.end()) {
      require(2);
      low_[bounds->second] = values[0];
      high_[bounds->second] = values[1];
    } else if (keyword == "xy xz yz") {
      require(3);
      tilts_ = values;
      tilt_line_ = lines_.number();
    } else if (keyword == "atoms" || keyword == "atom types" || is_other_count(keyword)) {
      require(1);
      if (keyword == "atoms") atoms_ = lines_.count(content_.front());
      if (keyword == "atom types") types_ = lines_.count(content_.front());
    } else {
      lines_.refuse("unknown line " + in_quotes(lines_.text().substr(0, 40)) + " in the header",
                    "give a data file of LAMMPS with xlo xhi, ylo yhi and zlo zhi");
    }
  }

  void skip_section() {
    while ((more_ = next_line())) {
      const std::string name = joined(content_, 0);
      if (is_read(name) || is_skipped(name)) return;
    }
  }

  // The number of an atom type, which may be given by its label.
  std::string type_of(std::string_view word) const {
    for (const auto& [number, label] : labels_) {
      if (label == word) return number;
    }
    const auto number = whole_number<std::size_t>(word);
    if (number && *number >= 1 && *number <= types_) return std::string(word);
    lines_.refuse(in_quotes(word.substr(0, 40)) + " is no atom type",
                  "give a number from 1 to " + std::to_string(types_));
  }

  // Reads a line for each atom type: its number and a word.
  void read_types(std::map<std::string, std::string>& words) {
    for (std::size_t k = 0; k < types_; ++k) {
      require_line();
      if (content_.size() != 2) lines_.refuse("this line has not two words", "give type and value");
      if (&words == &masses_) lines_.real(content_[1]);
      if (!words.emplace(type_of(content_[0]), content_[1]).second) {
        lines_.refuse("the atom type occurs twice", "give each type once");
      }
    }
  }

  void read_atoms(const std::string& style) {
    for (std::size_t i = 0; i < atoms_; ++i) {
      require_line();
      if (i == 0) columns_ = columns_of(style);
      read_atom();
    }
  }

  // The columns of a style, which the first line may follow by periodic images. Only the style
  // "atomic" has five columns.
  std::vector<int> columns_of(const std::string& style) const {
    const auto known = kStyles.find(style.empty() && content_.size() == 5 ? "atomic" : style);
    if (known == kStyles.end()) {
      std::string names;
      for (const auto& [name, ignored] : kStyles) names += ' ' + std::string(name);
      lines_.refuse(style.empty()
                        ? "the atom style is missing"
                        : "the atom style " + in_quotes(style.substr(0, 40)) + " is not read",
                    "write one behind the section, as in \"Atoms # sphere\":" + names);
    }
    std::vector<int> columns = known->second;
    const bool has_images = content_.size() == columns.size() + 3;
    for (int axis = 0; has_images && axis < 3; ++axis) columns.push_back(kImage + axis);
    return columns;
  }

  void read_atom() {
    std::vector<int> columns = columns_;
    std::ranges::replace_if(
        columns, [](int column) { return column > kReal; }, +kIgnored);
    ParticleTable::Row row = ParticleTable(columns).row(lines_, content_);
    std::string type;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (columns_[k] == kType) type = type_of(content_[k]);
      if (columns_[k] != kDensity) continue;
      const double diameter = row[kDiameter];
      row[kMass] =
          lines_.real(content_[k]) * std::numbers::pi / 6.0 * diameter * diameter * diameter;
    }
    place_of_.emplace(row[kId], rows_.size());
    rows_.push_back({row, lines_.number()});
    types_of_rows_.push_back(type);
  }

  void read_velocities() {
    has_velocities_ = true;
    std::vector<int> columns = {kId, kVx, kVx + 1, kVx + 2};
    for (int axis = 0; has_diameters() && axis < 3; ++axis) columns.push_back(kOmega + axis);
    const ParticleTable table(columns);
    std::set<double> seen;
    for (std::size_t i = 0; i < atoms_; ++i) {
      require_line();
      const ParticleTable::Row row = table.row(lines_, content_);
      const auto place = place_of_.find(row[kId]);
      if (place == place_of_.end()) {
        lines_.refuse("there is no atom " + number_text(row[kId]) + " before",
                      "give Velocities behind Atoms, for the same atoms");
      }
      if (!seen.insert(row[kId]).second) {
        lines_.refuse("the atom " + number_text(row[kId]) + " has two velocities", "remove one");
      }
      for (const int quantity : columns) rows_[place->second].row[quantity] = row[quantity];
    }
  }

  bool has_diameters() const { return std::ranges::find(columns_, +kDiameter) != columns_.end(); }

  ParticleFrame frame() {
    if (columns_.empty() && atoms_ > 0) {
      lines_.refuse("the section Atoms is missing", "give a data file with atoms");
    }
    ParticleFrame frame;
    frame.box.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      frame.box->lengths[axis] = high_[axis] - low_[axis];
      frame.box->periodic[axis] = true;  // the default of LAMMPS; the file does not say it
    }
    for (const double tilt : tilts_) {
      if (is_tilt(tilt, *frame.box)) refuse_tilt(path_, tilt_line_);
    }
    const ParticleTable table(columns_, derived_quantities());
    if (!has_diameters()) set_masses();
    if (choice_.needs_velocities && !has_velocities_) {
      lines_.refuse("the section Velocities is missing",
                    "give velocities, or draw them with --temperature");
    }
    add_sorted(frame, table, std::move(rows_), AllZero::NoNumbers, path_);
    frame.dimension = dimension_of(frame, choice_, path_);
    move_corner(frame, low_);
    return frame;
  }

  std::vector<int> derived_quantities() const {
    std::vector<int> derived;
    if (has_diameters() || !masses_.empty()) derived.push_back(kMass);
    for (int axis = 0; has_velocities_ && axis < 3; ++axis) {
      derived.push_back(kVx + axis);
      if (has_diameters()) derived.push_back(kOmega + axis);
    }
    return derived;
  }

  void set_masses() {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const auto mass = masses_.find(types_of_rows_[i]);
      if (mass != masses_.end()) rows_[i].row[kMass] = lines_.real(mass->second);
    }
  }

  std::filesystem::path path_;
  FrameChoice choice_;
  TextLines lines_;
  LineWords content_;    // of the present line
  std::string comment_;  // behind #
  bool more_ = false;    // whether there is a present line
  ParticleFrame::Vector low_ = {-0.5, -0.5, -0.5}, high_ = {0.5, 0.5, 0.5};
  std::vector<double> tilts_;
  int tilt_line_ = 0;
  std::size_t atoms_ = 0, types_ = 0;
  std::vector<int> columns_;                            // of the section Atoms
  std::vector<ParticleLine> rows_;                      // [N]
  std::vector<std::string> types_of_rows_;              // [N]
  std::map<double, std::size_t> place_of_;              // row of an atom
  std::map<std::string, std::string> masses_, labels_;  // by type
  bool has_velocities_ = false;
};

}  // namespace

ParticleFrame read_data_file(const std::filesystem::path& path, const FrameChoice& choice) {
  if (choice.frame.value_or(0) > 0) refuse_frame(path, 1);
  return DataFile(path, choice).read();
}

}  // namespace clatter
