#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/system/child_process.h"
#include "engine/system/file_descriptor.h"
#include "engine/system/write_file.h"
#include "render/output/gif.h"
#include "render/output/movie_format.h"

namespace clatter {

/// The words of the error of an encoder that cannot start, with a fix if the encoder is missing.
std::string with_install_advice(const RunError& error);

/// The last words of an encoder that failed, or a sentence without them.
std::string reason_of(const ChildProcess& encoder);

/// Number of pictures that a player finds in a film. -1: the encoder cannot start, or the file
/// cannot be read.
long pictures_in(const std::filesystem::path& film, const std::string& encoder = "ffmpeg");

/// An open folder of film parts.
struct PartsFolder {
  std::filesystem::path path;
  const FileDescriptor& opened;

  /// The path of a file in the folder. It has no characters of the folder's name, which could have
  /// a special meaning in lists of ffmpeg. See name_while_open().
  std::filesystem::path safe_name(const std::string& file) const;
};

/// Joins films in a folder to one in the file `joined`, without encoding them again. `texts` is a
/// file with its texts, a metadata file or a film. `sound` is a WAV file in the folder; empty: no
/// sound. The input of the encoder is written to the empty file `list`. A GIF has no texts and no
/// sound, and needs no list.
/// Throws RunError with the reason, also if the film lacks pictures, and then removes `joined`.
void join_films(const PartsFolder& folder, const std::vector<FilmPart>& parts, double fps,
                const std::filesystem::path& texts, const std::string& sound,
                const MovieFormat& format, NewFile& list, NewFile& joined,
                const std::string& encoder = "ffmpeg");

/// Throws UserError if `path` is a device or a pipe, which a film would replace.
void require_no_device(const std::filesystem::path& path);

/// Joins the films FIRST.EXTENSION in a folder to the film `path` of `count` pictures. FIRST is the
/// number of the first picture of a part. Only reads the folder: temporary files are beside the
/// film. Throws UserError if pictures are missing, or if parts differ in their size or frame rate,
/// or if `path` is a device or a pipe. Throws RunError if the film cannot be written.
void join_parts(const std::filesystem::path& folder, long count, double fps,
                const std::filesystem::path& path);

}  // namespace clatter
