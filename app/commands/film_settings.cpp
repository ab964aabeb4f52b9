#include "app/commands/film_settings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/commands/flag_checks.h"
#include "app/commands/flags.h"
#include "app/film/film_limits.h"
#include "engine/error.h"
#include "engine/text.h"
#include "engine/whole_number.h"
#include "render/output/cells.h"
#include "render/output/wav_file.h"

namespace clatter {

namespace {

constexpr Size kMinSize = {16, 16};

struct Preset {
  const char* size;
  double fps;
};

Preset preset_of(Quality quality) {
  switch (quality) {
    case Quality::Low:
      return {"854x480", 15.0};
    case Quality::Medium:
      return {"1280x720", 30.0};
    case Quality::High:
      return {"1920x1080", 60.0};
  }
  return {};
}

// The delays of a GIF are whole hundredths of a second, and programs change a delay of one.
constexpr double kMaxGifFps = 50.0;

double preset_fps(const RenderOptions& options, Quality quality) {
  const double fps = preset_of(quality).fps;
  return options.gif() ? std::min(fps, kMaxGifFps) : fps;
}

FrameRange parse_frames(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon != std::string::npos) {
    const std::string_view after = std::string_view(text).substr(colon + 1);
    const auto begin = whole_number<long>(std::string_view(text).substr(0, colon));
    const auto end = after.empty() ? std::numeric_limits<long>::max() : whole_number<long>(after);
    if (begin && end && *begin >= 0 && *begin < *end) return {*begin, *end};
  }
  throw UserError({"--frames", 0, 0}, "'" + text + "' is not a range of frames",
                  "write FIRST:END with 0 <= FIRST < END, for example 100:200, or FIRST:");
}

// Number of frames. `from`, `speed` and `fps` are known. The end is `to`, or the previous end.
long count_frames(const FrameTimes& times, const std::optional<double>& to) {
  constexpr double kFilmSeconds = 20.0;
  const double seconds = to ? times.seconds_at(*to) : kFilmSeconds;
  const double frames = std::max(1.0, std::round(seconds * times.fps));
  if (frames <= static_cast<double>(kMostFrames)) return static_cast<long>(frames);
  throw UserError({"--to", 0, 0}, "the film would have " + number_text(frames) + " frames",
                  "choose a larger --speed, or an earlier --to");
}

// A new film. The run is at `start`, 0 or the time of a checkpoint. The film begins there or at
// --from.
FilmState new_film(const RenderOptions& options, const View& view, double start) {
  constexpr double kPictureSeconds = 10.0;  // film time of a single picture
  const Quality quality = options.quality.value_or(Quality::Medium);
  FilmState film;
  film.size = parse_size(options.size.value_or(preset_of(quality).size), kMinSize);
  film.samples = options.supersample.value_or(1);
  film.shutter = options.shutter.value_or(0.0);
  film.transparent = options.transparent;
  film.encoding = options.encoding.value_or(Encoding::Balanced);
  film.overlay = view.overlay && !options.no_overlay;
  film.picture = options.one_picture();
  if (options.sound) film.sound.emplace();
  film.times = {options.from.value_or(start), options.speed.value_or(view.speed),
                options.fps.value_or(preset_fps(options, quality)), 1, view.pace};
  if (film.times.from < start) {
    throw UserError({"--from", 0, 0}, "the checkpoint is at t = " + number_text(start),
                    "give a later time, or omit --from");
  }
  const std::optional<double> to = options.to ? options.to : options.common.until;
  if (to && *to < film.times.from) {
    throw UserError(
        {"--to", 0, 0}, "the film would end before its beginning",
        "give a time after " + number_text(film.times.from) + ", the time of --from or --resume");
  }
  if (!options.one_picture()) {
    film.times.count = count_frames(film.times, to);
  } else if (!options.from || to) {
    film.times.from = to.value_or(film.times.time_after(kPictureSeconds));
  }
  return film;
}

// Refuses sound where a format or a part of a film has none.
void require_sound(const RenderOptions& options, const FrameTimes& times) {
  const auto refuse = [](const char* problem, const char* remedy) {
    throw UserError({"--sound", 0, 0}, problem, remedy);
  };
  if (options.gif()) refuse("a GIF has no sound", "write another format, or omit --sound");
  if (options.one_picture()) {
    refuse("one picture has no sound", "write a film or to a folder, or omit --sound");
  }
  if (options.frames || options.slurm > 0 || !options.join.empty()) {
    refuse("a film made in parts has no sound",
           "omit --sound, or omit --frames, --join and --slurm");
  }
  if (samples_before(times.count, times.fps) > kMaxWavSamples) {
    refuse("the sound would be longer than 6 hours", "choose an earlier --to, or omit --sound");
  }
}

[[noreturn]] void refuse_change(const char* flag, const std::string& before) {
  throw UserError({flag, 0, 0}, "the film of the checkpoint has " + before,
                  "omit the flag, or begin another film with --from");
}

template <class T, class Text>
void keep(const std::optional<T>& asked, const T& before, const char* flag, const Text& text) {
  if (asked && !(*asked == before)) refuse_change(flag, text(before));
}

// A resumed film keeps its settings, except for its end.
FilmState continued_film(const RenderOptions& options, FilmState film) {
  const FrameTimes& times = film.times;
  std::optional<Size> size;
  std::optional<double> fps = options.fps;
  if (options.quality) {
    size = parse_size(preset_of(*options.quality).size, kMinSize);
    if (!fps) fps = preset_fps(options, *options.quality);
  }
  if (options.size) size = parse_size(*options.size, kMinSize);
  keep(size, film.size, "--size", size_text);
  keep(fps, times.fps, "--fps", number_text);
  keep(options.speed, times.speed, "--speed", number_text);
  keep(options.supersample, film.samples, "--supersample", [](int n) { return std::to_string(n); });
  keep(options.shutter, film.shutter, "--shutter", number_text);
  keep(options.encoding, film.encoding, "--encoding",
       [](Encoding encoding) { return name_of(encoding); });
  if (options.transparent && !film.transparent) refuse_change("--transparent", "a background");
  if (options.no_overlay && film.overlay) refuse_change("--no-overlay", "an overlay");
  if (options.sound && !film.sound) refuse_change("--sound", "no sound");
  const std::optional<double> to = options.to ? options.to : options.common.until;
  if (to) film.times.count = count_frames(times, to);
  if (film.times.count < film.next) {
    throw UserError({"--to", 0, 0},
                    "the film is already at t = " + number_text(film.times.of(film.next - 1)),
                    "give a later time, or omit --to");
  }
  return film;
}

// A picture with the averages and plots of an earlier part of the run.
FilmState with_averages(FilmState picture, const FilmState& earlier) {
  picture.shown = earlier.shown;
  picture.plots = earlier.plots;
  picture.companions = earlier.companions;
  return picture;
}

void require_few_windows(const View& view, double last) {
  constexpr double kMaxWindows = 1e7;
  const bool averages = view.shows_averages() || std::ranges::any_of(view.plots, is_profile);
  if (!averages || last / view.window <= kMaxWindows) return;
  throw UserError({"view.window", 0, 0}, number_text(view.window) + " is too short for this film",
                  "choose at least " + number_text(last / kMaxWindows));
}

}  // namespace

