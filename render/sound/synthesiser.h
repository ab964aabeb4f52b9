#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/live/click_recorder.h"

// Sound of a film has three steps. ClickRecorder observes collisions, Synthesiser turns their
// clicks into samples, and a sink appends the samples to a WavFile. ffmpeg encodes this file when
// pieces are joined, so an encoder of sound never depends on pieces. FilmState has the state of the
// synthesiser and the checksum of the samples before the next frame. A resumed film cuts the file
// there. The synthesiser has one resonator per semitone, so its cost hardly depends on the number
// of clicks. Without sound nothing observes the collisions.

namespace clatter {

/// Samples per second of sound, of each channel.
constexpr int kSampleRate = 48000;

/// A stereo sample: left, right.
using StereoSample = std::array<std::int16_t, 2>;

/// The number of samples before a frame of a film.
long samples_before(long frame, double fps);

/// Units of frequency and energy, and density of clicks.
struct SoundScale {
  double frequency = 1.0;  ///< Click::frequency of the middle pitch, > 0
  double energy = 1.0;     ///< has amplitude 1 before the gain, > 0
  double rate = 0.0;       ///< clicks per second of film

  /// Visits the members that a checkpoint keeps.
  template <class Archive>
  void visit(Archive& io) {
    io(frequency, energy, rate);
  }
};

/// Sums over clicks, which give their scale.
class ClickSums {
 public:
  /// Adds clicks.
  void add(std::span<const Click> clicks);
  /// Number of clicks.
  long count() const { return count_; }
  /// The scale: root mean square frequency, mean energy, and the rate over `seconds` of film.
  /// Without clicks that have a frequency it is the default scale.
  SoundScale scale(double seconds) const;

 private:
  long count_ = 0;
  double squares_ = 0.0, energies_ = 0.0;  // sums of squared frequencies and of energies
};

/// Turns clicks into sound. A click excites a resonator, which decays within a few periods. There
/// is a resonator for each semitone around 1000 Hz, per channel. So any number of clicks takes the
/// same time. The sound depends on clicks and scale only, and not on the division into calls.
class Synthesiser {
 public:
  Synthesiser();

  /// Uses a scale for the clicks that are added from now on.
  void use(const SoundScale& scale);
  /// Adds a click at a time in seconds of film. A time before the next sample sounds at this
  /// sample.
  void add(const Click& click, double seconds);
  /// The samples up to number `end`. All clicks before this sample must have been added.
  std::vector<StereoSample> render(long end);
  /// Number of samples so far.
  long samples() const { return static_cast<long>(next_); }

  /// Visits the members that a checkpoint keeps.
  template <class Archive>
  void visit(Archive& io) {
    io(gain_, scale_, next_, envelope_, strikes_, resonators_);
    io.require(next_ >= 0);
    for (const Strike& strike : strikes_) {
      io.require(strike.sample >= next_ && strike.pitch >= 0 && strike.pitch <= kBelow + kAbove);
    }
  }

  /// Frequency of the middle pitch, in Hz.
  static constexpr double kMiddle = 1000.0;
  /// Number of semitones below and above the middle pitch.
  static constexpr int kBelow = 24, kAbove = 36;

 private:
  struct Strike {
    std::int64_t sample = 0;
    std::int32_t pitch = 0;  // number of the resonator
    double left = 0.0, right = 0.0;

    template <class Archive>
    void visit(Archive& io) {
      io(sample, pitch, left, right);
    }
  };
  // Rotating vectors whose first components are heard.
  struct Resonator {
    std::array<double, 2> left{}, right{};

    template <class Archive>
    void visit(Archive& io) {
      io(left, right);
    }
  };
  struct Rotation {
    double real = 0.0, imaginary = 0.0;  // of one sample, with the decay
  };

  double limited(double level);
  void ring(int pitch, std::span<const Strike> strikes, std::vector<std::array<double, 2>>& mix);

  std::vector<Rotation> rotations_;  // of each resonator
  double gain_ = 0.0;
  SoundScale scale_;
  std::int64_t next_ = 0;  // number of the next sample
  double envelope_ = 0.0;  // of the magnitude, decays slowly
  std::vector<Strike> strikes_;
  std::vector<Resonator> resonators_;
};

}  // namespace clatter
