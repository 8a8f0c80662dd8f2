#include "cluster/view_worker.h"

#include <chrono>
#include <future>
#include <optional>
#include <thread>
#include <utility>

#include "cluster/piece_renderer.h"
#include "cluster/view_messages.h"
#include "render/clock.h"
#include "render/state_opener.h"

namespace etendue::cluster {
namespace {

constexpr auto kWorkerPause = std::chrono::milliseconds(1);

// Opens documents in the background, so that messages are answered meanwhile. Only the newest one waits.
class BackgroundOpener {
 public:
  explicit BackgroundOpener(const std::function<uint64_t(const render::Document&)>& scene_hash)
      : scene_hash_(scene_hash) {}

  struct Opened {
    uint64_t epoch;
    Result<render::Document> document;
    uint64_t scene_hash;
  };

  void open(DocumentMessage message) {
    next_ = std::move(message);
    begin_next();
  }
  // A document that has been opened.
  std::optional<Opened> take() {
    if (!running_.valid() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
      return std::nullopt;
    Opened opened = running_.get();
    begin_next();
    return opened;
  }

 private:
  void begin_next() {
    if (!next_ || running_.valid()) return;
    running_ = std::async(std::launch::async, [this, message = std::move(*next_)] {
      auto document = opener_.open(message.text, "rank 0");
      if (document && opener_.is_reopened()) opened_hash_ = scene_hash_(opener_.opened());
      return Opened{message.epoch, std::move(document), opened_hash_};
    });
    next_.reset();
  }

  const std::function<uint64_t(const render::Document&)>& scene_hash_;
  render::StateOpener opener_;
  uint64_t opened_hash_ = 0;
  std::optional<DocumentMessage> next_;
  std::future<Opened> running_;  // last, because it uses the others
};

class ViewWorker {
 public:
  ViewWorker(Communicator& communicator, const ViewWorkerSetup& setup)
      : communicator_(communicator), setup_(setup), opener_(setup.scene_hash), renderer_({}, setup.threads) {}

  bool run() {
    while (!has_ended_) {
      while (const auto received = communicator_.receive()) handle(received->bytes);
      if (render::seconds_since(last_heard_) > setup_.longest_silence) return false;
      take_document();
      render();
      send_film();
      report_alive();
      std::this_thread::sleep_for(kWorkerPause);
    }
    return true;
  }

 private:
  // Samples that have not been sent yet.
  struct Unsent {
    std::vector<uint64_t> pieces;
    PieceResult sum;
  };

  void handle(const std::vector<std::byte>& bytes) {
    last_heard_ = render::Clock::now();
    const auto body = body_of(bytes);
    if (kind_of(bytes) == MessageKind::quit) {
      renderer_.cancel();
      communicator_.send(0, message(MessageKind::goodbye));
      has_ended_ = true;
      return;
    }
    switch (view_kind_of(bytes).value_or(ViewMessageKind::alive)) {
      case ViewMessageKind::stop:
        if (const auto epoch = epoch_from(body)) begin_epoch(*epoch);
        break;
      case ViewMessageKind::document:
        if (auto document = document_message_from(body); document && document->epoch == epoch_)
          opener_.open(std::move(*document));
        break;
      case ViewMessageKind::piece:
        if (const auto piece = piece_message_from(body); piece && piece->epoch == epoch_)
          pieces_.push_back(piece->piece);
        break;
      case ViewMessageKind::hold:
        if (const auto stopped = hold_from(body)) renderer_.pause(*stopped);
        break;
      case ViewMessageKind::taken:
        film_is_sent_ = false;
        break;
      default:
        break;
    }
  }

  void begin_epoch(uint64_t epoch) {
    epoch_ = epoch;
    is_ready_ = false;
    renderer_.cancel();
    pieces_.clear();
    unsent_.reset();
  }

  void take_document() {
    const auto opened = opener_.take();
    if (!opened || opened->epoch != epoch_) return;
    if (!opened->document) {
      communicator_.send(0,
                         document_message(ViewMessageKind::failed, {opened->epoch, opened->document.error().message}));
      return;
    }
    renderer_.set_document(*opened->document);
    is_ready_ = true;
    communicator_.send(0, encoded(ReadyMessage{epoch_, {setup_.version, opened->scene_hash}}));
  }

  void render() {
    if (!is_ready_) return;
    if (auto result = renderer_.take_result()) {
      communicator_.send(0, encoded(RenderedMessage{epoch_, result->piece.samples.size(), renderer_.status().seconds}));
      keep(std::move(*result));
    }
    if (renderer_.is_busy() || pieces_.empty()) return;
    renderer_.begin(pieces_.front());
    pieces_.erase(pieces_.begin());
  }

  void keep(PieceResult result) {
    const uint64_t id = result.piece.id;
    if (!unsent_) {
      unsent_ = Unsent{{id}, std::move(result)};
      return;
    }
    unsent_->pieces.push_back(id);
    add_samples(unsent_->sum.samples, result.samples);
    unsent_->sum.rays += result.rays;
    unsent_->sum.paths += result.paths;
  }

  // A film is sent when the one before has been taken, so its rate follows from the network and from rank 0.
  void send_film() {
    if (!unsent_ || film_is_sent_) return;
    const auto result = bytes_of(unsent_->sum);
    communicator_.send(0, encoded(FilmMessage{epoch_, std::move(unsent_->pieces), result}));
    unsent_.reset();
    film_is_sent_ = true;
  }

  void report_alive() {
    if (render::seconds_since(last_report_) < kAliveInterval) return;
    last_report_ = render::Clock::now();
    communicator_.send(0, view_message(ViewMessageKind::alive));
  }

  Communicator& communicator_;
  const ViewWorkerSetup& setup_;
  BackgroundOpener opener_;
  PieceRenderer renderer_;
  uint64_t epoch_ = 0;
  bool is_ready_ = false, film_is_sent_ = false, has_ended_ = false;
  std::vector<Piece> pieces_;  // to be rendered
  std::optional<Unsent> unsent_;
  render::Clock::time_point last_heard_ = render::Clock::now(), last_report_ = last_heard_;
};

}  // namespace

bool run_view_worker(Communicator& communicator, const ViewWorkerSetup& setup) {
  return ViewWorker(communicator, setup).run();
}

}  // namespace etendue::cluster
