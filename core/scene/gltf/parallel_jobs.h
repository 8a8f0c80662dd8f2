// Runs independent jobs on all processors, with progress and cancellation.
#pragma once
#include <cstddef>
#include <functional>

namespace etendue::scene::gltf {

// Thrown when a progress callback cancels.
struct Cancelled {};

// Runs job(0), ..., job(count - 1) in any order. `progress` receives the finished fraction and is called on the calling
// thread only; if it returns false, Cancelled is thrown. If jobs throw, the exception of the lowest index is rethrown.
void run_jobs(size_t count, const std::function<void(size_t)>& job, const std::function<bool(float)>& progress);

}  // namespace etendue::scene::gltf
