#pragma once

// Excludes the X11 headers, whose macros (None, Status, ...) clash with common names.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "engine/system/library.h"
#include "render/context/context.h"

namespace clatter {

/// OpenGL through EGL without a display server: Mesa's surfaceless platform, else the first usable
/// device.
class EglContext final : public GlContext {
 public:
  /// Creates the context and makes it current. Throws RunError if EGL or this version of OpenGL is
  /// missing.
  explicit EglContext(Api api = Api::Desktop);
  ~EglContext() override;

  const char* name() const override { return "egl"; }

 private:
  template <class F>
  F function(const char* symbol) const;
  /// The initialised display of a platform; EGL_NO_DISPLAY: none.
  EGLDisplay open_display(EGLenum platform, void* native) const;
  EGLDisplay open_any_display() const;
  void make_context(Api api);
  void release();
  [[noreturn]] void fail(const char* what) const;

  Library library_;
  EGLDisplay display_ = EGL_NO_DISPLAY;  ///< never terminated: the whole process shares it
  EGLSurface surface_ =
      EGL_NO_SURFACE;  ///< 1x1, for drivers that require one; pictures use framebuffers
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace clatter
