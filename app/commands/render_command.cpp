#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "app/commands/commands.h"
#include "app/commands/film_settings.h"
#include "app/commands/flag_checks.h"
#include "app/commands/flags.h"
#include "app/film/compared_scenes.h"
#include "app/film/film.h"
#include "app/film/film_job.h"
#include "app/film/film_limits.h"
#include "app/runs/picture_scene.h"
#include "app/runs/run.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/system/allocation.h"
#include "engine/system/signals.h"
#include "render/context/context.h"
#include "render/gl/canvas.h"
#include "render/output/film_join.h"
#include "render/output/frame_sink.h"
#include "render/output/movie.h"

namespace clatter {

namespace {

constexpr int kEncodingThreads = 2;

void require_drawable(const FilmState& film, const Gl& gl) {
  const int side = film.samples * std::max(film.size.width, film.size.height);
  const int largest = Canvas::largest_side(gl);
  if (side <= largest) return;
  throw UserError({"--size", 0, 0},
                  "the pictures have " + std::to_string(side) +
                      " samples along a side, and this OpenGL supports " + std::to_string(largest),
                  "give a smaller --size or --supersample");
}

SinkOptions sink_options(const RenderOptions& options, const std::vector<ComparedScene>& scenes,
                         const FilmState& film, const FrameRange& frames) {
  SinkOptions sink;
  sink.size = film.size;
  sink.fps = film.times.fps;
  sink.transparent = film.transparent;
  sink.encoding = film.encoding;
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
void note_kept_folder(const RenderOptions& options) {
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
  if (code == kOk) note_kept_folder(options);
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
  remove_plots(options, scene, resumed);
  const FilmState film = film_asked_for(options, scene.view, resumed);
  const FrameRange frames = frames_asked_for(options, film);
  View view = scene.view;
  view.overlay = film.overlay;
  const std::uint64_t seed = options.common.seed.value_or(resumed ? resumed->checkpoint.seed : 1);
  const std::vector<ComparedScene> scenes =
      compared_scenes({scene, seed}, options.compare, options.common, options.seed_flag);
  require_cells(film, scenes);
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
  add_compare_flags(*command, options->compare, "film");
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
      ->check(number_between(1.0, kMostFps));
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
      ->check(whole_number_between(1, kMostSamples));
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
                    "Draw the gas alone: no title, time, colour bar and scale bar, and no plots "
                    "unless --set view.plots gives some.");
  command->add_flag("--transparent", options->transparent,
                    "Draw no background. For PNG pictures, and for films .mov, .webm and .mkv.");
  command
      ->add_option("--encoding", options->encoding,
                   "CPU time and bytes of a film .mp4 or .webm, at nearly the same quality. fast: "
                   "the least CPU time. small: the least bytes. Default: balanced.")
      ->transform(one_of<Encoding>({{name_of(Encoding::Fast), Encoding::Fast},
                                    {name_of(Encoding::Balanced), Encoding::Balanced},
                                    {name_of(Encoding::Small), Encoding::Small}}))
      ->type_name("fast|balanced|small");
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
