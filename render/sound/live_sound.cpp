#include "render/sound/live_sound.h"

#include <algorithm>

namespace clatter {

// Seconds of sound from the beginning of a stretch to a time in it. A loudspeaker takes no longer
// sound.
static double seconds_to(double time, const PlayedStretch& stretch) {
  constexpr double kLongest = static_cast<double>(LiveSound::kMostWaiting) / kSampleRate;
  return std::min(kLongest, (time - stretch.from) / stretch.speed);
}

std::vector<StereoSample> LiveSound::next(
    const std::vector<std::shared_ptr<const PlayedStretch>>& played, long waiting) {
  std::vector<StereoSample> samples;
  for (const auto& stretch : played) {
    if (stretch->number <= heard_) continue;
    heard_ = stretch->number;
    if (samples.empty() && waiting == 0) samples.resize(kLatency);
    const std::vector<StereoSample> sound = render(*stretch);
    samples.insert(samples.end(), sound.begin(), sound.end());
  }
  const auto count = static_cast<long>(samples.size());
  if (waiting + count > kMostWaiting) {
    samples.erase(samples.begin(), samples.begin() + std::min(count, waiting + count - kLatency));
  }
  return samples;
}

std::vector<StereoSample> LiveSound::render(const PlayedStretch& stretch) {
  tune(stretch);
  for (const Click& click : stretch.clicks) {
    synthesiser_.add(click, seconds_ + seconds_to(click.time, stretch));
  }
  seconds_ += seconds_to(stretch.to, stretch);
  return synthesiser_.render(static_cast<long>(seconds_ * kSampleRate));
}

// While the scale forms, clicks have the scale so far.
void LiveSound::tune(const PlayedStretch& stretch) {
  constexpr double kSeconds = 2.0;
  if (stretch.laws != laws_) {
    laws_ = stretch.laws;
    sums_ = {};
    time_ = tuned_ = 0.0;
  }
  if (tuned_ < kSeconds && (sums_.count() > 0 || !stretch.clicks.empty())) {
    sums_.add(stretch.clicks);
    time_ += stretch.to - stretch.from;
    tuned_ += seconds_to(stretch.to, stretch);
  }
  synthesiser_.use(sums_.scale(time_ / stretch.speed));
}

}  // namespace clatter
