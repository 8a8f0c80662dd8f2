// Independent pieces of work on all processors, with a bar and a way out.
#pragma once
#include <cstddef>
#include <functional>

namespace etendue::scene::gltf {

struct Cancelled {};

// Runs job(0), ..., job(count - 1) in any order. `progress` gets the finished part, is called on this thread, and
// cancels by returning false: Cancelled is thrown. Otherwise, if jobs threw, the exception of the lowest one is thrown
// again.
void run_jobs(size_t count, const std::function<void(size_t)>& job, const std::function<bool(float)>& progress);

}  // namespace etendue::scene::gltf
