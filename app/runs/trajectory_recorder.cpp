#include "app/runs/trajectory_recorder.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "engine/checkpoint/archive.h"
#include "engine/error.h"
#include "engine/text.h"

namespace clatter {

namespace {

// The part of a recorder that a checkpoint keeps, besides the images.
struct SavedTrajectory {
  double every = 0.0;
  std::uint64_t next = 0;
  std::uint64_t bytes = 0;
  std::uint8_t format = 0;  // TrajectoryFormat
  bool spins = false;
  bool sheared = false;
};

template <class Archive>
void visit(Archive& io, SavedTrajectory& saved) {
  auto& [every, next, bytes, format, spins, sheared] = saved;
  io(every, next, bytes, format, spins, sheared);
}

// Moves the particles of a sheared box into the cell whose edge along y leads to the next image
// above. Readers require that it leans by at most half a side.
template <int D>
void put_into_tilted_cell(TrajectoryFrame<D>& frame, const Domain<D>& domain) {
  const double length = domain.box[0], height = domain.box[1];
  const double boxes = std::round(domain.offset / length);
  frame.tilt = domain.offset - boxes * length;
  for (std::size_t i = 0; i < frame.images.size(); ++i) {
    Vec<D>& r = frame.state.positions[i];
    IntVec<D>& image = frame.images[i];
    const double out = std::floor((r[0] - frame.tilt * r[1] / height) / length);
    r[0] -= out * length;
    image[0] += static_cast<int>(boxes) * image[1] + static_cast<int>(out);
  }
}

}  // namespace

template <int D>
TrajectoryRecorder<D>::TrajectoryRecorder(const std::filesystem::path& path, double every,
                                          bool spins, const std::vector<std::string>& species,
                                          Simulation<D>& simulation)
    : format_(trajectory_format(path, "--trajectory")),
      path_(path),
      every_(every),
      particles_(particles_of(simulation, spins, species)),
      times_(every),
      next_(times_.first_from(simulation.time())) {
  images_.emplace(simulation);
  open(simulation, 0);
}

template <int D>
TrajectoryRecorder<D>::TrajectoryRecorder(const std::filesystem::path& path, double every,
                                          bool spins, const std::vector<std::string>& species,
                                          Simulation<D>& simulation, const std::string& saved,
                                          const std::string& checkpoint)
    : format_(trajectory_format(path, "--trajectory")),
      path_(path),
      every_(every),
      particles_(particles_of(simulation, spins, species)),
      times_(every) {
  images_.emplace(simulation);
  ArchiveReader reader(saved, checkpoint);
  SavedTrajectory before;
  reader(before, *images_);
  reader.finish();
  if (before.every != every) {
    throw UserError(
        {"--every", 0, 0},
        "the trajectory of the checkpoint has the interval " + number_text(before.every),
        "give this interval");
  }
  if (before.format != static_cast<std::uint8_t>(format_)) {
    throw UserError({"--trajectory", 0, 0},
                    path.string() + " has another format than the trajectory of the checkpoint",
                    "name the trajectory of the interrupted run");
  }
  if (before.spins != spins) {
    throw UserError({"--trajectory", 0, 0},
                    before.spins ? "the trajectory of the checkpoint has angular velocities"
                                 : "the trajectory of the checkpoint has no angular velocities",
                    "resume the run without changes of roughness, or without --trajectory");
  }
  if (before.sheared != particles_.sheared) {
    throw UserError({"--trajectory", 0, 0},
                    before.sheared ? "the trajectory of the checkpoint has a tilted cell"
                                   : "the trajectory of the checkpoint has no tilted cell",
                    "resume the run without a change of [shear], or without --trajectory");
  }
  reader.require(!simulation.is_overdue(0.0, every, before.next));
  next_ = before.next;
  open(simulation, before.bytes);
}

template <int D>
TrajectoryParticles TrajectoryRecorder<D>::particles_of(const Simulation<D>& simulation, bool spins,
                                                        const std::vector<std::string>& species) {
  TrajectoryParticles particles{.count = simulation.particles().size(),
                                .spins = spins,
                                .sheared = simulation.model().shear_rate.has_value(),
                                .species = species};
  for (std::uint32_t i = 0; !species.empty() && i < particles.count; ++i) {
    particles.grains.push_back(simulation.grain(i));
  }
  return particles;
}

template <int D>
void TrajectoryRecorder<D>::open(const Simulation<D>& simulation, std::uint64_t bytes) {
  file_ = open_trajectory<D>(path_, format_, simulation.model(), particles_, bytes);
}

template <int D>
void TrajectoryRecorder<D>::add(const Simulation<D>& simulation) {
  TrajectoryFrame<D> frame{.number = static_cast<long>(next_),
                           .time = simulation.time(),
                           .model = simulation.model(),
                           .particles = particles_,
                           .state = simulation.state(),
                           .images = images_->images()};
  if (const Domain<D> domain = simulation.domain(); domain.sheared) {
    put_into_tilted_cell(frame, domain);
  }
  frame.state.spins.resize(particles_.spins ? frame.state.positions.size() : 0, Spin<D>::Zero());
  file_->add(frame);
  ++next_;
}

template <int D>
std::string TrajectoryRecorder<D>::save() {
  file_->sync();
  SavedTrajectory saved{every_,           next_,
                        file_->bytes(),   static_cast<std::uint8_t>(format_),
                        particles_.spins, particles_.sheared};
  ArchiveWriter writer;
  writer(saved, *images_);
  return writer.written();
}

template <int D>
void TrajectoryRecorder<D>::finish() {
  file_->finish();
}

template <int D>
std::string TrajectoryRecorder<D>::flags() const {
  return fmt::format("--trajectory {} --every {}", path_.string(), every_);
}

template class TrajectoryRecorder<2>;
template class TrajectoryRecorder<3>;

}  // namespace clatter
