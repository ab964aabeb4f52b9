#include "render/camera_path.h"

#include <algorithm>
#include <cmath>

namespace clatter {

static Camera aimed_at(const CameraKey& key, const Snapshot& snapshot, const Camera& whole) {
  Camera camera{key.centre.value_or(whole.centre), key.width.value_or(whole.width)};
  if (key.follow && *key.follow < snapshot.positions.cols()) {
    camera.centre = snapshot.positions.col(*key.follow);
  }
  return camera;
}

static Camera between(const Camera& from, const Camera& to, double u) {
  const double eased = u * u * (3.0 - 2.0 * u);
  const double zoom = std::log(to.width / from.width);
  const double share = zoom == 0.0 ? eased : std::expm1(eased * zoom) / std::expm1(zoom);
  return {from.centre + share * (to.centre - from.centre), from.width * std::exp(eased * zoom)};
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
