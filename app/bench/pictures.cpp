#include "app/bench/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <optional>

#include "engine/error.h"
#include "engine/picture/snapshot.h"
#include "engine/picture/view_observers.h"
#include "engine/run/scheduled_run.h"
#include "engine/system/child_process.h"
#include "engine/system/platform.h"
#include "engine/system/usage.h"
#include "render/context/context.h"
#include "render/gl/canvas.h"
#include "render/layers/renderer.h"
#include "render/output/image.h"
#include "render/output/movie.h"

namespace clatter {

namespace {

constexpr Size kLarge{1920, 1080}, kMedium{1280, 720};
constexpr int kMaxSamples = 4;

// Particles in one colour on a uniform background, so that the light of a particle gives its
// centre.
View plain_view() {
  View view;
  view.colour_by = ColourBy::None;
  view.field.reset();
  view.overlay = false;
  return view;
}

struct Drawn {
  Image image;
  Projection projection;
  double cpu_seconds;
};

Drawn draw(const Gl& gl, const Snapshot& snapshot, Size size, int samples) {
  constexpr int kFrames = 5;
  const View view = plain_view();
  const Canvas canvas(gl, size);
  Renderer renderer(gl, samples);
  Drawn drawn{{}, {renderer.fit(snapshot, size, view, {}), size}, 0.0};
  double began = 0.0;
  for (int k = 0; k <= kFrames; ++k) {
    if (k == 1) began = cpu_seconds();  // the first picture fills the caches
    canvas.bind();
    renderer.draw(snapshot, drawn.projection.camera, size, view, {});
    drawn.image = canvas.read();
  }
  drawn.cpu_seconds = (cpu_seconds() - began) / kFrames;
  return drawn;
}

// Isolated particles, at all positions relative to the pixel grid.
Snapshot apart(const Snapshot& snapshot) {
  constexpr double kSpacing = 2.5;
  Snapshot sparse = snapshot;
  std::vector<Vec2> places;
  double shift = 0.0;
  for (double y = kSpacing; y < sparse.box.y() - 0.5 * kSpacing; y += kSpacing) {
    for (double x = kSpacing; x < sparse.box.x() - 0.5 * kSpacing; x += kSpacing) {
      shift = std::fmod(shift + std::numbers::phi - 1.0, 1.0);
      places.emplace_back(x + 0.3 * shift, y + 0.3 * std::fmod(7.0 * shift, 1.0));
    }
  }
  sparse.positions = as_columns(places);
  sparse.velocities.setZero(2, sparse.positions.cols());
  sparse.spins.resize(0, 0);
  return sparse;
}

// The centroid of the light around a position, in pixels from the upper left corner.
Vec2 centre_of_light(const Image& image, const Vec2& place, double radius) {
  const auto brightness = [&](int x, int y) {
    const auto at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size.width) +
                         static_cast<std::size_t>(x));
    return static_cast<double>(image.rgba[at] + image.rgba[at + 1] + image.rgba[at + 2]);
  };
  const auto low = [&](double at) { return std::max(0, static_cast<int>(at - radius)); };
  const int left = low(place.x()), top = low(place.y());
  const int right = std::min(image.size.width - 1, static_cast<int>(place.x() + radius));
  const int bottom = std::min(image.size.height - 1, static_cast<int>(place.y() + radius));
  const double ground = brightness(left, top);
  Vec2 sum(0.0, 0.0);
  double light = 0.0;
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const double here = std::fabs(brightness(x, y) - ground);
      light += here;
      sum += here * Vec2(x + 0.5, y + 0.5);
    }
  }
  return light > 0.0 ? Vec2(sum / light) : place;
}

// Root mean square distance between the centres in a picture and the disks, in its pixels.
double centre_error(const Drawn& drawn, const Snapshot& snapshot) {
  double squares = 0.0;
  for (const auto& position : snapshot.positions.colwise()) {
    Vec2 place = drawn.projection.pixels(position);
    place.y() = drawn.projection.size.height - place.y();
    const double radius = 0.9 * snapshot.diameter * drawn.projection.scale();
    squares += (centre_of_light(drawn.image, place, radius) - place).squaredNorm();
  }
  return std::sqrt(squares / static_cast<double>(snapshot.count()));
}

