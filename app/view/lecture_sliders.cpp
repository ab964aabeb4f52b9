#include "app/view/lecture_sliders.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/view/controls.h"
#include "app/view/panels.h"
#include "app/view/plots_panel.h"

namespace clatter {

// The slider of a wall that drives the gas; empty: it drives nothing.
static std::string drive_of(const Wall& wall) {
  switch (wall.kind) {
    case WallKind::Driven:
      return "drive_speed";
    case WallKind::Thermal:
      return "temperature";
    case WallKind::Sawtooth:
    case WallKind::Sinusoidal:
      return "frequency";
    case WallKind::Static:
      break;
  }
  return {};
}

std::vector<std::string> usual_sliders(const Scene& scene) {
  std::vector<std::string> names;
  if (scene.particles.restitution < 1.0) names.emplace_back("particles.restitution");
  for (std::size_t side = 0; side < scene.walls.size(); ++side) {
    if (!scene.walls[side]) continue;
    const std::string drive = drive_of(*scene.walls[side]);
    if (!drive.empty()) names.push_back(std::string("walls.") + kSideNames[side] + '.' + drive);
  }
  if (scene.bulk_drive) names.emplace_back("bulk_drive.kick_speed");
  for (int axis = 0; scene.gravity && axis < scene.dimension(); ++axis) {
    if ((*scene.gravity)[axis] != 0.0) {
      names.push_back(std::string("gravity.acceleration.") + "xyz"[axis]);
    }
  }
  if (scene.particles.restitution == 1.0) names.emplace_back("particles.restitution");
  if (scene.particles.start.layout != Layout::File && scene.species.empty())
    names.emplace_back("particles.count");
  if (names.size() > Lecture::kMostSliders) names.resize(Lecture::kMostSliders);
  return names;
}

LectureSliders::LectureSliders(const WindowParts& parts, const PlotsPanel& plots)
    : session_(parts.session),
      controls_(parts.controls),
      mouse_tools_(parts.mouse_tools),
      plots_(plots) {}

std::vector<std::string> LectureSliders::names() const {
  const Lecture& lecture = session_.view().lecture;
  std::vector<std::string> names;
  for (const std::string& name :
       lecture.sliders.empty() ? usual_sliders(session_.scene()) : lecture.sliders) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

float LectureSliders::height_of(const std::string& name) const {
  const auto known = heights_.find(name);
  return known == heights_.end() ? 3.0f * ImGui::GetTextLineHeightWithSpacing() : known->second;
}

float LectureSliders::height(const std::vector<std::string>& names, std::size_t columns) const {
  float sum = 0.0f;
  for (std::size_t row = 0; row < names.size(); row += columns) {
    float highest = 0.0f;
    for (std::size_t k = row; k < std::min(row + columns, names.size()); ++k) {
      highest = std::max(highest, height_of(names[k]));
    }
    sum += highest + ImGui::GetStyle().ItemSpacing.y;
  }
  return sum;
}

bool LectureSliders::draw(const std::vector<std::string>& names, std::size_t columns) {
  const float gap = 2.0f * ImGui::GetStyle().ItemSpacing.x;
  const auto count = static_cast<float>(columns);
  const float width = std::floor((ImGui::GetContentRegionAvail().x - (count - 1.0f) * gap) / count);
  bool takes_tool = false;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k % columns > 0) ImGui::SameLine(0.0f, gap);
    ImGui::BeginChild(names[k].c_str(), ImVec2(width, height_of(names[k])), false,
                      ImGuiWindowFlags_NoScrollbar);
    const ChosenControls chosen(controls_, {names[k]});
    for (const char* side : kSideNames) {
      if (names[k].starts_with(std::string("walls.") + side + '.')) {
        ImGui::TextDisabled("%s wall", side);
      }
    }
    takes_tool |= gas_panels(session_, controls_, mouse_tools_, plots_.titles());
    heights_[names[k]] = std::round(ImGui::GetCursorPosY());
    ImGui::EndChild();
    controls_.report_missing(checked_run_);
  }
  checked_run_ = session_.frame().run;
  return takes_tool;
}

bool LectureSliders::choose(Lecture& lecture) {
  std::vector<std::string> words = {"none"};
  {
    const ChosenControls none(controls_, {});
    gas_panels(session_, controls_, mouse_tools_, plots_.titles());
    for (std::string& name : controls_.take_sliders()) words.push_back(std::move(name));
  }
  std::vector<std::string> names = this->names();
  names.resize(Lecture::kMostSliders, words.front());
  const std::vector<std::string> usual = usual_sliders(session_.scene());
  bool changed = false;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto place = [&](const std::string& name) {
      const auto found = std::ranges::find(words, name);
      return found == words.end() ? 0 : static_cast<int>(found - words.begin());
    };
    int chosen = place(names[k]);
    if (controls_.choice(fmt::format("lecture.slider.{}", k + 1).c_str(),
                         fmt::format("Slider {}", k + 1).c_str(), "Name of a slider", words, chosen,
                         k < usual.size() ? place(usual[k]) : 0)) {
      names[k] = words[static_cast<std::size_t>(chosen)];
      changed = true;
    }
  }
  if (!changed) return false;
  std::erase(names, words.front());
  lecture.sliders = std::move(names);
  return true;
}

}  // namespace clatter
