#include "engine/run/tally.h"

namespace clatter {

Tally empty_tally(int dimension) {
  return {.temperature_integral = VecX::Zero(dimension)};
}

template <int D>
void add(Tally& tally, const WindowTotals<D>& window) {
  tally.time += window.duration;
  tally.temperature_integral += window.duration * window.temperature;
  tally.spin_temperature_integral += window.duration * window.spin_temperature;
  tally.walls_in += window.walls_in;
  tally.bulk_in += window.bulk_in;
  tally.nudges_in += window.nudges_in;
  tally.gravity_in += window.gravity_in;
  tally.shear_in += window.shear_in;
  tally.dissipated += window.dissipated;
  tally.undissipated += window.undissipated;
  tally.collisions += static_cast<std::uint64_t>(window.collisions);
  tally.elasticised += static_cast<std::uint64_t>(window.elasticised);
}

template void add<2>(Tally&, const WindowTotals<2>&);
template void add<3>(Tally&, const WindowTotals<3>&);

}  // namespace clatter
