#pragma once

#include "engine/error.h"
#include "render/output/frame_sink.h"
#include "render/output/work_queue.h"

namespace clatter {

/// One picture, FILE.png.
class PngFile final : public FrameSink {
 public:
  PngFile(std::filesystem::path path, const SinkOptions& options);

  /// Writes the picture; another one replaces it.
  void add(Image image, std::vector<PngText> notes) override;
  void flush() override {}
  void finish(Ending) override {}

 private:
  std::filesystem::path path_;
  std::vector<PngText> texts_;
};

/// A folder of pictures, DIR/frame_000000.png and on, encoded by threads beside the caller's. Those
/// that are written stay, whatever happens.
class PngSequence final : public FrameSink {
 public:
  /// Makes the folder; throws UserError where it holds frames of these numbers already and may not
  /// replace them, or lacks earlier ones, and RunError where it cannot be made.
  PngSequence(std::filesystem::path folder, const SinkOptions& options);

  void add(Image image, std::vector<PngText> notes) override;
  void flush() override;
  void finish(Ending) override { flush(); }

 private:
  [[noreturn]] void fail(const RunError& error) const;

  std::filesystem::path folder_;
  std::vector<PngText> texts_;
  long next_;        ///< number of the next picture
  WorkQueue queue_;  ///< last, so that its threads end before the rest
};

}  // namespace clatter
