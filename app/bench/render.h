#pragma once

#include <string>

namespace clatter {

/// Prints the CPU time of each stage of a film per frame, by number of particles and picture size.
/// `count` is the number of particles; 0: all of the table. `dimension` is 2 for disks and 3 for
/// spheres. Without ffmpeg the table has no columns of the encoder. Writes the table also to
/// `json`, unless it is empty. Returns the exit code.
int bench_render(const std::string& json, int count, int dimension);

}  // namespace clatter
