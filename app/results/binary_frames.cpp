#include "app/results/binary_frames.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "app/results/gsd_reader.h"
#include "app/results/h5md_reader.h"
#include "app/results/isolated_hdf5.h"
#include "engine/checkpoint/archive.h"
#include "engine/error.h"
#include "engine/physics/state.h"
#include "engine/scene/text.h"

namespace clatter {

namespace {

std::vector<ParticleFrame::Vector> vectors_of(const std::vector<double>& numbers,
                                              std::size_t components) {
  std::vector<ParticleFrame::Vector> vectors(numbers.size() / components);
  for (std::size_t k = 0; k < vectors.size() * components; ++k) {
    vectors[k / components][k % components] = numbers[k];
  }
  return vectors;
}

void require_unit_diameters(const std::filesystem::path& path,
                            const std::vector<double>& diameters) {
  for (const double diameter : diameters) {
    if (diameter == 1.0) continue;
    throw UserError({path.string()}, "a diameter is " + number_text(diameter) + " instead of 1",
                    "divide all lengths by the diameter");
  }
}

ParticleFrame h5md_frame(const std::filesystem::path& path, std::optional<std::size_t> wanted) {
  const H5mdReader reader(path);
  const std::size_t place = wanted.value_or(std::max<std::size_t>(reader.frames(), 1) - 1);
  if (place >= reader.frames()) refuse_frame(path, reader.frames());
  const std::size_t components = reader.components();
  ParticleFrame frame;
  frame.number = step_of(reader.step(place));
  frame.time = reader.time(place);
  frame.positions = vectors_of(reader.vectors("position", place), components);
  frame.velocities = vectors_of(reader.vectors("velocity", place), components);
  if (reader.has("image")) frame.images = vectors_of(reader.vectors("image", place), components);
  if (components == 3 && reader.has("angular_velocity")) {
    frame.spins = vectors_of(reader.vectors("angular_velocity", place), components);
  }
  if (reader.has("mass")) frame.masses = reader.numbers("mass", place);
  if (reader.has("diameter")) require_unit_diameters(path, reader.numbers("diameter", place));
  const std::vector<double> lengths = reader.box(place);
  const std::vector<bool> periodic = reader.periodic();
  frame.box.emplace();
  for (std::size_t axis = 0; axis < components; ++axis) {
    frame.box->lengths[axis] = lengths[axis];
    frame.box->periodic[axis] = periodic[axis];
  }
  frame.dimension = is_flat(frame) ? 2 : 3;
  return frame;
}

}  // namespace

ParticleFrame read_gsd_frame(const std::filesystem::path& path, std::optional<std::size_t> wanted) {
  GsdReader reader(path);
  const std::uint64_t place = wanted.value_or(std::max<std::uint64_t>(reader.frames(), 1) - 1);
  if (place >= reader.frames()) refuse_frame(path, reader.frames());
  const auto first = [&](const std::string& name, double otherwise) {
    const std::vector<double> numbers = reader.numbers(name, place, 1);
    return numbers.empty() ? otherwise : numbers.front();
  };
  const double count = first("particles/N", 0.0);
  if (!(count >= 0.0 && count <= kMaxParticles<2>)) {
    throw UserError({path.string()}, "the number of particles is " + number_text(count),
                    "give a smaller file");
  }
  const auto particles = static_cast<std::uint64_t>(count);
  const auto vectors = [&](const std::string& name) {
    return vectors_of(reader.numbers(name, place, 3 * particles), 3);
  };
  ParticleFrame frame;
  frame.number = step_of(first("configuration/step", 0.0));
  frame.time = first("log/time", 0.0);
  frame.dimension = first("configuration/dimensions", 3.0) == 2.0 ? 2 : 3;
  require_unit_diameters(path, reader.numbers("particles/diameter", place, particles));

  const std::vector<double> box = reader.numbers("configuration/box", place, 6);
  if (box.empty()) throw UserError({path.string()}, "the box is missing", "give another file");
  if (box[3] != 0.0 || box[4] != 0.0 || box[5] != 0.0) {
    throw UserError({path.string()}, "the box is tilted", "give a file with a rectangular box");
  }
  frame.box = ParticleBox{{box[0], box[1], box[2]}, {true, true, frame.dimension == 3}};
  const std::vector<double> exact = reader.numbers("log/configuration/box", place, 3);
  const std::vector<double> periodic = reader.numbers("log/configuration/periodic", place, 3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!exact.empty()) frame.box->lengths[axis] = exact[axis];
    if (!periodic.empty()) frame.box->periodic[axis] = periodic[axis] != 0.0;
  }

  frame.positions = vectors("log/particles/position");
  frame.velocities = vectors("log/particles/velocity");
  frame.spins = vectors("log/particles/angular_velocity");
  frame.images = vectors("particles/image");
  frame.masses = reader.numbers("particles/mass", place, particles);
  if (frame.velocities.empty()) frame.velocities = vectors("particles/velocity");
  if (frame.positions.empty()) {
    frame.positions = vectors("particles/position");
    for (ParticleFrame::Vector& position : frame.positions) {
      for (int axis = 0; axis < frame.dimension; ++axis) {
        position[axis] += 0.5 * frame.box->lengths[axis];
      }
    }
  }
  frame.velocities.resize(frame.positions.size());  // HOOMD-blue omits velocities that are 0
  const std::vector<double> inertia =
      reader.numbers("particles/moment_inertia", place, 3 * particles);
  if (!inertia.empty() && inertia.back() > 0.0) frame.inertia = 4.0 * inertia.back();
  return frame;
}

ParticleFrame read_h5md_frame(const std::filesystem::path& path,
                              std::optional<std::size_t> wanted) {
  const std::string bytes = read_hdf5_apart(path, [&] {
    ParticleFrame frame = h5md_frame(path, wanted);
    ArchiveWriter writer;
    writer(frame);
    return writer.written();
  });
  ParticleFrame frame;
  ArchiveReader reader(bytes, path.string());
  reader(frame);
  reader.finish();
  return frame;
}

}  // namespace clatter
