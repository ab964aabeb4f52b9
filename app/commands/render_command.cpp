#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/flag_checks.h"
#include "app/commands/flags.h"
#include "app/runs/compared_scenes.h"
#include "app/runs/film.h"
#include "app/runs/film_cell.h"
#include "app/runs/film_job.h"
#include "app/runs/picture_scene.h"
#include "app/runs/run.h"
#include "app/system/exit_code.h"
#include "app/system/interrupt.h"
#include "app/system/outputs.h"
#include "app/system/process_usage.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/scene/text.h"
#include "engine/whole_number.h"
#include "render/context/context.h"
#include "render/gl/canvas.h"
#include "render/output/film_join.h"
#include "render/output/frame_sink.h"
#include "render/output/movie.h"
#include "render/output/wav_file.h"

namespace clatter {

namespace {

constexpr Size kMinSize = {16, 16};

// Presets of picture size and frame rate.
enum class Quality { Low, Medium, High };

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

constexpr int kEncodingThreads = 2;

struct RenderOptions {
  CommonOptions common;
  CheckpointOptions checkpoints;
  CompareOptions compare;
  bool seed_flag = false;  // whether --seed is given
  std::string out;
  std::optional<Quality> quality;   // absent: medium
  std::optional<std::string> size;  // absent: size of the quality
  std::optional<double> fps;        // absent: rate of the quality
  std::optional<double> from;       // absent: 0, or the time of the checkpoint
  std::optional<double> to;
  std::optional<double> speed;
  std::optional<std::string> frames;  // absent: all
  std::optional<int> supersample;     // absent: 1
  std::optional<double> shutter;      // absent: 0
  std::optional<int> threads;         // of a large gas and of encoding
  bool no_overlay = false;
  bool transparent = false;
  bool sound = false;
  bool overwrite = false;
  Backend backend = Backend::Auto;
  std::string join;  // folder of the parts of the film; empty: draw it
  int slurm = 0;     // tasks of an array job; 0: draw the film here
  TaskLimits limits;
  bool dry_run = false;

