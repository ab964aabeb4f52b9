#include "app/view/direction.h"

#include <algorithm>
#include <cmath>

namespace clatter {

static bool set_angles(View& view, double azimuth, double elevation) {
  const bool changed = view.azimuth != azimuth || view.elevation != elevation;
  view.azimuth = azimuth;
  view.elevation = elevation;
  return changed;
}

bool face(View& view, const Preset& preset) {
  return set_angles(view, preset.azimuth, preset.elevation);
}

bool turn(View& view, float right, float down) {
  constexpr double kDegrees = 0.4;  // per window unit
  if (right == 0.0f && down == 0.0f) return false;
  return set_angles(view, std::remainder(view.azimuth - kDegrees * right, 360.0),
                    std::clamp(view.elevation + kDegrees * down, -90.0, 90.0));
}

}  // namespace clatter
