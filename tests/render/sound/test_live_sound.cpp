#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "render/sound/live_sound.h"

namespace clatter {

namespace {

using Stretches = std::vector<std::shared_ptr<const PlayedStretch>>;

// A click of mean impulse and energy in the middle.
Click live_click(double time, double energy = 1.0) {
  return {time, 0.5, std::sqrt(energy), energy};
}

Stretches one_stretch(const PlayedStretch& stretch) {
  return {std::make_shared<const PlayedStretch>(stretch)};
}

// Numbers of the samples that end a silence of at least 10 ms.
std::vector<long> live_onsets(const std::vector<StereoSample>& samples) {
  std::vector<long> onsets;
  long silent = kSampleRate;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool sounds = samples[i] != StereoSample{};
    if (sounds && silent >= kSampleRate / 100) onsets.push_back(static_cast<long>(i));
    silent = sounds ? 0 : silent + 1;
  }
  return onsets;
}

int live_peak(const std::vector<StereoSample>& samples) {
  int peak = 0;
  for (const StereoSample& sample : samples) peak = std::max(peak, std::abs(int{sample[0]}));
  return peak;
}

}  // namespace

TEST_CASE("Live sound: clicks are in order at the speeds of their stretches") {
  LiveSound sound;
  // 0.125 s at speed 8, and 0.125 s at speed 0.5. The third stretch is elsewhere in the run.
  const Stretches played = {
      std::make_shared<const PlayedStretch>(PlayedStretch{1, 0.0, 0.5, 8.0, 1, {live_click(0.25)}}),
      std::make_shared<const PlayedStretch>(PlayedStretch{2, 0.5, 1.0, 8.0, 1, {}}),
      std::make_shared<const PlayedStretch>(
          PlayedStretch{3, 7.0, 7.0625, 0.5, 1, {live_click(7.0), live_click(7.03125)}})};
  std::vector<StereoSample> samples = sound.next({played[0], played[1]}, 0);
  CHECK(samples.size() == LiveSound::kLatency + 6000);
  // The loudspeaker has played a part. Known stretches are not repeated.
  const std::vector<StereoSample> more = sound.next(played, 4000);
  CHECK(more.size() == 6000);
  samples.insert(samples.end(), more.begin(), more.end());
  // Clicks at 0.03125 s, 0.125 s and 0.1875 s after the latency.
  CHECK(live_onsets(samples) == std::vector<long>{4800 + 1500, 4800 + 6000, 4800 + 9000});
}

TEST_CASE("Live sound: without new stretches it is silent, and continues after its latency") {
  LiveSound sound;
  CHECK(sound.next({}, 0).empty());
  const Stretches first = one_stretch({1, 0.0, 0.01, 1.0, 1, {live_click(0.0)}});
  CHECK(sound.next(first, 0).size() == LiveSound::kLatency + 480);
  CHECK(sound.next(first, 3000).empty());
  CHECK(sound.next(first, 0).empty());
  const Stretches second = one_stretch({2, 0.01, 0.02, 1.0, 1, {}});
  CHECK(sound.next(second, 0).size() == LiveSound::kLatency + 480);
  const Stretches third = one_stretch({3, 0.02, 0.03, 1.0, 1, {}});
  CHECK(sound.next(third, 1).size() == 480);
}

TEST_CASE("Live sound: the samples that wait are bounded, and the newest remain") {
  LiveSound sound;
  Stretches played;
  // 0.5 s, with a click 0.03 s before the end.
  for (std::uint64_t k = 0; k < 25; ++k) {
    const double from = 0.02 * static_cast<double>(k);
    played.push_back(
        std::make_shared<const PlayedStretch>(PlayedStretch{k + 1, from, from + 0.02, 1.0, 1, {}}));
  }
  played[23] = std::make_shared<const PlayedStretch>(
      PlayedStretch{24, 0.46, 0.48, 1.0, 1, {live_click(0.47)}});
  const std::vector<StereoSample> late = sound.next(played, 0);
  CHECK(late.size() == LiveSound::kLatency);
  CHECK(live_onsets(late) == std::vector<long>{4800 - 1440});
  // A loudspeaker that stands still gets no more.
  long waiting = LiveSound::kLatency;
  for (std::uint64_t k = 25; k < 100; ++k) {
    const double from = 0.02 * static_cast<double>(k);
    waiting += static_cast<long>(
        sound.next(one_stretch({k + 1, from, from + 0.02, 1.0, 1, {}}), waiting).size());
    CHECK(waiting <= LiveSound::kMostWaiting);
  }
  // An engine that is far too slow.
  CHECK(sound.next(one_stretch({101, 2.0, 3.0, 1e-9, 1, {live_click(2.5)}}), 1).size() ==
        LiveSound::kLatency - 1);
  CHECK(live_onsets(sound.next(one_stretch({102, 3.0, 3.02, 1.0, 1, {}}), 1)) ==
        std::vector<long>{0});
}

TEST_CASE("Live sound: the scale is that of the first two seconds with clicks, until laws change") {
  LiveSound sound;
  std::uint64_t number = 0;
  double time = 0.0;
  // Peak of a click in a stretch of 0.25 s of sound.
  const auto peak_of = [&](double energy, double speed, std::uint64_t laws) {
    const double from = time;
    time += 0.25 * speed;
    return live_peak(sound.next(
        one_stretch(
            {++number, from, time, speed, laws, {live_click(from + 0.125 * speed, energy)}}),
        1));
  };
  const auto full = static_cast<int>(std::lround(32767 * 0.25 * std::sqrt(0.5)));
  for (int k = 0; k < 9; ++k) {
    CHECK(live_peak(sound.next(one_stretch({++number, 0.0, 0.25, 1.0, 1, {}}), 1)) == 0);
  }
  for (int k = 0; k < 8; ++k) CHECK(peak_of(4.0, 1.0, 1) == full);
  CHECK(peak_of(1.0, 1.0, 1) == doctest::Approx(0.5 * full).epsilon(0.001));
  CHECK(peak_of(0.25, 1.0, 1) == doctest::Approx(0.25 * full).epsilon(0.001));
  for (int k = 0; k < 8; ++k) CHECK(peak_of(0.25, 1.0, 2) == full);
  // 4 clicks per second of sound become 4000. The mean level of 0.1 limits them to the amplitude
  // 0.1 / sqrt(0.5 * 4000 * 0.25 * 5 / 1000).
  CHECK(peak_of(0.25, 1000.0, 2) ==
        doctest::Approx(full * 0.1 / std::sqrt(2.5) / 0.25).epsilon(0.001));
  CHECK(peak_of(0.25, 1.0, 2) == full);
}

}  // namespace clatter
