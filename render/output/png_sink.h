#pragma once

#include "render/output/frame_sink.h"
#include "render/output/work_queue.h"

namespace clatter {

/// One picture, FILE.png.
class PngFile final : public FrameSink {
 public:
  PngFile(std::filesystem::path path, const SinkOptions& options);

  /// Writes the picture; another one replaces it.
  void add(Image image, double time) override;
  void finish() override {}

 private:
  std::filesystem::path path_;
  std::vector<PngText> texts_;
};

/// A folder of pictures, DIR/frame_000000.png and on, encoded by threads beside the caller's.
class PngSequence final : public FrameSink {
 public:
  /// Makes the folder; throws UserError where it holds frames already and may not replace them, and
  /// RunError where it cannot be made.
  PngSequence(std::filesystem::path folder, const SinkOptions& options);

  void add(Image image, double time) override;
  void finish() override;

 private:
  std::filesystem::path folder_;
  std::vector<PngText> texts_;
  int next_ = 0;     ///< number of the next picture
  WorkQueue queue_;  ///< last, so that its threads end before the rest
};

}  // namespace clatter
