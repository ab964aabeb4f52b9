#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/import/particle_table.h"
#include "app/import/text_frames.h"
#include "engine/laws/limits.h"
#include "engine/scene/csv_line.h"
#include "engine/text.h"

namespace clatter {

namespace {

// The frames of a CSV. A frame ends where the time changes.
class CsvFrames {
 public:
  CsvFrames(const std::filesystem::path& path, const FrameChoice& choice)
      : path_(path), choice_(choice), lines_(path) {
    if (!next_line()) lines_.refuse("the file has no header line", "name the columns in a header");
    const LineWords names = cells();
    const std::vector<int> all = columns();
    const auto species = std::ranges::find(all, +kName);
    if (species != all.end()) species_ = static_cast<std::size_t>(species - all.begin());
    if (std::ranges::count(all, +kName) > 1) {
      lines_.refuse("two columns are species", "remove one of them");
    }
    const std::vector<int> derived = species_ ? std::vector<int>{kType} : std::vector<int>();
    table_ = ParticleTable(all, derived, {names.begin(), names.end()});
    table_.require_state(lines_, choice_, "give the columns vx and vy");
    if (is_spatial()) table_.require_spheres(lines_, lines_.number());
    if (choice_.dimension && *choice_.dimension != (is_spatial() ? 3 : 2)) {
      lines_.refuse(std::string("these are columns of ") + (is_spatial() ? "spheres" : "disks"),
                    "omit --dimensions");
    }
    more_ = next_line();
  }

  std::optional<ParticleFrame> next() {
    if (!more_ && (frames_ > 0 || table_.has(kTime))) return std::nullopt;
    ParticleFrame frame;
    frame.dimension = is_spatial() ? 3 : 2;
    frame.number = static_cast<long>(frames_++);
    frame.mixture = species_.has_value();
    std::vector<ParticleLine> particles;
    for (; more_; more_ = next_line()) {
      const ParticleTable::Row row = next_row(frame);
      if (!particles.empty() && row[kTime] != frame.time) {
        require_later(row[kTime], frame.time);
        break;
      }
      frame.time = row[kTime];
      particles.push_back({row, lines_.number()});
    }
    if (frames_ == 1) particles_ = particles.size();
    if (particles.size() < particles_ && !more_) lines_.refuse_end();
    if (particles.size() != particles_) {
      lines_.refuse("the frame at time " + number_text(frame.time) + " has " +
                        std::to_string(particles.size()) + " particles instead of " +
                        std::to_string(particles_),
                    "give all frames the same particles");
    }
    add_sorted(frame, table_, std::move(particles), AllZero::Numbers, path_);
    return frame;
  }

 private:
  bool is_spatial() const { return table_.has(kX + 2) || table_.has(kVx + 2); }

  // The values of the present line. Names of species have numbers in the order of their occurrence.
  ParticleTable::Row next_row(ParticleFrame& frame) const {
    const LineWords words = cells();
    ParticleTable::Row row = table_.row(lines_, words);
    if (row[kTilt] != 0.0) refuse_tilt(path_, lines_.number());
    if (!species_) return row;
    row[kType] = type_of_name(frame.names, words[*species_]);
    if (frame.names.size() > kMaxSpecies) {
      lines_.refuse("there are more than " + std::to_string(kMaxSpecies) + " species",
                    "give a species its particles of all sizes");
    }
    return row;
  }

  // Skips blank lines and comments.
  bool next_line() {
    while (lines_.next()) {
      if (!is_csv_comment(lines_.text())) return true;
    }
    return false;
  }

  LineWords cells() const {
    LineWords words;
    for (const CsvCell& cell : csv_cells(lines_.text())) words.push_back(cell.text);
    return words;
  }

  std::vector<int> columns() const {
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
                                                             {"diameter", kDiameter},
                                                             {"mass", kMass},
                                                             {"species", kName},
                                                             {"tilt", kTilt},
                                                             {"time", kTime},
                                                             {"particle", kId}};
    const LineWords names = cells();
    const bool spatial = std::ranges::find(names, "z") != names.end() ||
                         std::ranges::find(names, "vz") != names.end();
    std::vector<int> columns;
    for (const std::string_view name : names) {
      const auto column = kColumns.find(name);
      if (column == kColumns.end()) {
        lines_.refuse("unknown column " + quoted_start(name),
                      "give the columns of a start state or of a trajectory, between commas");
      }
      if (spatial ? name == "omega" : name.starts_with("omega_")) {
        lines_.refuse(
            "the column " + in_quotes(name) + " is not one of " + (spatial ? "spheres" : "disks"),
            spatial ? "give omega_x, omega_y and omega_z" : "give omega");
      }
      columns.push_back(column->second);
    }
    return columns;
  }

  void require_later(double time, double before) const {
    if (time > before) return;
    lines_.refuse("the time goes back from " + number_text(before) + " to " + number_text(time),
                  "sort the lines by time, or separate the runs");
  }

  std::filesystem::path path_;
  FrameChoice choice_;
  TextLines lines_;
  ParticleTable table_;
  std::optional<std::size_t> species_;  // the column of their names; absent: none
  bool more_ = false;
  std::size_t frames_ = 0;
  std::size_t particles_ = 0;  // of the first frame
};

}  // namespace

ParticleFrame read_csv_frame(const std::filesystem::path& path, const FrameChoice& choice) {
  return chosen_frame(CsvFrames(path, choice), path, choice);
}

}  // namespace clatter
