#include "tests/engine/support/models.h"

namespace clatter::testing {

Model<2> periodic_box(double lx, double ly) {
  Model<2> model;
  model.box = {lx, ly};
  return model;
}

Model<3> periodic_box(double lx, double ly, double lz) {
  Model<3> model;
  model.box = {lx, ly, lz};
  model.inertia = 0.4;
  return model;
}

Model<2> four(const Wall& sides, const Wall& ends) {
  return with_walls(with_walls(periodic_box(9.0, 8.0), 0, sides), 1, ends);
}

Model<2> everything() {
  Model<2> model = rough(periodic_box(10.0, 9.0), 0.4, 0.6);
  model.walls = {kSinusoidal, kSawtooth, kRoughDriven, kThermal};
  model.restitution = 0.875;
  model.gravity = {0.25, -0.5};
  model.bulk_drive = BulkDrive{0.1875, 0.125, 0.0625};
  model.contact_time = 0.0078125;
  return model;
}

}  // namespace clatter::testing
