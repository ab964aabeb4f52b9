#include "tests/engine/support/models.h"

namespace clatter::testing {

template <int D>
static Model<D> everything_in(const Model<D>& box) {
  Model<D> model = rough(box, 0.4, 0.6);
  model.restitution = 0.875;
  model.bulk_drive = BulkDrive{0.1875, 0.125, 0.0625};
  model.contact_time = 0.0078125;
  return model;
}

template <>
Model<2> everything<2>() {
  Model<2> model = everything_in(periodic_box(10.0, 9.0));
  model.walls = {kSinusoidal, kSawtooth, kRoughDriven, kThermal};
  model.gravity = {0.25, -0.5};
  return model;
}

template <>
Model<3> everything<3>() {
  Model<3> model = everything_in(periodic_box(4.5, 4.0, 5.0));
  model.walls = {kSinusoidal, kSawtooth, kRoughDriven, kThermal, kLossy, kSinusoidal};
  model.gravity = {0.25, -0.5, 0.125};
  return model;
}

}  // namespace clatter::testing