  std::string extension() const { return std::filesystem::path(out).extension(); }
  bool one_picture() const { return extension() == ".png"; }
  bool film() const { return Movie::knows(extension()); }
  bool gif() const { return extension() == ".gif"; }
};

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
  constexpr double kMaxFrames = 1e7;
  const double span = to ? *to - times.from : kFilmSeconds * times.speed;
  const double frames = std::max(1.0, std::round(span * times.fps / times.speed));
  if (frames <= kMaxFrames) return static_cast<long>(frames);
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
  film.overlay = view.overlay && !options.no_overlay;
  if (options.sound) film.sound.emplace();
  film.times = {options.from.value_or(start), options.speed.value_or(view.speed),
                options.fps.value_or(preset_fps(options, quality)), 1};
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
    film.times.from = to.value_or(film.times.from + kPictureSeconds * film.times.speed);
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

// Refuses settings that the format cannot have.
void require_format(const RenderOptions& options, const FilmState& film) {
  if (options.gif() && film.times.fps > kMaxGifFps) {
    throw UserError({"--fps", 0, 0}, "a GIF has at most 50 frames per second",
                    "give at most --fps 50, or write another format");
  }
  if (film.sound) require_sound(options, film.times);
  const std::string extension = options.extension();
  if (!film.transparent || extension.empty() || extension == ".png") return;
  if (Movie::has_alpha(extension)) return;
  throw UserError({"--transparent", 0, 0}, "a film " + extension + " cannot be transparent",
                  "write a film .mov, .webm or .mkv, a FILE.png or a folder, or omit the flag");
}

void require_drawable(const FilmState& film, const Gl& gl) {
  const int side = film.samples * std::max(film.size.width, film.size.height);
  const int largest = Canvas::largest_side(gl);
  if (side <= largest) return;
  throw UserError({"--size", 0, 0},
                  "the pictures have " + std::to_string(side) +
                      " samples along a side, and this OpenGL supports " + std::to_string(largest),
                  "give a smaller --size or --supersample");
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

// The film to draw: from the checkpoint, unless the flags give another beginning.
FilmState film_asked_for(const RenderOptions& options, const View& view,
                         const std::optional<Resumed>& resumed) {
  if (!resumed) return new_film(options, view, 0.0);
  const std::optional<FilmState> film = film_of(*resumed);
  const bool goes_on =
      film && !options.one_picture() && options.from.value_or(film->times.from) == film->times.from;
  if (!goes_on) return new_film(options, view, resumed->time());
  require_same_view(*resumed);
  return continued_film(options, *film);
}

// The same film at its beginning.
FilmState restarted(FilmState film) {
  film.next = 0;
  film.begin.reset();
  film.ranges.reset();
  film.camera.reset();
  film.shown.clear();
  film.checksums.clear();
  film.notes.clear();
  film.companions.clear();
  if (film.sound) film.sound.emplace();
  return film;
}

FrameRange frames_asked_for(const RenderOptions& options, const FilmState& film) {
  if (!options.frames) return {0, film.times.count};
  FrameRange frames = parse_frames(*options.frames);
  if (frames.begin >= film.times.count) {
    throw UserError({"--frames", 0, 0},
                    "the film has " + std::to_string(film.times.count) + " frames",
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

SinkOptions sink_options(const RenderOptions& options, const std::vector<ComparedScene>& scenes,
                         const FilmState& film, const FrameRange& frames) {
  SinkOptions sink;
  sink.size = film.size;
  sink.fps = film.times.fps;
  sink.transparent = film.transparent;
  sink.texts = picture_texts(scenes);
  sink.threads = options.threads.value_or(kEncodingThreads);
  sink.overwrite = options.overwrite;
  sink.begin = frames.begin;
  if (options.frames) sink.end = frames.end;
  if (film.sound) {
    sink.sound = film.sound->samples();
    sink.sound_checksum = film.sound->checksum;
  }
  sink.stop = interrupted;
  sink.next = std::max(film.next, frames.begin);
  sink.goes_on = film.begin == frames.begin && film.next >= frames.begin;
  if (sink.goes_on) {
    sink.checksums = film.checksums;
    sink.notes = film.notes;
  }
  return sink;
}

void require_few_windows(const View& view, double last) {
  constexpr double kMaxWindows = 1e7;
  if (!view.shows_averages() || last / view.window <= kMaxWindows) return;
  throw UserError({"view.window", 0, 0}, number_text(view.window) + " is too short for this film",
                  "choose at least " + number_text(last / kMaxWindows));
}

// Refuses what a film of several gases cannot have.
void require_comparable(const RenderOptions& options) {
  if (options.compare.count() == 0) return;
  if (options.compare.count() >= kMostCells) {
    throw UserError({"", 0, 0}, "a film shows at most 4 gases beside each other",
                    "give fewer scenes or --compare");
  }
  const auto refuse = [](const char* flag, const char* problem) {
    throw UserError({flag, 0, 0}, problem, std::string("omit ") + flag + ", or give one scene");
  };
  if (options.sound) refuse("--sound", "a film of several gases has no sound");
  if (options.slurm > 0) refuse("--slurm", "an array job films one gas");
  if (!options.join.empty()) refuse("--join", "parts of a film are joined without their scenes");
}

// Refuses cells that are too small.
void require_cells(Size whole, int count) {
  for (int number = 0; number < count; ++number) {
    const Size cell = cell_size(whole, number, count);
    if (cell.width >= kMinSize.width && cell.height >= kMinSize.height) continue;
    throw UserError({"--size", 0, 0}, "the cell of a gas would be " + size_text(cell),
                    "give a size that leaves at least " + size_text(kMinSize) + " for each gas");
  }
}

// Returns whether the sink has frames. A checkpoint keeps the run even if the sink cannot be
// written.
template <int D>
bool draw(Film<D>& film, const FrameRange& frames, FrameSink& sink, Run<D>& run,
          Progress& progress) {
  try {
    const long next = film.draw(frames, sink, progress);
    if (next <= frames.begin) return false;
    sink.finish(next == frames.end ? Ending::Whole : Ending::Cut);
    if (next == frames.end) film.end_part();
    return true;
  } catch (const RunError& error) {
    throw RunError(error.what() + run.rescue());
  }
}

// Files that other programs wrote among the pieces are not removed.
void tell_kept_folder(const RenderOptions& options) {
  const std::filesystem::path folder = pieces_folder(options.out);
  std::error_code ignored;
  if (!options.film() || options.common.quiet || !std::filesystem::exists(folder, ignored)) return;
  std::fprintf(stderr, "note: %s has other files and was kept\n", folder.c_str());
}

template <int D>
int film_run(const RenderOptions& options, const std::vector<ComparedScene>& scenes,
             const View& view, std::optional<Resumed> resumed,
             const std::filesystem::path& checkpoint, const FilmState& film,
             const FrameRange& frames) {
  Run<D> run("render", scenes[0].scene, options.common, options.checkpoints, std::move(resumed),
             checkpoint);
  const auto context = open_context(options.backend);
  require_drawable(film, context->gl());
  const int threads = options.threads.value_or(processors());
  run.scheduled().use_threads(threads);
  Film<D> filming(run, scenes, view, film, threads, context->gl());
  const auto sink = open_sink(options.out, sink_options(options, scenes, film, frames));
  bool drawn = false;
  {
    Progress progress(options.common.shown_progress(), "filming", run.simulation().time(),
                      film.times.of(frames.end - 1));
    drawn = draw(filming, frames, *sink, run, progress);
  }
  run.put_aside();
  if (drawn && !options.common.quiet) std::fprintf(stderr, "%s\n", options.out.c_str());
  const int code = run.end();
  if (code == kOk) tell_kept_folder(options);
  return code;
}

// Films a run again from time 0. A checkpoint precedes only the pieces that follow it, so it cannot
// replace a damaged piece.
template <int D>
int film_again(RenderOptions options, std::vector<ComparedScene> scenes, const View& view,
               const std::filesystem::path& checkpoint, const FilmState& film,
               const FrameRange& frames) {
  options.checkpoints.resume.clear();
  options.common.seed = scenes[0].seed;
  options.overwrite = true;
  scenes[0].scene = load(options.common);
  return film_run<D>(options, scenes, view, std::nullopt, checkpoint, restarted(film), frames);
}

// Refuses an output that is the scene or its start state.
void require_apart(const RenderOptions& options, const Scene& scene) {
  const Output output{"--out", options.out};
  require_distinct({&output, 1}, inputs_of(options.common, options.checkpoints, scene, ""));
}

// Joins the parts of the film.
int join(const RenderOptions& options, const Scene& scene, const FilmState& film) {
  require_apart(options, scene);
  if (!options.film()) {
    throw UserError({"--join", 0, 0}, "only films are joined",
                    "give a film such as film.mp4 as --out");
  }
  require_writable_file(options.out, "--out");
  join_parts(options.join, film.times.count, film.times.fps, options.out);
  if (!options.common.quiet) std::fprintf(stderr, "%s\n", options.out.c_str());
  return kOk;
}

// Gives the film to Slurm.
int submit(const RenderOptions& options, const Scene& scene, const FilmState& film) {
  if (options.one_picture()) {
    throw UserError({"--slurm", 0, 0}, "one picture needs no tasks",
                    "give a film or a folder as --out, or omit --slurm");
  }
  require_apart(options, scene);
  const std::filesystem::path script =
      write_film_job({.scene = scene,
                      .seed = options.common.seed.value_or(1),
                      .film = film,
                      .out = options.out,
                      .backend = options.backend,
                      .threads = options.threads.value_or(kEncodingThreads),
                      .tasks = options.slurm,
                      .limits = options.limits,
                      .overwrite = options.overwrite});
  if (!options.dry_run) submit_batch(script);
  print(script.string() + '\n');
  return kOk;
}

int render(const RenderOptions& options) {
  require_comparable(options);
  Scene scene = load(options.common, options.checkpoints.start_file());
  std::optional<Resumed> resumed = resume(options.common, options.checkpoints, scene);
  const FilmState film = film_asked_for(options, scene.view, resumed);
  const FrameRange frames = frames_asked_for(options, film);
  View view = scene.view;
  view.overlay = film.overlay;
  const std::uint64_t seed = options.common.seed.value_or(resumed ? resumed->checkpoint.seed : 1);
  const std::vector<ComparedScene> scenes =
      compared_scenes({scene, seed}, options.compare, options.common, options.seed_flag);
  require_cells(film.size, static_cast<int>(scenes.size()));
  for (const ComparedScene& compared : scenes) {
    require_few_windows(compared.scene.view, film.times.last());
  }
  require_folder_of(options.out, "--out");
  require_format(options, film);
  if (!options.join.empty()) return join(options, scene, film);
  if (options.slurm > 0) return submit(options, scene, film);
  const std::filesystem::path checkpoint =
      checkpoint_path(options.common, options.checkpoints, resumed, options.out);
  std::vector<Output> outputs = {{"--checkpoint", checkpoint},
                                 {"--checkpoint", previous_checkpoint(checkpoint)},
                                 {"--out", options.out}};
  if (options.film()) outputs.push_back({"--out", pieces_folder(options.out)});
  std::vector<std::filesystem::path> inputs =
      inputs_of(options.common, options.checkpoints, scene, checkpoint);
  for (auto& input : inputs_of(options.compare, scenes)) inputs.push_back(std::move(input));
  require_distinct(outputs, inputs);
  require_checkpoint_place(checkpoint, options.checkpoints);
  catch_interrupts();
  const bool same_laws = resumed && changed_laws(*resumed).empty();
  return with_dimension(scene.dimension(), [&](auto dimension) {
    try {
      return film_run<dimension>(options, scenes, view, std::move(resumed), checkpoint, film,
                                 frames);
    } catch (const DamagedPiece& damage) {
      if (!same_laws) throw;
      std::fprintf(stderr, "clatter: %s; the film restarts from its beginning\n",
                   damage.problem().c_str());
    }
    return film_again<dimension>(options, scenes, view, checkpoint, film, frames);
  });
}

}  // namespace

void add_render_command(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = program.add_subcommand("render", "Film a scene, or draw one picture of it.");
  add_common_flags(*command, options->common);
  command
      ->add_option("scenes", options->compare.scenes,
                   "Up to three more scenes. The film shows all gases beside each other.")
      ->type_name("SCENE");
  command
      ->add_option("--compare", options->compare.settings,
                   "Show the scene also with another value of a key, in a further cell beside it. "
                   "Repeatable, up to four cells. --set applies to all cells.")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_progress_flag(*command, options->common);
  add_checkpoint_flags(*command, options->checkpoints);
  command
      ->add_option(
          "--out", options->out,
          "The file extension selects the format. Films end in .mp4, .webm, .gif, .mov (ProRes, "
          "for editing), or .mkv (without loss). One picture ends in .png. A folder gets a picture "
          "for each frame.")
      ->required()
      ->type_name("FILE|DIR");
  command
      ->add_option("-q,--quality", options->quality,
                   "Size and frame rate. -ql: 854x480, 15 frames a second. -qm: 1280x720, 30. -qh: "
                   "1920x1080, 60; in a GIF 50. Default: m.")
      ->transform(
          one_of<Quality>({{"l", Quality::Low}, {"m", Quality::Medium}, {"h", Quality::High}}))
      ->type_name("l|m|h");
  command
      ->add_option("--size", options->size,
                   "Size of the picture in pixels. Default: the size of --quality.")
      ->type_name("WIDTHxHEIGHT");
  command
      ->add_option(
          "--fps", options->fps,
          "Frames per second of film, at most 50 in a GIF. Default: the rate of --quality.")
      ->check(number_between(1.0, 1000.0));
  command
      ->add_option("--from", options->from,
                   "Simulation time of the first frame, or of the one picture. Default: 0, or the "
                   "time of the checkpoint.")
      ->check(non_negative_number());
  command
      ->add_option(
          "--to", options->to,
          "Simulation time at the end of the film, or of the one picture. Default: 20 s of film, "
          "and a picture after 10 s.")
      ->check(non_negative_number());
  command
      ->add_option("--speed", options->speed,
                   "Simulation time per second of film. Default: view.speed of the scene.")
      ->check(positive_number());
  command
      ->add_option(
          "--supersample", options->supersample,
          "Samples per pixel, along each axis. They are averaged in linear light. Default: "
          "1.")
      ->check(whole_number_between(1, 4));
  command
      ->add_option("--shutter", options->shutter,
                   "Motion blur. The value is the open share of the time between two "
                   "frames. Default: 0.")
      ->check(number_between(0.0, 1.0));
  command
      ->add_option("--threads", options->threads,
                   "Number of threads that run a large gas, and that encode the pictures of a "
                   "folder. The pictures do not depend on it. Default: the number of processors, "
                   "and 2 for encoding.")
      ->check(whole_number_between(1, 256));
  command->add_flag("--no-overlay", options->no_overlay,
                    "Draw no title, time, colour bar and scale bar.");
  command->add_flag("--transparent", options->transparent,
                    "Draw no background. For PNG pictures, and for films .mov, .webm and .mkv.");
  command->add_flag("--sound", options->sound,
                    "Give a film the sound of its collisions. A folder gets it as sound.wav.");
  command->add_flag("--overwrite", options->overwrite,
                    "Replace existing frames in a folder, or an interrupted film.");
  CLI::Option* frames = command
                            ->add_option("--frames", options->frames,
                                         "Draw these frames of the film only, numbered from 0, "
                                         "without END. Parts from several "
                                         "machines make one film.")
                            ->type_name("FIRST:END");
  CLI::Option* join =
      command
          ->add_option(
              "--join", options->join,
              "Join the films FIRST.EXTENSION in a folder to the film --out, without drawing. "
              "FIRST is the number of the first frame of a part.")
          ->check(named_file())
          ->type_name("DIR")
          ->excludes(frames);
  CLI::Option* slurm =
      command
          ->add_option(
              "--slurm", options->slurm,
              "Draw the film in this number of tasks on a cluster. The folder FILE.slurm gets "
              "the batch script, the logs and the parts. The task that ends last joins them.")
          ->check(whole_number_between(1, 1000))
          ->type_name("TASKS")
          ->excludes(frames)
          ->excludes(join);
  for (const char* flag : {"--resume", "--checkpoint"}) {
    join->excludes(command->get_option(flag));
    slurm->excludes(command->get_option(flag));
  }
  add_cluster_flags(*command, options->limits, options->dry_run, slurm);
  add_backend_flag(*command, options->backend);
  command->callback([options, command, &exit_code] {
    options->seed_flag = command->count("--seed") > 0;
    exit_code = render(*options);
  });
}

}  // namespace clatter
