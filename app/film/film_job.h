#pragma once

#include <cstdint>
#include <filesystem>

#include "app/film/film.h"
#include "app/system/batch_script.h"
#include "engine/scene/scene.h"
#include "render/context/context.h"

namespace clatter {

/// A film that an array job draws. Each task draws a part of the frames. The task that ends last
/// joins the parts of a film file; a folder of pictures needs no joining.
struct FilmJob {
  Scene scene;
  std::uint64_t seed = 1;
  FilmState film;             ///< at its beginning
  std::filesystem::path out;  ///< film file, or folder for pictures
  Backend backend = Backend::Auto;
  int threads = 2;  ///< encoding threads of a task
  int tasks = 1;    ///< at most one task per FrameSink::kPiece frames is used
  TaskLimits limits;
  bool overwrite = false;  ///< may replace pictures, or parts of another film
};

/// Writes the folder OUT.slurm with the scene, its start state start.csv, and the batch script
/// job.sh. The tasks write logs, checkpoints and parts into this folder. A folder of the same film
/// keeps its parts, so that a second submission continues the first. Returns the path of the
/// script. Throws UserError if `out` has no known format, or if the job or the pictures of another
/// film would be replaced. Throws RunError if files cannot be written.
std::filesystem::path write_film_job(const FilmJob& job);

}  // namespace clatter
