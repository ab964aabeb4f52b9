#pragma once

#include <memory>
#include <string>

#include "render/context/gl.h"

namespace clatter {

/// Source of the OpenGL context.
enum class Backend {
  Auto,    ///< Egl if it works, else Osmesa
  Egl,     ///< off screen, on a GPU if there is one
  Osmesa,  ///< off screen, on the CPU, without a driver
  Glfw,    ///< on a display
};

/// Name of a backend on the command line: "auto", "egl", "osmesa" or "glfw".
const char* name_of(Backend backend);

/// An OpenGL 3.3 core context. It is current on the thread that creates it, for its whole life. A
/// thread may have only one at a time, because Mesa's backends share the current context.
class GlContext {
 public:
  GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  virtual ~GlContext() = default;

  /// The OpenGL functions, valid during the life of the context.
  const Gl& gl() const { return gl_; }
  /// Name of the backend, see name_of().
  virtual const char* name() const = 0;
  /// Renderer and version from the driver: "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 ...".
  std::string description() const;

 protected:
  Gl gl_;  ///< loaded by the constructor of the backend
};

/// Opens a context. Throws RunError with the error of each tried backend and the package to
/// install.
std::unique_ptr<GlContext> open_context(Backend backend);

}  // namespace clatter
