// Rank 0 of a viewer on several ranks: sends documents to the other ranks, gives them pieces, and collects their samples
// for the session of the viewer.
//
// Messages are handled by a thread of its own, the only one that uses the communicator. Another rank that does not
// answer is given up until it does.
#pragma once
#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "cluster/communicator.h"
#include "cluster/view_messages.h"
#include "cluster/view_schedule.h"
#include "render/clock.h"
#include "render/shared_sampling.h"

namespace etendue::cluster {

struct ViewManagerSetup {
  std::string version;                                          // of the program
  std::function<uint64_t(const render::Document&)> scene_hash;  // of a document before edits
  double longest_silence = 5;                                   // of a rank, in seconds; it reports every second
  double piece_patience = 10;   // for the next piece or film, in seconds, besides 8 times its duration
  double first_patience = 120;  // for the first one of a document, whose scene is compiled
  double shortest_piece = 0.2;  // planned duration, in seconds
  // The fraction of its time that the thread may spend on adding films. Pieces are as long as this needs.
  double merge_load = 0.2;
};

class ViewManager final : public render::SharedSampling {
 public:
  ViewManager(Communicator& communicator, ViewManagerSetup setup);
  // Ends the thread. The communicator can be used afterwards, for example to dismiss the ranks.
  ~ViewManager();
  ViewManager(const ViewManager&) = delete;
  ViewManager& operator=(const ViewManager&) = delete;

  bool begin(const render::Document& document) override;
  void end() override;
  void set_limit(uint32_t samples) override;
  void hold(bool stopped) override;
  std::optional<uint32_t> next_sample() override;
  bool has_samples() const override;
  std::optional<render::SharedSamples> take() override;
  render::SharingStatus status() const override;
  std::vector<std::string> take_messages() override;

  // Whether all ranks have answered lately.
  bool all_answer() const;

 private:
  enum class RankState {
    opening,   // the present document
    ready,     // and receives pieces
    excluded,  // from the present document: another scene, another version, or no progress
    silent     // does not answer
  };
  struct Rank {
    RankState state = RankState::opening;
    std::string problem = {};  // of an excluded or silent rank
    RankIdentity identity = {};
    bool is_open = false;  // the document is open, but its identity is not confirmed yet
    uint32_t queued = 0;   // pieces that the rank has received and not rendered
    int damaged = 0;       // films
    render::Clock::time_point heard{}, progressed{};
  };
  // A document that is to be sent.
  struct Begun {
    uint64_t epoch = 0;
    std::optional<render::Document> document;  // nothing if it is not shared
  };

  // The thread.
  void run();
  void send_document(Begun begun);
  void send_to_all(const std::vector<std::byte>& bytes);
  void send_state_to(int rank);
  void handle(const Message& message);
  void handle_film(int rank, std::span<const std::byte> body);
  void add_film(int rank, const FilmMessage& film, PieceResult result);
  void confirm_identities();
  void check_progress();
  void exclude(int rank, RankState state, const std::string& problem);
  void give_work();
  void report_alive();
  void update_status();
  double piece_seconds() const;
  Rank& rank_at(int rank) { return ranks_[static_cast<size_t>(rank)]; }

  Communicator& communicator_;
  const ViewManagerSetup setup_;

  // Shared, under mutex_.
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool quit_ = false;
  uint64_t epoch_ = 0;
  std::optional<Begun> begun_;
  std::string incompatibility_;  // why the present document is not shared; empty if it is
  bool is_shared_ = false;
  bool is_held_ = false;
  ViewSchedule schedule_;
  std::optional<render::SharedSamples> received_;
  render::SharingStatus status_;
  std::vector<std::string> messages_;
  bool all_answer_ = true;

  // Used by the thread only.
  std::vector<Rank> ranks_;
  uint64_t sent_epoch_ = 0;
  std::string sent_state_;  // of the document; empty if it is not shared
  int width_ = 0, height_ = 0;
  bool sent_hold_ = false;
  // The document before edits, and the hash of its scene, which is computed in the background.
  std::shared_ptr<const render::Document> origin_, hashed_origin_;
  std::optional<uint64_t> origin_hash_;
  std::future<uint64_t> hashing_;
  double merge_seconds_ = 0;  // of one film, measured
  render::Clock::time_point last_report_{};

  std::thread thread_;  // last, because it uses all other members
};

}  // namespace etendue::cluster
