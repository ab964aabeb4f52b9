#include "app/results/particle_frame.h"

#include <algorithm>
#include <string>

#include "engine/error.h"
#include "engine/scene/text.h"

namespace clatter {

bool is_flat(const ParticleFrame& frame) {
  if (frame.positions.empty()) return !frame.box || frame.box->lengths[2] <= 1.0;
  const auto flat = [](const ParticleFrame::Vector& vector) { return vector[2] == 0.0; };
  return std::ranges::all_of(frame.positions, flat) && std::ranges::all_of(frame.velocities, flat);
}

long step_of(double number) {
  return number >= 0.0 && number < 9e15 ? static_cast<long>(number) : 0;
}

void refuse_frame(const std::filesystem::path& path, std::size_t frames) {
  if (frames == 0) throw UserError({path.string()}, "the file has no frame", "give another file");
  throw UserError({path.string()}, "the file has " + counted(frames, "frame"),
                  frames == 1 ? "give --frame 0, or omit it"
                              : "give --frame from 0 to " + std::to_string(frames - 1));
}

}  // namespace clatter
