#include "view_ranks.h"

#include <unistd.h>

#include <optional>

#include "bench/reference_key.h"
#include "cluster/mpi_job.h"
#include "cluster/render_manager.h"
#include "cluster/view_manager.h"
#include "cluster/view_worker.h"
#include "command.h"
#include "render_ranks.h"

namespace etendue::cli {
namespace {

// Ranks that share a machine with others have a low priority, so that the viewer answers at once. Threads that are
// started later inherit it.
void lower_priority() {
  constexpr int kNiceness = 10;
  [[maybe_unused]] const int niceness = ::nice(kNiceness);
}

int render_for_viewer(cluster::Communicator& communicator, int threads) {
  if (cluster::run_view_worker(communicator, {threads_of_rank(threads), ETENDUE_VERSION, bench::image_key})) {
    communicator.close();
    return 0;
  }
  // Rank 0 does not exist any more.
  communicator.abort(1);
  return 1;
}

}  // namespace

int view_on_ranks(const viewer::ViewOptions& options) {
  const int launched = cluster::launched_rank();
  if (launched > 0 && cluster::processes_on_machine() > 1) lower_priority();
  const auto communicator = cluster::join_mpi_job();
  if (!communicator) {
    const Error& error = communicator.error();
    return launched == 0 ? fail(error) : static_cast<int>(error.fault);
  }
  cluster::Communicator& ranks = **communicator;
  if (ranks.rank() > 0) return render_for_viewer(ranks, options.threads);
  viewer::ViewOptions used = options;
  used.threads = threads_of_rank(options.threads);
  int code = 0;
  bool all_answer = false;
  {
    cluster::ViewManager manager(ranks, {.version = ETENDUE_VERSION, .scene_hash = bench::image_key});
    used.sharing = &manager;
    code = viewer::run_viewer(used);
    all_answer = manager.all_answer();
  }
  constexpr double kPatience = 5;  // seconds
  cluster::dismiss_ranks(ranks, code, all_answer ? kPatience : 0);
  return code;
}

}  // namespace etendue::cli
