#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "engine/stop_request.h"
#include "render/output/image.h"
#include "render/sound/synthesiser.h"

namespace clatter {

/// End of a film: complete, or interrupted and open for a restart.
enum class Ending { Whole, Cut };

/// The trade of a film between CPU time and bytes, at nearly the same quality. `clatter bench
/// accuracy` measures it.
enum class Encoding { Fast, Balanced, Small };

/// Its name on the command line.
std::string name_of(Encoding encoding);

/// Output for finished pictures.
class FrameSink {
 public:
  FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;
  /// Without a call of finish(), stops the work and keeps the complete pictures.
  virtual ~FrameSink() = default;

  /// Adds the next picture with its own texts. Waits only while too many pictures are unwritten.
  /// Throws the error of an earlier picture.
  virtual void add(Image image, std::vector<PngText> notes) = 0;
  /// Appends samples to the sound of the film. Only for sinks that were opened with sound.
  virtual void add_sound(std::span<const StereoSample> samples) = 0;
  /// CRC-32 of the sound so far.
  virtual std::uint32_t sound_checksum() const { return 0; }
  /// Waits until all complete pieces and the sound are written. Throws the first error.
  virtual void flush() = 0;
  /// Waits until everything is written. Throws the first error.
  virtual void finish(Ending ending) = 0;
  /// CRC-32 of each complete piece, in order. Empty for files with checksums of their own.
  virtual std::vector<std::uint32_t> checksums() const { return {}; }

  /// Number of pictures in a piece. A film can restart at picture numbers that are multiples of it.
  static constexpr long kPiece = 60;
};

/// Options of a sink.
struct SinkOptions {
  Size size;          ///< size of every picture
  double fps = 30.0;  ///< pictures per second of a film
  std::vector<PngText>
      texts;               ///< texts of the file; a film stores "Title" and a comment with the rest
  bool overwrite = false;  ///< may replace existing pictures or pieces
  int threads = 2;         ///< number of threads that encode a sequence
  long begin = 0;          ///< number of the first picture in the file or folder
  long end = std::numeric_limits<long>::max();  ///< number of the last picture plus 1
  long next = 0;         ///< number of the next picture; pictures begin..next - 1 already exist
  bool goes_on = false;  ///< restart: existing pictures from `next` on may be replaced
  std::vector<std::uint32_t> checksums = {};  ///< of the pieces before `next`; empty: unknown
  std::vector<PngText> notes = {};            ///< texts of the picture before `next`
  /// Number of samples of the sound that already exist; absent: a film without sound.
  std::optional<long> sound = {};
  std::uint32_t sound_checksum = 0;  ///< of these samples
  StopRequest stop = {};             ///< once made, an encoder that hangs is an error
  bool transparent = false;          ///< whether a film keeps the alpha of the pictures
  Encoding encoding = Encoding::Balanced;  ///< of formats that have a choice
};

/// A complete piece of a restarted film, or an earlier picture of a folder, differs from its
/// checksum.
class DamagedPiece : public UserError {
  using UserError::UserError;
};

/// Throws UserError unless a path without a format of films and pictures can be a folder: it is
/// one, or its name has no extension.
void require_folder_format(const std::filesystem::path& path);

/// Opens the sink for a path: a film (.mp4, .mov, .webm, .gif, .mkv), one picture (.png), or a
/// folder for a sequence of pictures. Throws UserError for another extension, if earlier pictures
/// are missing, or if existing pictures would be replaced. Throws DamagedPiece for a film or a
/// folder.
std::unique_ptr<FrameSink> open_sink(const std::filesystem::path& path, const SinkOptions& options);

}  // namespace clatter
