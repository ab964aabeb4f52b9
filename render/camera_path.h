#pragma once

#include <vector>

#include "engine/publish/snapshot.h"
#include "render/camera.h"

namespace clatter {

/// The camera at the snapshot's time, of a path given by keys in order of time; before the first of
/// them it is there already, after the last it stays. `whole` stands for what a key leaves out, and
/// for a disk that there is not.
///
/// A share u in 0..1 of the time from one key to the next, the width is
///   w = w_0 (w_1 / w_0)^e with e = u^2 (3 - 2u),
/// so that zooming begins and ends gently and looks even, and the centre
///   c = c_0 + (c_1 - c_0) (w - w_0) / (w_1 - w_0), or for w_1 = w_0 its limit c_0 + (c_1 - c_0) e,
/// so that a zoom keeps one point of the world where it is on the picture. Where a disk is
/// followed, c_0 or c_1 is its place at the time.
Camera camera_at(const std::vector<CameraKey>& keys, const Snapshot& snapshot, const Camera& whole);

}  // namespace clatter
