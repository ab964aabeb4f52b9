#include "render/camera_path.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

}  // namespace clatter
