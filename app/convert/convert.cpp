#include "app/convert/convert.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "app/import/frame_reader.h"
#include "app/import/frame_species.h"
#include "app/results/three_axes.h"
#include "app/results/trajectory_file.h"
#include "app/results/vtp_trajectory.h"
#include "app/runs/picture_scene.h"
#include "app/system/exit_code.h"
#include "app/system/missing_newline.h"
#include "app/system/outputs.h"
#include "engine/checkpoint/checkpoint.h"
#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/initial/gaussian_velocities.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "engine/scene/state_file.h"
#include "engine/system/signals.h"
#include "engine/system/write_file.h"
#include "engine/text.h"

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
    frame.species = run.laws().species;
    frame.grains = state.grains;
    return frame;
  });
}

// Throws for a choice that has no meaning for the only state of a checkpoint.
void require_no_choice(const FrameChoice& choice) {
  const auto refuse = [](const std::string& flag, const std::string& problem) {
    throw UserError({flag, 0, 0}, problem, "omit " + flag);
  };
  if (choice.frame) refuse("--frame", "a checkpoint has one state");
  if (choice.dimension) refuse("--dimensions", "a checkpoint has disks or spheres");
  if (choice.scale != 1.0) refuse("--scale", "the lengths of a checkpoint are in diameters");
  if (!choice.group.empty()) refuse("--group", "a checkpoint is no H5MD file");
}

// Tells that particles of a deep box are disks.
void note_disks(const ParticleFrame& frame, const ConvertOptions& options) {
  if (options.choice.dimension || frame.dimension == 3 || !frame.box) return;
  if (frame.box->lengths[2] <= frame.largest_diameter() * (1.0 + frame.rounding)) return;
  std::fprintf(stderr,
               "note: all particles of %s move in one plane z, so they are disks; "
               "--dimensions 3 makes spheres\n",
               options.in.c_str());
}

ParticleFrame frame_of_file(const ConvertOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::exists(options.in, ignored)) {
    const std::string list = options.in + ".series";
    throw UserError(
        {options.in}, "there is no such file",
        std::filesystem::exists(list, ignored) ? "give the list " + list : "check the name");
  }
  if (std::filesystem::is_directory(options.in, ignored)) {
    throw UserError({options.in}, "this is a folder", "give a file in it");
  }
  if (!is_special(options.in) && is_checkpoint(options.in)) {
    require_no_choice(options.choice);
    return frame_of_checkpoint(options.in);
  }
  if (is_plain_text(options.in)) note_missing_newline(options.in);
  const ParticleFrame frame = read_frame(options.in, options.choice, "IN");
  note_disks(frame, options);
  return frame;
}

// Throws because particles have a species that the scene lacks.
[[noreturn]] void refuse_names(const ConvertOptions& options, const std::string& problem) {
  throw UserError({"--scene", 0, 0}, problem, "give the scene of " + options.in);
}

// Gives the particles the species of the scene, by their names. Without columns of sizes and masses
// they are those of the species.
void set_species(ParticleFrame& frame, const Scene& scene, const ConvertOptions& options) {
  if (scene.species.empty()) return;
  std::vector<Grain> grains;
  for (std::size_t i = 0; i < frame.positions.size(); ++i) {
    std::size_t number = 0;
    if (!frame.species.empty()) {
      const std::string& name = frame.species[frame.grains[i].species].name;
      const auto found = find_species(scene.species, name);
      if (!found) refuse_names(options, "the scene has no species " + in_quotes(name));
      number = *found;
    } else if (scene.species.size() > 1) {
      refuse_names(options, "the scene has species, and " + options.in + " has none");
    }
    Grain grain = scene.grain(number, 0, 1);
    if (!frame.diameters.empty()) grain.radius = 0.5 * frame.diameters[i];
    if (!frame.masses.empty()) grain.mass = frame.masses[i];
    grains.push_back(grain);
  }
  frame.species = scene.species;
  frame.grains = std::move(grains);
}

