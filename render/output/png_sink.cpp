#include "render/output/png_sink.h"

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/system/write_file.h"
#include "engine/whole_number.h"

namespace clatter {

namespace {

std::vector<PngText> joined(std::vector<PngText> texts, const std::vector<PngText>& notes) {
  texts.insert(texts.end(), notes.begin(), notes.end());
  return texts;
}

std::string frame_name(long number) {
  return fmt::format("frame_{:06}.png", number);
}

// The number of a frame; -1: another file.
long frame_number(const std::filesystem::directory_entry& entry) {
  constexpr std::string_view kPrefix = "frame_", kSuffix = ".png";
  const std::string name = entry.path().filename();
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return -1;
  const std::string_view digits(name.data() + kPrefix.size(),
                                name.size() - kPrefix.size() - kSuffix.size());
  return whole_number<long>(digits).value_or(-1);
}

void require_earlier_frames(const std::filesystem::path& folder, const SinkOptions& options) {
  for (long number = options.begin; number < options.next; ++number) {
    const std::filesystem::path frame = folder / frame_name(number);
    if (!std::filesystem::exists(frame)) {
      throw UserError({folder.string()}, "the frame " + frame.string() + " of the film is missing",
                      "name the folder of the film, or start one with --frames " +
                          std::to_string(options.next) + ":");
    }
    if (!is_whole_png(frame)) {
      throw DamagedPiece({folder.string()}, "the frame " + frame.string() + " is damaged",
                         "draw the film again with --overwrite, without --resume");
    }
  }
}

void make_folder(const std::filesystem::path& folder, const SinkOptions& options) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::filesystem::directory_iterator files;
  if (!error) files = std::filesystem::directory_iterator(folder, error);
  if (error) throw RunError("cannot write to " + folder.string() + ": " + error.message());
  remove_leftovers(folder);
  if (options.overwrite || options.goes_on) return;
  for (const auto& entry : files) {
    const long number = frame_number(entry);
    if (number < options.next || number >= options.end) continue;
    throw UserError({folder.string()}, "holds frames already: " + frame_name(number),
                    "give another folder, or --overwrite to replace them");
  }
}

}  // namespace

PngFile::PngFile(std::filesystem::path path, const SinkOptions& options)
    : path_(std::move(path)), texts_(options.texts) {
  require_writable(path_);
}

void PngFile::add(Image image, std::vector<PngText> notes) {
  write_png(path_, image, joined(texts_, notes));
}

PngSequence::PngSequence(std::filesystem::path folder, const SinkOptions& options)
    : folder_(std::move(folder)),
      texts_(options.texts),
      begin_(options.begin),
      next_(options.next),
      queue_(options.threads, static_cast<std::size_t>(options.threads)) {
  require_earlier_frames(folder_, options);
  make_folder(folder_, options);
  if (!options.sound) return;
  const std::filesystem::path sound = folder_ / "sound.wav";
  if (!options.overwrite && *options.sound == 0 && !options.goes_on &&
      std::filesystem::exists(sound)) {
    throw UserError({folder_.string()}, "has a sound already: sound.wav",
                    "give another folder, or --overwrite to replace it");
  }
  sound_.emplace(sound, *options.sound, options.sound_checksum);
}

void PngSequence::add(Image image, std::vector<PngText> notes) {
  try {
    queue_.add([image = std::move(image), path = folder_ / frame_name(next_),
                texts = joined(texts_, notes)] { write_png(path, image, texts); });
  } catch (const RunError& error) {
    fail(error);
  }
  ++next_;
}

void PngSequence::flush() {
  try {
    queue_.drain();
    if (sound_) sound_->flush();
  } catch (const RunError& error) {
    fail(error);
  }
}

void PngSequence::finish(Ending) {
  flush();
  for (long number = begin_; number < next_; ++number) {
    const std::filesystem::path frame = folder_ / frame_name(number);
    if (!std::filesystem::exists(frame)) {
      fail(RunError("the frame " + frame.string() + " was removed during the run"));
    }
  }
}

void PngSequence::fail(const RunError& error) const {
  throw RunError(std::string(error.what()) + "; earlier pictures are in " + folder_.string());
}

}  // namespace clatter
