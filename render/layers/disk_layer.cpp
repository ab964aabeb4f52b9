#include "render/layers/disk_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "render/layers/chords.h"
#include "render/layers/wall_layer.h"

namespace clatter {

namespace {

constexpr double kSoftEdge = 0.5;  // from the radius of a disk to its outermost pixels, pixels

// The radius of the largest disks.
double radius_pixels(const Snapshot& snapshot, const Projection& projection) {
  return 0.5 * snapshot.diameter * projection.scale();
}

// The centres from which a disk reaches into a picture.
struct Sight {
  Vec2 low, high;

  Sight(const Projection& projection, double radius)
      : low(Vec2::Constant(-(radius + kSoftEdge))),
        high(projection.drawn().width + radius + kSoftEdge,
             projection.drawn().height + radius + kSoftEdge) {}
  bool contains(const Vec2& centre) const {
    return (centre.array() > low.array()).all() && (centre.array() < high.array()).all();
  }
};

// The radius of the largest disks that have a coverage, if there is one.
double largest_covered(const Snapshot& snapshot, const Projection& projection) {
  const double largest = radius_pixels(snapshot, projection);
  if (largest < Coverage::kLargestRadius) return largest;
  double covered = 0.0;
  for (const Grain& grain : snapshot.grains) {
    const double radius = grain.radius * projection.scale();
    if (radius < Coverage::kLargestRadius) covered = std::max(covered, radius);
  }
  return covered;
}

double largest_point_of(const Gl& gl) {
  std::array<GLfloat, 2> range = {};
  constexpr GLenum kPointSizeRangeOfEs = 0x846D;  // GL_ALIASED_POINT_SIZE_RANGE
  gl.GetFloatv(gl.api == Api::Es ? kPointSizeRangeOfEs : GL_POINT_SIZE_RANGE, range.data());
  return range[1];
}

// Calls `visit` with the centre, in pixels, and the number of each visible disk and periodic image.
template <class Visit>
void visit_disks(const Snapshot& snapshot, const Projection& projection, const Tiling& tiling,
                 Visit visit) {
  // Calls `shifted` with the boxes along an axis between a disk and its periodic images.
  auto shifts = [&](int axis, double place, double radius, auto&& shifted) {
    const int first = tiling.first[axis], last = tiling.last[axis];
    for (int copy = first; copy <= last; ++copy) shifted(copy);
    if (snapshot.walls[2 * axis]) return;
    if (place < radius) shifted(last + 1);
    if (place > snapshot.box[axis] - radius) shifted(first - 1);
  };

  const bool alike = snapshot.grains.empty();
  double radius = 0.5 * snapshot.diameter;
  Sight sight(projection, radius * projection.scale());
  for (std::size_t i = 0; i < snapshot.count(); ++i) {
    const Vec2 place = snapshot.positions.col(static_cast<Eigen::Index>(i));
    if (!alike) {
      radius = snapshot.radius(i);
      sight = Sight(projection, radius * projection.scale());
    }
    const auto show = [&](const Vec2& at, int across, int above) {
      const Vec2 centre =
          projection.pixels(at + Vec2(across * snapshot.box[0], above * snapshot.box[1]));
      if (sight.contains(centre)) visit(centre, i);
    };
    if (snapshot.slide == 0.0 && snapshot.offset == 0.0) {
      shifts(0, place.x(), radius, [&](int across) {
        shifts(1, place.y(), radius, [&](int above) { show(place, across, above); });
      });
      continue;
    }
    shifts(1, place.y(), radius, [&](int above) {
      Vec2 slid(place.x() + above * snapshot.offset, place.y());
      slid.x() -= std::floor(slid.x() / snapshot.box[0]) * snapshot.box[0];
      shifts(0, slid.x(), radius, [&](int across) { show(slid, across, above); });
    });
  }
}

}  // namespace

DiskLayer::DiskLayer(const Gl& gl, std::optional<double> largest_point)
    : gl_(&gl),
      largest_point_(largest_point.value_or(largest_point_of(gl))),
      point_(gl, "disk_point.vert", "disk.frag"),
      square_(gl, "disk_quad.vert", "disk.frag"),
      swept_(gl),
      light_(gl),
      buffer_(generate<Buffer>(gl, gl.GenBuffers)),
      radii_of_disks_(gl),
      points_(generate<VertexArray>(gl, gl.GenVertexArrays)),
      squares_(generate<VertexArray>(gl, gl.GenVertexArrays)) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  for (const auto& [array, divisor] : {std::pair(points_.id(), 0), std::pair(squares_.id(), 1)}) {
    gl.BindVertexArray(array);
    gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(Disk), nullptr);
    gl.VertexAttribPointer(1, 4, GL_UNSIGNED_SHORT, GL_TRUE, sizeof(Disk),
                           reinterpret_cast<const void*>(offsetof(Disk, light)));
    gl.VertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, sizeof(Disk),
                           reinterpret_cast<const void*>(offsetof(Disk, angle)));
    for (GLuint attribute : {0, 1, 2}) {
      gl.EnableVertexAttribArray(attribute);
      gl.VertexAttribDivisor(attribute, divisor);
    }
  }
}

