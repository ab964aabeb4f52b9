// Keeps libraries loaded to the end of a program under the address sanitizer. A driver unloaded
// before the search for leaks would take along the pointers to its memory, and the names of its
// functions, by which leaks.supp recognises its leaks.

#include <dlfcn.h>

extern "C" int dlclose(void*) noexcept {
  return 0;
}
