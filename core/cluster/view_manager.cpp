#include "cluster/view_manager.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "render/division.h"

namespace etendue::cluster {
namespace {

constexpr auto kManagerPause = std::chrono::milliseconds(1);
constexpr uint32_t kMostQueued = 2;  // pieces of a rank: one that it renders, and one that waits
constexpr int kMostDamaged = 3;      // films of a rank
constexpr double kPieceTimes = 8;    // of a piece, after which its rank makes no progress

std::string name_of(int rank) { return "rank " + std::to_string(rank); }

}  // namespace

ViewManager::ViewManager(Communicator& communicator, ViewManagerSetup setup)
    : communicator_(communicator),
      setup_(std::move(setup)),
      schedule_(communicator.size()),
      status_{.ranks = communicator.size(), .note = {}},
      ranks_(static_cast<size_t>(communicator.size())),
      thread_([this] { run(); }) {}

ViewManager::~ViewManager() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool ViewManager::begin(const render::Document& document) {
  const std::lock_guard lock(mutex_);
  const std::string before = std::exchange(
      incompatibility_, document.origin ? render::division_incompatibility(document) : "the scene is not from a file");
  is_shared_ = incompatibility_.empty();
  if (!is_shared_ && incompatibility_ != before) messages_.push_back("The other ranks wait: " + incompatibility_);
  schedule_.begin(document.limits.samples);
  received_.reset();
  begun_ = Begun{++epoch_, is_shared_ ? std::optional(document) : std::nullopt};
  changed_.notify_all();
  return is_shared_;
}

void ViewManager::end() {
  const std::lock_guard lock(mutex_);
  incompatibility_ = "the image continues from stored samples";
  is_shared_ = false;
  received_.reset();
  begun_ = Begun{++epoch_, std::nullopt};
  changed_.notify_all();
}

void ViewManager::set_limit(uint32_t samples) {
  const std::lock_guard lock(mutex_);
  schedule_.set_limit(samples);
}

void ViewManager::hold(bool stopped) {
  const std::lock_guard lock(mutex_);
  is_held_ = stopped;
  changed_.notify_all();
}

std::optional<uint32_t> ViewManager::next_sample() {
  const std::lock_guard lock(mutex_);
  return schedule_.next_own();
}

bool ViewManager::has_samples() const {
  const std::lock_guard lock(mutex_);
  return received_.has_value();
}

std::optional<render::SharedSamples> ViewManager::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(received_, std::nullopt);
}

render::SharingStatus ViewManager::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

std::vector<std::string> ViewManager::take_messages() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

bool ViewManager::all_answer() const {
  const std::lock_guard lock(mutex_);
  return all_answer_;
}

void ViewManager::run() {
  const auto now = render::Clock::now();
  for (Rank& rank : ranks_) rank.heard = now;
  std::unique_lock lock(mutex_);
  while (!quit_) {
    changed_.wait_for(lock, kManagerPause, [&] { return quit_ || begun_ || is_held_ != sent_hold_; });
    auto begun = std::exchange(begun_, std::nullopt);
    const bool held = is_held_;
    lock.unlock();
    if (begun) send_document(std::move(*begun));
    if (held != std::exchange(sent_hold_, held)) send_to_all(hold_message(held));
    while (const auto message = communicator_.receive()) handle(*message);
    confirm_identities();
    check_progress();
    give_work();
    report_alive();
    update_status();
    lock.lock();
  }
}

// Ranks stop before the state of the document is written, which takes some time.
void ViewManager::send_document(Begun begun) {
  sent_epoch_ = begun.epoch;
  sent_state_.clear();
  send_to_all(epoch_message(ViewMessageKind::stop, sent_epoch_));
  for (Rank& rank : ranks_) {
    if (rank.state != RankState::silent) rank.state = RankState::opening;
    rank.is_open = false;
    rank.queued = 0;
  }
  if (!begun.document) return;
  render::Document& document = *begun.document;
  width_ = document.width;
  height_ = document.height;
  if (document.origin != origin_) {
    origin_ = document.origin;
    origin_hash_.reset();
  }
  document.limits = {};
  sent_state_ = render::state_json(document, 0);
  send_to_all(document_message(ViewMessageKind::document, {sent_epoch_, sent_state_}));
}

