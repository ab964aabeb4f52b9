#include "app/results/gsd_trajectory.h"

#include <array>
#include <cstring>

#include "app/results/three_axes.h"

namespace clatter {

namespace {

// The chunks of a frame, in the order of their data in GsdTrajectory::add().
std::vector<GsdChunk> hoomd_chunks(std::uint64_t particles, bool spins) {
  using enum GsdType;
  std::vector<GsdChunk> chunks = {
      {"configuration/step", UInt64, 1},
      {"configuration/dimensions", UInt8, 1, 1, true},
      {"configuration/box", Float, 6, 1, true},
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
  if (!spins) return chunks;
  chunks.push_back({"particles/moment_inertia", Float, particles, 3});
  chunks.push_back({"particles/angmom", Float, particles, 4});
  chunks.push_back({"log/particles/angular_velocity", Double, particles, 3});
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

}  // namespace

template <int D>
GsdTrajectory<D>::GsdTrajectory(const std::filesystem::path& path, std::size_t particles,
                                bool spins, std::uint64_t bytes)
    : spins_(spins), file_(path, hoomd_chunks(particles, spins), bytes) {}

template <int D>
void GsdTrajectory<D>::add(const TrajectoryFrame<D>& frame) {
  const Model<D>& model = frame.model;
  const std::size_t particles = frame.state.positions.size();
  std::array<double, 3> box = in_space(model.box);  // disks have no extent along z
  const auto centred = [&](std::array<double, 3> position) {
    for (std::size_t axis = 0; axis < 3; ++axis) position[axis] -= 0.5 * box[axis];
    return position;
  };
  std::vector<std::uint8_t> periodic;
  for (int axis = 0; axis < 3; ++axis) periodic.push_back(is_periodic(model, axis));
  const auto single = [](double number) { return static_cast<float>(number); };
  std::vector<std::string> data = {
      chunk_bytes(std::vector{static_cast<std::uint64_t>(frame.number)}),
      chunk_bytes(std::vector{static_cast<std::uint8_t>(D)}),
      chunk_bytes(std::vector{single(box[0]), single(box[1]), single(box[2]), 0.0f, 0.0f, 0.0f}),
      chunk_bytes(std::vector{static_cast<std::uint32_t>(particles)}),
      chunk_bytes(std::vector<float>(particles, 1.0f)),
      chunk_bytes(std::vector<float>(particles, single(model.diameter))),
      chunk_bytes<float>(frame.state.positions, centred),
      chunk_bytes<float>(frame.state.velocities),
      chunk_bytes<std::int32_t>(frame.images),
      chunk_bytes(std::vector{frame.time}),
      chunk_bytes(std::vector(box.begin(), box.end())),
      chunk_bytes(periodic),
      chunk_bytes<double>(frame.state.positions),
      chunk_bytes<double>(frame.state.velocities),
  };
  if (spins_) {
    const double inertia = model.grain().moment_of_inertia();
    const double about_plane = D == 2 ? 0.0 : inertia;
    // The angular momentum L is the quaternion (0, 2 L) for particles without rotation.
    const auto momentum = [&](const std::array<double, 3>& spin) {
      return std::array{0.0, 2.0 * inertia * spin[0], 2.0 * inertia * spin[1],
                        2.0 * inertia * spin[2]};
    };
    data.push_back(chunk_bytes<float>(frame.state.spins, [&](const auto&) {
      return std::array{about_plane, about_plane, inertia};
    }));
    data.push_back(chunk_bytes<float>(frame.state.spins, momentum));
    data.push_back(chunk_bytes<double>(frame.state.spins));
  }
  file_.add(data);
}

template class GsdTrajectory<2>;
template class GsdTrajectory<3>;

}  // namespace clatter
