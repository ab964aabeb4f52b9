#include "render/layers/sphere_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "render/layers/eye_uniforms.h"
#include "render/layers/sphere_light.h"
#include "render/neighbour_shade.h"
#include "render/occlusion.h"

namespace clatter {

namespace {

// An image of a sphere.
struct Seen {
  Vec3 centre;                // view coordinates
  std::array<Vec2, 2> shape;  // rectangle around it on the picture, drawn pixels
  std::uint32_t number;
  double distance;  // increases from each sphere to those that it hides
  double radius;    // drawn, world units
  double opacity;   // below 1 if it is drawn wider than it is
  bool cut;         // by a plane
};

bool in_sight(const std::array<Vec2, 2>& shape, Size drawn) {
  const auto& [low, high] = shape;
  return (high.array() > 0.0).all() && low.x() < drawn.width && low.y() < drawn.height;
}

// See sphere_layer.h.
double distance_from(const Eye& eye, const Vec3& seen, double radius) {
  if (eye.inverse_distance() == 0.0) return -seen.z();
  return (seen - Vec3(0.0, 0.0, 1.0 / eye.inverse_distance())).squaredNorm() - radius * radius;
}

std::vector<Seen> visible(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                          const std::optional<Slab>& slab, bool ghosts) {
  const double largest = 0.5 * snapshot.diameter;
  const DrawnRegion region = drawn_region(snapshot, slab, !ghosts);
  const DrawnRegion uncut = drawn_region(snapshot, slab, true);
  std::vector<Seen> all;
  for (std::size_t i = 0; i < snapshot.count(); ++i) {
    const Vec3 position = snapshot.positions.col(static_cast<Eigen::Index>(i));
    const double radius = snapshot.radius(i);
    visit_images(snapshot, position, radius, [&](const Vec3& place) {
      if ((place.array() + radius <= region.low.array()).any() ||
          (place.array() - radius >= region.high.array()).any()) {
        return;
      }
      const Vec3 centre = eye.seen(place);
      if (eye.w(centre + Vec3(0.0, 0.0, radius)) < Eye::kNearest) return;
      if (SphereLight::draws(eye, centre, largest)) return;
      const double pixel = eye.w(centre) / eye.scale();
      // A small sphere among large ones is drawn wider and fainter.
      const bool small = eye.pixels(centre, radius) < Coverage::kLargestRadius;
      const double wide = small ? Coverage::kLargestRadius * pixel : radius;
      // The soft edge reaches half a pixel beyond the sphere.
      const auto shape = eye.around(centre, wide + 0.5 * pixel);
      if (!in_sight(shape, projection.drawn())) return;
      all.push_back({centre, shape, static_cast<std::uint32_t>(i),
                     distance_from(eye, centre, radius), wide,
                     small ? radius * radius / (wide * wide) : 1.0, uncut.cuts(place, wide)});
    });
  }
  std::ranges::sort(all, [](const Seen& a, const Seen& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.number < b.number;
  });
  return all;
}

// The spheres that nearer ones do not hide, from back to front, by their index in `all`.
std::vector<std::uint32_t> not_hidden(const std::vector<Seen>& all, const Projection& projection,
                                      const Eye& eye) {
  Occlusion occlusion(projection.drawn());
  std::vector<std::uint32_t> shown;
  for (std::size_t k = all.size(); k-- > 0;) {
    const Seen& seen = all[k];
    // On the picture a sphere is an ellipse in its rectangle. The smaller axis is at least that of
    // the circle of its radius around the centre, which the ellipse contains. The squares of the
    // axes have the same sum as those of the rectangle.
    const double smaller = eye.pixels(seen.centre, seen.radius) + 0.5;
    const auto& [low, high] = seen.shape;
    const double larger =
        std::sqrt(std::max(0.25 * (high - low).squaredNorm() - smaller * smaller, 0.0));
    if (occlusion.hides(0.5 * (low + high), larger)) continue;
    shown.push_back(static_cast<std::uint32_t>(k));
    if (seen.cut || seen.opacity < 1.0) continue;
    occlusion.cover(eye.pixels(seen.centre), smaller - 1.0);
  }
  std::ranges::reverse(shown);
  return shown;
}

// Draws each cut sphere later, just before an uncut one would cover it on the picture: longer runs
// of one kind need fewer draw calls. The picture is divided into square tiles.
void join_runs(std::vector<std::uint32_t>& shown, const std::vector<Seen>& all, Size drawn) {
  constexpr double kTile = 8.0;  // pixels
  const auto index = [](double place, int pixels) {
    return static_cast<std::size_t>(std::clamp(place, 0.0, pixels - 1.0) / kTile);
  };
  const std::size_t columns = index(drawn.width, drawn.width) + 1;
  const std::size_t rows = index(drawn.height, drawn.height) + 1;
  std::vector<std::uint32_t> covered(columns * rows, 0);  // the last run of cut spheres in a tile
  std::vector<std::uint32_t> ordered, later;
  std::uint32_t run = 1;
  for (const std::uint32_t k : shown) {
    const auto& [low, high] = all[k].shape;
    bool waits = false;
    for (std::size_t y = index(low.y(), drawn.height); y <= index(high.y(), drawn.height); ++y) {
      for (std::size_t x = index(low.x(), drawn.width); x <= index(high.x(), drawn.width); ++x) {
        std::uint32_t& tile = covered[y * columns + x];
        if (all[k].cut) tile = run;
        waits = waits || tile == run;
      }
    }
    if (!all[k].cut && waits) {
      ordered.insert(ordered.end(), later.begin(), later.end());
      later.clear();
      ++run;
    }
    (all[k].cut ? later : ordered).push_back(k);
  }
  ordered.insert(ordered.end(), later.begin(), later.end());
  shown = std::move(ordered);
}

std::string defines_of(Blending blending, const std::string& defines) {
  return blending == Blending::Light ? defines : defines + "ENCODED ";
}

std::array<float, 3> as_floats(const auto& vector) {
  return {static_cast<float>(vector.x()), static_cast<float>(vector.y()),
          static_cast<float>(vector.z())};
}

}  // namespace

SphereLayer::Programs::Programs(const Gl& gl, Blending blending, const std::string& defines)
    : uncut(gl, "sphere.vert", "sphere.frag", defines_of(blending, defines)),
      cut(gl, "sphere.vert", "sphere.frag", defines_of(blending, defines + "CUT ")) {}

SphereLayer::SphereLayer(const Gl& gl, Blending blending)
    : gl_(&gl),
      blending_(blending),
      plain_(gl, blending, ""),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      vertices_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindVertexArray(vertices_.id());
  for (GLuint attribute : {0, 1, 2, 3, 4, 5}) {
    gl.EnableVertexAttribArray(attribute);
    gl.VertexAttribDivisor(attribute, 1);
  }
}

