#include "render/context/egl_context.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "engine/error.h"

namespace clatter {

EglContext::EglContext(Api api) : library_("libEGL.so.1", "libegl1") {
  display_ = open_any_display();
  if (display_ == EGL_NO_DISPLAY) fail("neither a surfaceless display nor a device");
  try {
    make_context(api);
    auto address_of = library_.function<decltype(&eglGetProcAddress)>("eglGetProcAddress");
    gl_ = load_gl([&](const char* symbol) { return reinterpret_cast<void*>(address_of(symbol)); },
                  api);
  } catch (...) {
    release();
    throw;
  }
}

EglContext::~EglContext() {
  release();
}

template <class F>
F EglContext::function(const char* symbol) const {
  auto address_of = library_.function<decltype(&eglGetProcAddress)>("eglGetProcAddress");
  return reinterpret_cast<F>(address_of(symbol));
}

EGLDisplay EglContext::open_display(EGLenum platform, void* native) const {
  auto get_display = function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  auto initialise = library_.function<decltype(&eglInitialize)>("eglInitialize");
  if (!get_display) return EGL_NO_DISPLAY;
  EGLDisplay display = get_display(platform, native, nullptr);
  if (display == EGL_NO_DISPLAY || !initialise(display, nullptr, nullptr)) return EGL_NO_DISPLAY;
  return display;
}

EGLDisplay EglContext::open_any_display() const {
  EGLDisplay display = open_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr);
  auto query_devices = function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  if (display != EGL_NO_DISPLAY || !query_devices) return display;

  std::array<EGLDeviceEXT, 16> devices;
  EGLint count = 0;
  query_devices(devices.size(), devices.data(), &count);
  for (EGLint i = 0; i < count && display == EGL_NO_DISPLAY; ++i) {
    display = open_display(EGL_PLATFORM_DEVICE_EXT, devices[i]);
  }
  return display;
}

void EglContext::make_context(Api api) {
  auto bind_api = library_.function<decltype(&eglBindAPI)>("eglBindAPI");
  auto choose_config = library_.function<decltype(&eglChooseConfig)>("eglChooseConfig");
  auto create_surface =
      library_.function<decltype(&eglCreatePbufferSurface)>("eglCreatePbufferSurface");
  auto create_context = library_.function<decltype(&eglCreateContext)>("eglCreateContext");
  auto make_current = library_.function<decltype(&eglMakeCurrent)>("eglMakeCurrent");

  const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                           api == Api::Es ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!bind_api(api == Api::Es ? EGL_OPENGL_ES_API : EGL_OPENGL_API) ||
      !choose_config(display_, wanted, &config, 1, &count) || !count) {
    fail("the display does not offer OpenGL");
  }
  const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
  surface_ = create_surface(display_, config, size);

  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                            3,
                            EGL_CONTEXT_MINOR_VERSION,
                            3,
                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                            EGL_NONE};
  const EGLint version_of_es[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0,
                                  EGL_NONE};
  context_ =
      create_context(display_, config, EGL_NO_CONTEXT, api == Api::Es ? version_of_es : version);
  if (context_ == EGL_NO_CONTEXT) {
    fail(api == Api::Es ? "no OpenGL ES 3.0 context" : "no OpenGL 3.3 core context");
  }
  if (!make_current(display_, surface_, surface_, context_)) fail("the context cannot be current");
}

void EglContext::release() {
  auto make_current = library_.function<decltype(&eglMakeCurrent)>("eglMakeCurrent");
  auto destroy_context = library_.function<decltype(&eglDestroyContext)>("eglDestroyContext");
  auto destroy_surface = library_.function<decltype(&eglDestroySurface)>("eglDestroySurface");
  make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (context_ != EGL_NO_CONTEXT) destroy_context(display_, context_);
  if (surface_ != EGL_NO_SURFACE) destroy_surface(display_, surface_);
}

void EglContext::fail(const char* what) const {
  auto get_error = library_.function<decltype(&eglGetError)>("eglGetError");
  throw RunError(
      fmt::format("egl: {}, error 0x{:04x} (apt install libegl1 libegl-mesa0)", what, get_error()));
}

}  // namespace clatter