void ViewManager::send_to_all(const std::vector<std::byte>& bytes) {
  for (int rank = 1; rank < communicator_.size(); ++rank)
    if (rank_at(rank).state != RankState::silent) communicator_.send(rank, bytes);
}

// Everything that a rank has missed.
void ViewManager::send_state_to(int rank) {
  communicator_.send(rank, epoch_message(ViewMessageKind::stop, sent_epoch_));
  communicator_.send(rank, hold_message(sent_hold_));
  if (!sent_state_.empty())
    communicator_.send(rank, document_message(ViewMessageKind::document, {sent_epoch_, sent_state_}));
}

void ViewManager::handle(const Message& message) {
  Rank& rank = rank_at(message.from);
  rank.heard = render::Clock::now();
  if (rank.state == RankState::silent) {
    rank.state = RankState::opening;
    rank.problem.clear();
    rank.is_open = false;
    rank.queued = 0;
    {
      const std::lock_guard lock(mutex_);
      messages_.push_back(name_of(message.from) + " answers again");
    }
    send_state_to(message.from);
  }
  const auto body = body_of(message.bytes);
  switch (view_kind_of(message.bytes).value_or(ViewMessageKind::alive)) {
    case ViewMessageKind::ready:
      if (const auto ready = ready_message_from(body); ready && ready->epoch == sent_epoch_) {
        rank.identity = ready->identity;
        rank.is_open = true;
      }
      break;
    case ViewMessageKind::failed:
      if (const auto failed = document_message_from(body); failed && failed->epoch == sent_epoch_)
        exclude(message.from, RankState::excluded, failed->text);
      break;
    case ViewMessageKind::rendered:
      if (const auto rendered = rendered_message_from(body); rendered && rendered->epoch == sent_epoch_) {
        rank.progressed = rank.heard;
        if (rank.queued > 0) --rank.queued;
        const std::lock_guard lock(mutex_);
        schedule_.measure(message.from, rendered->samples, rendered->seconds);
      }
      break;
    case ViewMessageKind::film:
      handle_film(message.from, body);
      communicator_.send(message.from, view_message(ViewMessageKind::taken));
      break;
    default:
      break;
  }
}

void ViewManager::handle_film(int rank, std::span<const std::byte> body) {
  const auto film = film_message_from(body);
  if (film && film->epoch != sent_epoch_) return;
  rank_at(rank).progressed = rank_at(rank).heard;
  const auto start = render::Clock::now();
  auto result = film ? piece_result_from(film->result, width_, height_) : std::nullopt;
  if (!result) {
    const std::lock_guard lock(mutex_);
    if (++rank_at(rank).damaged < kMostDamaged) schedule_.give_up(rank);
  } else {
    add_film(rank, *film, std::move(*result));
    const double seconds = render::seconds_since(start);
    merge_seconds_ = merge_seconds_ > 0 ? 0.5 * (merge_seconds_ + seconds) : seconds;
  }
  if (!result && rank_at(rank).damaged >= kMostDamaged)
    exclude(rank, RankState::excluded, "sends damaged films; its network or memory is faulty");
}

// Films are added outside of the mutex, which the session needs for its next sample.
void ViewManager::add_film(int rank, const FilmMessage& film, PieceResult result) {
  std::optional<render::SharedSamples> sum;
  uint32_t count = 0;
  {
    const std::lock_guard lock(mutex_);
    if (film.epoch != epoch_) return;
    const uint32_t before = schedule_.delivered_samples();
    if (!schedule_.deliver(rank, film.pieces)) return;
    count = schedule_.delivered_samples() - before;
    sum = std::exchange(received_, std::nullopt);
  }
  if (!sum)
    sum = render::SharedSamples{.samples = std::move(result.samples)};
  else
    add_samples(sum->samples, result.samples);
  sum->count += count;
  sum->rays += result.rays;
  sum->paths += result.paths;
  const std::lock_guard lock(mutex_);
  if (film.epoch == epoch_) received_ = std::move(sum);
}

