#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/error.h"
#include "engine/publish/scheduled_run.h"
#include "engine/scene/scene_file.h"

using namespace clatter;

namespace {

Scene vibrated() {
  return load_scene("vibrated", {{"view.window", "2.0"}});
}

}  // namespace

TEST_CASE("ScheduledRun: laws that change to themselves leave the run as it is, to the bit") {
  Scene scene = vibrated();
  ScheduledRun plain(scene, 11);
  for (double time : {1.0, 1.7, 8.25}) {
    scene.changes.push_back({.time = time, .set = {{"disks.restitution", "0.9"}}});
  }
  ScheduledRun changing(scene, 11);
  plain.run_until(12.0);
  changing.run_until(12.0);
  CHECK(changing.simulation().state_hash() == plain.simulation().state_hash());
}

TEST_CASE("ScheduledRun: what is changed by hand is played back to the same bits") {
  ScheduledRun live(vibrated(), 12);
  live.show(vibrated().view);
  // Halted wherever the steps end, as a window does it.
  for (int part = 1; part <= 40; ++part) {
    live.run_until(0.5 * part, Simulation<2>::kNoLimit, live.simulation().counts().steps() + 1000);
    if (part % 5 != 0) continue;
    live.change({{"disks.restitution", std::to_string(1.0 - 0.01 * part)},
                 {"walls.left.drive_speed", std::to_string(0.1 * part)}});
  }
  live.change({{"gravity.acceleration", "[0.0, -0.5]"}});
  const double time = live.simulation().time() + 3.0;
  live.run_until(time);

  Scene scene = vibrated();
  scene.changes = live.scene().changes;
  REQUIRE(scene.changes.size() == 9);
  ScheduledRun played(parse_scene(scene_to_toml(scene), ""), 12);
  played.run_until(time);
  CHECK(played.simulation().state_hash() == live.simulation().state_hash());
  CHECK(played.scene().disks.restitution == live.scene().disks.restitution);

  ScheduledRun other(vibrated(), 12);
  other.run_until(time);
  CHECK(other.simulation().state_hash() != live.simulation().state_hash());
}

TEST_CASE("ScheduledRun: a run that goes on from a checkpoint has the changes up to then") {
  Scene scene = vibrated();
  scene.changes = {{.time = 2.0, .set = {{"disks.restitution", "0.7"}}},
                   {.time = 6.0, .set = {{"disks.restitution", "0.99"}}}};
  ScheduledRun whole(scene, 13);
  whole.run_until(4.0);
  ScheduledRun rest(scene, 13, whole.simulation().save());
  CHECK(rest.scene().disks.restitution == 0.7);
  whole.run_until(9.0);
  rest.run_until(9.0);
  CHECK(rest.simulation().state_hash() == whole.simulation().state_hash());
}

TEST_CASE("ScheduledRun: the live field goes on across changes") {
  const Scene scene = vibrated();
  ScheduledRun plain(scene, 14), changing(scene, 14);
  plain.show(scene.view);
  changing.show(scene.view);
  for (int part = 1; part <= 50; ++part) {
    plain.run_until(0.1 * part);
    changing.run_until(0.1 * part);
    changing.change({{"disks.restitution", "0.9"}});
  }
  const FieldMap a = *plain.snapshot().field, b = *changing.snapshot().field;
  REQUIRE(a.values.size() == b.values.size());
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    CHECK(b.values[i] == doctest::Approx(a.values[i]).epsilon(1e-9));
  }
}

TEST_CASE("ScheduledRun: arrows and balances go on across changes") {
  View view = vibrated().view;
  view.arrows = Arrows::HeatFlux;
  for (const Field field : {Field::Temperature, Field::BalanceEnergy}) {
    view.field = field;
    const auto at_ten = [&](const std::vector<double>& times) {
      Scene scene = vibrated();
      for (const double time : times) {
        scene.changes.push_back({.time = time, .set = {{"disks.restitution", "0.9"}}});
      }
      ScheduledRun run(scene, 15);
      run.show(view);
      run.run_until(10.0);
      return run.snapshot();
    };
    const Snapshot plain = at_ten({}), changed = at_ten({8.5, 9.25, 9.75});
    CHECK(changed.field->whole_window);
    REQUIRE(changed.arrows->arrows.size() == plain.arrows->arrows.size());
    REQUIRE(plain.arrows->arrows.size() > 10);
    double longest = 0.0;
    for (const auto& arrow : plain.arrows->arrows) longest = std::max(longest, arrow.value.norm());
    for (std::size_t k = 0; k < plain.arrows->arrows.size(); ++k) {
      const Vec2 off = changed.arrows->arrows[k].value - plain.arrows->arrows[k].value;
      CHECK(off.norm() < 1e-10 * longest);
    }
    // What was booked under each of the laws closes, and as many cells have a residual.
    for (std::size_t i = 0; i < plain.field->values.size(); ++i) {
      CHECK(std::isnan(changed.field->values[i]) == std::isnan(plain.field->values[i]));
      if (field == Field::BalanceEnergy && !std::isnan(plain.field->values[i])) {
        CHECK(std::fabs(changed.field->values[i]) < 1e-12);
      }
    }
  }
}

TEST_CASE("ScheduledRun: what cannot be is refused, and nothing has happened") {
  ScheduledRun run(vibrated(), 15);
  run.run_until(3.0);
  CHECK_THROWS_AS(run.change({{"disks.restitution", "1.5"}}), UserError);
  CHECK_THROWS_AS(run.change({{"disks.count", "5"}}), UserError);
  // A wall that stands far inside at once has disks in it.
  CHECK_THROWS_AS(run.change({{"walls.left",
                               "{ kind = 'sawtooth', stroke = 6.0, frequency = 0.01,"
                               " phase = 0.9 }"}}),
                  PhysicalStop);
  CHECK(run.scene().changes.empty());
  CHECK(run.scene().disks.restitution == 0.9);
  CHECK(run.run_until(4.0));
}
