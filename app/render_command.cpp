#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/commands.h"
#include "app/flag_checks.h"
#include "app/interrupt.h"
#include "app/run.h"
#include "app/write_file.h"
#include "engine/error.h"
#include "engine/scene/text.h"
#include "render/canvas.h"
#include "render/context/context.h"
#include "render/output/frame_sink.h"
#include "render/renderer.h"

namespace clatter {

namespace {

// Presets of size and rate.
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

struct RenderOptions {
  CommonOptions common;
  CheckpointOptions checkpoints;
  std::string out;
  Quality quality = Quality::Medium;
  std::optional<std::string> size;  // absent: that of the quality
  std::optional<double> fps;        // likewise
  std::optional<double> from;       // absent: 0, or the time of the checkpoint
  std::optional<double> to;
  std::optional<double> speed;
  int supersample = 1;
  bool no_overlay = false;
  bool overwrite = false;
  Backend backend = Backend::Auto;
};

// When the frames are: k-th at from + k interval.
struct FrameTimes {
  double from;
  double interval;
  long count;

  double last() const { return from + static_cast<double>(count - 1) * interval; }
};

Size parse_size(const std::string& text) {
  Size size;
  char after;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &after) == 2 &&
      size.width >= 16 && size.height >= 16 && size.width <= 16384 && size.height <= 16384) {
    return size;
  }
  throw UserError({"--size", 0, 0}, "'" + text + "' is no picture size",
                  "write WIDTHxHEIGHT, each from 16 to 16384, for instance 1280x720");
}

double fps_of(const RenderOptions& options) {
  return options.fps.value_or(preset_of(options.quality).fps);
}

// The run is at `start`, 0 or the time of a checkpoint, and the film begins there or at --from.
FrameTimes frame_times(const RenderOptions& options, double start, double speed) {
  constexpr double kFilmSeconds = 20.0;
  constexpr double kPictureSeconds = 10.0;  // into the film, where one picture is asked for
  const bool one_picture = std::filesystem::path(options.out).extension() == ".png";
  const double from = options.from.value_or(start);
  if (from < start) {
    throw UserError({"--from", 0, 0}, "the checkpoint is at t = " + number_text(start),
                    "give a time after that, or leave --from out");
  }
  const std::optional<double> to = options.to ? options.to : options.common.until;
  if (to && *to < from) {
    throw UserError({"--to", 0, 0}, "the film would end before it begins",
                    "give a time after " + number_text(from) + ", that of --from or --resume");
  }
  if (one_picture) {
    const double time = options.from ? from : from + kPictureSeconds * speed;
    return {to.value_or(time), 0.0, 1};
  }
  const double interval = speed / fps_of(options);
  const double span = to ? *to - from : kFilmSeconds * speed;
  constexpr double kMostFrames = 1e7;
  const double frames = std::max(1.0, std::round(span / interval));
  if (frames > kMostFrames) {
    throw UserError({"--to", 0, 0}, "the film would have " + number_text(frames) + " frames",
                    "choose a larger --speed, or an earlier --to");
  }
  return {from, interval, static_cast<long>(frames)};
}

// Draws one frame after the other; fewer than there are times where the run ended early.
long film(Run& run, const View& view, const OverlayText& text, const FrameTimes& times,
          Renderer& renderer, const Canvas& canvas, FrameSink& sink, Progress& progress) {
  canvas.bind();
  run.scheduled().show(view);
  std::optional<Camera> camera;
  for (long k = 0; k < times.count; ++k) {
    const double time = times.from + static_cast<double>(k) * times.interval;
    if (!run.until(time, progress)) return k;
    const Snapshot snapshot = run.scheduled().snapshot();
    if (!camera) camera = renderer.fit(snapshot, canvas.size(), view, text);
    renderer.draw(snapshot, *camera, canvas.size(), view, text);
    sink.add(canvas.read(), time);
    progress.update(time);
  }
  return times.count;
}

