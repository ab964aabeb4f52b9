#pragma once

#include <cstdint>
#include <vector>

#include "engine/publish/snapshot.h"
#include "render/camera.h"

namespace clatter {

/// A part of a disk's path on the picture, which it goes straight on and at one speed.
struct Chord {
  std::uint32_t disk = 0;
  Vec2 start = {0.0, 0.0}, end = {0.0, 0.0};  ///< of its centre, pixels
  double from = 0.0, to = 0.0;                ///< times after the snapshot's, from < to <= 0
};

/// The disks' paths of the last `time`, as far as disks on them come into sight, and those of their
/// images across periodic borders. A parabola is as many chords as keep within a sixteenth of a
/// pixel of it.
std::vector<Chord> chords(const Snapshot& snapshot, const Projection& projection, double time);

}  // namespace clatter
