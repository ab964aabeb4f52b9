#include "render/context/osmesa_context.h"

#include "engine/error.h"

namespace clatter {

namespace {

// The interface of OSMesa that is used here, as in GL/osmesa.h of Mesa up to version 25.0. Later
// versions have neither the library nor the header.
using Context = osmesa_context*;
using CreateContextAttribs = Context (*)(const int* attributes, Context shared);
using DestroyContext = void (*)(Context);
using MakeCurrent = GLboolean (*)(Context, void* pixels, GLenum type, GLsizei width,
                                  GLsizei height);
using Function = void (*)();
using GetProcAddress = Function (*)(const char* name);
constexpr int kProfile = 0x33, kCoreProfile = 0x34, kMajorVersion = 0x36, kMinorVersion = 0x37;

Library open_library() {
  try {
    return Library("libOSMesa.so.8", "libosmesa6");
  } catch (const RunError& error) {
    throw RunError(std::string("osmesa: ") + error.what() +
                   "; Mesa has no OSMesa since version 25.1, use --backend egl");
  }
}

}  // namespace

OsmesaContext::OsmesaContext()
    : library_(open_library()),
      context_(nullptr, library_.function<DestroyContext>("OSMesaDestroyContext")) {
  const int attributes[] = {kProfile, kCoreProfile, kMajorVersion, 3, kMinorVersion, 3, 0};
  auto create = library_.function<CreateContextAttribs>("OSMesaCreateContextAttribs");
  auto make_current = library_.function<MakeCurrent>("OSMesaMakeCurrent");
  auto address_of = library_.function<GetProcAddress>("OSMesaGetProcAddress");

  context_.reset(create(attributes, nullptr));
  if (!context_ || !make_current(context_.get(), surface_.data(), GL_UNSIGNED_BYTE, 1, 1)) {
    throw RunError("osmesa: no OpenGL 3.3 core context (apt install libosmesa6)");
  }
  gl_ = load_gl([&](const char* symbol) { return reinterpret_cast<void*>(address_of(symbol)); });
}

}  // namespace clatter
