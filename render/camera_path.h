#pragma once

#include <vector>

#include "engine/picture/snapshot.h"
#include "render/camera.h"

namespace clatter {

/// The camera of a path at the time of the snapshot. `keys` are in order of time. The camera is
/// constant before the first key and after the last one. `whole` replaces missing values of a key
/// and the position of a missing particle.
///
/// u, 0..1, is the fraction of the time between two keys 0 and 1. The width is
///   w = w_0 (w_1 / w_0)^e with e = u^2 (3 - 2u),
/// which is a smooth zoom. The centre is
///   c = c_0 + (c_1 - c_0) (w - w_0) / (w_1 - w_0), or for w_1 = w_0 its limit c_0 + (c_1 - c_0) e,
/// which keeps one world point fixed on the picture during a zoom. The angles of spheres are
/// a_0 + (a_1 - a_0) e. If a key follows a particle, its centre is the current position of the
/// particle.
Camera camera_at(const std::vector<CameraKey>& keys, const Snapshot& snapshot, const Camera& whole);

/// The camera of a view of spheres that shows the whole box inside the margins of a picture of
/// `size`. It is far enough away for all angles of the view's path, which turns at one distance.
Camera whole_box(const Snapshot& snapshot, const View& view, Size size, const Margins& margins);

}  // namespace clatter