void DiskLayer::draw(const Snapshot& snapshot, const Projection& projection,
                     const DiskColours& colours, const Tiling& tiling) {
  constexpr double kLimit = Coverage::kLargestRadius;
  const double largest = radius_pixels(snapshot, projection);
  const bool has_small = snapshot.smallest_radius() * projection.scale() < kLimit;
  if (has_small) draw_coverage(snapshot, projection, colours, tiling);
  if (largest < kLimit) return;
  if (snapshot.exposure > 0.0) {
    swept_.draw(snapshot, projection, colours, tiling, kLimit);
  } else {
    draw_shapes(snapshot, projection, colours, tiling);
  }
}

// Disks of a mixture that are too large for a coverage are left out.
void DiskLayer::draw_coverage(const Snapshot& snapshot, const Projection& projection,
                              const DiskColours& colours, const Tiling& tiling) {
  const double largest = largest_covered(snapshot, projection);
  coverage_.restart(projection.drawn(), largest);
  if (snapshot.exposure > 0.0) {
    cover_paths(snapshot, projection, colours, tiling, largest);
  } else {
    visit_disks(snapshot, projection, tiling, [&](const Vec2& centre, std::size_t i) {
      if (snapshot.grains.empty()) return coverage_.add(centre, colours.of(snapshot, i));
      const double radius = snapshot.radius(i) * projection.scale();
      if (radius >= Coverage::kLargestRadius) return;
      coverage_.add(centre, colours.of(snapshot, i), 1.0f, radius / largest);
    });
  }
  coverage_.sum();
  light_.draw(coverage_, projection, faces_of(snapshot), tiling.faintness, colours.blending);
}

// Adds disks along their paths in steps, each with its share of the exposure. The coverage resolves
// positions far below a step.
void DiskLayer::cover_paths(const Snapshot& snapshot, const Projection& projection,
                            const DiskColours& colours, const Tiling& tiling, double largest) {
  constexpr double kStep = 0.25;  // pixels
  constexpr double kMaxSteps = 1e6;
  const bool alike = snapshot.grains.empty();
  for (const Chord& chord :
       chords(snapshot, snapshot.flights, projection, snapshot.exposure, tiling)) {
    const double radius = snapshot.radius(chord.disk) * projection.scale();
    if (radius >= Coverage::kLargestRadius) continue;
    const Sight sight(projection, radius);
    const double relative = alike ? 1.0 : radius / largest;
    const Colour colour = colours.of(snapshot, chord.disk);
    const Vec2 way = chord.end - chord.start;
    const int steps = static_cast<int>(std::min(way.norm() / kStep, kMaxSteps)) + 1;
    const double share = (chord.to - chord.from) / snapshot.exposure / steps;
    for (int k = 0; k < steps; ++k) {
      const Vec2 centre = chord.start + (k + 0.5) / steps * way;
      if (!sight.contains(centre)) continue;
      coverage_.add(centre, colour, static_cast<float>(share), relative);
    }
  }
}

