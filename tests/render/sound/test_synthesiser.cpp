#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/checkpoint/archive.h"
#include "render/sound/synthesiser.h"

namespace clatter {

namespace {

constexpr SoundScale kFewClicks{1.0, 1.0, 1.0};

std::vector<Click> random_clicks(int count, double seconds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  std::exponential_distribution<double> energy(1.0);
  std::vector<Click> clicks;
  for (int i = 0; i < count; ++i) {
    const double e = energy(random);
    clicks.push_back({seconds * i / count, place(random), 2.0 * std::sqrt(e), e});
  }
  return clicks;
}

std::vector<StereoSample> sound_of(const std::vector<Click>& clicks, const SoundScale& scale,
                                   long end) {
  Synthesiser synthesiser;
  synthesiser.use(scale);
  for (const Click& click : clicks) synthesiser.add(click, click.time);
  return synthesiser.render(end);
}

int peak_of(const std::vector<StereoSample>& samples) {
  int peak = 0;
  for (const StereoSample& sample : samples) {
    peak = std::max({peak, std::abs(int{sample[0]}), std::abs(int{sample[1]})});
  }
  return peak;
}

// Cycles per second in the first 3 ms of a click, from its changes of sign.
double frequency_of(double impulse) {
  const auto samples = sound_of({{0.0, 0.5, impulse, 1.0}}, kFewClicks, 144);
  int changes = 0;
  std::size_t first = 0, last = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if ((samples[i][0] < 0) == (samples[i - 1][0] < 0)) continue;
    if (changes++ == 0) first = i;
    last = i;
  }
  return 0.5 * (changes - 1) * kSampleRate / static_cast<double>(last - first);
}

}  // namespace

TEST_CASE("Synthesiser: a click begins at its sample, on its side, with its energy") {
  const auto samples = sound_of({{0.5, 0.1, 1.0, 0.25}}, kFewClicks, kSampleRate);
  CHECK(peak_of({samples.begin(), samples.begin() + 24000}) == 0);
  CHECK(samples[24000][0] == std::lround(32767 * 0.25 * 0.5 * std::sqrt(0.9)));
  CHECK(samples[24000][1] == std::lround(32767 * 0.25 * 0.5 * std::sqrt(0.1)));
  // The click is short.
  CHECK(peak_of({samples.begin() + 24000 + 4800, samples.end()}) == 0);
}

TEST_CASE("Synthesiser: the pitch is proportional to the impulse, up to its limits") {
  CHECK(frequency_of(1.0) == doctest::Approx(1000.0).epsilon(0.03));
  CHECK(frequency_of(2.0) == doctest::Approx(2000.0).epsilon(0.03));
  CHECK(frequency_of(3.0) == doctest::Approx(3000.0).epsilon(0.03));
  CHECK(frequency_of(100.0) == doctest::Approx(8000.0).epsilon(0.03));
}

TEST_CASE("Synthesiser: the sound does not depend on calls and checkpoints") {
  const std::vector<Click> clicks = random_clicks(3000, 1.0);
  const SoundScale scale{2.0, 1.0, 30.0};  // loud enough for the limiter
  const auto whole = sound_of(clicks, scale, kSampleRate);
  Synthesiser synthesiser;
  synthesiser.use(scale);
  std::vector<StereoSample> parts;
  std::size_t added = 0;
  for (long frame = 1; frame <= 29; ++frame) {
    const long end = samples_before(frame, 29.0);
    while (added < clicks.size() && clicks[added].time * kSampleRate < static_cast<double>(end)) {
      synthesiser.add(clicks[added], clicks[added].time);
      ++added;
    }
    const auto part = synthesiser.render(end);
    parts.insert(parts.end(), part.begin(), part.end());
    ArchiveWriter writer;
    writer(synthesiser);
    Synthesiser next;
    ArchiveReader reader(writer.written(), "test");
    reader(next);
    reader.finish();
    synthesiser = next;
  }
  CHECK(peak_of(whole) > 3000);
  CHECK((parts == whole));
}

TEST_CASE("Synthesiser: any number of clicks has the same loudness and does not clip") {
  for (const int count : {1000, 100'000}) {
    CAPTURE(count);
    const std::vector<Click> clicks = random_clicks(count, 1.0);
    ClickSums sums;
    sums.add(clicks);
    const auto samples = sound_of(clicks, sums.scale(1.0), kSampleRate);
    double square = 0.0;
    for (const auto& [left, right] : samples) square += 0.5 * (left * left + right * right);
    const double loudness = std::sqrt(square / kSampleRate) / 32767.0;
    CHECK(loudness > 0.05);
    CHECK(loudness < 0.2);
    CHECK(peak_of(samples) < 32767);
  }
  // Clicks that the scale did not foresee, all at one sample.
  const std::vector<Click> burst(10'000, {0.0, 0.5, 5.0, 100.0});
  const auto samples = sound_of(burst, kFewClicks, 4800);
  CHECK(samples[0][0] > 30'000);
  CHECK(peak_of(samples) < 32767);
}

TEST_CASE(
    "Synthesiser: a scale without clicks is the default, and equal clicks are in the middle") {
  CHECK(ClickSums().scale(2.0).frequency == 1.0);
  ClickSums sums;
  const std::vector<Click> clicks(6, {0.0, 0.5, 3.0, 4.5});
  sums.add(clicks);
  CHECK(sums.scale(2.0).frequency == doctest::Approx(3.0));
  CHECK(sums.scale(2.0).energy == doctest::Approx(4.5));
  CHECK(sums.scale(2.0).rate == doctest::Approx(3.0));
}

}  // namespace clatter
