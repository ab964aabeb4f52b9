#include "app/runs/convert.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "app/results/frame_reader.h"
#include "app/results/three_axes.h"
#include "app/results/trajectory_file.h"
#include "app/runs/picture_scene.h"
#include "app/system/exit_code.h"
#include "app/system/interrupt.h"
#include "app/system/missing_newline.h"
#include "app/system/outputs.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/publish/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "engine/scene/state_file.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

void set_box(ParticleFrame& frame, const Scene& scene) {
  frame.box.emplace();
  frame.inertia = scene.particles.inertia;
  for (int axis = 0; axis < scene.dimension(); ++axis) {
    frame.box->lengths[axis] = scene.box[axis];
    frame.box->periodic[axis] = scene.periodic(axis);
  }
}

template <class Vectors>
std::vector<ParticleFrame::Vector> all_in_space(const Vectors& vectors) {
  std::vector<ParticleFrame::Vector> all;
  for (const auto& vector : vectors) all.push_back(in_space(vector));
  return all;
}

ParticleFrame frame_of_checkpoint(const std::string& file) {
  const Checkpoint checkpoint = read_checkpoint(file);
  const Scene scene = parse_scene(checkpoint.scene, file, {}, StartFile::Skip);
  return with_dimension(scene.dimension(), [&](auto dimension) {
    constexpr int D = dimension;
    const ScheduledRun<D> run(scene, checkpoint.seed, std::get<RunState<D>>(checkpoint.saved));
    const State<D> state = run.simulation().state();
    ParticleFrame frame;
    frame.dimension = D;
    frame.time = run.simulation().time();
    set_box(frame, run.laws());
    frame.positions = all_in_space(state.positions);
    frame.velocities = all_in_space(state.velocities);
    frame.spins = all_in_space(state.spins);
    frame.images.resize(frame.positions.size());
    return frame;
  });
}

bool is_text(TrajectoryFormat format) {
  return format != TrajectoryFormat::Gsd && format != TrajectoryFormat::H5md;
}

ParticleFrame frame_of_file(const ConvertOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::exists(options.in, ignored)) {
    throw UserError({options.in}, "there is no such file", "check the name");
  }
  if (std::filesystem::is_directory(options.in, ignored)) {
    throw UserError({options.in}, "this is a folder", "give a file in it");
  }
  if (!is_special(options.in) && is_checkpoint(options.in)) {
    if (options.frame) {
      throw UserError({"--frame", 0, 0}, "a checkpoint has one state", "omit --frame");
    }
    return frame_of_checkpoint(options.in);
  }
  const TrajectoryFormat format = trajectory_format(options.in, "IN");
  if (is_text(format)) tell_missing_newline(options.in);
  return read_frame(options.in, format, options.frame);
}

// Gives the particles of a CSV the box of the scene.
void add_box(ParticleFrame& frame, const ConvertOptions& options) {
  if (options.scene.empty()) return;
  if (frame.box) {
    throw UserError({"--scene", 0, 0}, options.in + " has a box", "omit --scene");
  }
  const Scene scene = load_any_scene(options.scene, {}, StartFile::Skip);
  if (scene.dimension() != frame.dimension) {
    throw UserError({"--scene", 0, 0},
                    "the box has " + std::to_string(scene.dimension()) + " dimensions, and " +
                        options.in + " has " + std::to_string(frame.dimension),
                    "give the scene of the particles");
  }
  set_box(frame, scene);
  wrap_into_box(frame, options.in);
}

template <int D>
State<D> state_of(const ParticleFrame& frame) {
  State<D> state;
  for (const ParticleFrame::Vector& vector : frame.positions) {
    state.positions.emplace_back(Eigen::Map<const Vec<D>>(vector.data()));
  }
  for (const ParticleFrame::Vector& vector : frame.velocities) {
    state.velocities.emplace_back(Eigen::Map<const Vec<D>>(vector.data()));
  }
  for (const ParticleFrame::Vector& vector : frame.spins) {  // that of a disk is along z
    state.spins.emplace_back(Eigen::Map<const Spin<D>>(vector.data() + (D == 2 ? 2 : 0)));
  }
  return state;
}

template <int D>
Model<D> model_of(const ParticleFrame& frame) {
  constexpr double kUniform = D == 2 ? 0.5 : 0.4;
  Model<D> model;
  model.inertia = frame.inertia.value_or(kUniform);
  for (int axis = 0; axis < D; ++axis) {
    model.box[axis] = frame.box->lengths[axis];
    if (frame.box->periodic[axis]) continue;
    model.walls[2 * axis].emplace();
    model.walls[2 * axis + 1].emplace();
  }
  return model;
}

// Writes a trajectory of one frame, completely or not at all.
template <int D>
void write_frame(const std::filesystem::path& path, TrajectoryFormat format,
                 const ParticleFrame& frame) {
  const Model<D> model = model_of<D>(frame);
  TrajectoryFrame<D> written{.number = frame.number,
                             .time = frame.time,
                             .model = model,
                             .state = state_of<D>(frame),
                             .images = {}};
  for (const ParticleFrame::Vector& image : frame.images) {
    written.images.push_back(Eigen::Map<const Vec<D>>(image.data()).template cast<int>());
  }
  const std::filesystem::path target = target_of(path);
  NewFile made = new_file_beside(target);
  if (!made.file) throw RunError("cannot write " + path.string() + ": " + std::strerror(errno));
  made.file.close();
  try {
    const auto file = open_trajectory<D>(made.path, format, model, frame.positions.size(),
                                         !frame.spins.empty(), 0);
    file->add(written);
    file->finish();
    rename_synced(made.path, target);
  } catch (const RunError& error) {
    std::error_code ignored;
    std::filesystem::remove(made.path, ignored);
    std::filesystem::remove(frames_path(made.path, format), ignored);
    std::string text = error.what();
    const std::string hidden = made.path.string();
    if (const std::size_t place = text.find(hidden); place != text.npos) {
      text.replace(place, hidden.size(), path.string());
    }
    throw RunError(text);
  }
}

}  // namespace

int convert(const ConvertOptions& options) {
  const TrajectoryFormat format = trajectory_format(options.out, "OUT");
  const Output out{"OUT", options.out};
  require_distinct({&out, 1}, std::vector<std::filesystem::path>{options.in, options.scene});
  require_writable_file(options.out, "OUT");
  ParticleFrame frame = frame_of_file(options);
  add_box(frame, options);
  catch_interrupts();  // the new file is written whole, and a signal ends the reading at once
  with_dimension(frame.dimension, [&](auto dimension) {
    if (format == TrajectoryFormat::Csv) {
      write_file(options.out, state_to_csv(state_of<dimension>(frame)));
      return;
    }
    if (!frame.box) {
      throw UserError({options.in}, "a CSV has no box", "give its scene with --scene");
    }
    write_frame<dimension>(options.out, format, frame);
  });
  return kOk;
}

}  // namespace clatter
