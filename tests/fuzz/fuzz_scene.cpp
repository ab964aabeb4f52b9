// libFuzzer: the text of a scene, read and validated, run for a thousand collisions, drawn.

#include <algorithm>
#include <cstdint>
#include <string>

#include "engine/error.h"
#include "engine/publish/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "render/context/context.h"
#include "render/gl/canvas.h"
#include "render/layers/renderer.h"

using namespace clatter;

namespace {

// More are no other, only slower.
constexpr int kMaxParticles<2> = 1000;
constexpr std::uint64_t kCollisions = 1000, kSteps = 20000;
// Averages take time where nothing moves, too.
constexpr double kWindows = 100.0;

void draw(const Scene& scene, const Snapshot& snapshot) {
  static const auto context = open_context(Backend::Osmesa);
  static const Canvas canvas(context->gl(), {64, 48});
  static Renderer renderer(context->gl());
  canvas.bind();
  const OverlayText text{scene.title, scene.caption};
  const Camera camera = renderer.fit(snapshot, {64, 48}, scene.view, text);
  renderer.draw(snapshot, camera, {64, 48}, scene.view, text);
}

void run(const std::string& text) {
  const Scene scene = parse_scene(text, "fuzz.toml", {});
  if (scene.particles.count > kMaxParticles<2>) return;
  ScheduledRun<2> run(scene, 1);
  run.show(scene.view);
  const double end = scene.measure.burn_in + scene.measure.duration;
  run.run_until(std::min(end, kWindows * scene.view.window), kCollisions, kSteps);
  draw(run.scene(), run.snapshot());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    run({reinterpret_cast<const char*>(data), size});
  } catch (const UserError&) {
  } catch (const PhysicalStop&) {
  }
  return 0;
}
