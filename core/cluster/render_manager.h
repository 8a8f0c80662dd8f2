// Rank 0 of a rendering on several ranks: gives out pieces, renders some itself, and adds up the results.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "base/provided_files.h"
#include "cluster/communicator.h"
#include "cluster/messages.h"
#include "cluster/piece_renderer.h"
#include "cluster/work_schedule.h"
#include "render/clock.h"
#include "render/error_monitor.h"
#include "render/thread_pool.h"

namespace etendue::cluster {

struct ManagerSetup {
  render::Document document;  // with the limits of the whole rendering
  RankIdentity identity = {};
  int threads = 0;                      // as in render::SessionOptions
  render::PartialSamples samples = {};  // that exist already; an empty film: none
  SampleRanges done = {};               // their numbers
  ScheduleOptions schedule = {};
  // The files of the scene, sent to the other ranks; without them each rank reads the scene.
  std::optional<std::vector<ProvidedFile>> files = {};
  double connect_seconds = 120;  // ranks that have not opened the document after this time take no part
};

class RenderManager {
 public:
  RenderManager(Communicator& communicator, ManagerSetup setup);

  // Handles what has arrived and gives out work; returns at once unless results have to be added. An error ends the
  // job: a rank cannot open the document, or is of another version.
  Result<void> step();
  bool is_finished() const { return schedule_.is_finished(); }

  // Of the whole rendering; `samples` is the number of those that have been added.
  render::Status status();
  const render::PartialSamples& samples() const { return samples_; }
  const SampleRanges& done() const { return schedule_.done(); }
  uint64_t bytes_received() const { return bytes_received_; }
  double merge_seconds() const { return merge_seconds_; }  // in all
  // One line about the work of the ranks, with those that failed.
  std::string summary() const;

 private:
  enum class RankState { connecting, ready, lost };

  Result<void> handle(const Message& message);
  Result<void> connect(int rank, const std::vector<std::byte>& message);
  void give_up_connecting();
  bool is_connecting() const;
  void receive_own(const PieceResult& result);
  void receive_result(int rank, std::span<const std::byte> bytes);
  void receive_arrival(int collector, std::span<const std::byte> bytes);
  void receive_sum(int collector, std::span<const std::byte> bytes);
  void collect();
  void merge(const PieceResult& result);
  void give_work(int rank);
  void update_error();
  double now() const { return render::seconds_since(start_); }

  Communicator& communicator_;
  ManagerSetup setup_;
  render::PartialSamples samples_;
  WorkSchedule schedule_;
  PieceRenderer renderer_;
  render::ThreadPool workers_;
  render::ErrorMonitor error_monitor_;
  std::vector<RankState> ranks_;
  render::Clock::time_point start_;  // of the job, then of rendering
  bool is_rendering_ = false;
  uint64_t rays_ = 0, paths_ = 0, bytes_received_ = 0;
  double merge_seconds_ = 0;
};

// Ends the job on the other ranks and leaves it. If a rank does not answer within `seconds`, all are ended, and the
// function does not return; `exit_code` is that of the process then.
void dismiss_ranks(Communicator& communicator, int exit_code, double seconds = 5);

}  // namespace etendue::cluster
