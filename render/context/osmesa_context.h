#pragma once

#include <array>
#include <memory>

#include "render/context/context.h"
#include "render/context/library.h"

struct osmesa_context;

namespace clatter {

/// OpenGL by Mesa's off-screen library: needs neither display nor driver.
class OsmesaContext final : public GlContext {
 public:
  /// Makes the context and makes it current; throws RunError.
  OsmesaContext();

  const char* name() const override { return "osmesa"; }

 private:
  using Handle = std::unique_ptr<osmesa_context, void (*)(osmesa_context*)>;

  Library library_;
  Handle context_;
  std::array<unsigned char, 4> surface_ = {};  ///< OSMesa insists on one; pictures have their own
};

}  // namespace clatter