void remove_plots(const RenderOptions& options, Scene& scene, std::optional<Resumed>& resumed) {
  if (options.common.sets("view.plots")) return;
  const std::optional<FilmState> film = resumed ? film_of(*resumed) : std::nullopt;
  if (!film || options.from || options.one_picture()) {
    if (options.no_overlay) scene.view.plots.clear();
    return;
  }
  const auto without_plots = [](const KeyDifference& key) {
    return key.key == "view.plots" && (key.before.empty() || key.before == "[]");
  };
  if (!film->overlay && std::erase_if(resumed->differences, without_plots) > 0) {
    scene.view.plots.clear();
  }
}

FilmState film_asked_for(const RenderOptions& options, const View& view,
                         const std::optional<Resumed>& resumed) {
  if (!resumed) return new_film(options, view, 0.0);
  const std::optional<FilmState> film = film_of(*resumed);
  const bool goes_on = film && !film->picture && !options.one_picture() &&
                       options.from.value_or(film->times.from) == film->times.from;
  if (goes_on) {
    require_same_view(*resumed);
    return continued_film(options, *film);
  }
  const FilmState next = new_film(options, view, resumed->time());
  const bool has_averages = film && next.picture && has_same_view(*resumed) &&
                            film->times.speed == next.times.speed &&
                            film->largest_exposure() == next.largest_exposure();
  return has_averages ? with_averages(next, *film) : next;
}

