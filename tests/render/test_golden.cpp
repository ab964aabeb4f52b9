#include <doctest/doctest.h>

#include <array>
#include <string>

#include "engine/dimension.h"
#include "engine/error.h"
#include "engine/run/scheduled_run.h"
#include "engine/scene/scene_file.h"
#include "render/camera_path.h"
#include "render/layers/renderer.h"
#include "tests/render/optional_context.h"
#include "tests/support/golden_picture.h"

// Pictures of eleven scenes, kept in assets/golden. Where a change of the looks is meant,
//   CLATTER_WRITE_GOLDEN=1 build/release/tests/render_tests -tc='Golden*EGL*'
// draws them again; look at each before it is kept.

namespace clatter {

namespace {

struct Golden {
  const char* name;
  const char* scene;
  double time;
};

constexpr std::array kGolden = {Golden{"driven", R"(
        box.size = [16.0, 12.0]
        particles = { count = 70, restitution = 0.9 }
        walls.left = { kind = "driven", drive_speed = 1.0 }
        walls.right = { kind = "thermal", temperature = 1.0 }
        view = { field = "density", range = [0.0, 3.0], field_range = [0.0, 1.0], overlay = false })",
                                       20.0},
                                Golden{"rough", R"(
        box.size = [12.0, 9.0]
        particles = { count = 40, restitution = 0.9, friction = 0.5, start.spin_temperature = 1.0 }
        [view]
        colour_by = "spin"
        range = [-4.0, 4.0]
        theme = "light"
        grid = true
        overlay = false)",
                                       2.0},
                                Golden{"shaken", R"(
        box.size = [16.0, 12.0]
        particles = { count = 60, restitution = 0.9 }
        gravity.acceleration = [0.0, -1.0]
        walls.left = { kind = "static" }
        walls.right = { kind = "sawtooth", stroke = 0.5, frequency = 0.4 }
        walls.bottom = { kind = "sinusoidal", stroke = 1.0, frequency = 0.8 }
        walls.top = { kind = "static" }
        view = { colour_by = "velocity_y", range = [-4.0, 4.0], overlay = false })",
                                       3.1},
                                Golden{"small", R"(
        box.size = [200.0, 150.0]
        particles.count = 1200
        view = { palette = "inferno", range = [0.0, 4.0], overlay = false })",
                                       1.0},
                                Golden{"labelled", R"(
        title = "Heat flux"
        caption = "From the hot wall to the cold one."
        box.size = [16.0, 12.0]
        particles.count = 70
        walls.left = { kind = "thermal", temperature = 2.0 }
        walls.right = { kind = "thermal", temperature = 0.5 }
        [view]
        colour_by = "none"
        field = "temperature"
        field_palette = "cividis"
        field_range = [0.0, 3.0]
        arrows = "velocity"
        theme = "projector")",
                                       6.0},
                                Golden{"slab", R"(
        box.size = [10.0, 7.0, 8.0]
        particles = { count = 150, restitution = 0.9 }
        walls.left = { kind = "driven", drive_speed = 1.0 }
        walls.right = { kind = "thermal", temperature = 2.0 }
        walls.back = { kind = "static" }
        walls.front = { kind = "sinusoidal", stroke = 0.5, frequency = 0.5 }
        [view]
        field = "density"
        range = [0.0, 4.0]
        field_range = [0.0, 1.0]
        overlay = false
        slab = { axis = "z", from = 0.0, to = 5.0 }
        slices = [{ axis = "z", position = 2.0 }, { axis = "y", position = 0.0 }])",
                                       4.0},
                                Golden{"volume", R"(
        box.size = [10.0, 7.0, 8.0]
        particles = { count = 60, restitution = 0.9 }
        walls.left = { kind = "driven", drive_speed = 1.0 }
        walls.right = { kind = "static" }
        measure.cells = [5, 4, 4]
        [view]
        colour_by = "none"
        field = "density"
        field_palette = "inferno"
        field_range = [0.0, 0.3]
        volume = 0.5
        slices = [{ axis = "y", position = 1.0 }]
        slab = { axis = "x", from = 2.0, to = 10.0 }
        overlay = false)",
                                       6.0},
                                Golden{"packing", R"(
        box.size = [7.0, 7.0, 7.0]
        particles = { volume_fraction = 0.55, restitution = 0.9 }
        [view]
        colour_by = "velocity_z"
        range = [-2.0, 2.0]
        theme = "light"
        view_angle = 0.0
        azimuth = 45.0
        elevation = 35.26
        overlay = false)",
                                       0.2},
                                Golden{"orbit", R"(
        title = "Spheres"
        box.size = [9.0, 12.0, 9.0]
        particles = { count = 60, restitution = 0.9 }
        gravity.acceleration = [0.0, -1.0, 0.0]
        walls.bottom = { kind = "driven", drive_speed = 3.0 }
        walls.top = { kind = "static" }
        [view]
        colour_by = "depth"
        azimuth = -120.0
        elevation = -15.0
        camera = [{ time = 0.0 }, { time = 4.0, centre = [4.0, 5.0, 3.0], width = 14.0, azimuth = -60.0, elevation = 20.0 }])",
                                       2.0},
                                Golden{"mixture", R"(
        title = "Mixture"
        box.size = [16.0, 12.0]
        particles = { restitution = 0.9 }
        walls.left = { kind = "driven", drive_speed = 1.0 }
        walls.right = { kind = "static" }
        [[species]]
        name = "small"
        count = 60
        [[species]]
        name = "large"
        count = 8
        diameter = 2.5
        [[species]]
        name = "dust"
        count = 80
        diameter = 0.15
        [view]
        colour_by = "species"
        trails = 0.4)",
                                       2.0},
                                Golden{"unequal", R"(
        box.size = [10.0, 7.0, 8.0]
        particles = { restitution = 0.9 }
        walls.left = { kind = "static" }
        walls.right = { kind = "static" }
        [[species]]
        name = "small"
        count = 150
        diameter = 0.8
        [[species]]
        name = "large"
        count = 12
        diameter = 2.4
        colour = "#e0a020"
        polydispersity = { kind = "uniform", width = 0.2 }
        [view]
        colour_by = "species"
        slab = { axis = "z", from = 0.0, to = 6.0 }
        azimuth = 30.0
        elevation = 20.0)",
                                       1.0}};

