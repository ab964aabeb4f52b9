// A library to preload before GLFW. OpenGL then reports a lost context.

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
