#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/import/particle_table.h"
#include "app/import/text_frames.h"
#include "app/import/xyz_head.h"
#include "engine/laws/limits.h"
#include "engine/text.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

// A property of extended XYZ: NAME:TYPE:COLUMNS.
struct XyzProperty {
  std::string name;
  char type;  // S, I, R or L
  int columns;
  int quantity;  // kIgnored: no quantity of a particle
};

// The quantities of properties, whose names have any case.
int quantity_of(const std::string& name) {
  static const std::map<std::string, int> kNames = {
      {"pos", kX},        {"velo", kVx},           {"vel", kVx},
      {"velocity", kVx},  {"velocities", kVx},     {"momenta", kMomentum},
      {"omega", kOmega},  {"map_shift", kImage},   {"radius", kRadius},
      {"radii", kRadius}, {"diameter", kDiameter}, {"diameters", kDiameter},
      {"mass", kMass},    {"masses", kMass},       {"type", kType}};
  std::string lower = name;
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto found = kNames.find(lower);
  return found == kNames.end() ? kIgnored : found->second;
}

constexpr int kMostColumns = 1'000'000;  // of a line; descriptors have hundreds

// The number of columns of a property. Quantities that are not read may have any.
int width_of(const TextLines& lines, int quantity, const std::string& property,
             const std::string& word) {
  const int columns = whole_number<int>(word).value_or(0);
  if (quantity == kIgnored) {
    if (columns >= 1) return columns;
    lines.refuse(property + " has no positive number of columns",
                 "give at most " + std::to_string(kMostColumns));
  }
  if (columns == (quantity >= kRadius ? 1 : 3)) return columns;
  lines.refuse(property + " has a wrong width", "give vectors three columns, and numbers one");
}

std::vector<XyzProperty> properties_of(const TextLines& lines, const XyzHead& head) {
  std::vector<std::string> parts;
  const std::string text = head.has("properties") ? head.text("properties") : "species:S:1:pos:R:3";
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  if (parts.size() % 3 != 0) {
    lines.refuse("the properties are no triples NAME:TYPE:COLUMNS",
                 "write, say, Properties=species:S:1:pos:R:3:velo:R:3");
  }
  std::vector<XyzProperty> properties;
  std::set<std::string> names;
  int all_columns = 0;
  for (std::size_t k = 0; k < parts.size(); k += 3) {
    const std::string& name = parts[k];
    const std::string said = "the property " + quoted_start(name);
    const std::string& type = parts[k + 1];
    int quantity = quantity_of(name);
    if (quantity == kType && type != "I") quantity = kIgnored;  // names of types
    if (name.empty()) lines.refuse("a property has no name", "write NAME:TYPE:COLUMNS");
    const int columns = width_of(lines, quantity, said, parts[k + 2]);
    if (columns > kMostColumns - all_columns) {
      lines.refuse("the properties have more than " + std::to_string(kMostColumns) + " columns",
                   "remove some of them");
    }
    all_columns += columns;
    if (type.size() != 1 || std::string("SIRL").find(type) == std::string::npos) {
      lines.refuse(said + " has the type " + quoted_start(type), "give S, I, R or L");
    }
    if (quantity != kIgnored && type != "R" && type != "I") {
      lines.refuse(said + " has the type " + type, "give R for numbers");
    }
    if (!names.insert(name).second) lines.refuse(said + " occurs twice", "remove one of them");
    properties.push_back({name, type.front(), columns, quantity});
  }
  return properties;
}

class XyzFrames {
 public:
  XyzFrames(const std::filesystem::path& path, const FrameChoice& choice)
      : path_(path), choice_(choice), lines_(path, TextLines::Exponents::Fortran) {}

  std::optional<ParticleFrame> next() {
    do {
      if (!lines_.next()) return std::nullopt;
    } while (lines_.words().empty());
    if (lines_.words().size() > 1) {
      lines_.refuse("this line has more than the number of particles",
                    "give a frame of extended XYZ");
    }
    const std::size_t particles = lines_.count(lines_.words().front());
    lines_.require_next();
    const XyzHead head(lines_);
    ParticleFrame frame;
    frame.number = frames_++;
    const ParticleFrame::Vector corner = read_head(head, frame);
    properties_ = properties_of(lines_, head);
    const ParticleTable table = table_of_properties();
    for (std::size_t i = 0; i < particles; ++i) {
      lines_.require_next();
      table.add(frame, row(table), lines_.number());
      if (!table.has(kType)) add_symbol(frame);
    }
    set_names(head, table, frame);
    frame.dimension = dimension_of(frame, choice_, path_);
    move_corner(frame, corner);
    return frame;
  }