constexpr Size kGoldenSize{320, 240};

Image drawn(const Golden& golden, const Gl& gl) {
  const Scene scene = parse_scene(golden.scene, golden.name);
  const Snapshot snapshot = with_dimension(scene.dimension(), [&](auto dimension) {
    ScheduledRun<dimension> run(scene, 1);
    run.show(scene.view);
    run.run_until(golden.time);
    return run.snapshot();
  });
  const OverlayText text{scene.title, scene.caption};
  Renderer renderer(gl);
  const Canvas canvas(gl, kGoldenSize);
  canvas.bind();
  const Camera whole = renderer.fit(snapshot, kGoldenSize, scene.view, text);
  renderer.draw(snapshot, camera_at(scene.view.camera, snapshot, whole), kGoldenSize, scene.view,
                text);
  return canvas.read();
}

void compare(const Gl& gl) {
  for (const Golden& golden : kGolden) {
    testing::check_golden(golden.name, drawn(golden, gl));
  }
}

}  // namespace

TEST_CASE("Golden pictures: OSMesa draws them") {
  if (const auto context = open_or_skip(Backend::Osmesa)) compare(context->gl());
}

TEST_CASE("Golden pictures: EGL draws them") {
  if (const auto context = open_or_skip(Backend::Egl)) compare(context->gl());
}

TEST_CASE("Golden pictures: OpenGL ES 3.0 draws them, as WebGL 2 does") {
  if (const auto context = open_es_context()) compare(context->gl());
}

TEST_CASE("Golden pictures: a disk a quarter of a pixel off is detected") {
  const auto context = open_context(Backend::Auto);
  const Golden& golden = kGolden.front();
  const Scene scene = parse_scene(golden.scene, golden.name);
  ScheduledRun<2> run(scene, 1);
  run.show(scene.view);
  run.run_until(golden.time);
  Snapshot snapshot = run.snapshot();
  Renderer renderer(context->gl());
  const Camera camera = renderer.fit(snapshot, kGoldenSize, scene.view, {});
  snapshot.positions(0, 7) += 0.25 * camera.width / kGoldenSize.width;
  const Canvas canvas(context->gl(), kGoldenSize);
  canvas.bind();
  renderer.draw(snapshot, camera, kGoldenSize, scene.view, {});
  CHECK(testing::wrong_pixels(drawn(golden, context->gl()), canvas.read()) > 0);
}

}  // namespace clatter
