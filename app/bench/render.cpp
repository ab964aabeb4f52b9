#include <fmt/printf.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "app/bench/tables.h"
#include "app/runs/run.h"
#include "app/system/exit_code.h"
#include "app/system/outputs.h"
#include "engine/dimension.h"
#include "engine/physics/theory.h"
#include "engine/picture/live_field.h"
#include "engine/picture/snapshot.h"
#include "engine/system/usage.h"
#include "engine/system/write_file.h"
#include "render/context/context.h"
#include "render/contrast_maps.h"
#include "render/gl/canvas.h"
#include "render/layers/renderer.h"
#include "render/output/movie.h"

namespace clatter {

namespace {

constexpr int kFrames = 10;
constexpr double kFps = 30.0;

// CPU milliseconds per frame, by the name of the stage.
using Times = std::map<std::string_view, double>;

constexpr const char* particles_of(int dimension) {
  return dimension == 2 ? "disks" : "spheres";
}

// The stages of a frame in the order of their columns. Particles, heatmap and overlay are parts of
// the drawing, repeated separately.
std::vector<const char*> stages_of(int dimension, bool with_films) {
  std::vector<const char*> stages = {"simulate", "snapshot", "draw", particles_of(dimension),
                                     "heatmap",  "overlay",  "read", "png"};
  if (with_films) stages.insert(stages.end(), {"fast", "balanced", "small"});
  return stages;
}

// The share of the box that the particles fill.
constexpr double fraction_of(int dimension) {
  return dimension == 2 ? 0.5 : 0.1;
}

// Adds the CPU time of a stage to `times`, up to the end of its drawing. Counts all threads,
// because OpenGL may draw on several.
template <class Work>
void spend(Times& times, const char* stage, const Gl& gl, Work work) {
  const double began = cpu_seconds();
  work();
  gl.Finish();
  times[stage] += 1e3 * (cpu_seconds() - began) / kFrames;
}

// Elastic particles in a periodic box, coloured over a heatmap: disks in the shape of a film, or
// spheres in a cube.
Scene scene_of(int count, int dimension) {
  Scene scene = default_scene(dimension);
  scene.title = "Bench";
  scene.particles.count = count;
  const double volume = count * packing_fraction(dimension, 1.0) / fraction_of(dimension);
  if (dimension == 2) {
    scene.box = Vec2(std::sqrt(volume * 16.0 / 9.0), std::sqrt(volume * 9.0 / 16.0));
  } else {
    scene.box.setConstant(std::cbrt(volume));
  }
  scene.view.field = Quantity::Density;
  return scene;
}

std::filesystem::path temporary_file(const char* extension) {
  return std::filesystem::temp_directory_path() /
         ("clatter-bench-" + std::to_string(process_number()) + extension);
}

// The CPU milliseconds of the encoder for one film.
double encode(std::vector<Image> images, Encoding encoding) {
  const std::filesystem::path film = temporary_file(".mp4");
  const double before = 1e3 * child_cpu_seconds();
  SinkOptions options;
  options.size = images.front().size;
  options.encoding = encoding;
  Movie movie(film, options);
  for (Image& image : images) movie.add(std::move(image), {});
  movie.finish(Ending::Whole);
  std::filesystem::remove(film);
  return 1e3 * child_cpu_seconds() - before;
}

// The layers of the particles and of the heatmap.
template <int D>
struct Layers {
  explicit Layers(const Gl& gl) : particles(gl), heatmap(gl) {}
  DiskLayer particles;
  FieldLayer heatmap;
};
template <>
struct Layers<3> {
  explicit Layers(const Gl& gl) : light(gl), particles(gl), heatmap(gl) {}
  SphereLight light;
  SphereLayer particles;
  SliceLayer heatmap;
};

// A film of the simulation from its present time.
template <int D>
class Filming {
 public:
  Filming(const Gl& gl, Simulation<D>& simulation, LiveField<D>& field, const View& view, Size size)
      : gl_(gl),
        simulation_(simulation),
        field_(field),
        view_(view),
        canvas_(gl, size, GL_SRGB8_ALPHA8, D == 2 ? Depth::None : Depth::Buffer),
        renderer_(gl),
        layers_(gl),
        overlay_(gl) {}

  // Excludes the first frame, which fills the caches.
  Times measure(bool with_films) {
    frame(simulation_.time());
    times_ = {};
    std::vector<Image> images;
    const double start = simulation_.time();
    for (int k = 1; k <= kFrames; ++k) images.push_back(frame(start + k / kFps));
    for (const Image& image : images) spend(times_, "png", gl_, [&] { encode_png(image); });
    if (with_films) {
      times_["fast"] = encode(images, Encoding::Fast) / kFrames;
      times_["balanced"] = encode(images, Encoding::Balanced) / kFrames;
      times_["small"] = encode(std::move(images), Encoding::Small) / kFrames;
    }
    return times_;
  }

