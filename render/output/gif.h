#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "engine/system/file_descriptor.h"

namespace clatter {

/// A film file that is a part of a film.
struct FilmPart {
  std::filesystem::path path;
  long count = 0;  ///< number of pictures
};

/// Number of pictures in a GIF, counted block by block up to the first byte that begins no block.
/// There browsers stop. Absent: the file is no GIF.
std::optional<long> pictures_in_gif(const std::filesystem::path& film);

/// Joins GIFs of one size to a GIF of one stream, which repeats for ever. Each picture keeps its
/// pixels and palette. The delays are those of `fps` pictures per second; their roundings do not
/// add up. Throws RunError if a part is damaged or lacks pictures, or if `joined` cannot be
/// written.
void join_gifs(const std::vector<FilmPart>& parts, double fps, FileDescriptor& joined);

}  // namespace clatter
