#include "engine/system/library.h"

#include <dlfcn.h>

#include <string>

#include "engine/error.h"

namespace clatter {

Library::Library(const char* name, const char* package) : name_(name) {
  // RTLD_LOCAL: several GL libraries in one process must not see each other's symbols.
  // RTLD_NODELETE: drivers leave exit handlers and thread-local state behind.
  handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (!handle_) throw RunError(std::string(dlerror()) + " (apt install " + package + ")");
}

void* Library::address(const char* symbol) const {
  void* found = dlsym(handle_, symbol);
  if (!found) throw RunError(std::string(name_) + " has no function " + symbol);
  return found;
}

}  // namespace clatter
