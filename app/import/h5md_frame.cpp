#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/import/binary_frames.h"
#include "app/import/frame_order.h"
#include "app/results/h5md_reader.h"
#include "app/results/isolated_hdf5.h"
#include "engine/checkpoint/archive.h"
#include "engine/error.h"
#include "engine/text.h"

namespace clatter {

namespace {

// Reads the types of the particles, and their names if they are an enumeration.
void read_types(ParticleFrame& frame, const H5mdReader& reader, std::size_t place,
                const std::filesystem::path& path) {
  for (const double number : reader.numbers("species", place)) {
    if (!(std::fabs(number) <= std::numeric_limits<int>::max()) || number != std::floor(number)) {
      throw UserError({path.string()}, "a species is " + number_text(number),
                      "give whole numbers, or an enumeration");
    }
    frame.types.push_back(static_cast<int>(number));
  }
  const std::map<int, std::string> names = reader.species_names();
  frame.mixture = !names.empty();
  name_types(frame, names);
}

void read_box(ParticleFrame& frame, const H5mdReader& reader, std::size_t place) {
  reader.require_dimension();
  const std::vector<double> lengths = reader.box(place);
  const std::vector<bool> periodic = reader.periodic();
  frame.box.emplace();
  for (std::size_t axis = 0; axis < lengths.size(); ++axis) {
    frame.box->lengths[axis] = lengths[axis];
    frame.box->periodic[axis] = periodic[axis];
  }
}

ParticleFrame h5md_frame(const std::filesystem::path& path, const FrameChoice& choice) {
  const H5mdReader reader(path, choice.group);
  const std::size_t place = choice.frame.value_or(std::max<std::size_t>(reader.frames(), 1) - 1);
  if (place >= reader.frames()) refuse_frame(path, reader.frames());
  const auto vectors = [&](const std::string& name) {
    return vectors_of(reader.vectors(name, place), reader.components());
  };
  ParticleFrame frame;
  frame.positions = vectors("position");
  frame.number = step_of(reader.step(place));
  frame.time = reader.time(place);
  if (choice.needs_velocities || reader.is_sampled("velocity", place)) {
    frame.velocities = vectors("velocity");
  }
  if (reader.has("image")) frame.images = vectors("image");
  if (reader.components() == 3 && reader.has("angular_velocity")) {
    frame.spins = vectors("angular_velocity");
  }
  if (reader.has("mass")) frame.masses = reader.numbers("mass", place);
  if (reader.has("diameter")) frame.diameters = reader.numbers("diameter", place);
  if (reader.has("species")) read_types(frame, reader, place, path);
  for (const std::string name : {"position", "mass", "diameter"}) {
    if (!reader.has(name) || !reader.is_single(name)) continue;
    frame.rounding = 2.0 * std::numeric_limits<float>::epsilon();
  }
  read_box(frame, reader, place);
  if (reader.has("id")) sort_by_id(frame, reader.ids(place), path);
  if (reader.components() == 2 && choice.dimension == 3) {
    throw UserError({path.string()}, "the positions have two components", "omit --dimensions");
  }
  frame.dimension = reader.components() == 2 ? 2 : dimension_of(frame, choice, path);
  move_corner(frame, {});
  return frame;
}

}  // namespace

ParticleFrame read_h5md_frame(const std::filesystem::path& path, const FrameChoice& choice) {
  const std::string bytes = read_hdf5_apart(path, [&] {
    ParticleFrame frame = h5md_frame(path, choice);
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
