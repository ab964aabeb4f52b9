#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/output/frame_sink.h"

namespace clatter {

/// A film format of ffmpeg.
struct MovieFormat {
  using Arguments = std::vector<std::string>;  ///< of ffmpeg

  std::string extension;          ///< file extension, ".mp4"
  std::string muxer;              ///< name of the container in ffmpeg
  Arguments pixels;               ///< conversion of the pictures for the codec
  Arguments clear_pixels;         ///< of pictures with alpha; empty: the format has no alpha
  std::vector<Arguments> codecs;  ///< one for each Encoding, or one for all
  Arguments sound;                ///< of the sound; empty: the format has none

  /// Whether a film has a choice of the Encoding.
  bool has_encodings() const { return codecs.size() > 1; }
};

/// The format of a file extension; nullptr: none.
const MovieFormat* find_movie_format(const std::string& extension);

/// The content of an ffmpeg metadata file. The text "Title" becomes the title, all others the
/// comment. A file, because a scene may be longer than a command line.
std::string metadata_file(const std::vector<PngText>& texts);

/// The command that encodes raw RGBA pictures, with alpha that is not premultiplied, from standard
/// input into `file`, with the texts of `metadata`. An incomplete file is playable.
std::vector<std::string> encoding_command(const std::string& encoder, const MovieFormat& format,
                                          const SinkOptions& options,
                                          const std::filesystem::path& metadata,
                                          const std::filesystem::path& file);

/// A film as an entry of a list for ffmpeg's "concat": a quoted URL.
std::string list_entry(const std::filesystem::path& film);

/// The command that joins films into `file` without encoding, with the texts of a metadata file or
/// of a film, and with the sound of a WAV file unless `sound` is empty. `list` is a file for
/// ffmpeg's "concat", of list_entry(). The index of an mp4 comes first, so that it can play while
/// it loads.
std::vector<std::string> joining_command(const std::string& encoder, const MovieFormat& format,
                                         const std::filesystem::path& texts,
                                         const std::filesystem::path& sound,
                                         const std::filesystem::path& list,
                                         const std::filesystem::path& file);

/// The command that lists the pictures of a film on standard error, one line "0,..." per picture.
std::vector<std::string> listing_command(const std::string& encoder,
                                         const std::filesystem::path& file);

}  // namespace clatter
