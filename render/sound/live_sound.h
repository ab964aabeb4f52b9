#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/live/played_stretch.h"
#include "render/sound/synthesiser.h"

namespace clatter {

/// The sound of a gas that plays, at its speed. A loudspeaker takes the samples. A gas that pauses,
/// jumps or plays backwards has no stretches, so it is silent.
///
/// The scale is that of the first seconds with clicks. It is kept until the scene or the laws
/// change. The loudness follows the speed.
class LiveSound {
 public:
  /// The samples of the stretches since the last call. `waiting` is the number of samples that the
  /// loudspeaker has not played yet. If it has none, silence of kLatency samples comes first. If
  /// more than kMostWaiting would wait, the oldest of the new samples are left out.
  std::vector<StereoSample> next(const std::vector<std::shared_ptr<const PlayedStretch>>& played,
                                 long waiting);

  /// Usual number of samples that wait: a picture may be late by this time.
  static constexpr long kLatency = kSampleRate / 10;
  /// Largest number of samples that wait.
  static constexpr long kMostWaiting = 3 * kLatency;

 private:
  std::vector<StereoSample> render(const PlayedStretch& stretch);
  void tune(const PlayedStretch& stretch);

  Synthesiser synthesiser_;
  double seconds_ = 0.0;     // of sound so far
  std::uint64_t heard_ = 0;  // number of the last stretch
  std::uint64_t laws_ = 0;   // PlayedStretch::laws of the scale
  ClickSums sums_;           // of the scale
  double time_ = 0.0;        // simulation time of these sums
  double tuned_ = 0.0;       // seconds of these sums
};

}  // namespace clatter
