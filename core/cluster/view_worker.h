// A rank that renders samples for the viewer of rank 0.
#pragma once
#include <functional>
#include <string>

#include "cluster/communicator.h"
#include "render/document.h"

namespace etendue::cluster {

struct ViewWorkerSetup {
  int threads = 0;  // as in render::SessionOptions
  std::string version;
  std::function<uint64_t(const render::Document&)> scene_hash;
  // Rank 0 sends something every second. After a silence of this many seconds it is assumed to have ended.
  double longest_silence = 15;
};

// Serves rank 0 until the viewer ends. Returns whether rank 0 has ended it, rather than vanished.
bool run_view_worker(Communicator& communicator, const ViewWorkerSetup& setup);

}  // namespace etendue::cluster
