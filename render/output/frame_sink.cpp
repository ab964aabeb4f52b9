#include "render/output/frame_sink.h"

#include <array>

#include "engine/error.h"
#include "render/output/movie.h"
#include "render/output/png_sink.h"

namespace clatter {

std::string name_of(Encoding encoding) {
  constexpr std::array kNames = {"fast", "balanced", "small"};
  return kNames[static_cast<std::size_t>(encoding)];
}

void require_folder_format(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return;
  // A hidden file such as .mp4 has no extension in C++.
  const std::string name = path.filename();
  if (name == ".png" || Movie::knows(name)) {
    throw UserError({path.string()}, "the name before the extension is missing",
                    "give a name such as film" + name);
  }
  const std::string extension = path.extension();
  if (extension.empty()) return;
  throw UserError({path.string()}, "the format " + extension + " is not supported",
                  "use .mp4, .mov, .webm, .gif, .mkv or .png, or a folder for a sequence of pictures");
}

std::unique_ptr<FrameSink> open_sink(const std::filesystem::path& path,
                                     const SinkOptions& options) {
  const std::string extension = path.extension();
  if (extension == ".png") return std::make_unique<PngFile>(path, options);
  if (Movie::knows(extension)) return std::make_unique<Movie>(path, options);
  require_folder_format(path);
  return std::make_unique<PngSequence>(path, options);
}

}  // namespace clatter
