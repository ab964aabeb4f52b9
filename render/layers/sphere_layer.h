#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/picture/snapshot.h"
#include "render/drawn_region.h"
#include "render/eye.h"
#include "render/gl/shader_program.h"
#include "render/layers/disk_colours.h"

// Spheres. An Eye maps the world to view coordinates, and these to pixels and depths. Each sphere
// is a rectangle; sphere.frag finds the point where the ray of a pixel meets the sphere. Spheres
// that do not overlap hide each other in the order of |c - e|^2 - r^2, with the viewer at e. The
// reason is the plane on which two spheres have equal values: it is between them, and the sphere
// with the smaller value is on the side of the viewer. No ray from the viewer crosses this plane
// twice. For a distant viewer this is the order of depths. So spheres are drawn from back to front,
// and their soft edges blend with the spheres behind. Occlusion has a bit for
// each pixel, and leaves out hidden spheres. Cut spheres need a slower shader, so they are drawn in
// runs of their own. NeighbourShade is the ambient occlusion of a sphere by its neighbours, to
// second order in the normal. It depends on no pixel, so it is the same at all sizes. Planes of a
// slab and of periodic borders cut spheres flat. Sides of the box and slices come first, edges of
// the box last, tested against the depths.

namespace clatter {

/// Draws spheres with soft light and exact depth, each as the pixels of its rectangle on the
/// picture, without those that SphereLight draws. Spheres of known orientation have marks that turn
/// with them. They are drawn from back to front, so that their
/// edges blend with what is behind them.
class SphereLayer {
 public:
  /// Encoded blending is for pictures without a background.
  explicit SphereLayer(const Gl& gl, Blending blending = Blending::Light);

  /// Draws the spheres of a snapshot, and their images at periodic borders. With `ghosts` the parts
  /// beyond these borders are drawn faintly, with depths.
  void draw(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
            const DiskColours& colours, const std::optional<Slab>& slab, bool ghosts = true);

 private:
  struct Sphere {
    std::array<float, 4> centre;  // view coordinates, and the radius
    Light light;
    std::array<float, 4> crowding;  // direction and weight of its NeighbourShade
    std::array<float, 3> squares, products;
    std::array<float, 4> turn;  // from the view to the sphere, real part last
  };

  // Consecutive spheres that planes cut, or that none cuts.
  struct Run {
    bool cut;
    std::size_t first;
    GLsizei count;
  };

  // Programs without and with planes that cut spheres.
  struct Programs {
    Programs(const Gl& gl, Blending blending, const std::string& defines);
    Program uncut, cut;
  };

  void read_from(std::size_t first) const;
  void collect(const Snapshot& snapshot, const Projection& projection, const Eye& eye,
               const DiskColours& colours, const std::optional<Slab>& slab, bool ghosts);
  void set_uniforms(const Program& program, const Snapshot& snapshot, const Projection& projection,
                    const Eye& eye, const std::optional<Slab>& slab, bool ghosts) const;

  const Gl* gl_;
  Blending blending_;
  Programs plain_;                  ///< without marks
  std::optional<Programs> marked_;  ///< absent: no marks drawn yet
  Buffer buffer_;
  VertexArray vertices_;
  std::vector<Sphere> spheres_;  ///< from back to front; reused to avoid allocations
  std::vector<Run> runs_;        ///< of the spheres, in order
};

}  // namespace clatter
