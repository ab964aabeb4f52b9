#include "render/context/web_context.h"

#include <emscripten/html5.h>

#include "engine/error.h"

namespace clatter {

WebContext::WebContext(const std::string& canvas) {
  EmscriptenWebGLContextAttributes wanted;
  emscripten_webgl_init_context_attributes(&wanted);
  wanted.majorVersion = 2;
  wanted.alpha = wanted.antialias = wanted.depth = wanted.stencil = false;
  handle_ = static_cast<int>(emscripten_webgl_create_context(canvas.c_str(), &wanted));
  if (handle_ <= 0) throw RunError("this browser has no WebGL 2");
  emscripten_webgl_make_context_current(handle_);
  if (!emscripten_webgl_enable_extension(handle_, "EXT_color_buffer_float")) {
    throw RunError("this browser cannot draw floating-point numbers (EXT_color_buffer_float)");
  }
  gl_ = load_gl([](const char* symbol) { return emscripten_webgl_get_proc_address(symbol); },
                Api::Es);
  // With the extension all formats of a Canvas are complete. The browser answers only after it has
  // drawn all earlier pictures, during which the page would stand still.
  gl_.CheckFramebufferStatus = [](GLenum) { return GLenum{GL_FRAMEBUFFER_COMPLETE}; };
}

WebContext::~WebContext() {
  emscripten_webgl_destroy_context(handle_);
}

}  // namespace clatter
