#pragma once

#include <vector>

#include "engine/picture/snapshot.h"
#include "render/eye.h"
#include "render/gl/shader_program.h"
#include "render/layers/disk_colours.h"

// The volume is a field as fog that emits and absorbs light. volume.frag follows the ray of each
// pixel from cell to cell to the surface in the depth buffer. Cells are uniform, so their light is
// a sum of exponentials without a step. Spheres without a shape have no depths, so the volume is in
// front of them.

namespace clatter {

/// Draws a field of spheres as a fog that emits and absorbs light. The extinction coefficient of a
/// cell is proportional to the magnitude in it, and its light has the colour of the value. Cells
/// without a value are empty.
class VolumeLayer {
 public:
  /// Encoded blending is for pictures without a background.
  explicit VolumeLayer(const Gl& gl, Blending blending = Blending::Light);

  /// Draws the field of the snapshot, in the slab, in front of the surfaces of `depths`, a texture
  /// of the depths of the picture. The bound framebuffer must not have these depths.
  void draw(const Snapshot& snapshot, const View& view, const Projection& projection,
            const Eye& eye, const ColourScale& scale, GLuint depths);

 private:
  const Gl* gl_;
  Blending blending_;
  Program program_;
  VertexArray vertices_;  ///< no attributes: the shader computes the corners
  Texture cells_;
  std::vector<Eigen::Array4f> fog_;  ///< [cells_z][cells_y][cells_x]; reused to avoid allocations
};

}  // namespace clatter
