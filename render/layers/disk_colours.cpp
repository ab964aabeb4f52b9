#include "render/layers/disk_colours.h"

#include <cmath>

namespace clatter {

Light light_of(Colour colour) {
  const auto of_65535 = [](float share) {
    return static_cast<std::uint16_t>(std::lround(65535.0f * share));
  };
  return {of_65535(linear_light(colour.red)), of_65535(linear_light(colour.green)),
          of_65535(linear_light(colour.blue)), of_65535(colour.alpha / 255.0f)};
}

double disk_value(const Snapshot& snapshot, ColourBy colour_by, std::size_t i, const VecX& away) {
  const auto column = static_cast<Eigen::Index>(i);
  switch (colour_by) {
    case ColourBy::None:
    case ColourBy::Species:
      return 0.0;
    case ColourBy::Speed:
      return snapshot.velocities.col(column).norm();
    case ColourBy::VelocityX:
      return snapshot.velocities(0, column);
    case ColourBy::VelocityY:
      return snapshot.velocities(1, column);
    case ColourBy::VelocityZ:
      return snapshot.velocities(2, column);
    case ColourBy::Spin:
      if (snapshot.spins.size() == 0) return 0.0;
      return snapshot.spins.rows() == 1 ? snapshot.spins(0, column)
                                        : snapshot.spins.col(column).norm();
    case ColourBy::Depth:
      return away.dot(snapshot.positions.col(column) - 0.5 * snapshot.box);
    case ColourBy::Diameter:
      return 2.0 * snapshot.radius(i);
  }
  return 0.0;
}

Colour DiskColours::of(const Snapshot& snapshot, std::size_t i) const {
  if (tracer == i) return traced;
  if (has_scale(colour_by)) return scale(disk_value(snapshot, colour_by, i, away));
  const bool has_species = !species.empty() && !snapshot.grains.empty();
  return has_species ? species[snapshot.grains[i].species] : plain;
}

}  // namespace clatter
