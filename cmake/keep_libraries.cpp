// Keeps loaded libraries loaded, in programs with sanitizers. Reports name the functions of a library, and suppressions
// find it, only while it is loaded; Mesa unloads its driver with the last display.
#include <dlfcn.h>

int dlclose(void* /*handle*/) noexcept { return 0; }