void SphereLayer::read_from(std::size_t first) const {
  const auto attribute = [&](GLuint index, GLint size, std::size_t offset, GLenum type = GL_FLOAT) {
    gl_->VertexAttribPointer(index, size, type, type != GL_FLOAT, sizeof(Sphere),
                             reinterpret_cast<const void*>(first * sizeof(Sphere) + offset));
  };
  attribute(0, 4, offsetof(Sphere, centre));
  attribute(1, 4, offsetof(Sphere, light), GL_UNSIGNED_SHORT);
  attribute(2, 4, offsetof(Sphere, crowding));
  attribute(3, 3, offsetof(Sphere, squares));
  attribute(4, 3, offsetof(Sphere, products));
  attribute(5, 4, offsetof(Sphere, turn));
}

void SphereLayer::collect(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                          const DiskColours& colours, const std::optional<Slab>& slab,
                          bool ghosts) {
  const std::vector<Seen> all = visible(snapshot, projection, eye, slab, ghosts);
  std::vector<std::uint32_t> shown = not_hidden(all, projection, eye);
  join_runs(shown, all, projection.drawn());
  std::vector<Vec3> centres;
  std::vector<double> radii = {0.5 * snapshot.diameter};  // one for all
  if (!snapshot.grains.empty()) radii.clear();
  for (const Seen& seen : all) {
    centres.push_back(seen.centre);
    if (!snapshot.grains.empty()) radii.push_back(snapshot.radius(seen.number));
  }
  const std::vector<NeighbourShade> shades = neighbour_shades(centres, radii, shown);
  const Eigen::Quaterniond world_of_view(Eigen::Matrix3d(eye.axes().transpose()));
  spheres_.clear();
  runs_.clear();
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const NeighbourShade& shade = shades[k];
    const Seen& seen = all[shown[k]];
    if (runs_.empty() || runs_.back().cut != seen.cut) runs_.push_back({seen.cut, k, 0});
    ++runs_.back().count;
    const auto [x, y, z] = as_floats(shade.direction);
    Eigen::Quaternionf turn = Eigen::Quaternionf::Identity();
    if (!snapshot.orientations.empty()) {
      turn = (snapshot.orientations[seen.number].conjugate() * world_of_view).cast<float>();
    }
    Light light = light_of(colours.of(snapshot, seen.number));
    light[3] = static_cast<std::uint16_t>(std::lround(seen.opacity * light[3]));
    const auto [at_x, at_y, at_z] = as_floats(seen.centre);
    spheres_.push_back({{at_x, at_y, at_z, static_cast<float>(seen.radius)},
                        light,
                        {x, y, z, shade.weight},
                        as_floats(shade.squares),
                        as_floats(shade.products),
                        {turn.x(), turn.y(), turn.z(), turn.w()}});
  }
}

void SphereLayer::set_uniforms(const Program& program, const Snapshot& snapshot,
                               const Projection& projection, const Eye& eye,
                               const std::optional<Slab>& slab, bool ghosts) const {
  const DrawnRegion region = drawn_region(snapshot, slab, true);
  const DrawnRegion faint = drawn_region(snapshot, slab, !ghosts);
  program.use();
  set_eye(*gl_, program, snapshot.box, projection, eye);
  gl_->Uniform1f(program.uniform("u_samples"), projection.samples);
  set_vector(*gl_, program, "u_low", region.low);
  set_vector(*gl_, program, "u_high", region.high);
  set_vector(*gl_, program, "u_ghost_low", faint.low);
  set_vector(*gl_, program, "u_ghost_high", faint.high);
}

void SphereLayer::draw(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
                       const DiskColours& colours, const std::optional<Slab>& slab, bool ghosts) {
  collect(snapshot, projection, eye, colours, slab, ghosts);
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, spheres_.size() * sizeof(Sphere), spheres_.data(),
                  GL_STREAM_DRAW);
  const bool marked = !snapshot.orientations.empty();
  if (marked && !marked_) marked_.emplace(*gl_, blending_, "MARKED ");
  const Programs& programs = marked ? *marked_ : plain_;
  for (const Program* program : {&programs.uncut, &programs.cut}) {
    set_uniforms(*program, snapshot, projection, eye, slab, ghosts);
  }
  encode_light(*gl_, blending_ == Blending::Light);
  gl_->BindVertexArray(vertices_.id());
  for (const Run& run : runs_) {
    (run.cut ? programs.cut : programs.uncut).use();
    read_from(run.first);
    gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, run.count);
  }
  encode_light(*gl_, false);
}

}  // namespace clatter
