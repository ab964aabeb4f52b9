#pragma once

#include <array>
#include <memory>

#include "engine/system/library.h"
#include "render/context/context.h"

struct osmesa_context;

namespace clatter {

/// OpenGL through Mesa's off-screen library, without a display or driver.
class OsmesaContext final : public GlContext {
 public:
  /// Creates the context and makes it current. Throws RunError if OSMesa or OpenGL 3.3 is missing.
  OsmesaContext();

  const char* name() const override { return "osmesa"; }

 private:
  using Handle = std::unique_ptr<osmesa_context, void (*)(osmesa_context*)>;

  Library library_;
  Handle context_;
  std::array<unsigned char, 4> surface_ = {};  ///< required by OSMesa; pictures use framebuffers
};

}  // namespace clatter
