#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/view/session.h"
#include "app/view/window_parts.h"

namespace clatter {

class PlotsPanel;

/// The sliders of lecture mode for a scene that names none: the restitution of inelastic particles,
/// then the drive, gravity and the number of particles, as far as the scene has them.
std::vector<std::string> usual_sliders(const Scene& scene);

/// The sliders of lecture mode: controls of the panels, chosen by their names.
class LectureSliders {
 public:
  LectureSliders(const WindowParts& parts, const PlotsPanel& plots);

  /// Their names, each once.
  std::vector<std::string> names() const;
  /// Height of the controls with these names in rows of `columns`, as they were drawn last, pixels.
  float height(const std::vector<std::string>& names, std::size_t columns) const;
  /// Draws the controls with these names, in rows of `columns`. Returns true if a mouse tool was
  /// chosen.
  bool draw(const std::vector<std::string>& names, std::size_t columns);
  /// Draws lists of names. Returns true if another slider was chosen.
  bool choose(Lecture& lecture);

 private:
  float height_of(const std::string& name) const;

  Session& session_;
  Controls& controls_;
  MouseTools& mouse_tools_;
  const PlotsPanel& plots_;
  std::map<std::string, float> heights_;  // of the controls, pixels
  std::uint64_t checked_run_ = 0;         // run whose panels had the controls
};

}  // namespace clatter