// Ranks whose scene and program are those of rank 0 become ready.
void ViewManager::confirm_identities() {
  if (hashing_.valid() && hashing_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    const uint64_t hash = hashing_.get();
    if (hashed_origin_ == origin_) origin_hash_ = hash;
  }
  if (origin_ && !origin_hash_ && !hashing_.valid()) {
    hashed_origin_ = origin_;
    hashing_ = std::async(std::launch::async, [this, origin = origin_] { return setup_.scene_hash(*origin); });
  }
  if (!origin_hash_) return;
  for (int i = 1; i < communicator_.size(); ++i) {
    Rank& rank = rank_at(i);
    if (rank.state != RankState::opening || !rank.is_open) continue;
    if (rank.identity.version != setup_.version) {
      exclude(i, RankState::excluded,
              "runs etendue " + rank.identity.version + ", but rank 0 runs " + setup_.version +
                  "; install the same version on all machines");
    } else if (rank.identity.scene_hash != *origin_hash_) {
      exclude(i, RankState::excluded,
              origin_->scene_name + " has another content there than on rank 0; copy the scene to all machines");
    } else {
      rank.state = RankState::ready;
      rank.problem.clear();
      rank.progressed = render::Clock::now();
    }
  }
}

void ViewManager::check_progress() {
  const double patience = setup_.piece_patience + kPieceTimes * piece_seconds();
  for (int i = 1; i < communicator_.size(); ++i) {
    Rank& rank = rank_at(i);
    if (rank.state == RankState::silent) continue;
    if (render::seconds_since(rank.heard) > setup_.longest_silence) {
      exclude(i, RankState::silent, "does not answer; the others go on");
      continue;
    }
    if (rank.state != RankState::ready) continue;
    std::unique_lock lock(mutex_);
    const bool has_work = schedule_.undelivered(i) > 0 && !sent_hold_;
    if (!has_work) rank.progressed = render::Clock::now();
    const bool is_first = schedule_.is_first(i);
    if (render::seconds_since(rank.progressed) <= (is_first ? setup_.first_patience : patience)) continue;
    lock.unlock();
    exclude(i, RankState::excluded, "makes no progress; the others go on");
  }
}

// What the rank delivers later is not added.
void ViewManager::exclude(int rank, RankState state, const std::string& problem) {
  const std::lock_guard lock(mutex_);
  schedule_.give_up(rank);
  const bool is_new = rank_at(rank).problem != problem;
  rank_at(rank).state = state;
  rank_at(rank).problem = problem;
  if (is_new) messages_.push_back(name_of(rank) + ": " + problem);
}

// The planned duration of a piece.
double ViewManager::piece_seconds() const {
  return std::max(setup_.shortest_piece, merge_seconds_ * (communicator_.size() - 1) / setup_.merge_load);
}

void ViewManager::give_work() {
  if (sent_hold_) return;
  const std::lock_guard lock(mutex_);
  if (!is_shared_ || epoch_ != sent_epoch_) return;
  for (int i = 1; i < communicator_.size(); ++i) {
    Rank& rank = rank_at(i);
    while (rank.state == RankState::ready && rank.queued < kMostQueued) {
      const auto piece = schedule_.next(i, piece_seconds());
      if (!piece) break;
      communicator_.send(i, encoded(PieceMessage{sent_epoch_, *piece}));
      ++rank.queued;
    }
  }
}

void ViewManager::report_alive() {
  if (render::seconds_since(last_report_) < kAliveInterval) return;
  last_report_ = render::Clock::now();
  send_to_all(view_message(ViewMessageKind::alive));
}

void ViewManager::update_status() {
  render::SharingStatus status{.ranks = communicator_.size(), .active = 1, .note = {}};
  for (int i = 1; i < communicator_.size(); ++i) {
    const Rank& rank = rank_at(i);
    if (rank.state == RankState::ready) ++status.active;
    if (rank.state == RankState::excluded || rank.state == RankState::silent)
      status.note += (status.note.empty() ? "" : "; ") + name_of(i) + ": " + rank.problem;
  }
  const bool all_answer = std::ranges::none_of(ranks_, [](const Rank& r) { return r.state == RankState::silent; });
  const std::lock_guard lock(mutex_);
  all_answer_ = all_answer;
  status.own_samples = schedule_.own_samples();
  status.other_samples = schedule_.delivered_samples();
  if (!is_shared_) status.active = 1;
  if (!incompatibility_.empty()) status.note = incompatibility_;
  status_ = std::move(status);
}

}  // namespace etendue::cluster