 private:
  // Reads time and box. Returns the lower corner of the box.
  ParticleFrame::Vector read_head(const XyzHead& head, ParticleFrame& frame) const {
    if (head.has("time")) frame.time = head.numbers("time", 1).front();
    if (!head.has("lattice")) {
      lines_.refuse("the box is missing", "give Lattice=\"...\" nine numbers");
    }
    const std::vector<double> lattice = head.numbers("lattice", 9);
    frame.box.emplace();
    for (std::size_t k = 0; k < 9; ++k) {
      if (k % 4 == 0) frame.box->lengths[k / 4] = lattice[k];
    }
    frame.box->lines.fill(lines_.number());
    for (std::size_t k = 0; k < 9; ++k) {
      if (k % 4 != 0 && is_tilt(lattice[k], *frame.box)) refuse_tilt(path_, lines_.number());
    }
    frame.box->periodic = {true, true, true};  // without the key
    if (head.has("pbc")) frame.box->periodic = head.truths("pbc");
    if (!head.has("origin")) return {};
    const std::vector<double> origin = head.numbers("origin", 3);
    return {origin[0], origin[1], origin[2]};
  }

  ParticleTable table_of_properties() const {
    std::vector<int> columns;
    std::vector<std::string> names;
    for (const XyzProperty& property : properties_) {
      for (int c = 0; c < property.columns; ++c) {
        columns.push_back(property.quantity == kIgnored ? kIgnored : property.quantity + c);
        names.push_back(property.name);
      }
    }
    const auto has = [&](int quantity) {
      return std::ranges::find(columns, quantity) != columns.end();
    };
    if (has(kVx) && has(kMomentum)) {
      lines_.refuse("there are velocities and momenta", "remove one of them");
    }
    const std::vector<int> derived =
        has(kMomentum) ? std::vector<int>{kVx, kVx + 1, kVx + 2} : std::vector<int>();
    const ParticleTable table(columns, derived, names);
    table.require_state(lines_, choice_, "give the property velo, vel, velocities or momenta");
    return table;
  }

  // Adds the type of the particle of the present line: its symbol.
  void add_symbol(ParticleFrame& frame) const {
    const std::optional<std::size_t> column = symbol_column();
    if (!column || frame.names.size() > kMaxSpecies) return;
    frame.types.push_back(type_of_name(frame.names, lines_.words()[*column]));
  }

  // The names of types are those of the file, or the symbols. A single symbol, or very many, are no
  // types.
  void set_names(const XyzHead& head, const ParticleTable& table, ParticleFrame& frame) const {
    if (!table.has(kType)) {
      if (frame.names.size() > 1 && frame.names.size() <= kMaxSpecies) return;
      frame.types.clear();
      frame.names.clear();
      return;
    }
    std::map<int, std::string> names;
    for (const std::string& name : head.words("type_names")) {
      names.emplace(static_cast<int>(names.size()) + 1, name);
    }
    frame.mixture = head.has("type_names");
    name_types(frame, names);
  }

  // The column of symbols; absent: there is none.
  std::optional<std::size_t> symbol_column() const {
    std::size_t column = 0;
    for (const XyzProperty& property : properties_) {
      if (property.name == "species") return column;
      column += static_cast<std::size_t>(property.columns);
    }
    return std::nullopt;
  }

  // The values of the present line. Velocities follow from momenta and masses.
  ParticleTable::Row row(const ParticleTable& table) const {
    const LineWords words = lines_.words();
    ParticleTable::Row row = table.row(lines_, words);
    require_types(words);
    if (!table.has(kMomentum)) return row;
    const double mass = table.has(kMass) ? row[kMass] : mass_of_species(words);
    for (int axis = 0; axis < 3; ++axis) row[kVx + axis] = row[kMomentum + axis] / mass;
    return row;
  }

  // ASE writes no masses of elements. Its X, which is no element, has the mass 1.
  double mass_of_species(const LineWords& words) const {
    const std::optional<std::size_t> column = symbol_column();
    if (column && words[*column] == "X") return 1.0;
    lines_.refuse("momenta need masses", "give the property masses, or velocities");
  }

  void require_types(const LineWords& words) const {
    std::size_t column = 0;
    for (const XyzProperty& property : properties_) {
      for (int c = 0; c < property.columns; ++c) {
        const std::string_view word = words[column++];
        if (has_type(word, property.type)) continue;
        lines_.refuse(quoted_start(word) + " is not of the type " + property.type +
                          " of the property " + quoted_start(property.name),
                      "write a number of this type, or change the type");
      }
    }
  }

  bool has_type(std::string_view word, char type) const {
    static const std::set<std::string_view> kTruths = {"T",    "F",     "True", "False",
                                                       "true", "false", "TRUE", "FALSE"};
    if (type == 'L') return kTruths.contains(word);
    if (type == 'R') return lines_.number_in(word).has_value();
    return type == 'S' || signed_number<long long>(word).has_value();
  }

  std::filesystem::path path_;
  FrameChoice choice_;
  TextLines lines_;
  std::vector<XyzProperty> properties_;  // of the present frame
  long frames_ = 0;
};

}  // namespace

ParticleFrame read_xyz_frame(const std::filesystem::path& path, const FrameChoice& choice) {
  return chosen_frame(XyzFrames(path, choice), path, choice);
}

}  // namespace clatter