 private:
  Image frame(double time) {
    const Size size = canvas_.size();
    canvas_.bind();
    Snapshot snapshot;
    Image image;
    spend(times_, "simulate", gl_, [&] { simulation_.run_until(time); });
    spend(times_, "snapshot", gl_, [&] {
      snapshot = snapshot_of(simulation_);
      field_.publish(snapshot);
    });
    const Projection projection{renderer_.fit(snapshot, size, view_, {}), size};
    draw_parts(snapshot, projection);
    spend(times_, "draw", gl_,
          [&] { renderer_.draw(snapshot, projection.camera, size, view_, {}); });
    spend(times_, "read", gl_, [&] { image = canvas_.read(); });
    return image;
  }

  void draw_parts(const Snapshot& snapshot, const Projection& projection) {
    const ThemeColours theme = theme_of(view_);
    const ColourScale scale{particle_map(view_.palette, theme.background), 0.0, 3.0};
    const Legends legends{Legend{label_of(view_.colour_by, D), scale, "auto"},
                          Legend{label_of(*view_.field, D), scale, "auto"},
                          {}};
    const DiskColours colours{view_.colour_by, scale, theme.disk};
    if constexpr (D == 2) {
      spend(times_, "heatmap", gl_, [&] {
        layers_.heatmap.draw(snapshot, projection, scale, view_.field_style, theme.static_wall);
      });
      spend(times_, particles_of(D), gl_,
            [&] { layers_.particles.draw(snapshot, projection, colours); });
    } else {
      const Eye eye(projection);
      gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
      gl_.Enable(GL_DEPTH_TEST);
      spend(times_, "heatmap", gl_, [&] {
        layers_.heatmap.draw(snapshot, slices_of(snapshot, view_), projection, eye, scale,
                             view_.field_style, theme.static_wall);
      });
      spend(times_, particles_of(D), gl_, [&] {
        if (SphereLight::draws(eye, snapshot)) {
          layers_.light.draw(snapshot, projection, eye, colours, view_.slab, {});
        }
        layers_.particles.draw(snapshot, projection, eye, colours, view_.slab);
      });
      gl_.Disable(GL_DEPTH_TEST);
    }
    spend(times_, "overlay", gl_, [&] {
      overlay_.draw(snapshot, projection, view_, legends, {"Bench", ""});
    });
  }

  const Gl& gl_;
  Simulation<D>& simulation_;
  LiveField<D>& field_;
  const View& view_;
  Canvas canvas_;
  Renderer renderer_;
  Layers<D> layers_;
  Overlay overlay_;
  Times times_{};
};

// A row of the table for each size of the picture.
template <int D>
void add_rows(nlohmann::ordered_json& rows, const Gl& gl, int count, bool with_films) {
  const Scene scene = scene_of(count, D);
  const auto simulation = simulation_of<D>(scene, 1);
  LiveField<D> field(*simulation, scene.view);
  for (const Size size : {Size{1280, 720}, {1920, 1080}}) {
    const Times times = Filming<D>(gl, *simulation, field, scene.view, size).measure(with_films);
    print(fmt::sprintf("%8d %10s", count, size_text(size).c_str()));
    nlohmann::ordered_json row = {{"count", count}, {"width", size.width}, {"height", size.height}};
    for (const char* stage : stages_of(D, with_films)) {
      print(fmt::sprintf(" %8.2f", times.at(stage)));
      row[std::string(stage) + "_milliseconds"] = times.at(stage);
    }
    print("\n");
    rows.push_back(row);
  }
}

}  // namespace

int bench_render(const std::string& json, int count, int dimension) {
  const std::vector<int> counts =
      count > 0 ? std::vector{count} : std::vector{1'000, 10'000, 100'000, 1'000'000};
  const auto context = open_context(Backend::Auto);
  const char* particles = particles_of(dimension);
  const bool with_films = has_film_encoder();
  std::fprintf(
      stderr,
      "elastic %s at phi = %g over a heatmap, %g frames per time unit, %s\n"
      "CPU milliseconds per frame, all threads; draw: the whole picture, with its parts %s, "
      "heatmap and overlay;\n%s\n",
      particles, fraction_of(dimension), kFps, context->description().c_str(), particles,
      with_films ? "fast, balanced, small: the encodings of films"
                 : "without the columns of the encoder, which need ffmpeg (apt install ffmpeg)");
  print(fmt::sprintf("%8s %10s", "N", "size"));
  for (const char* stage : stages_of(dimension, with_films)) print(fmt::sprintf(" %8s", stage));
  print("\n");
  auto rows = nlohmann::ordered_json::array();
  for (const int number : counts) {
    with_dimension(dimension, [&](auto dimension) {
      add_rows<dimension>(rows, context->gl(), number, with_films);
    });
  }
  if (!json.empty()) write_file(json, rows.dump(1) + "\n");
  return kOk;
}

}  // namespace clatter
