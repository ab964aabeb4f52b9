#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "app/commands/flags.h"
#include "app/film/compared_scenes.h"
#include "app/film/film.h"
#include "app/film/film_job.h"
#include "app/runs/run.h"
#include "render/context/context.h"
#include "render/output/movie.h"

namespace clatter {

/// Presets of picture size and frame rate.
enum class Quality { Low, Medium, High };

/// The flags of `clatter render`.
struct RenderOptions {
  CommonOptions common;
  CheckpointOptions checkpoints;
  CompareOptions compare;
  bool seed_flag = false;  ///< whether --seed is given
  std::string out;
  std::optional<Quality> quality;   ///< absent: medium
  std::optional<std::string> size;  ///< absent: size of the quality
  std::optional<double> fps;        ///< absent: rate of the quality
  std::optional<double> from;       ///< absent: 0, or the time of the checkpoint
  std::optional<double> to;
  std::optional<double> speed;
  std::optional<std::string> frames;  ///< absent: all
  std::optional<int> supersample;     ///< absent: 1
  std::optional<double> shutter;      ///< absent: 0
  std::optional<Encoding> encoding;   ///< absent: balanced
  std::optional<int> threads;         ///< of a large gas and of encoding
  bool no_overlay = false;
  bool transparent = false;
  bool sound = false;
  bool overwrite = false;
  Backend backend = Backend::Auto;
  std::string join;  ///< folder of the parts of the film; empty: draw it
  int slurm = 0;     ///< tasks of an array job; 0: draw the film here
  TaskLimits limits;
  bool dry_run = false;

  /// File extension of the output, with its dot.
  std::string extension() const { return std::filesystem::path(out).extension(); }
  /// Whether the output is one picture, a film in a file, or a GIF.
  bool one_picture() const { return extension() == ".png"; }
  bool film() const { return Movie::knows(extension()); }
  bool gif() const { return extension() == ".gif"; }
};

/// Removes the plots of the scene for a film of the gas alone, by --no-overlay of this command or
/// of the one that began the resumed film. Plots of --set remain.
void remove_plots(const RenderOptions& options, Scene& scene, std::optional<Resumed>& resumed);

/// The film to draw: from the checkpoint, unless the flags give another beginning. Throws UserError
/// if the flags contradict each other or the checkpoint.
FilmState film_asked_for(const RenderOptions& options, const View& view,
                         const std::optional<Resumed>& resumed);

/// The same film at its beginning.
FilmState restarted(FilmState film);

/// The frames of --frames; all without it. Throws UserError if the film has no frame of them.
FrameRange frames_asked_for(const RenderOptions& options, const FilmState& film);

/// Throws UserError if the format cannot have the settings of the film.
void require_format(const RenderOptions& options, const FilmState& film);

/// Throws UserError for flags that a film of several gases cannot have.
void require_comparable(const RenderOptions& options);

/// Throws UserError if a film of these gases has cells that are too small, or too many windows of
/// averages.
void require_cells(const FilmState& film, std::span<const ComparedScene> scenes);

}  // namespace clatter
