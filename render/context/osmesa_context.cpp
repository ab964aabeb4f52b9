#include "render/context/osmesa_context.h"

#include <GL/osmesa.h>

#include "engine/error.h"

namespace clatter {

OsmesaContext::OsmesaContext()
    : library_("libOSMesa.so.8", "libosmesa6"),
      context_(nullptr,
               library_.function<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext")) {
  const int attributes[] = {OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  auto create =
      library_.function<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs");
  auto make_current = library_.function<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent");
  auto address_of = library_.function<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress");

  context_.reset(create(attributes, nullptr));
  if (!context_ || !make_current(context_.get(), surface_.data(), GL_UNSIGNED_BYTE, 1, 1)) {
    throw RunError("osmesa: no OpenGL 3.3 core context (apt install libosmesa6)");
  }
  gl_ = load_gl([&](const char* symbol) { return reinterpret_cast<void*>(address_of(symbol)); });
}

}  // namespace clatter