int render(const RenderOptions& options) {
  Scene scene = load(options.common, options.checkpoints.start_file());
  View view = scene.view;
  if (options.speed) view.speed = *options.speed;
  view.overlay = view.overlay && !options.no_overlay;
  std::optional<Resumed> resumed = resume(options.checkpoints, scene);
  const FrameTimes times = frame_times(options, resumed ? resumed->time() : 0.0, view.speed);
  const Size size = parse_size(options.size.value_or(preset_of(options.quality).size));
  constexpr double kMostWindows = 1e7;
  if (view.shows_averages() && times.last() / view.window > kMostWindows) {
    throw UserError({"view.window", 0, 0}, number_text(view.window) + " is too short for this film",
                    "choose at least " + number_text(times.last() / kMostWindows));
  }
  const Output outputs[] = {{"--out", options.out}, {"--checkpoint", options.checkpoints.file}};
  require_distinct(outputs);
  require_folder_of(options.out, "--out");
  catch_interrupts();

  Run run("render", scene, options.common, options.checkpoints, std::move(resumed), options.out);
  const auto context = open_context(options.backend);
  const Canvas canvas(context->gl(), size);
  Renderer renderer(context->gl(), options.supersample);
  SinkOptions sink_options;
  sink_options.size = size;
  sink_options.fps = fps_of(options);
  sink_options.texts = {{"Title", scene.title},
                        {"Software", "clatter " CLATTER_VERSION},
                        {"Seed", std::to_string(run.seed())},
                        {"Scene", scene_to_toml(scene)}};
  sink_options.threads = options.common.threads;
  sink_options.overwrite = options.overwrite;
  const auto sink = open_sink(options.out, sink_options);
  long frames;
  {
    Progress progress(options.common.shown_progress(), "filming", run.simulation().time(),
                      times.last());
    frames =
        film(run, view, {scene.title, scene.caption}, times, renderer, canvas, *sink, progress);
  }
  run.put_aside();
  if (frames == 0) return run.end();
  sink->finish();
  if (!options.common.quiet) std::fprintf(stderr, "%s\n", options.out.c_str());
  return run.end();
}

}  // namespace

void add_render_command(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      program.add_subcommand("render", "Film a scene, or draw one picture of it, without a window");
  add_common_flags(*command, options->common);
  add_checkpoint_flags(*command, options->checkpoints);
  command
      ->add_option(
          "--out", options->out,
          "FILE.mp4, .webm, .gif or, without loss, .mkv (film), FILE.png (one picture), or DIR "
          "(a picture a frame)")
      ->required();
  command
      ->add_option("-q,--quality", options->quality,
                   "-ql: 854x480, 15 frames a second; -qm: 1280x720, 30; -qh: 1920x1080, 60 "
                   "(default: m)")
      ->transform(
          one_of<Quality>({{"l", Quality::Low}, {"m", Quality::Medium}, {"h", Quality::High}}))
      ->type_name("l|m|h");
  command->add_option("--size", options->size, "Picture size in pixels (default: the quality's)")
      ->type_name("WIDTHxHEIGHT");
  command->add_option("--fps", options->fps, "Frames per second of film (default: the quality's)")
      ->check(number_between(1.0, 1000.0));
  command
      ->add_option("--from", options->from,
                   "Simulation time of the first frame, or of the one picture (default: 0, or that "
                   "of the checkpoint)")
      ->check(non_negative_number());
  command
      ->add_option(
          "--to", options->to,
          "Simulation time of the film's end, or of the one picture (default: 20 s of film; a "
          "picture 10 s into it)")
      ->check(non_negative_number());
  command
      ->add_option("--speed", options->speed,
                   "Simulation time per second of film (default: the scene's view.speed)")
      ->check(positive_number());
  command
      ->add_option("--supersample", options->supersample,
                   "Draw all but the overlay so many times larger, and average in linear light")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  command->add_flag("--no-overlay", options->no_overlay,
                    "Draw no title, time, colour bar, scale bar");
  command->add_flag("--overwrite", options->overwrite,
                    "Replace frames that a folder holds already");
  add_backend_flag(*command, options->backend);
  command->callback([options, &exit_code] { exit_code = render(*options); });
}

}  // namespace clatter
