#include "render_ranks.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <thread>
#include <utility>

#include "base/file.h"
#include "base/provided_files.h"
#include "bench/reference_key.h"
#include "cluster/checkpoint_ranges.h"
#include "cluster/mpi_job.h"
#include "cluster/render_manager.h"
#include "cluster/worker.h"
#include "command.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "render/checkpoint.h"
#include "render/clock.h"
#include "render/division.h"
#include "render_statistics.h"

namespace etendue::cli {
namespace {

constexpr double kProgressInterval = 0.1;  // seconds

// The part of the image that the ranks give each other.
render::Document part_of(render::Document document) {
  document.part.first_sample = 1;
  return document;
}

// When a rank has died, mpirun sends SIGCONT to the others, and ends them one second later. This is the time to write a
// checkpoint.
std::atomic<bool> checkpoint_requested{false};
void request_checkpoint(int) { checkpoint_requested = true; }

// The files that this process has read to open the document. Those that have disappeared since are left out; the other
// ranks report them.
std::vector<ProvidedFile> files_of_scene(const std::string& checkpoint_file) {
  std::vector<ProvidedFile> files;
  for (const std::string& path : files_read())
    if (path != checkpoint_file)
      if (auto bytes = read_file(path)) files.push_back({path, std::move(*bytes)});
  return files;
}

class RanksJob {
 public:
  RanksJob(cluster::Communicator& communicator, const render::Document& document, const RanksArguments& a,
           std::optional<RenderedSamples> start)
      : a_(a),
        document_(document),
        earlier_seconds_(start ? start->seconds : 0),
        manager_(communicator, setup_of(document, a, std::move(start))) {}

  int run() {
    const std::atomic<bool>& interrupted = watch_interrupts();
    std::signal(SIGCONT, request_checkpoint);
    if (auto ok = render(interrupted); !ok) return fail(ok.error());
    const render::Status status = manager_.status();
    if (interrupted) return stop(status);
    std::fprintf(stderr, "etendue: %s\n", manager_.summary().c_str());
    if (auto ok = write_image(status); !ok) return fail(ok.error());
    std::error_code ignored;
    if (checkpoint_written_ || a_.resumes) std::filesystem::remove(a_.checkpoint_file, ignored);
    return 0;
  }

 private:
  static cluster::ManagerSetup setup_of(const render::Document& document, const RanksArguments& a,
                                        std::optional<RenderedSamples> start) {
    cluster::ManagerSetup setup{.document = document,
                                .identity = {ETENDUE_VERSION, bench::image_key(document)},
                                .threads = threads_of_rank(a.files.threads)};
    setup.schedule.collectors = a.collectors;
    if (a.sends_scene) setup.files = files_of_scene(a.checkpoint_file);
    if (!start) return setup;
    setup.samples = std::move(start->samples);
    setup.done = std::move(start->ranges);
    return setup;
  }

  Result<void> render(const std::atomic<bool>& interrupted) {
    Progress progress;
    auto last_shown = render::Clock::now(), last_checkpoint = last_shown;
    while (!manager_.is_finished() && !interrupted) {
      if (auto ok = manager_.step(); !ok) return ok;
      if (checkpoint_requested.exchange(false))
        if (auto ok = write_checkpoint(manager_.status()); !ok) return ok;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (render::seconds_since(last_shown) < kProgressInterval) continue;
      last_shown = render::Clock::now();
      const render::Status status = manager_.status();
      print_incompatibility(status);
      progress.show(status.progress, progress_text(status));
      if (a_.checkpoint_interval <= 0 || render::seconds_since(last_checkpoint) < a_.checkpoint_interval) continue;
      if (auto ok = write_checkpoint(status); !ok) return ok;
      last_checkpoint = render::Clock::now();
    }
    print_incompatibility(manager_.status());
    return {};
  }

  void print_incompatibility(const render::Status& status) {
    if (incompatibility_printed_ || status.incompatibility.empty()) return;
    std::fprintf(stderr, "etendue: %s\n", status.incompatibility.c_str());
    incompatibility_printed_ = true;
  }

  // The checkpoint first, because little time is left if mpirun ends the job.
  int stop(const render::Status& status) {
    if (status.samples == 0) {
      std::fprintf(stderr, "etendue: interrupted before the first sample; nothing was written\n");
      return static_cast<int>(Fault::interrupted);
    }
    if (auto ok = write_checkpoint(status); !ok) return fail(ok.error());
    std::fprintf(stderr, "etendue: interrupted at %u spp; continue with --resume %s\n", status.samples,
                 a_.checkpoint_file.c_str());
    if (auto ok = write_image(status); !ok) return fail(ok.error());
    return static_cast<int>(Fault::interrupted);
  }

  Result<void> write_checkpoint(const render::Status& status) {
    if (status.samples == 0) return {};
    checkpoint_written_ = true;
    const std::string state = render::state_json(document_, status.samples);
    return render::write_checkpoint(a_.checkpoint_file, {.state = cluster::with_ranges(state, manager_.done()),
                                                         .film = manager_.samples().film,
                                                         .seconds = status.seconds + earlier_seconds_,
                                                         .integrator_state = {},
                                                         .tails = manager_.samples().tails});
  }

  Result<void> write_image(const render::Status& status) {
    const SamplesToWrite written{manager_.samples(), status.rays, status.seconds};
    return write_samples(document_, written, a_.files);
  }

  const RanksArguments& a_;
  const render::Document& document_;
  double earlier_seconds_;
  cluster::RenderManager manager_;
  bool incompatibility_printed_ = false, checkpoint_written_ = false;
};

}  // namespace

int threads_of_rank(int threads) {
  if (threads > 0 || cluster::processes_on_machine() == 1) return threads;
  const int available = static_cast<int>(std::thread::hardware_concurrency());
  return std::max(1, available / cluster::processes_on_machine());
}

std::string ranks_incompatibility(const render::Document& document) {
  return render::division_incompatibility(part_of(document));
}

int run_on_ranks(int threads, const std::function<int(cluster::Communicator&)>& render) {
  const auto communicator = cluster::join_mpi_job();
  if (!communicator) return fail_on_all_ranks(communicator.error());
  cluster::Communicator& ranks = **communicator;
  if (ranks.rank() > 0) {
    cluster::run_worker(ranks, {threads_of_rank(threads), ETENDUE_VERSION, bench::image_key});
    ranks.close();
    return 0;
  }
  const int code = render(ranks);
  cluster::dismiss_ranks(ranks, code);
  return code;
}

int render_on_ranks(cluster::Communicator& communicator, const render::Document& document,
                    const RanksArguments& arguments, std::optional<RenderedSamples> start) {
  return RanksJob(communicator, document, arguments, std::move(start)).run();
}

}  // namespace etendue::cli