FilmState restarted(FilmState film) {
  film.next = 0;
  film.begin.reset();
  film.shown.clear();
  film.plots.clear();
  film.checksums.clear();
  film.notes.clear();
  film.cells.clear();
  film.companions.clear();
  if (film.sound) film.sound.emplace();
  return film;
}

FrameRange frames_asked_for(const RenderOptions& options, const FilmState& film) {
  if (!options.frames) return {0, film.times.count};
  FrameRange frames = parse_frames(*options.frames);
  if (frames.begin >= film.times.count) {
    throw UserError({"--frames", 0, 0},
                    "the film has " + counted(static_cast<std::size_t>(film.times.count), "frame"),
                    "give a smaller FIRST, or a later --to");
  }
  frames.end = std::min(frames.end, film.times.count);
  if (film.next > frames.end) {
    throw UserError({"--frames", 0, 0},
                    "the checkpoint is already at frame " + std::to_string(film.next),
                    "resume an earlier checkpoint, or omit --resume");
  }
  return frames;
}

void require_format(const RenderOptions& options, const FilmState& film) {
  if (options.gif() && film.times.fps > kMaxGifFps) {
    throw UserError({"--fps", 0, 0}, "a GIF has at most 50 frames per second",
                    "give at most --fps 50, or write another format");
  }
  if (film.sound) require_sound(options, film.times);
  const std::string extension = options.extension();
  if (options.encoding && !Movie::has_encodings(extension)) {
    throw UserError({"--encoding", 0, 0},
                    extension.empty() ? "a folder of pictures has no encoding"
                                      : "the format " + extension + " has one encoding",
                    "write a film .mp4 or .webm, or omit the flag");
  }
  if (!film.transparent || extension.empty() || extension == ".png") return;
  if (Movie::has_alpha(extension)) return;
  throw UserError({"--transparent", 0, 0}, "a film " + extension + " cannot be transparent",
                  "write a film .mov, .webm or .mkv, a FILE.png or a folder, or omit the flag");
}

void require_comparable(const RenderOptions& options) {
  if (options.compare.count() == 0) return;
  require_few_gases(options.compare, "film");
  const auto refuse = [](const char* flag, const char* problem) {
    throw UserError({flag, 0, 0}, problem, std::string("omit ") + flag + ", or give one scene");
  };
  if (options.slurm > 0) refuse("--slurm", "an array job films one gas");
  if (!options.join.empty()) refuse("--join", "parts of a film are joined without their scenes");
}

void require_cells(const FilmState& film, std::span<const ComparedScene> scenes) {
  const int count = static_cast<int>(scenes.size());
  const bool plots = !scenes[0].scene.view.plots.empty();
  const Size gases = plots ? split_for_plots(film.size).gases.size : film.size;
  for (int number = 0; number < count; ++number) {
    const Size cell = picture_cell(gases, number, count).size;
    if (cell.width < kMinSize.width || cell.height < kMinSize.height) {
      throw UserError({"--size", 0, 0}, "the cell of a gas would be " + size_text(cell),
                      "give a size that leaves at least " + size_text(kMinSize) + " for each gas");
    }
    require_few_windows(scenes[static_cast<std::size_t>(number)].scene.view, film.times.last());
  }
}

}  // namespace clatter
