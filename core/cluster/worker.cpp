#include "cluster/worker.h"

#include <chrono>
#include <optional>
#include <thread>

#include "base/provided_files.h"
#include "cluster/collector.h"
#include "cluster/messages.h"
#include "cluster/piece_renderer.h"
#include "cluster/sent_scene.h"

namespace etendue::cluster {
namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(1);

class Worker {
 public:
  Worker(Communicator& communicator, const WorkerSetup& setup) : communicator_(communicator), setup_(setup) {}

  // One turn; false after the end of the job.
  bool step() {
    while (const auto received = communicator_.receive())
      if (!handle(received->from, received->bytes)) return false;
    if (!renderer_) return true;
    if (const auto result = renderer_->take_result())
      communicator_.send(result->piece.collector, message(MessageKind::result, bytes_of(*result)));
    return true;
  }

 private:
  bool handle(int from, const std::vector<std::byte>& bytes) {
    const auto kind = kind_of(bytes);
    if (kind == MessageKind::quit) {
      if (renderer_) renderer_->cancel();
      communicator_.send(0, message(MessageKind::goodbye));
      return false;
    }
    if (kind == MessageKind::document) open(text_of(body_of(bytes)));
    if (kind == MessageKind::scene) open_sent(bytes);
    if (kind == MessageKind::piece && renderer_)
      if (const auto piece = piece_from(body_of(bytes))) renderer_->begin(*piece);
    if (collector_) collect(kind, from, body_of(bytes));
    return true;
  }

  void collect(std::optional<MessageKind> kind, int from, std::span<const std::byte> body) {
    if (kind == MessageKind::result) collector_->receive(from, body);
    if (kind == MessageKind::collect) collector_->send_sum();
    if (kind == MessageKind::decision)
      if (const auto decision = decision_from(body)) collector_->decide(*decision);
  }

  void open_sent(const std::vector<std::byte>& bytes) {
    pass_on(communicator_, bytes);
    auto sent = sent_scene_from(body_of(bytes));
    if (!sent) {
      communicator_.send(0, text_message(MessageKind::failed, "the scene of rank 0 has not arrived completely"));
      return;
    }
    provide_files(std::move(sent->files));
    open(sent->state);
  }

  void open(const std::string& state) {
    const auto document = render::document_from_state(state, "rank 0");
    if (!document) {
      communicator_.send(0, text_message(MessageKind::failed, document.error().message));
      return;
    }
    renderer_.emplace(*document, setup_.threads);
    collector_.emplace(communicator_, document->width, document->height);
    communicator_.send(0, ready_message({setup_.version, setup_.scene_hash(*document)}));
  }

  Communicator& communicator_;
  const WorkerSetup& setup_;
  std::optional<PieceRenderer> renderer_;
  std::optional<Collector> collector_;
};

}  // namespace

void run_worker(Communicator& communicator, const WorkerSetup& setup) {
  Worker worker(communicator, setup);
  while (worker.step()) std::this_thread::sleep_for(kPollInterval);
}

}  // namespace etendue::cluster
