// Measuring in a process of one's own, where nothing is loaded, cached or allocated yet.
#pragma once
#include <cstddef>
#include <functional>

namespace etendue::test {

// Runs `work` in a child of this process and returns its exit code; -1 if it crashed. Call it before this process has
// started threads: they would be missing in the child.
int in_own_process(const std::function<int()>& work);

// Bytes of this process that were resident at most (VmHWM), and are now (VmRSS).
size_t peak_resident();
size_t resident();

}  // namespace etendue::test