// Gives the particles of a file without a box that of the scene, and its species.
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
  set_species(frame, scene, options);
  set_box(frame, scene);
  wrap_into_box(frame, options.in);
}

// Draws the velocities of particles that have none, or are all at rest.
void draw_velocities(ParticleFrame& frame, const ConvertOptions& options) {
  if (!options.temperature) return;
  const auto moves = [](const ParticleFrame::Vector& v) { return v != ParticleFrame::Vector{}; };
  if (std::ranges::any_of(frame.velocities, moves)) {
    throw UserError({"--temperature", 0, 0}, options.in + " has velocities", "omit --temperature");
  }
  with_dimension(frame.dimension, [&](auto dimension) {
    std::vector<double> masses;
    for (const Grain& grain : frame.grains) masses.push_back(grain.mass);
    frame.velocities = all_in_space(
        masses.empty()
            ? gaussian_velocities<dimension()>(frame.positions.size(), *options.temperature,
                                               options.seed)
            : gaussian_velocities<dimension()>(masses, *options.temperature, options.seed));
  });
}

template <int D>
State<D> state_of(const ParticleFrame& frame) {
  State<D> state;
  state.grains = frame.grains;
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
  model.diameter = frame.largest_diameter();
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
  const TrajectoryParticles particles{.count = frame.positions.size(),
                                      .spins = !frame.spins.empty(),
                                      .species = names_of(frame.species),
                                      .grains = frame.grains};
  TrajectoryFrame<D> written{.number = frame.number,
                             .time = frame.time,
                             .model = model,
                             .particles = particles,
                             .state = state_of<D>(frame),
                             .images = {}};
  for (const ParticleFrame::Vector& image : frame.images) {
    written.images.push_back(Eigen::Map<const Vec<D>>(image.data()).template cast<int>());
  }
  if (format == TrajectoryFormat::Vtp) return write_file(path, vtp_text(written));
  const std::filesystem::path target = target_of(path);
  NewFile made = new_file_beside(target);
  if (!made.file) throw RunError("cannot write " + path.string() + ": " + std::strerror(errno));
  made.file.close();
  try {
    const auto file = open_trajectory<D>(made.path, format, model, particles, 0);
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

// Throws for a start state of several kinds whose sizes or masses are in its scene alone.
void require_sizes(const ParticleFrame& frame, const ConvertOptions& options) {
  const bool known = !frame.diameters.empty() && !frame.masses.empty();
  if (!frame.mixture || frame.box || known || !options.scene.empty()) return;
  throw UserError({options.in}, "the columns diameter and mass are missing",
                  "add them, or give the scene of the particles with --scene");
}

// A start state names species, and its scene describes them.
void note_species(const ParticleFrame& frame, TrajectoryFormat format) {
  if (format != TrajectoryFormat::Csv || frame.names.empty() || frame.species.empty()) return;
  std::fprintf(stderr, "note: the scene of this start state needs these species:\n%s",
               species_toml(frame).c_str());
}

}  // namespace

int convert(const ConvertOptions& options) {
  const TrajectoryFormat format = trajectory_format(options.out, "OUT");
  const Output out{"OUT", options.out};
  require_distinct({&out, 1}, std::vector<std::filesystem::path>{options.in, options.scene});
  require_writable_file(options.out, "OUT");
  ParticleFrame frame = frame_of_file(options);
  require_sizes(frame, options);
  add_box(frame, options);
  draw_velocities(frame, options);
  catch_interrupts();  // the new file is written whole, and a signal ends the reading at once
  with_dimension(frame.dimension, [&](auto dimension) {
    if (format == TrajectoryFormat::Csv) {
      write_file(options.out, state_to_csv(state_of<dimension>(frame), frame.species));
      return;
    }
    if (!frame.box) {
      throw UserError({options.in}, "the file has no box", "give its scene with --scene");
    }
    write_frame<dimension>(options.out, format, frame);
  });
  if (options.scene.empty()) note_species(frame, format);
  return kOk;
}

}  // namespace clatter
