// Keeps libraries loaded to the end of a program under the address sanitizer. Unloading a driver
// before the leak search would remove its pointers to its memory. It would also remove its function
// names, which leaks.supp needs.

#include <dlfcn.h>

extern "C" int dlclose(void*) noexcept {
  return 0;
}
