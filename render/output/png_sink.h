#pragma once

#include <optional>

#include "engine/error.h"
#include "render/output/frame_sink.h"
#include "render/output/wav_file.h"
#include "render/output/work_queue.h"

namespace clatter {

/// One picture, FILE.png.
class PngFile final : public FrameSink {
 public:
  /// Throws RunError if the picture cannot be written.
  PngFile(std::filesystem::path path, const SinkOptions& options);

  /// Writes the picture. A later picture replaces it.
  void add(Image image, std::vector<PngText> notes) override;
  /// A picture has no sound.
  void add_sound(std::span<const StereoSample>) override {}
  void flush() override {}
  void finish(Ending) override {}

 private:
  std::filesystem::path path_;
  std::vector<PngText> texts_;
};

/// A folder of pictures, DIR/frame_000000.png etc., encoded by worker threads. Its sound is
/// DIR/sound.wav. Written pictures always remain.
class PngSequence final : public FrameSink {
 public:
  /// Creates the folder. Throws UserError if earlier frames are missing, or if frames of these
  /// numbers exist and may not be replaced. Throws DamagedPiece if an earlier frame is no whole
  /// PNG file, and RunError if the folder cannot be created.
  PngSequence(std::filesystem::path folder, const SinkOptions& options);

  void add(Image image, std::vector<PngText> notes) override;
  void add_sound(std::span<const StereoSample> samples) override { sound_->append(samples); }
  std::uint32_t sound_checksum() const override { return sound_ ? sound_->checksum() : 0; }
  void flush() override;
  /// Throws RunError also if a picture has been removed.
  void finish(Ending) override;

 private:
  [[noreturn]] void fail(const RunError& error) const;

  std::filesystem::path folder_;
  std::vector<PngText> texts_;
  long begin_;                    ///< number of the first picture
  long next_;                     ///< number of the next picture
  std::optional<WavFile> sound_;  ///< DIR/sound.wav; absent: none
  WorkQueue queue_;               ///< last member: its threads must end first
};

}  // namespace clatter
