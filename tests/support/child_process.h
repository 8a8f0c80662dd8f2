// Measurements in a child process, where nothing is loaded, cached or allocated yet.
#pragma once
#include <cstddef>
#include <functional>

namespace etendue::test {

// Runs `work` in a child of this process and returns its exit code, or -1 if it crashed. Must be called before this
// process starts threads, because they do not exist in the child.
int run_in_child_process(const std::function<int()>& work);

// Resident memory of this process in bytes: the peak (VmHWM) and the present value (VmRSS).
size_t peak_resident_bytes();
size_t resident_bytes();

}  // namespace etendue::test
