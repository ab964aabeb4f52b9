#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/output/frame_sink.h"

namespace clatter {

/// A kind of film, as ffmpeg makes it.
struct MovieFormat {
  std::string extension;              ///< of its files: ".mp4"
  std::string muxer;                  ///< ffmpeg's name of the container
  std::vector<std::string> encoding;  ///< ffmpeg's arguments for the pictures
};

/// The kind of film that an extension stands for; nullptr: none.
const MovieFormat* find_movie_format(const std::string& extension);

/// The texts of a film as a file of ffmpeg's metadata: one is its title, the rest its comment. A
/// scene in them may be longer than a command line.
std::string metadata_file(const std::vector<PngText>& texts);

/// The command that encodes raw RGBA pictures from its standard input into a file that plays as far
/// as it is written, with the texts of that metadata file.
std::vector<std::string> encoding_command(const std::string& encoder, const MovieFormat& format,
                                          const SinkOptions& options,
                                          const std::filesystem::path& metadata,
                                          const std::filesystem::path& file);

/// The command that copies the films that a list for ffmpeg's "concat" names into one, with the
/// texts of that metadata file, and its index first where there is one, so that it can play before
/// it is loaded.
std::vector<std::string> joining_command(const std::string& encoder, const MovieFormat& format,
                                         const std::filesystem::path& metadata,
                                         const std::filesystem::path& list,
                                         const std::filesystem::path& file);

/// The command that writes a line that begins with "0," for each picture of a film on its standard
/// error.
std::vector<std::string> listing_command(const std::string& encoder,
                                         const std::filesystem::path& file);

}  // namespace clatter
