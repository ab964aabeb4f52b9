#include "render/output/png_sink.h"

#include <algorithm>
#include <cstdio>
#include <thread>

#include "engine/error.h"

namespace clatter {

namespace {

std::vector<PngText> texts_of(const SinkOptions& options) {
  std::vector<PngText> texts;
  if (!options.title.empty()) texts.push_back({"Title", options.title});
  if (!options.comment.empty()) texts.push_back({"Comment", options.comment});
  return texts;
}

std::vector<PngText> with_time(std::vector<PngText> texts, double time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", time);
  texts.push_back({"Simulation time", text});
  return texts;
}

std::string frame_name(int number) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%06d.png", number);
  return name;
}

bool is_frame(const std::filesystem::directory_entry& entry) {
  const std::filesystem::path name = entry.path().filename();
  return name.extension() == ".png" && name.string().starts_with("frame_");
}

void make_folder(const std::filesystem::path& folder, bool overwrite) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::filesystem::directory_iterator files(folder, error);
  if (error) throw RunError("cannot write to " + folder.string() + ": " + error.message());
  if (!overwrite && std::any_of(begin(files), end(files), is_frame)) {
    throw UserError({folder.string()}, "holds frames already",
                    "give another folder, or --overwrite to replace them");
  }
}

// Encoding a frame takes about as long as drawing it, so a few threads keep up with any gas.
int encoder_threads() {
  return std::clamp<int>(std::thread::hardware_concurrency(), 1, 4);
}

}  // namespace

PngFile::PngFile(std::filesystem::path path, const SinkOptions& options)
    : path_(std::move(path)), texts_(texts_of(options)) {}

void PngFile::add(Image image, double time) {
  write_png(path_, image, with_time(texts_, time));
}

PngSequence::PngSequence(std::filesystem::path folder, const SinkOptions& options)
    : folder_(std::move(folder)),
      texts_(texts_of(options)),
      queue_(encoder_threads(), encoder_threads()) {
  make_folder(folder_, options.overwrite);
}

void PngSequence::add(Image image, double time) {
  queue_.add([image = std::move(image), path = folder_ / frame_name(next_),
              texts = with_time(texts_, time)] { write_png(path, image, texts); });
  ++next_;
}

void PngSequence::finish() {
  queue_.finish();
}

}  // namespace clatter
