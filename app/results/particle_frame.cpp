#include "app/results/particle_frame.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/error.h"
#include "engine/text.h"

namespace clatter {

namespace {

using Vector = ParticleFrame::Vector;

// Of the numbers that are finite.
double largest_component(const std::vector<Vector>& vectors) {
  double largest = 0.0;
  for (const Vector& vector : vectors) {
    for (const double number : vector) {
      if (std::isfinite(number)) largest = std::max(largest, std::fabs(number));
    }
  }
  return largest;
}

}  // namespace

double ParticleFrame::largest_diameter() const {
  double largest = grains.empty() ? 1.0 : 0.0;
  for (const Grain& grain : grains) largest = std::max(largest, 2.0 * grain.radius);
  return largest;
}

std::vector<Vector> vectors_of(const std::vector<double>& numbers, std::size_t components) {
  std::vector<Vector> vectors(numbers.size() / components);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    vectors[k / components][k % components] = numbers[k];
  }
  return vectors;
}

std::optional<std::size_t> first_out_of_plane(const ParticleFrame& frame, double scale) {
  const double slowest = frame.rounding * largest_component(frame.velocities);
  const double slowest_spin = frame.rounding * largest_component(frame.spins);
  for (std::size_t i = 0; i < frame.positions.size(); ++i) {
    const double plane = frame.positions.front()[2], z = frame.positions[i][2];
    const double near = frame.rounding * std::max(scale, std::fabs(plane));
    const auto spins_out = [&](int axis) {
      return !frame.spins.empty() && !(std::fabs(frame.spins[i][axis]) <= slowest_spin);
    };
    const bool moves_out =
        !frame.velocities.empty() && !(std::fabs(frame.velocities[i][2]) <= slowest);
    if (!(std::fabs(z - plane) <= near) || moves_out || spins_out(0) || spins_out(1)) return i;
  }
  return std::nullopt;
}

int dimension_of(const ParticleFrame& frame, const FrameChoice& choice,
                 const std::filesystem::path& path) {
  if (choice.dimension == 3) return 3;
  const std::optional<std::size_t> out = first_out_of_plane(frame, choice.scale);
  if (choice.dimension == 2 && out) {
    refuse_particle(frame, *out, path,
                    "the particle is not in the plane of the first, or leaves it",
                    "give disks that move in one plane z");
  }
  if (choice.dimension) return 2;
  if (!frame.positions.empty()) return out ? 3 : 2;
  const double layer = choice.scale * (1.0 + frame.rounding);
  return !frame.box || frame.box->lengths[2] <= layer ? 2 : 3;
}

void move_corner(ParticleFrame& frame, const Vector& corner) {
  for (Vector& position : frame.positions) {
    for (int axis = 0; axis < frame.dimension; ++axis) position[axis] -= corner[axis];
    if (frame.dimension == 2) position[2] = 0.0;
  }
  for (Vector& velocity : frame.velocities) {
    if (frame.dimension == 2) velocity[2] = 0.0;
  }
}

void name_types(ParticleFrame& frame, const std::map<int, std::string>& names) {
  std::map<int, int> places;
  for (const int type : frame.types) places[type] = 0;
  frame.names.clear();
  for (auto& [type, place] : places) {
    const auto name = names.find(type);
    place = static_cast<int>(frame.names.size());
    frame.names.push_back(name == names.end() ? "type" + std::to_string(type) : name->second);
  }
  for (int& type : frame.types) type = places.at(type);
}

long step_of(double number) {
  return number >= 0.0 && number < 9e15 ? static_cast<long>(number) : 0;
}

void refuse_particle(const ParticleFrame& frame, std::size_t particle,
                     const std::filesystem::path& path, const std::string& problem,
                     const std::string& advice) {
  if (!frame.lines.empty())
    throw UserError({path.string(), frame.lines[particle]}, problem, advice);
  const std::string name = frame.ids.empty() ? "particle " + std::to_string(particle)
                                             : "id " + number_text(frame.ids[particle]);
  throw UserError({path.string()}, name + ": " + problem, advice);
}

void refuse_frame(const std::filesystem::path& path, std::size_t frames) {
  if (frames == 0) {
    throw UserError({path.string()}, "the file has no frame", "give a file with particles");
  }
  throw UserError({path.string()}, "the file has " + counted(frames, "frame"),
                  frames == 1 ? "give --frame 0, or omit it"
                              : "give --frame from 0 to " + std::to_string(frames - 1));
}

bool is_tilt(double across, const ParticleBox& box) {
  constexpr double kRounding = 1e-9;
  const auto& [x, y, z] = box.lengths;
  return !(std::fabs(across) <= kRounding * std::max({x, y, z}));
}

void refuse_tilt(const std::filesystem::path& path, int line) {
  throw UserError({path.string(), line}, "the box is tilted: its edges are not along x, y and z",
                  "give a rectangular box");
}

}  // namespace clatter
