#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
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

// Columns of data files alone: a number of a type or its label, and a density.
constexpr int kTypeOrLabel = kReal + 1;
constexpr int kDensity = kReal + 2;

// The columns of the section Atoms, by atom style.
const std::map<std::string_view, std::vector<int>> kStyles = {
    {"atomic", {kId, kTypeOrLabel, kX, kX + 1, kX + 2}},
    {"charge", {kId, kTypeOrLabel, kReal, kX, kX + 1, kX + 2}},
    {"bond", {kId, kWhole, kTypeOrLabel, kX, kX + 1, kX + 2}},
    {"angle", {kId, kWhole, kTypeOrLabel, kX, kX + 1, kX + 2}},
    {"molecular", {kId, kWhole, kTypeOrLabel, kX, kX + 1, kX + 2}},
    {"full", {kId, kWhole, kTypeOrLabel, kReal, kX, kX + 1, kX + 2}},
    {"dipole", {kId, kTypeOrLabel, kReal, kX, kX + 1, kX + 2, kReal, kReal, kReal}},
    {"sphere", {kId, kTypeOrLabel, kDiameter, kDensity, kX, kX + 1, kX + 2}},
    {"bpm/sphere", {kId, kWhole, kTypeOrLabel, kDiameter, kDensity, kX, kX + 1, kX + 2}}};

// Whether the particles depend on a section.
bool is_read(const std::string& section) {
  return section == "Atoms" || section == "Velocities" || section == "Masses" ||
         section == "Atom Type Labels";
}

// The keyword in the header that counts the rows of a skipped section: one of molecules, of other
// bodies or of force fields. Empty: the section is no such one.
std::string_view count_of(const std::string& section) {
  static const std::map<std::string_view, std::string_view> kCounts = {
      {"Bonds", "bonds"},
      {"Angles", "angles"},
      {"Dihedrals", "dihedrals"},
      {"Impropers", "impropers"},
      {"Ellipsoids", "ellipsoids"},
      {"Lines", "lines"},
      {"Triangles", "triangles"},
      {"Bodies", "bodies"},
      {"Pair Coeffs", "atom types"},
      {"PairIJ Coeffs", "atom types"},
      {"Bond Coeffs", "bond types"},
      {"Angle Coeffs", "angle types"},
      {"BondBond Coeffs", "angle types"},
      {"BondAngle Coeffs", "angle types"},
      {"Dihedral Coeffs", "dihedral types"},
      {"MiddleBondTorsion Coeffs", "dihedral types"},
      {"EndBondTorsion Coeffs", "dihedral types"},
      {"AngleTorsion Coeffs", "dihedral types"},
      {"AngleAngleTorsion Coeffs", "dihedral types"},
      {"BondBond13 Coeffs", "dihedral types"},
      {"Improper Coeffs", "improper types"},
      {"AngleAngle Coeffs", "improper types"},
      {"Bond Type Labels", "bond types"},
      {"Angle Type Labels", "angle types"},
      {"Dihedral Type Labels", "dihedral types"},
      {"Improper Type Labels", "improper types"}};
  const auto found = kCounts.find(section);
  return found == kCounts.end() ? "" : found->second;
}

// Whether the rows of a skipped section have numbers only, apart from labels of their types.
bool has_numbers(const std::string& section) {
  return !section.ends_with(" Coeffs") && !section.ends_with(" Labels");
}

