#include "render/camera_path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/eye.h"

namespace clatter {

static Camera aimed_at(const CameraKey& key, const Snapshot& snapshot, const Camera& whole) {
  Camera camera = whole;
  camera.width = key.width.value_or(whole.width);
  std::optional<VecX> centre = key.centre;
  if (key.follow && *key.follow < snapshot.positions.cols()) {
    centre = snapshot.positions.col(*key.follow);
  }
  if (centre) {
    camera.centre = centre->head<2>();
    if (centre->size() == 3) camera.orbit.z = (*centre)[2];
  }
  camera.orbit.azimuth = key.azimuth.value_or(whole.orbit.azimuth);
  camera.orbit.elevation = key.elevation.value_or(whole.orbit.elevation);
  return camera;
}

static Camera between(const Camera& from, const Camera& to, double u) {
  const double eased = u * u * (3.0 - 2.0 * u);
  const double zoom = std::log(to.width / from.width);
  const double share = zoom == 0.0 ? eased : std::expm1(eased * zoom) / std::expm1(zoom);
  const auto mixed = [](auto a, auto b, double part) { return a + part * (b - a); };
  Camera camera = from;
  camera.centre = from.centre + share * (to.centre - from.centre);
  camera.width = from.width * std::exp(eased * zoom);
  camera.orbit.z = mixed(from.orbit.z, to.orbit.z, share);
  camera.orbit.azimuth = mixed(from.orbit.azimuth, to.orbit.azimuth, eased);
  camera.orbit.elevation = mixed(from.orbit.elevation, to.orbit.elevation, eased);
  return camera;
}

Camera camera_at(const std::vector<CameraKey>& keys, const Snapshot& snapshot,
                 const Camera& whole) {
  if (keys.empty()) return whole;
  const auto next =
      std::ranges::find_if(keys, [&](const CameraKey& key) { return key.time > snapshot.time; });
  if (next == keys.begin()) return aimed_at(keys.front(), snapshot, whole);
  const CameraKey& before = *std::prev(next);
  const Camera from = aimed_at(before, snapshot, whole);
  if (next == keys.end()) return from;
  return between(from, aimed_at(*next, snapshot, whole),
                 (snapshot.time - before.time) / (next->time - before.time));
}

// The corners of the box with the walls at their outermost positions. Spheres stick out of periodic
// borders by half their diameter.
static std::vector<Vec3> corners_of(const Snapshot& snapshot) {
  Vec3 low = Vec3::Zero(), high = snapshot.box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto &near = snapshot.walls[2 * axis], &far = snapshot.walls[2 * axis + 1];
    low[axis] -= near ? near->outermost_travel() : 0.5 * snapshot.diameter;
    high[axis] += far ? far->outermost_travel() : 0.5 * snapshot.diameter;
  }
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) {
    corners.emplace_back(k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(),
                         k & 4 ? high.z() : low.z());
  }
  return corners;
}

Camera whole_box(const Snapshot& snapshot, const View& view, Size size, const Margins& margins) {
  constexpr int kParts = 16;  // of the turn between two keys
  const std::vector<Vec3> corners = corners_of(snapshot);
  const Vec3 centre = 0.5 * (corners.front() + corners.back());
  const auto fitted = [&](const Vec2& angles) {
    Orbit orbit;
    orbit.azimuth = angles.x();
    orbit.elevation = angles.y();
    orbit.view_angle = view.view_angle;
    return fit_orbit(centre, corners, orbit, size, margins);
  };
  const auto angles_of = [&](const CameraKey& key) {
    return Vec2(key.azimuth.value_or(view.azimuth), key.elevation.value_or(view.elevation));
  };
  Camera camera = fitted({view.azimuth, view.elevation});
  for (std::size_t k = 0; k < view.camera.size(); ++k) {
    const Vec2 from = angles_of(view.camera[k]);
    const Vec2 to = angles_of(view.camera[std::min(k + 1, view.camera.size() - 1)]);
    for (int part = 0; part < kParts; ++part) {
      camera.width = std::max(camera.width, fitted(from + (to - from) * part / kParts).width);
    }
  }
  return camera;
}

}  // namespace clatter