PictureTable antialiasing(const Gl& gl, const Snapshot& snapshot) {
  PictureTable table{"antialiasing", "samples a pixel, along each axis, at 1280x720", {}};
  const Snapshot sparse = apart(snapshot);
  const Drawn best = draw(gl, snapshot, kMedium, kMaxSamples);
  for (const int samples : {4, 3, 2, 1}) {
    const Drawn drawn = draw(gl, snapshot, kMedium, samples);
    table.rows.push_back({std::to_string(samples), static_cast<double>(samples), drawn.cpu_seconds,
                          structural_similarity(drawn.image, best.image),
                          centre_error(draw(gl, sparse, kMedium, samples), sparse)});
  }
  return table;
}

PictureTable sizes(const Gl& gl, const Snapshot& snapshot) {
  PictureTable table{"picture_size", "size, enlarged to 1920x1080", {}};
  const Snapshot sparse = apart(snapshot);
  const Drawn best = draw(gl, snapshot, kLarge, kMaxSamples);
  for (const Size size : {kLarge, kMedium, Size{854, 480}, {426, 240}, {214, 120}}) {
    const Drawn drawn = draw(gl, snapshot, size, 1);
    const double enlarged = static_cast<double>(kLarge.width) / size.width;
    table.rows.push_back({size_text(size), static_cast<double>(size.width), drawn.cpu_seconds,
                          structural_similarity(resized(drawn.image, kLarge), best.image),
                          enlarged * centre_error(draw(gl, sparse, size, 1), sparse)});
  }
  return table;
}

// The pictures of a second of film, as a film of the scene has them.
std::vector<Image> film_pictures(const Gl& gl, const Scene& scene, Simulation<2>& simulation,
                                 int count) {
  ViewObservers<2> shown(simulation, scene.view, 0.0);
  const Canvas canvas(gl, kLarge);
  Renderer renderer(gl, 1);
  std::vector<Image> pictures;
  std::optional<Camera> camera;
  const double start = simulation.time();
  for (int k = 0; k < count; ++k) {
    simulation.run_until(start + k * scene.view.speed / count);
    Snapshot snapshot = snapshot_of(simulation);
    shown.publish(snapshot);
    const OverlayText text{scene.title, scene.caption};
    if (!camera) camera = renderer.fit(snapshot, kLarge, scene.view, text);
    canvas.bind();
    renderer.draw(snapshot, *camera, kLarge, scene.view, text);
    pictures.push_back(canvas.read());
  }
  return pictures;
}

// The pictures of a film.
std::vector<Image> decoded(const std::filesystem::path& film, Size size) {
  const std::filesystem::path raw = film.string() + ".rgba";
  ChildProcess decoder({"ffmpeg", "-v", "error", "-nostdin", "-y", "-i", film.string(), "-vf",
                        "scale=in_color_matrix=bt709:in_range=tv", "-f", "rawvideo", "-pix_fmt",
                        "rgba", raw.string()});
  if (!decoder.wait()) throw RunError("ffmpeg cannot read its film: " + decoder.last_words());
  std::ifstream file(raw, std::ios::binary);
  std::vector<Image> pictures;
  Image picture{size, std::vector<unsigned char>(4 * static_cast<std::size_t>(size.width) *
                                                 static_cast<std::size_t>(size.height))};
  while (file.read(reinterpret_cast<char*>(picture.rgba.data()),
                   static_cast<std::streamsize>(picture.rgba.size()))) {
    pictures.push_back(picture);
  }
  std::filesystem::remove(raw);
  return pictures;
}

// The mean similarity of every tenth picture.
double similarity(const std::vector<Image>& pictures, const std::vector<Image>& originals) {
  constexpr std::size_t kEach = 10;
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < std::min(pictures.size(), originals.size()); k += kEach) {
    sum += structural_similarity(pictures[k], originals[k]);
    ++count;
  }
  return sum / count;
}

