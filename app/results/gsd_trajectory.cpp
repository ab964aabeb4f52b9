#include "app/results/gsd_trajectory.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "app/results/three_axes.h"

namespace clatter {

namespace {

// Bytes of a name of a type: the longest name, and a zero.
std::uint32_t name_width(const TrajectoryParticles& particles) {
  std::size_t longest = 0;
  for (const std::string& name : particles.species) longest = std::max(longest, name.size());
  return static_cast<std::uint32_t>(longest + 1);
}

// The chunks of a frame, in the order of their data in GsdTrajectory::add().
std::vector<GsdChunk> hoomd_chunks(const TrajectoryParticles& all) {
  using enum GsdType;
  const std::uint64_t particles = all.count;
  std::vector<GsdChunk> chunks = {
      {"configuration/step", UInt64, 1},
      {"configuration/dimensions", UInt8, 1, 1, true},
      {"configuration/box", Float, 6, 1, !all.sheared},
      {"particles/N", UInt32, 1, 1, true},
      {"particles/mass", Float, particles, 1, true},
      {"particles/diameter", Float, particles, 1, true},
      {"particles/position", Float, particles, 3},
      {"particles/velocity", Float, particles, 3},
      {"particles/image", Int32, particles, 3},
      {"log/time", Double, 1},
      {"log/configuration/box", Double, 3, 1, true},
      {"log/configuration/periodic", UInt8, 3, 1, true},
      {"log/particles/position", Double, particles, 3},
      {"log/particles/velocity", Double, particles, 3},
  };
  if (all.spins) {
    chunks.push_back({"particles/moment_inertia", Float, particles, 3});
    chunks.push_back({"particles/angmom", Float, particles, 4});
    chunks.push_back({"log/particles/angular_velocity", Double, particles, 3});
  }
  if (all.sheared) chunks.push_back({"log/configuration/tilt", Double, 1});
  if (!all.is_mixture()) return chunks;
  chunks.push_back({"particles/types", Int8, all.species.size(), name_width(all), true});
  chunks.push_back({"particles/typeid", UInt32, particles, 1, true});
  chunks.push_back({"log/particles/mass", Double, particles, 1, true});
  chunks.push_back({"log/particles/diameter", Double, particles, 1, true});
  return chunks;
}

template <class T>
std::string chunk_bytes(const std::vector<T>& numbers) {
  std::string bytes(numbers.size() * sizeof(T), '\0');
  if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

// The components of vectors as numbers of type T, after `change` of each vector.
template <class T, class Vectors, class Change>
std::string chunk_bytes(const Vectors& vectors, const Change& change) {
  std::vector<T> numbers;
  for (const auto& vector : vectors) {
    for (const auto number : change(in_space(vector))) numbers.push_back(static_cast<T>(number));
  }
  return chunk_bytes(numbers);
}

template <class T, class Vectors>
std::string chunk_bytes(const Vectors& vectors) {
  return chunk_bytes<T>(vectors, [](const auto& vector) { return vector; });
}

// A number of each particle.
template <class T, class Value>
std::string grain_bytes(const std::vector<Grain>& grains, const Value& value) {
  std::vector<T> numbers;
  for (const Grain& grain : grains) numbers.push_back(static_cast<T>(value(grain)));
  return chunk_bytes(numbers);
}

double mass_of(const Grain& grain) {
  return grain.mass;
}

double diameter_of(const Grain& grain) {
  return 2.0 * grain.radius;
}

// What each particle is.
template <int D>
std::vector<Grain> all_grains(const TrajectoryFrame<D>& frame) {
  if (frame.particles.is_mixture()) return frame.particles.grains;
  return std::vector<Grain>(frame.state.positions.size(), frame.model.grain());
}

// The names of the types, each filled with zeros.
std::string type_bytes(const TrajectoryParticles& particles) {
  std::string bytes;
  for (const std::string& name : particles.species) {
    bytes += name;
    bytes.resize(bytes.size() + name_width(particles) - name.size(), '\0');
  }
  return bytes;
}

// The moments of inertia about all axes, of disks about z, and the angular momenta. An angular
// momentum L is the quaternion (0, 2 L) for particles without rotation.
template <int D>
std::array<std::string, 2> rotation_bytes(const TrajectoryFrame<D>& frame,
                                          const std::vector<Grain>& grains) {
  std::vector<float> moments, momenta;
  const auto add = [](std::vector<float>& numbers, double number) {
    numbers.push_back(static_cast<float>(number));
  };
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const double inertia = grains[i].moment_of_inertia();
    add(momenta, 0.0);
    const std::array<double, 3> spin = in_space(frame.state.spins[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      add(moments, D == 2 && axis < 2 ? 0.0 : inertia);
      add(momenta, 2.0 * inertia * spin[axis]);
    }
  }
  return {chunk_bytes(moments), chunk_bytes(momenta)};
}

}  // namespace

template <int D>
GsdTrajectory<D>::GsdTrajectory(const std::filesystem::path& path, TrajectoryParticles particles,
                                std::uint64_t bytes)
    : particles_(std::move(particles)), file_(path, hoomd_chunks(particles_), bytes) {}

template <int D>
void GsdTrajectory<D>::add(const TrajectoryFrame<D>& frame) {
  const Model<D>& model = frame.model;
  const std::vector<Grain> grains = all_grains(frame);
  std::array<double, 3> box = in_space(model.box);  // disks have no extent along z
  const auto centred = [&](std::array<double, 3> position) {
    for (std::size_t axis = 0; axis < 3; ++axis) position[axis] -= 0.5 * box[axis];
    position[0] -= 0.5 * frame.tilt;
    return position;
  };
  std::vector<std::uint8_t> periodic;
  for (int axis = 0; axis < 3; ++axis) periodic.push_back(is_periodic(model, axis));
  const auto single = [](double number) { return static_cast<float>(number); };
  std::vector<std::string> data = {
      chunk_bytes(std::vector{static_cast<std::uint64_t>(frame.number)}),
      chunk_bytes(std::vector{static_cast<std::uint8_t>(D)}),
      chunk_bytes(std::vector{single(box[0]), single(box[1]), single(box[2]),
                              single(frame.tilt / box[1]), 0.0f, 0.0f}),
      chunk_bytes(std::vector{static_cast<std::uint32_t>(grains.size())}),
      grain_bytes<float>(grains, mass_of),
      grain_bytes<float>(grains, diameter_of),
      chunk_bytes<float>(frame.state.positions, centred),
      chunk_bytes<float>(frame.state.velocities),
      chunk_bytes<std::int32_t>(frame.images),
      chunk_bytes(std::vector{frame.time}),
      chunk_bytes(std::vector(box.begin(), box.end())),
      chunk_bytes(periodic),
      chunk_bytes<double>(frame.state.positions),
      chunk_bytes<double>(frame.state.velocities),
  };
  if (particles_.spins) {
    const auto [moments, momenta] = rotation_bytes(frame, grains);
    data.insert(data.end(), {moments, momenta, chunk_bytes<double>(frame.state.spins)});
  }
  if (particles_.sheared) data.push_back(chunk_bytes(std::vector{frame.tilt}));
  if (particles_.is_mixture()) {
    data.push_back(type_bytes(particles_));
    data.push_back(grain_bytes<std::uint32_t>(grains, [](const Grain& g) { return g.species; }));
    data.push_back(grain_bytes<double>(grains, mass_of));
    data.push_back(grain_bytes<double>(grains, diameter_of));
  }
  file_.add(data);
}

template class GsdTrajectory<2>;
template class GsdTrajectory<3>;

}  // namespace clatter
