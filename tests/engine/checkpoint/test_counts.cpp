// Counts of a checkpoint that would make a resumed run loop or reserve memory without end.

#include <doctest/doctest.h>

#include <cstring>
#include <string>

#include "engine/error.h"
#include "engine/measure/measurement.h"
#include "engine/picture/live_field.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"

using namespace clatter;

namespace {

std::string number_bytes(std::uint64_t number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

// The bytes with another number in place of the only one that is `number`.
std::string with_number(std::string bytes, std::uint64_t number, std::uint64_t other) {
  const std::size_t at = bytes.find(number_bytes(number));
  REQUIRE(at != bytes.npos);
  REQUIRE(bytes.find(number_bytes(number), at + 1) == bytes.npos);
  return bytes.replace(at, sizeof number, number_bytes(other));
}

Scene scene_with(const std::string& keys) {
  return parse_scene(
      "box.size = [9, 8]\nparticles = { count = 5, restitution = 1.0 }\n"
      "measure.burn_in = 0.0\nmeasure.duration = 20.0\n" +
          keys,
      "counts.toml", {});
}

}  // namespace

// At t = 12.345 there are 1234 samples.
TEST_CASE("Counts: samples that should have been long ago are refused, not made up for") {
  for (const std::string keys :
       {"measure.fields = []\nmeasure.observables = [\"radial_distribution\"]\n"
        "measure.radial_distribution = { interval = 0.01 }\n",
        "measure.fields = [\"density\"]\nmeasure.cells = [2, 2]\n"
        "measure.estimator = \"snapshot\"\nmeasure.interval = 0.01\n"}) {
    CAPTURE(keys);
    const Scene scene = scene_with(keys);
    ScheduledRun<2> run(scene, 1);
    Measurement<2> measurement(run.simulation(), scene.measure, 20.0);
    run.run_until(12.345);
    const std::string saved = measurement.save();
    const auto resume = [&](const std::string& bytes) {
      ScheduledRun<2> resumed(scene, 1, run.simulation().save());
      Measurement<2>(resumed.simulation(), scene.measure, 20.0, ArchiveReader(bytes, "a"),
                     Averages::GoOn);
    };
    CHECK_NOTHROW(resume(saved));
    CHECK_THROWS_AS(resume(with_number(saved, 1234, 7)), UserError);
  }
}

// The window has 8 parts of 0.01.
TEST_CASE("Counts: parts of a live field that should have ended long ago are refused") {
  const Scene scene = scene_with("view.field = \"density\"\nview.window = 0.08\n");
  ScheduledRun<2> run(scene, 1);
  LiveField<2> field(run.simulation(), scene.view);
  run.run_until(12.345);
  const std::string saved = field.save();
  const auto resume = [&](const std::string& bytes) {
    ScheduledRun<2> resumed(scene, 1, run.simulation().save());
    LiveField<2>(resumed.simulation(), scene.view, ArchiveReader(bytes, "a"));
  };
  CHECK_NOTHROW(resume(saved));
  CHECK_THROWS_AS(resume(with_number(saved, 1234, 7)), UserError);
}
