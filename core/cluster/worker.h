// A rank that renders pieces for rank 0.
#pragma once
#include <functional>
#include <string>

#include "cluster/communicator.h"
#include "render/document.h"

namespace etendue::cluster {

struct WorkerSetup {
  int threads = 0;  // as in render::SessionOptions
  std::string version;
  std::function<uint64_t(const render::Document&)> scene_hash;
};

// Serves rank 0 until the job ends. Errors are reported to rank 0.
void run_worker(Communicator& communicator, const WorkerSetup& setup);

}  // namespace etendue::cluster
