#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/output/image.h"

namespace clatter {

/// Where finished pictures go.
class FrameSink {
 public:
  FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;
  /// Without finish() before, gives up: stops the work and leaves nothing half-written behind.
  virtual ~FrameSink() = default;

  /// Takes the next picture, of simulation time `time`; waits only while too many are unwritten.
  /// Throws what went wrong with an earlier one.
  virtual void add(Image image, double time) = 0;
  /// Waits until everything is written; throws what went wrong.
  virtual void finish() = 0;
};

/// How pictures are kept.
struct SinkOptions {
  Size size;          ///< of every picture
  double fps = 30.0;  ///< pictures per second of a film
  std::vector<PngText>
      texts;               ///< kept in the file; a film has a title, and the rest as its comment
  bool overwrite = false;  ///< whether a sequence may replace pictures that exist
  int threads = 2;         ///< that encode a sequence's pictures
};

/// The sink that a path asks for: a film (.mp4, .webm, .gif, .mkv), one picture (.png), or else a
/// folder for a sequence of pictures. Throws UserError for any other extension.
std::unique_ptr<FrameSink> open_sink(const std::filesystem::path& path, const SinkOptions& options);

}  // namespace clatter