PictureTable encodings(const Gl& gl, const Scene& scene, Simulation<2>& simulation) {
  constexpr int kPictures = 60;
  PictureTable table{"encoding", "encoding of a film, 1920x1080, 60 frames a second", {}};
  const std::vector<Image> originals = film_pictures(gl, scene, simulation, kPictures);
  for (const Encoding encoding : {Encoding::Small, Encoding::Balanced, Encoding::Fast}) {
    const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                       fmt::format("clatter-bench-{}.mp4", process_number());
    SinkOptions options;
    options.size = kLarge;
    options.fps = kPictures;
    options.encoding = encoding;
    const double began = child_cpu_seconds();
    Movie movie(path, options);
    for (const Image& picture : originals) movie.add(picture, {});
    movie.finish(Ending::Whole);
    const double seconds = child_cpu_seconds() - began;
    const auto bytes = static_cast<double>(std::filesystem::file_size(path));
    table.rows.push_back({.setting = name_of(encoding),
                          .value = static_cast<double>(encoding),
                          .cpu_seconds = seconds / kPictures,
                          .ssim = similarity(decoded(path, kLarge), originals),
                          .centre_error = std::numeric_limits<double>::quiet_NaN(),
                          .bytes = bytes});
    std::filesystem::remove(path);
  }
  return table;
}

// Each frame stays until the next. The shown gas is on average half a frame old.
PictureTable frame_rates(const Gl& gl, Simulation<2>& simulation, double speed) {
  PictureTable table{
      "frame_rate", "frames a second of film, at 1280x720; ms for a second of film", {}};
  double start = simulation.time();
  for (const double fps : {240.0, 120.0, 60.0, 30.0, 15.0}) {
    simulation.run_until(start);
    const Snapshot shown = snapshot_of(simulation);
    simulation.run_until(start + 0.5 * speed / fps);
    const Snapshot now = snapshot_of(simulation);
    start = simulation.time();
    const Drawn drawn = draw(gl, shown, kMedium, 1);
    double squares = 0.0;
    for (Eigen::Index i = 0; i < now.positions.cols(); ++i) {
      Vec2 moved = now.positions.col(i) - shown.positions.col(i);
      for (int axis = 0; axis < 2; ++axis) {
        moved[axis] -= now.box[axis] * std::round(moved[axis] / now.box[axis]);
      }
      squares += moved.squaredNorm();
    }
    const auto count = static_cast<double>(now.count());
    table.rows.push_back(
        {std::to_string(static_cast<int>(fps)), fps, fps * drawn.cpu_seconds,
         structural_similarity(drawn.image, draw(gl, now, kMedium, kMaxSamples).image),
         drawn.projection.scale() * std::sqrt(squares / count)});
  }
  return table;
}

void mark_dominated(std::vector<PictureRow>& rows) {
  for (PictureRow& row : rows) {
    row.dominated = std::ranges::any_of(rows, [&](const PictureRow& other) {
      return other.cpu_seconds < 0.9 * row.cpu_seconds && other.ssim > row.ssim &&
             other.centre_error < row.centre_error;
    });
  }
}

}  // namespace

PictureTable measure_pictures(const std::string& dial, const Scene& scene, double time) {
  const auto simulation = simulation_of<2>(scene, 1);
  simulation->run_until(time);
  const auto context = open_context(Backend::Auto);
  PictureTable table;
  if (dial == kPictureDials[0]) {
    table = antialiasing(context->gl(), snapshot_of(*simulation));
  } else if (dial == kPictureDials[1]) {
    table = sizes(context->gl(), snapshot_of(*simulation));
  } else if (dial == kPictureDials[3]) {
    table = encodings(context->gl(), scene, *simulation);
  } else {
    table = frame_rates(context->gl(), *simulation, scene.view.speed);
  }
  mark_dominated(table.rows);
  return table;
}

}  // namespace clatter
