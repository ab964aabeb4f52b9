#include "render/sound/synthesiser.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "engine/physics/elementary.h"

namespace clatter {

namespace {

constexpr int kPitches = Synthesiser::kBelow + 1 + Synthesiser::kAbove;
constexpr double kDecayPeriods = 5.0;  // periods in which a resonator decays by a factor e
constexpr double kClickPeak = 0.25;    // of a click of mean energy, without other clicks
constexpr double kLoudness = 0.1;      // root mean square of many clicks, of each channel
constexpr double kKnee = 0.5;          // levels below it are not limited
constexpr double kCeiling = 0.97;      // of all levels
constexpr double kRelease = 0.1;       // seconds in which the limiter recovers by a factor e
constexpr double kSilence = 1e-7;      // a weaker resonator is at rest

double frequency_of(int pitch) {
  return Synthesiser::kMiddle * std::exp2((pitch - Synthesiser::kBelow) / 12.0);
}

// The number of the resonator with a frequency nearest to a ratio to the middle one.
int pitch_of(double ratio) {
  if (!(ratio > 0.0)) return 0;
  const double semitones = 12.0 * natural_log(ratio) / std::numbers::ln2;
  constexpr double kLow = -Synthesiser::kBelow, kHigh = Synthesiser::kAbove;
  return Synthesiser::kBelow + static_cast<int>(std::lround(std::clamp(semitones, kLow, kHigh)));
}

// Clicks at random times add their energies. A click in the middle of the picture has half its
// energy in each channel, and a decaying cosine a quarter of its decay time.
double gain_of(const SoundScale& scale) {
  const double click_seconds = 0.25 * kDecayPeriods / Synthesiser::kMiddle;
  const double loudness = std::sqrt(0.5 * scale.rate * click_seconds);
  return std::min(kClickPeak, kLoudness / std::max(loudness, 1e-30));
}

std::int16_t quantised(double value) {
  return static_cast<std::int16_t>(std::lround(32767.0 * value));
}

}  // namespace

long samples_before(long frame, double fps) {
  return static_cast<long>(std::floor(static_cast<double>(frame) * kSampleRate / fps));
}

void ClickSums::add(std::span<const Click> clicks) {
  count_ += static_cast<long>(clicks.size());
  for (const Click& click : clicks) {
    squares_ += click.frequency * click.frequency;
    energies_ += click.energy;
  }
}

SoundScale ClickSums::scale(double seconds) const {
  if (!(squares_ > 0.0) || !(energies_ > 0.0) || !(seconds > 0.0)) return {};
  const auto count = static_cast<double>(count_);
  return {std::sqrt(squares_ / count), energies_ / count, count / seconds};
}

Synthesiser::Synthesiser() : resonators_(kPitches) {
  for (int pitch = 0; pitch < kPitches; ++pitch) {
    const double cycles = frequency_of(pitch) / kSampleRate;
    const double decay = std::exp(-cycles / kDecayPeriods);
    const SineCosine turn = sin_cos_2pi(cycles);
    rotations_.push_back({decay * turn.cosine, decay * turn.sine});
  }
}

void Synthesiser::use(const SoundScale& scale) {
  scale_ = scale;
  gain_ = gain_of(scale);
}

void Synthesiser::add(const Click& click, double seconds) {
  const double sample = std::floor(seconds * kSampleRate);
  const double amplitude = gain_ * std::sqrt(click.energy / scale_.energy);
  strikes_.push_back({std::max(static_cast<std::int64_t>(sample), next_),
                      pitch_of(click.frequency / scale_.frequency),
                      amplitude * std::sqrt(1.0 - click.place),
                      amplitude * std::sqrt(click.place)});
}

// Limits a level below kCeiling. The gain of the limiter falls at once and recovers slowly.
double Synthesiser::limited(double level) {
  constexpr double kKept = 1.0 - 1.0 / (kRelease * kSampleRate);
  envelope_ = std::max(level, envelope_ * kKept);
  if (envelope_ <= kKnee) return 1.0;
  constexpr double kRange = kCeiling - kKnee;
  const double over = (envelope_ - kKnee) / kRange;
  return (kKnee + kRange * over / (1.0 + over)) / envelope_;
}

void Synthesiser::ring(int pitch, std::span<const Strike> strikes,
                       std::vector<std::array<double, 2>>& mix) {
  const Rotation& by = rotations_[static_cast<std::size_t>(pitch)];
  auto& [left, right] = resonators_[static_cast<std::size_t>(pitch)];
  const auto turn = [&by](std::array<double, 2>& vector) {
    vector = {vector[0] * by.real - vector[1] * by.imaginary,
              vector[0] * by.imaginary + vector[1] * by.real};
  };
  const auto size = [](const std::array<double, 2>& vector) {
    return std::max(std::abs(vector[0]), std::abs(vector[1]));
  };
  std::size_t struck = 0;
  for (std::size_t i = 0; i < mix.size(); ++i) {
    for (;
         struck < strikes.size() && strikes[struck].sample == next_ + static_cast<std::int64_t>(i);
         ++struck) {
      left[0] += strikes[struck].left;
      right[0] += strikes[struck].right;
    }
    if (std::max(size(left), size(right)) < kSilence) {
      left = right = {};
      if (struck == strikes.size()) return;
      i = static_cast<std::size_t>(strikes[struck].sample - next_) - 1;
      continue;
    }
    mix[i][0] += left[0];
    mix[i][1] += right[0];
    turn(left);
    turn(right);
  }
}

std::vector<StereoSample> Synthesiser::render(long end) {
  if (end <= next_) return {};
  std::vector<std::array<double, 2>> mix(static_cast<std::size_t>(end - next_));
  const auto later =
      std::stable_partition(strikes_.begin(), strikes_.end(),
                            [end](const Strike& strike) { return strike.sample < end; });
  std::stable_sort(strikes_.begin(), later, [](const Strike& a, const Strike& b) {
    return a.pitch != b.pitch ? a.pitch < b.pitch : a.sample < b.sample;
  });
  std::span<const Strike> due(strikes_.data(), static_cast<std::size_t>(later - strikes_.begin()));
  for (int pitch = 0; pitch < kPitches; ++pitch) {
    const auto other = std::find_if(
        due.begin(), due.end(), [pitch](const Strike& strike) { return strike.pitch != pitch; });
    const auto count = static_cast<std::size_t>(other - due.begin());
    ring(pitch, due.first(count), mix);
    due = due.subspan(count);
  }
  strikes_.erase(strikes_.begin(), later);
  next_ = end;
  std::vector<StereoSample> samples;
  samples.reserve(mix.size());
  for (const auto& [left, right] : mix) {
    const double gain = limited(std::max(std::abs(left), std::abs(right)));
    samples.push_back({quantised(gain * left), quantised(gain * right)});
  }
  return samples;
}

}  // namespace clatter
