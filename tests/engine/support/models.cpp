#include "tests/engine/support/models.h"

namespace clatter::testing {

Model<2> periodic_box(double lx, double ly) {
  Model<2> model;
  model.box = {lx, ly};
  return model;
}

Model<2> with_walls(Model<2> model, int axis, const Wall& wall) {
  model.walls[2 * axis] = model.walls[2 * axis + 1] = wall;
  return model;
}

Model<2> four(const Wall& sides, const Wall& ends) {
  return with_walls(with_walls(periodic_box(9.0, 8.0), 0, sides), 1, ends);
}

Model<2> inelastic(Model<2> model, double restitution) {
  model.restitution = restitution;
  return model;
}

Model<2> rough(Model<2> model, double friction, double tangential_restitution) {
  model.roughness = {friction, tangential_restitution};
  model.spins = true;
  return model;
}

Model<2> falling(Model<2> model, const Vec2& gravity) {
  model.gravity = gravity;
  return model;
}

Model<2> kicked(Model<2> model, double interval, double speed) {
  model.bulk_drive = BulkDrive{interval, speed, model.spins ? speed : 0.0};
  return model;
}

Model<2> with_contact_time(Model<2> model, double contact_time) {
  model.contact_time = contact_time;
  return model;
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
