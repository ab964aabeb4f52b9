#include "render/output/png_sink.h"

#include <cstdio>

#include "engine/error.h"

namespace clatter {

namespace {

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

}  // namespace

PngFile::PngFile(std::filesystem::path path, const SinkOptions& options)
    : path_(std::move(path)), texts_(options.texts) {}

void PngFile::add(Image image, double time) {
  write_png(path_, image, with_time(texts_, time));
}

PngSequence::PngSequence(std::filesystem::path folder, const SinkOptions& options)
    : folder_(std::move(folder)),
      texts_(options.texts),
      queue_(options.threads, static_cast<std::size_t>(options.threads)) {
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
