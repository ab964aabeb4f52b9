#pragma once

// Without X11's headers, whose macros (None, Status, ...) clash with everything.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "render/context/context.h"
#include "render/context/library.h"

namespace clatter {

/// OpenGL by EGL without a display server: Mesa's surfaceless platform, else the first device.
class EglContext final : public GlContext {
 public:
  /// Makes the context and makes it current; throws RunError.
  EglContext();
  ~EglContext() override;

  const char* name() const override { return "egl"; }

 private:
  template <class F>
  F function(const char* symbol) const;
  /// The platform's display, initialised; EGL_NO_DISPLAY where there is none.
  EGLDisplay open_display(EGLenum platform, void* native) const;
  EGLDisplay open_any_display() const;
  void make_context();
  void release();
  [[noreturn]] void fail(const char* what) const;

  Library library_;
  EGLDisplay display_ = EGL_NO_DISPLAY;  ///< never terminated: EGL hands one to the whole process
  EGLSurface surface_ =
      EGL_NO_SURFACE;  ///< 1x1, for drivers that want one; pictures have their own
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace clatter
