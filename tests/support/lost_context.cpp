// Loaded into a program before GLFW, it makes OpenGL say that the driver has dropped its context.

#include <dlfcn.h>

#include <cstring>

namespace {

using Function = void (*)();

unsigned lost() {
  return 0x8255;  // GL_UNKNOWN_CONTEXT_RESET
}

}  // namespace

extern "C" Function glfwGetProcAddress(const char* name) {
  if (std::strcmp(name, "glGetGraphicsResetStatus") == 0) return reinterpret_cast<Function>(lost);
  static const auto found =
      reinterpret_cast<Function (*)(const char*)>(dlsym(RTLD_NEXT, "glfwGetProcAddress"));
  return found(name);
}
