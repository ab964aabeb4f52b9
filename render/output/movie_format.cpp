#include "render/output/movie_format.h"

#include <fmt/format.h>

#include <array>

namespace clatter {

namespace {

// Codecs that store colour at half the resolution need even sides.
const std::string kEvenSides = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=0x101418,";
const std::string kEvenClearSides = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=black@0,";

using Arguments = MovieFormat::Arguments;

Arguments with(Arguments all, const Arguments& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// Converts explicitly: by default ffmpeg converts to BT.601, and players assume BT.709. The encoder
// of ProRes takes the names of the colours from the pictures.
Arguments converted(const std::string& sides, const std::string& pixels,
                    const std::string& matrix = "bt709") {
  return {"-vf",
          sides + "scale=out_color_matrix=" + matrix + ":out_range=tv,format=" + pixels +
              ",setparams=colorspace=" + matrix + ":color_trc=bt709:color_primaries=bt709",
          "-colorspace",
          matrix,
          "-color_trc",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_range",
          "tv"};
}

// Fragments of one second of film play even after a crash. The frames depend on timing if x264
// looks ahead in a thread of its own: about 1 of 100 encodings of small pictures differed, and 0 of
// 1600 without this thread.
Arguments x264(const std::string& preset, const std::string& quality,
               const std::string& parameters = "") {
  return {"-c:v",           "libx264",
          "-preset",        preset,
          "-crf",           quality,
          "-x264-params",   "sync-lookahead=0" + parameters,
          "-movflags",      "+empty_moov+default_base_moof",
          "-frag_duration", "1000000"};
}

Arguments vp9(const std::string& deadline, const std::string& speed, const std::string& quality) {
  return {"-c:v",    "libvpx-vp9", "-crf",          quality,     "-b:v",
          "0",       "-deadline",  deadline,        "-cpu-used", speed,
          "-row-mt", "1",          "-tile-columns", "2"};
}

const Arguments kProRes = {"-c:v",           "prores_ks",
                           "-profile:v",     "4444",
                           "-alpha_bits",    "16",
                           "-vendor",        "apl0",
                           "-movflags",      "+empty_moov+default_base_moof",
                           "-frag_duration", "1000000"};
const Arguments kFfv1 = {"-c:v", "ffv1", "-level", "3", "-g", "1", "-slicecrc", "1"};
const Arguments kGif = {
    "-filter_complex",
    "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=none",
    "-gifflags", "-offsetting-transdiff"};

// The encodings of a format have nearly the same similarity to the pictures. mov: ProRes 4444, for
// editing. FFV1: lossless, with checksums. GIF: one palette per frame, because one for the whole
// film needs all frames in memory. Whole frames, because ffmpeg 5 to 9 leaves out equal indices
// also where a frame has the palette of the first one and its predecessor another. A transparent
// WebM has the matrix of BT.601, because Firefox decodes VP9 with alpha by it whatever the film
// says.
const std::array<MovieFormat, 5>& formats() {
  static const std::array<MovieFormat, 5> all = {{
      {".mp4",
       "mp4",
       converted(kEvenSides, "yuv420p"),
       {},
       {x264("ultrafast", "18"), x264("veryfast", "16", ":subme=1:me=dia"), x264("slow", "20")},
       {"-c:a", "aac", "-b:a", "192k", "-flags:a", "+bitexact"}},
      {".mov",
       "mov",
       converted("", "yuv444p10le"),
       converted("", "yuva444p10le"),
       {kProRes},
       {"-c:a", "pcm_s16le"}},
      {".webm",
       "webm",
       converted(kEvenSides, "yuv420p"),
       with(converted(kEvenClearSides, "yuva420p", "smpte170m"), {"-auto-alt-ref", "0"}),
       {vp9("realtime", "8", "24"), vp9("realtime", "5", "24"), vp9("good", "4", "28")},
       {"-c:a", "libopus", "-b:a", "160k", "-flags:a", "+bitexact"}},
      {".mkv",
       "matroska",
       {"-pix_fmt", "bgr0"},
       {"-pix_fmt", "bgra"},
       {kFfv1},
       {"-c:a", "flac", "-flags:a", "+bitexact"}},
      {".gif", "gif", {}, {}, {kGif}, {}},
  }};
  return all;
}

// "file:" prevents ffmpeg from reading a name with a colon as a protocol.
std::string name_of(const std::filesystem::path& file) {
  return "file:" + file.string();
}

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// Escapes a value for a metadata file of ffmpeg.
std::string escaped(std::string_view value) {
  std::string text;
  for (const char c : value) {
    if (std::string_view("=;#\\\n").find(c) != std::string_view::npos) text += '\\';
    text += c;
  }
  return text;
}

}  // namespace

const MovieFormat* find_movie_format(const std::string& extension) {
  for (const MovieFormat& format : formats()) {
    if (extension == format.extension) return &format;
  }
  return nullptr;
}

std::string metadata_file(const std::vector<PngText>& texts) {
  std::string title;
  std::string comment;
  for (const PngText& text : texts) {
    if (text.keyword == "Title") {
      title = text.text;
    } else {
      comment += text.keyword + ": " + text.text + "\n";
    }
  }
  return ";FFMETADATA1\ntitle=" + escaped(title) + "\ncomment=" + escaped(comment) + "\n";
}

// The encoder with options to report only errors and to replace its output.
static std::vector<std::string> quiet(const std::string& encoder) {
  return {encoder, "-v", "error", "-nostdin", "-y"};
}

// The texts of the second input are those of the film.
static const std::vector<std::string> kTextsOfSecond = {"-map_metadata", "1"};

// Options for the input with the texts of a film, a metadata file or a film. It must be the second
// input, for kTextsOfSecond.
static std::vector<std::string> texts_of(const std::filesystem::path& texts) {
  std::vector<std::string> all = {"-i", name_of(texts)};
  if (!find_movie_format(texts.extension())) all.insert(all.begin(), {"-f", "ffmetadata"});
  return all;
}

std::vector<std::string> encoding_command(const std::string& encoder, const MovieFormat& format,
                                          const SinkOptions& options,
                                          const std::filesystem::path& metadata,
                                          const std::filesystem::path& file) {
  std::vector<std::string> all = quiet(encoder);
  append(all, {"-f", "rawvideo", "-pix_fmt", "rgba", "-video_size", size_text(options.size)});
  append(all, {"-framerate", fmt::format("{:.10g}", options.fps), "-i", "pipe:0"});
  append(all, texts_of(metadata));
  append(all, kTextsOfSecond);
  append(all, options.transparent ? format.clear_pixels : format.pixels);
  append(all,
         format.codecs[format.has_encodings() ? static_cast<std::size_t>(options.encoding) : 0]);
  append(all, {"-f", format.muxer, name_of(file)});
  return all;
}

// Without "file:" ffmpeg resolves the name against the URL of the list, which it cuts at a "?".
std::string list_entry(const std::filesystem::path& film) {
  std::string quoted = "'";
  for (const char c : name_of(film)) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::vector<std::string> joining_command(const std::string& encoder, const MovieFormat& format,
                                         const std::filesystem::path& texts,
                                         const std::filesystem::path& sound,
                                         const std::filesystem::path& list,
                                         const std::filesystem::path& file) {
  std::vector<std::string> all = quiet(encoder);
  append(all, {"-f", "concat", "-safe", "0", "-i", name_of(list)});
  append(all, texts_of(texts));
  if (!sound.empty()) append(all, {"-i", name_of(sound)});
  append(all, kTextsOfSecond);
  append(all, {"-map", "0"});
  if (!sound.empty()) append(all, {"-map", "2:a"});
  // "+bitexact" leaves out version and random identifiers: equal films are equal files.
  append(all, {"-c", "copy", "-fflags", "+bitexact"});
  if (!sound.empty()) append(all, format.sound);
  // The bit rate in an mp4 would depend on the pieces.
  if (format.muxer == "mp4") append(all, {"-movflags", "+faststart", "-write_btrt", "0"});
  append(all, {"-f", format.muxer, name_of(file)});
  return all;
}

std::vector<std::string> listing_command(const std::string& encoder,
                                         const std::filesystem::path& file) {
  return {encoder, "-v", "error", "-nostdin", "-i",       name_of(file), "-map",
          "0:v:0", "-c", "copy",  "-f",       "framecrc", "pipe:2"};
}

}  // namespace clatter
