#include "render/context/gl.h"

#include <string>

#include "engine/error.h"

namespace clatter {

Gl load_gl(const std::function<void*(const char*)>& address_of, Api api) {
  Gl gl;
  gl.api = api;
  std::string missing;
#define CLATTER_GL_LOAD(name)                                            \
  gl.name = reinterpret_cast<decltype(gl.name)>(address_of("gl" #name)); \
  if (!gl.name) missing += " gl" #name;
  CLATTER_GL_FUNCTIONS(CLATTER_GL_LOAD)
#undef CLATTER_GL_LOAD
  if (!missing.empty()) throw RunError("this OpenGL lacks functions of version 3.3:" + missing);
  return gl;
}

void encode_light(const Gl& gl, bool on) {
  if (gl.api == Api::Es) return;
  (on ? gl.Enable : gl.Disable)(GL_FRAMEBUFFER_SRGB);
}

}  // namespace clatter