void DiskLayer::collect(const Snapshot& snapshot, const Projection& projection,
                        const DiskColours& colours, const Tiling& tiling) {
  const bool marked = !snapshot.angles.empty(), alike = snapshot.grains.empty();
  disks_.clear();
  radii_.clear();
  visit_disks(snapshot, projection, tiling, [&](const Vec2& centre, std::size_t i) {
    if (!alike) {
      const double radius = snapshot.radius(i) * projection.scale();
      if (radius < Coverage::kLargestRadius) return;
      radii_.push_back(static_cast<float>(radius));
    }
    disks_.push_back({static_cast<float>(centre.x()), static_cast<float>(centre.y()),
                      marked ? static_cast<float>(snapshot.angles[i]) : 0.0f,
                      light_of(colours.of(snapshot, i))});
  });
  if (alike) radii_ = {static_cast<float>(radius_pixels(snapshot, projection))};
}

void DiskLayer::draw_shapes(const Snapshot& snapshot, const Projection& projection,
                            const DiskColours& colours, const Tiling& tiling) {
  collect(snapshot, projection, colours, tiling);
  encode_light(*gl_, colours.blending == Blending::Light);
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, disks_.size() * sizeof(Disk), disks_.data(), GL_STREAM_DRAW);

  const GLsizei count = static_cast<GLsizei>(disks_.size());
  const double reach = radius_pixels(snapshot, projection) + kSoftEdge;
  if (2.0 * reach <= largest_point_) {
    // OpenGL drops points with their centre outside the viewport, so the viewport has a margin.
    use(point_, snapshot, projection, colours.blending, tiling.faintness,
        static_cast<int>(reach) + 1);
    if (gl_->api == Api::Desktop) gl_->Enable(GL_PROGRAM_POINT_SIZE);  // ES: always on
    gl_->BindVertexArray(points_.id());
    radii_of_disks_.set(3, radii_, 0);
    gl_->DrawArrays(GL_POINTS, 0, count);
  } else {
    use(square_, snapshot, projection, colours.blending, tiling.faintness, 0);
    gl_->BindVertexArray(squares_.id());
    radii_of_disks_.set(3, radii_, 1);
    gl_->DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
  }
  encode_light(*gl_, false);
  gl_->Viewport(0, 0, projection.drawn().width, projection.drawn().height);
}

// Uses the program for these pictures. The viewport has a margin around the picture, in pixels.
void DiskLayer::use(ProgramVariants& programs, const Snapshot& snapshot,
                    const Projection& projection, Blending blending, float faintness, int margin) {
  const int width = projection.drawn().width + 2 * margin;
  const int height = projection.drawn().height + 2 * margin;
  gl_->Viewport(-margin, -margin, width, height);

  const Faces faces = faces_of(snapshot);
  const Vec2 low = projection.pixels(faces.low), high = projection.pixels(faces.high);
  std::string defines;
  if (blending == Blending::Encoded) defines += "ENCODED ";
  if (!snapshot.angles.empty()) defines += "MARKED ";
  const Program& program = programs.with(defines);
  program.use();
  gl_->Uniform2f(program.uniform("u_origin"), -margin, -margin);
  gl_->Uniform2f(program.uniform("u_extent"), width, height);
  gl_->Uniform1f(program.uniform("u_samples"), projection.samples);
  gl_->Uniform1f(program.uniform("u_faintness"), faintness);
  gl_->Uniform2f(program.uniform("u_box_low"), low.x(), low.y());
  gl_->Uniform2f(program.uniform("u_box_high"), high.x(), high.y());
}

}  // namespace clatter
