#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/output/image.h"

namespace clatter {

/// Whether a film has come to its end, or is cut and may be taken up again.
enum class Ending { Whole, Cut };

/// Where finished pictures go.
class FrameSink {
 public:
  FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;
  /// Without finish() before, gives up: stops the work and keeps the pictures that are whole.
  virtual ~FrameSink() = default;

  /// Takes the next picture and what is to be said of it alone; waits only while too many are
  /// unwritten. Throws what went wrong with an earlier one.
  virtual void add(Image image, std::vector<PngText> notes) = 0;
  /// Waits until all pieces that are whole are written; throws what went wrong.
  virtual void flush() = 0;
  /// Waits until everything is written; throws what went wrong.
  virtual void finish(Ending ending) = 0;
  /// CRC-32 of each piece that is whole, in order; empty where pieces carry their own.
  virtual std::vector<std::uint32_t> checksums() const { return {}; }

  /// How many pictures a piece has: where the number of one is a multiple of this, a film can be
  /// taken up again.
  static constexpr long kPiece = 60;
};

/// How pictures are kept.
struct SinkOptions {
  Size size;          ///< of every picture
  double fps = 30.0;  ///< pictures per second of a film
  std::vector<PngText>
      texts;               ///< kept in the file; a film has a title, and the rest as its comment
  bool overwrite = false;  ///< whether a sequence may replace pictures that exist
  int threads = 2;         ///< that encode a sequence's pictures
  long begin = 0;          ///< number of the first picture in the file or folder
  long end = std::numeric_limits<long>::max();  ///< one more than the number of the last
  long next = 0;  ///< number of the first picture that is added; those from `begin` on are there
  bool goes_on = false;  ///< what is there from `next` on is of this film, before it was cut
  std::vector<std::uint32_t> checksums = {};  ///< of the pieces before `next`; empty: not known
  std::vector<PngText> notes = {};            ///< of the picture before `next`
};

/// The sink that a path asks for: a film (.mp4, .webm, .gif, .mkv), one picture (.png), or else a
/// folder for a sequence of pictures. Throws UserError for any other extension, where earlier
/// pictures are missing, or where others are in the way.
std::unique_ptr<FrameSink> open_sink(const std::filesystem::path& path, const SinkOptions& options);

}  // namespace clatter
