#include "render/output/movie.h"

#include <fcntl.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "engine/error.h"

namespace clatter {

namespace {

// Thrown on the writing thread; the caller's thread asks the encoder for the reason.
struct EncoderStopped {};

struct Format {
  const char* extension;
  const char* muxer;
  std::vector<std::string> encoding;
  bool index_later = false;  // in a second file, once the film is whole
};

// The colours are those of BT.709, said and done: left alone, ffmpeg converts by BT.601 and players
// assume BT.709. Both codecs store colour at half the resolution, so sides are made even.
const std::string kEvenSides =
    "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=0x101418,"
    "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";

std::vector<std::string> video(std::vector<std::string> codec) {
  std::vector<std::string> all = {"-vf",          kEvenSides, "-colorspace",      "bt709",
                                  "-color_trc",   "bt709",    "-color_primaries", "bt709",
                                  "-color_range", "tv"};
  all.insert(all.end(), codec.begin(), codec.end());
  return all;
}

// An mp4 is written in fragments of a second of film, which play even where the machine stops
// halfway. VP9's "realtime" is five times as fast as "good" for a fifth more bytes at the same
// quality. FFV1 keeps every bit of a picture, with checksums. A GIF has a palette for each frame:
// one for the whole film would have ffmpeg keep every frame in memory.
const std::array<Format, 4>& formats() {
  static const std::array<Format, 4> all = {{
      {".mp4", "mp4",
       video({"-c:v", "libx264", "-preset", "fast", "-crf", "18", "-movflags",
              "+empty_moov+default_base_moof", "-frag_duration", "1000000"}),
       true},
      {".webm", "webm",
       video({"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-deadline", "realtime", "-cpu-used",
              "5", "-row-mt", "1", "-tile-columns", "2"})},
      {".mkv",
       "matroska",
       {"-c:v", "ffv1", "-level", "3", "-g", "1", "-slicecrc", "1", "-pix_fmt", "bgr0"}},
      {".gif",
       "gif",
       {"-filter_complex",
        "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=none"}},
  }};
  return all;
}

const Format* find_format(const std::string& extension) {
  for (const Format& format : formats()) {
    if (extension == format.extension) return &format;
  }
  return nullptr;
}

std::vector<std::string> arguments_for(const std::string& encoder, const Format& format,
                                       const SinkOptions& options,
                                       const std::filesystem::path& part) {
  char fps[32];
  std::snprintf(fps, sizeof fps, "%.10g", options.fps);
  const std::string size =
      std::to_string(options.size.width) + "x" + std::to_string(options.size.height);
  std::vector<std::string> all = {encoder, "-v",         "error",    "-nostdin", "-y",
                                  "-f",    "rawvideo",   "-pix_fmt", "rgba",     "-video_size",
                                  size,    "-framerate", fps,        "-i",       "pipe:0"};
  all.insert(all.end(), format.encoding.begin(), format.encoding.end());
  std::string comment;
  for (const PngText& text : options.texts) {
    if (text.keyword == "Title") {
      all.insert(all.end(), {"-metadata", "title=" + text.text});
    } else {
      comment += text.keyword + ": " + text.text + "\n";
    }
  }
  if (!comment.empty()) all.insert(all.end(), {"-metadata", "comment=" + comment});
  // "file:" keeps a colon in the name from being taken for a protocol.
  all.insert(all.end(), {"-f", format.muxer, "file:" + part.string()});
  return all;
}

// Copies fragments into one film with its index first, so that it can play before it is loaded.
std::vector<std::string> indexing_arguments(const std::string& encoder,
                                            const std::filesystem::path& part,
                                            const std::filesystem::path& indexed) {
  return {encoder, "-v",   "error",     "-nostdin",   "-y", "-i",  "file:" + part.string(),
          "-c",    "copy", "-movflags", "+faststart", "-f", "mp4", "file:" + indexed.string()};
}

std::filesystem::path part_name(const std::filesystem::path& path) {
  std::filesystem::path part = path;
  part.replace_extension(".part" + path.extension().string());
  return part;
}

ChildProcess start_encoder(const std::string& encoder, const SinkOptions& options,
                           const std::filesystem::path& path, const std::filesystem::path& part) {
  // Found out now rather than after the first hour of a run.
  const FileDescriptor file(open(part.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666));
  if (!file) throw RunError("cannot write " + path.string() + ": " + std::strerror(errno));
  try {
    return ChildProcess(arguments_for(encoder, *find_format(path.extension()), options, part));
  } catch (const RunError& error) {
    unlink(part.c_str());
    throw RunError(std::string(error.what()) + "; films need ffmpeg (apt install ffmpeg)");
  }
}

}  // namespace

Movie::Movie(std::filesystem::path path, const SinkOptions& options, const std::string& encoder)
    : path_(std::move(path)),
      part_(part_name(path_)),
      program_(encoder),
      encoder_(start_encoder(encoder, options, path_, part_)),
      queue_(1, 4) {}

Movie::~Movie() {
  // The encoder goes first: a write to it may be what the thread waits in.
  encoder_.kill();
  if (!part_.empty()) unlink(part_.c_str());
}

bool Movie::knows(const std::string& extension) {
  return find_format(extension) != nullptr;
}

void Movie::add(Image image, double) {
  try {
    queue_.add([this, image = std::move(image)] {
      if (!encoder_.write(image.rgba)) throw EncoderStopped();
    });
  } catch (const EncoderStopped&) {
    fail();
  }
}

void Movie::finish() {
  try {
    queue_.finish();
  } catch (const EncoderStopped&) {
    fail();
  }
  if (!encoder_.wait()) fail();
  if (find_format(path_.extension())->index_later) index();
  if (rename(part_.c_str(), path_.c_str()) != 0) {
    throw RunError("cannot write " + path_.string() + ": " + std::strerror(errno));
  }
  part_.clear();
}

void Movie::index() {
  const std::filesystem::path indexed = part_name(part_);
  ChildProcess indexer(indexing_arguments(program_, part_, indexed));
  if (indexer.wait()) {
    unlink(part_.c_str());
    part_ = indexed;
  } else {
    // Where there is no room for a copy, the film stays as it is, which plays as well.
    unlink(indexed.c_str());
  }
}

void Movie::fail() {
  encoder_.kill();
  throw RunError("ffmpeg could not write " + path_.string() + ": " + encoder_.last_words());
}

}  // namespace clatter