// Whether a keyword of the header counts things.
bool is_count(std::string_view keyword) {
  static const std::set<std::string_view> kWords = {"atoms",
                                                    "bonds",
                                                    "angles",
                                                    "dihedrals",
                                                    "impropers",
                                                    "ellipsoids",
                                                    "lines",
                                                    "triangles",
                                                    "bodies",
                                                    "atom types",
                                                    "bond types",
                                                    "angle types",
                                                    "dihedral types",
                                                    "improper types",
                                                    "extra bond per atom",
                                                    "extra angle per atom",
                                                    "extra dihedral per atom",
                                                    "extra improper per atom",
                                                    "extra special per atom"};
  return kWords.contains(keyword);
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
      if (!is_read(section) && count_of(section).empty()) {
        lines_.refuse("unknown section " + quoted_start(section),
                      "give the sections of a data file of LAMMPS");
      }
      if (!lines_.next()) refuse_end();
      if (!lines_.words().empty()) {
        lines_.refuse("this line is not blank",
                      "leave the line behind the name of a section blank");
      }
      read_section(section, style);
      more_ = next_line();
    }
    return frame();
  }

 private:
  void read_section(const std::string& section, const std::string& style) {
    if (section == "Atoms") {
      read_atoms(style);
    } else if (section == "Velocities") {
      read_velocities();
    } else if (section == "Masses") {
      read_masses();
    } else if (section == "Atom Type Labels") {
      read_labels();
    } else if (section == "Bodies") {
      skip_bodies();
    } else {
      skip_section(section);
    }
  }

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
    if (!next_line()) refuse_end();
  }
  [[noreturn]] void refuse_end() const {
    lines_.refuse("the file ends within a section", "give a complete file");
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
      bound_lines_[bounds->second] = lines_.number();
      low_[bounds->second] = values[0];
      high_[bounds->second] = values[1];
    } else if (keyword == "xy xz yz") {
      require(3);
      tilts_ = values;
      tilt_line_ = lines_.number();
    } else if (is_count(keyword)) {
      require(1);
      counts_[keyword] = keyword == "atoms" ? lines_.count(content_.front())
                                            : number_of(content_.front(), keyword);
    } else {
      lines_.refuse("unknown line " + quoted_start(lines_.text()) + " in the header",
                    "give a data file of LAMMPS with xlo xhi, ylo yhi and zlo zhi");
    }
  }

  std::size_t number_of(std::string_view word, const std::string& things) const {
    if (const auto number = whole_number<std::uint32_t>(word)) return *number;
    lines_.refuse(quoted_start(word) + " is no number of " + things, "give a whole number");
  }

  // The number of things in the header; 0: the header does not have it.
  std::size_t count(std::string_view things) const {
    const auto found = counts_.find(things);
    return found == counts_.end() ? 0 : found->second;
  }

  void skip_section(const std::string& section) {
    std::size_t rows = count(count_of(section));
    if (section == "PairIJ Coeffs") rows = rows * (rows + 1) / 2;
    for (std::size_t k = 0; k < rows; ++k) {
      require_line();
      const std::string name = joined(content_, 0);
      if (content_.size() < 2 || is_read(name) || !count_of(name).empty()) {
        lines_.refuse("this line is no row of the section " + section,
                      "give " + counted(rows, "row"));
      }
      if (has_numbers(section)) require_numbers(section);
    }
  }

  // Throws unless the present line has numbers, apart from a label of its type.
  void require_numbers(const std::string& section) const {
    for (std::size_t k = 0; k < content_.size(); ++k) {
      if (k == 1 || lines_.number_in(content_[k])) continue;
      lines_.refuse(quoted_start(content_[k]) + " is no number",
                    "give the rows of the section " + section);
    }
  }

  // A body has a line with its number and two numbers of values, which are in the next lines.
  void skip_bodies() {
    for (std::size_t k = 0; k < count("bodies"); ++k) {
      require_line();
      if (content_.size() != 4) lines_.refuse("this line has not four words", "give a body");
      std::size_t rest = number_of(content_[2], "values") + number_of(content_[3], "values");
      while (rest > 0) {
        require_line();
        if (content_.size() > rest) lines_.refuse("a body has too many values", "remove some");
        for (const std::string_view word : content_) lines_.real(word);
        rest -= content_.size();
      }
    }
  }

  // The number of an atom type, which may be given by its label.
  std::size_t type_of(std::string_view word) const {
    if (const auto label = labels_.find(std::string(word)); label != labels_.end()) {
      return label->second;
    }
    return numbered_type(word);
  }

  std::size_t numbered_type(std::string_view word) const {
    const std::size_t types = count("atom types");
    const auto number = whole_number<std::size_t>(word);
    if (number && *number >= 1 && *number <= types) return *number;
    if (types == 0) {
      lines_.refuse("the header does not say the number of atom types",
                    "write, say, \"1 atom types\" in the header");
    }
    lines_.refuse(quoted_start(word) + " is no atom type",
                  "give a number from 1 to " + std::to_string(types));
  }

  // Reads a line of an atom type and its value.
  void require_pair() {
    require_line();
    if (content_.size() != 2) lines_.refuse("this line has not two words", "give type and value");
  }

  void read_masses() {
    for (std::size_t k = 0; k < count("atom types"); ++k) {
      require_pair();
      if (!masses_.emplace(type_of(content_[0]), lines_.real(content_[1])).second) {
        lines_.refuse("the atom type occurs twice", "give each type once");
      }
    }
  }

  void read_labels() {
    std::set<std::size_t> types;
    for (std::size_t k = 0; k < count("atom types"); ++k) {
      require_pair();
      const std::size_t type = numbered_type(content_[0]);
      if (!types.insert(type).second || !labels_.emplace(content_[1], type).second) {
        lines_.refuse("the atom type occurs twice", "give each type one label");
      }
    }
  }

  void read_atoms(const std::string& style) {
    for (std::size_t i = 0; i < count("atoms"); ++i) {
      require_line();
      if (i == 0) set_columns(columns_of(style));
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
      lines_.refuse(style.empty() ? "the atom style is missing"
                                  : "the atom style " + quoted_start(style) + " is not read",
                    "write one behind the section, as in \"Atoms # sphere\":" + names);
    }
    std::vector<int> columns = known->second;
    const bool has_images = content_.size() == columns.size() + 3;
    for (int axis = 0; has_images && axis < 3; ++axis) columns.push_back(kImage + axis);
    return columns;
  }

  // Types and densities are read apart from the table.
  void set_columns(const std::vector<int>& columns) {
    columns_ = columns;
    std::vector<int> others = columns;
    std::ranges::replace_if(
        others, [](int column) { return column > kReal; }, +kIgnored);
    table_ = ParticleTable(others);
  }

  void read_atom() {
    ParticleTable::Row row = table_.row(lines_, content_);
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const bool is_image = columns_[k] >= kImage && columns_[k] < kImage + 3;
      if (is_image && !whole_number<long long>(content_[k])) {
        lines_.refuse(quoted_start(content_[k]) + " is no periodic image", "give whole numbers");
      }
      if (columns_[k] == kTypeOrLabel) row[kType] = static_cast<double>(type_of(content_[k]));
      if (columns_[k] != kDensity) continue;
      const double diameter = row[kDiameter];
      row[kMass] =
          lines_.real(content_[k]) * std::numbers::pi / 6.0 * diameter * diameter * diameter;
    }
    place_of_.emplace(row[kId], rows_.size());
    rows_.push_back({row, lines_.number()});
  }

  void read_velocities() {
    has_velocities_ = true;
    std::vector<int> columns = {kId, kVx, kVx + 1, kVx + 2};
    for (int axis = 0; has_diameters() && axis < 3; ++axis) columns.push_back(kOmega + axis);
    const ParticleTable table(columns);
    std::set<double> seen;
    for (std::size_t i = 0; i < count("atoms"); ++i) {
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
    if (columns_.empty() && count("atoms") > 0) {
      lines_.refuse("the section Atoms is missing", "give a data file with atoms");
    }
    ParticleFrame frame;
    frame.box.emplace();
    frame.box->lines = bound_lines_;
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
    std::map<int, std::string> names;
    for (const auto& [label, type] : labels_) names[static_cast<int>(type)] = label;
    name_types(frame, names);
    frame.dimension = dimension_of(frame, choice_, path_);
    move_corner(frame, low_);
    return frame;
  }

  std::vector<int> derived_quantities() const {
    std::vector<int> derived = {kType};
    if (has_diameters() || !masses_.empty()) derived.push_back(kMass);
    for (int axis = 0; has_velocities_ && axis < 3; ++axis) {
      derived.push_back(kVx + axis);
      if (has_diameters()) derived.push_back(kOmega + axis);
    }
    return derived;
  }

  void set_masses() {
    for (auto& [row, line] : rows_) {
      const auto mass = masses_.find(static_cast<std::size_t>(row[kType]));
      if (mass != masses_.end()) row[kMass] = mass->second;
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
  std::array<int, 3> bound_lines_ = {};                     // of the edges of the box; 0: none
  std::map<std::string, std::size_t, std::less<>> counts_;  // in the header, by keyword
  std::vector<int> columns_;                                // of the section Atoms
  ParticleTable table_;                                     // of the section Atoms
  std::vector<ParticleLine> rows_;                          // [N]
  std::map<double, std::size_t> place_of_;                  // row of an atom
  std::map<std::size_t, double> masses_;                    // by atom type
  std::map<std::string, std::size_t> labels_;               // atom type of a label
  bool has_velocities_ = false;
};

}  // namespace

ParticleFrame read_data_file(const std::filesystem::path& path, const FrameChoice& choice) {
  if (choice.frame.value_or(0) > 0) refuse_frame(path, 1);
  return DataFile(path, choice).read();
}

}  // namespace clatter
