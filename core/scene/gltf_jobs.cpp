#include "scene/gltf_jobs.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace etendue::scene::gltf {

void run_jobs(size_t count, const std::function<void(size_t)>& job, const std::function<bool(float)>& progress) {
  std::atomic<size_t> done{0};
  std::atomic<bool> cancelled{false};
  std::mutex mutex;
  std::exception_ptr error;
  size_t failed = count;
  const auto caller = std::this_thread::get_id();
  tbb::parallel_for(tbb::blocked_range<size_t>(0, count, 1), [&](const tbb::blocked_range<size_t>& range) {
    for (size_t i = range.begin(); i != range.end(); ++i) {
      if (cancelled) return;
      try {
        job(i);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (i < failed) failed = i, error = std::current_exception();
      }
      const float part = static_cast<float>(++done) / static_cast<float>(count);
      if (std::this_thread::get_id() == caller && !progress(part)) cancelled = true;
    }
  });
  if (cancelled) throw Cancelled{};
  if (error) std::rethrow_exception(error);
}

}  // namespace etendue::scene::gltf
