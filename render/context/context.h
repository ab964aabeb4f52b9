#pragma once

#include <memory>
#include <string>

#include "render/context/gl.h"

namespace clatter {

/// Where OpenGL comes from.
enum class Backend {
  Auto,    ///< the first of the next two that works
  Egl,     ///< off screen, on a GPU where there is one
  Osmesa,  ///< off screen, on the processor, without any driver
  Glfw,    ///< that of a display
};

/// An OpenGL 3.3 core context, current on the thread that made it from its making to its end.
/// A thread has one at a time, because Mesa's backends share their notion of the current one.
class GlContext {
 public:
  GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  virtual ~GlContext() = default;

  /// The context's functions; they live as long as it.
  const Gl& gl() const { return gl_; }
  /// The backend's name as on the command line: "egl", "osmesa", "glfw".
  virtual const char* name() const = 0;
  /// What draws, in the driver's words, e.g. "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 ...".
  std::string description() const;

 protected:
  Gl gl_;  ///< loaded by the backend's constructor
};

/// Opens a context; throws RunError that names what each tried backend said and what to install.
std::unique_ptr<GlContext> open_context(Backend backend);

}  // namespace clatter
