#include "cluster/render_manager.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "base/number_text.h"
#include "cluster/sent_scene.h"
#include "render/limit_progress.h"
#include "render/tail_statistics.h"
#include "sampling/sampler.h"

namespace etendue::cluster {
namespace {

render::PartialSamples begun_with(ManagerSetup& setup) {
  render::PartialSamples samples = std::move(setup.samples);
  const int width = setup.document.width, height = setup.document.height;
  if (samples.film.width() == 0) samples.film = film::Film(width, height);
  samples.tails.resize(render::TailStatistics::tile_count(width, height));
  return samples;
}

bool keep_going() { return true; }

}  // namespace

RenderManager::RenderManager(Communicator& communicator, ManagerSetup setup)
    : communicator_(communicator),
      setup_(std::move(setup)),
      samples_(begun_with(setup_)),
      schedule_(communicator.size(), setup_.document.limits.samples, setup_.done, setup_.schedule),
      renderer_(setup_.document, setup_.threads),
      workers_(setup_.threads),
      error_monitor_(workers_),
      ranks_(static_cast<size_t>(communicator.size()), RankState::connecting),
      start_(render::Clock::now()) {
  const render::Document& d = setup_.document;
  error_monitor_.reset(find_sampler(d.method.sampler)->independent);
  error_monitor_.set_measure(d.limits.measure, d.display.transform());
  render::Document sent = d;
  sent.limits = {};
  const std::string state = render::state_json(sent, 0);
  ranks_[0] = RankState::ready;
  if (setup_.files) {
    pass_on(communicator_, sent_scene_message({state, *std::exchange(setup_.files, std::nullopt)}));
    return;
  }
  for (int rank = 1; rank < communicator_.size(); ++rank)
    communicator_.send(rank, text_message(MessageKind::document, state));
}

Result<void> RenderManager::step() {
  while (const auto message = communicator_.receive())
    if (auto ok = handle(*message); !ok) return ok;
  if (is_connecting()) {
    if (now() < setup_.connect_seconds) return {};
    give_up_connecting();
  }
  if (!is_rendering_) {
    is_rendering_ = true;
    start_ = render::Clock::now();
    if (setup_.document.limits.seconds > 0) schedule_.set_deadline(setup_.document.limits.seconds);
  }
  if (const auto result = renderer_.take_result()) receive_own(*result);
  if (is_finished()) return {};
  collect();
  for (int rank = 0; rank < communicator_.size(); ++rank) give_work(rank);
  return {};
}

bool RenderManager::is_connecting() const { return std::ranges::find(ranks_, RankState::connecting) != ranks_.end(); }

void RenderManager::give_up_connecting() {
  for (size_t i = 0; i < ranks_.size(); ++i) {
    if (ranks_[i] != RankState::connecting) continue;
    ranks_[i] = RankState::lost;
    schedule_.remove(static_cast<int>(i));
  }
}

Result<void> RenderManager::handle(const Message& message) {
  const auto kind = kind_of(message.bytes);
  if (kind == MessageKind::result)
    receive_result(message.from, body_of(message.bytes));
  else if (kind == MessageKind::arrival)
    receive_arrival(message.from, body_of(message.bytes));
  else if (kind == MessageKind::sum)
    receive_sum(message.from, body_of(message.bytes));
  else if (kind == MessageKind::ready || kind == MessageKind::failed)
    return connect(message.from, message.bytes);
  return {};
}

Result<void> RenderManager::connect(int rank, const std::vector<std::byte>& message) {
  const std::string name = "rank " + std::to_string(rank);
  if (kind_of(message) == MessageKind::failed) return input_error(name + ": " + text_of(body_of(message)));
  const auto identity = identity_from(body_of(message));
  if (!identity || identity->version != setup_.identity.version)
    return input_error(name + ": runs etendue " + (identity ? identity->version : "of an unknown version") +
                       ", but rank 0 runs " + setup_.identity.version + "; install the same version on all machines");
  if (identity->scene_hash != setup_.identity.scene_hash)
    return input_error(name + ": " + setup_.document.scene_name +
                       " has another content there than on rank 0; copy the scene to all machines");
  RankState& state = ranks_[static_cast<size_t>(rank)];
  if (state == RankState::connecting) state = RankState::ready;
  return {};
}

void RenderManager::receive_own(const PieceResult& result) {
  if (!schedule_.complete(0, result.piece.id, now())) return;
  const auto start = render::Clock::now();
  merge(result);
  // A first estimate, so that collectors begin before many ranks have their first pieces.
  if (bytes_received_ == 0) schedule_.set_merge_seconds(render::seconds_since(start));
}

void RenderManager::receive_result(int rank, std::span<const std::byte> bytes) {
  bytes_received_ += bytes.size();
  const auto start = render::Clock::now();
  const auto result = piece_result_from(bytes, setup_.document.width, setup_.document.height);
  if (!result) {
    schedule_.reject(rank);
    return;
  }
  const bool is_new = schedule_.is_at(rank, 0) && schedule_.complete(rank, result->piece.id, now());
  give_work(rank);  // first, so that the rank does not wait for the merging
  if (!is_new) return;
  merge(*result);
  const double seconds = render::seconds_since(start);
  merge_seconds_ += seconds;
  schedule_.set_merge_seconds(seconds);
}

// A result has arrived at its collector, which adds it if it is new.
void RenderManager::receive_arrival(int collector, std::span<const std::byte> bytes) {
  const auto arrival = arrival_from(bytes);
  if (!arrival || arrival->rank < 1 || arrival->rank >= communicator_.size()) return;
  if (arrival->is_damaged != 0) {
    if (schedule_.is_at(arrival->rank, collector)) schedule_.reject(arrival->rank);
    return;
  }
  const bool is_new =
      schedule_.is_at(arrival->rank, collector) && schedule_.complete(arrival->rank, arrival->piece, now());
  give_work(arrival->rank);
  communicator_.send(collector, decision_message({arrival->rank, is_new ? 1 : 0, arrival->piece}));
}

void RenderManager::receive_sum(int collector, std::span<const std::byte> bytes) {
  bytes_received_ += bytes.size();
  const auto start = render::Clock::now();
  const auto result = piece_result_from(bytes, setup_.document.width, setup_.document.height);
  if (!result) {
    schedule_.retire(collector);
    return;
  }
  if (!schedule_.deliver(collector)) return;
  merge(*result);
  merge_seconds_ += render::seconds_since(start);
}

void RenderManager::collect() {
  while (const auto late = schedule_.late_collector(now())) schedule_.retire(*late);
  while (const auto collector = schedule_.next_to_collect(now()))
    communicator_.send(*collector, message(MessageKind::collect));
}

void RenderManager::merge(const PieceResult& result) {
  add_samples(samples_, result.samples);
  rays_ += result.rays;
  paths_ += result.paths;
  update_error();
}

void RenderManager::update_error() {
  const uint32_t samples = schedule_.done().count();
  if (!error_monitor_.is_error_due(samples)) return;
  error_monitor_.measure_error(samples_.film, samples, now(), keep_going);
  const auto& error = error_monitor_.measured();
  const double limit = setup_.document.limits.error;
  if (limit > 0 && error.known && error.value <= limit) schedule_.close();
}

void RenderManager::give_work(int rank) {
  if (ranks_[static_cast<size_t>(rank)] != RankState::ready) return;
  const auto piece = schedule_.next(rank, now());
  if (!piece) return;
  if (rank == 0)
    renderer_.begin(*piece);
  else
    communicator_.send(rank, piece_message(*piece));
}

render::Status RenderManager::status() {
  const render::Limits& limits = setup_.document.limits;
  render::Status status = renderer_.status();
  const double seconds = is_rendering_ ? now() : 0;
  const uint32_t samples = schedule_.done().count();
  const render::SamplingState state{.samples = samples,
                                    .seconds = seconds,
                                    .error = error_monitor_.measured(),
                                    .estimator = error_monitor_.estimator()};
  status.samples = samples;
  status.seconds = seconds;
  status.rays = rays_;
  status.paths = paths_;
  status.rays_per_second = seconds > 0 ? static_cast<double>(rays_) / seconds : 0;
  status.paths_per_second = seconds > 0 ? static_cast<double>(paths_) / seconds : 0;
  status.error = error_monitor_.error();
  status.measure = limits.measure;
  status.measured_error = error_monitor_.measured();
  status.rejected = samples_.film.invalid_samples();
  status.progress = render::progress_to_limit(limits, state);
  status.time_left = render::time_to_limit(limits, state);
  status.phase = is_rendering_ ? "rendering" : "connecting";
  status.phase_progress = 0;
  status.finished = is_finished();
  return status;
}

std::string RenderManager::summary() const {
  const int ranks = communicator_.size();
  std::string text = std::to_string(ranks) + (ranks == 1 ? " rank rendered " : " ranks rendered ");
  for (int rank = 0; rank < communicator_.size(); ++rank)
    text += (rank > 0 ? " + " : "") + std::to_string(schedule_.samples_of(rank));
  text += " samples per pixel";
  if (bytes_received_ > 0)
    text += "; rank 0 added " +
            format_text("%.1f MB of results in %.2f s", 1e-6 * static_cast<double>(bytes_received_), merge_seconds_);
  if (schedule_.repeated_pieces() > 0) text += "; repeated pieces: " + std::to_string(schedule_.repeated_pieces());
  if (schedule_.collectors() > 0) text += "; ranks that added results: " + std::to_string(schedule_.collectors());
  if (schedule_.retired_collectors() > 0)
    text += ", of which failed: " + std::to_string(schedule_.retired_collectors());
  if (schedule_.damaged_results() > 0) text += "; damaged results: " + std::to_string(schedule_.damaged_results());
  for (int rank = 1; rank < communicator_.size(); ++rank)
    if (ranks_[static_cast<size_t>(rank)] == RankState::lost || schedule_.is_late(rank, now()))
      text += "; rank " + std::to_string(rank) + " does not answer";
  return text;
}

void dismiss_ranks(Communicator& communicator, int exit_code, double seconds) {
  for (int rank = 1; rank < communicator.size(); ++rank) communicator.send(rank, message(MessageKind::quit));
  const auto start = render::Clock::now();
  for (int left = communicator.size() - 1; left > 0;) {
    while (const auto received = communicator.receive())
      if (kind_of(received->bytes) == MessageKind::goodbye) --left;
    if (render::seconds_since(start) > seconds) communicator.abort(exit_code);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  communicator.close();
}

}  // namespace etendue::cluster
