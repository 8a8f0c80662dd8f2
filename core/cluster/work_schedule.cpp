#include "cluster/work_schedule.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace etendue::cluster {
namespace {

// The fraction of the remaining time that a piece takes.
constexpr double kGuidedFraction = 0.5;
// While no speed is known, so many ranks render one sample each. More would only send more results to rank 0.
constexpr size_t kPilots = 16;
// The planned duration of the first piece of a rank is this fraction of that of others, because the rank may be slow.
constexpr double kFirstPieceFraction = 0.25;
// The ratio of the sizes of consecutive pieces is limited, because short measurements are inaccurate.
constexpr uint32_t kGrowth = 8;
// Where no work is left, a piece that takes this many times as long as planned is given to a further rank.
constexpr double kLateAtEnd = 1.5;
// Seconds between two searches for late pieces where no other work is left.
constexpr double kLookInterval = 0.05;
// Collectors that send their sums at the same time, so that these do not fill the memory of rank 0.
constexpr int kMostAsked = 4;
// Fewer ranks have no collectors.
constexpr int kFewestForCollectors = 32;
constexpr uint32_t kMostSamples = 1'000'000;  // per pixel

}  // namespace

WorkSchedule::WorkSchedule(int ranks, uint32_t samples, SampleRanges done, const ScheduleOptions& options)
    : options_(options), samples_(samples), ranks_(static_cast<size_t>(ranks)), done_(std::move(done)), begun_(done_) {
  if (options.collectors) collectors_.begin(std::clamp(*options.collectors, 0, ranks - 1));
}

std::optional<size_t> WorkSchedule::find(uint64_t id) const {
  const auto found = std::ranges::find(open_, id, [](const OpenPiece& open) { return open.piece.id; });
  if (found == open_.end()) return std::nullopt;
  return static_cast<size_t>(found - open_.begin());
}

int WorkSchedule::active_ranks() const {
  return static_cast<int>(std::ranges::count_if(ranks_, [](const Rank& r) { return r.is_active; }));
}

// Speeds that are not known count as the mean of the others.
void WorkSchedule::update_speeds() {
  double seconds = 0, speed = 0;
  int known = 0;
  for (const Rank& r : ranks_) {
    if (!r.is_active || r.seconds_per_sample <= 0) continue;
    seconds += r.seconds_per_sample;
    speed += 1 / r.seconds_per_sample;
    ++known;
  }
  typical_seconds_per_sample_ = known > 0 ? seconds / known : 0;
  samples_per_second_ = known > 0 ? speed + (active_ranks() - known) / typical_seconds_per_sample_ : 0;
  no_work_until_ = 0;
}

double WorkSchedule::seconds_per_sample(int rank) const {
  const double measured = rank_at(rank).seconds_per_sample;
  return measured > 0 ? measured : typical_seconds_per_sample_;
}

// Collectors begin where rank 0 could not add the results of all ranks. The square root balances the work of rank 0 and
// of the collectors.
void WorkSchedule::set_merge_seconds(double seconds) {
  merge_seconds_ = seconds;
  const int ranks = active_ranks();
  if (options_.collectors || collectors_.count() > 0 || ranks < kFewestForCollectors) return;
  if (seconds * ranks <= options_.merge_load * options_.longest_piece) return;
  collectors_.begin(static_cast<int>(std::lround(std::sqrt(ranks))));
  for (int c = 1; c <= collectors_.count(); ++c)
    if (!rank_at(c).is_active) collectors_.retire(c);
}

// The duration of pieces with which rank 0 is always merging, or a collector half of its time. A collector that is always
// merging could not answer in time.
double WorkSchedule::merging_seconds() const {
  const int groups = collectors_.usable();
  if (groups == 0) return merge_seconds_ * active_ranks();
  return 2 * merge_seconds_ * (active_ranks() + groups - 1) / groups;
}

// The time between two sums of a collector.
double WorkSchedule::collecting_seconds() const {
  return std::max(options_.longest_piece, merge_seconds_ * collectors_.count() / options_.merge_load);
}

double WorkSchedule::piece_seconds(double now) const {
  double seconds = std::max(options_.longest_piece, merging_seconds() / options_.merge_load);
  if (samples_ > 0 && samples_per_second_ > 0) {
    const double rest = samples_ - std::min(samples_, begun_.count());
    seconds = std::min(seconds, kGuidedFraction * rest / samples_per_second_);
  }
  seconds = std::max({seconds, options_.shortest_piece, merging_seconds()});
  return std::min(seconds, std::max(0.0, deadline_ - now));
}

uint32_t WorkSchedule::piece_samples(int rank, double now) const {
  const Rank& r = rank_at(rank);
  const double per_sample = seconds_per_sample(rank);
  if (per_sample <= 0) return 1;
  const bool is_first = r.seconds_per_sample <= 0;
  const double seconds =
      is_first ? std::max(kFirstPieceFraction * piece_seconds(now), merging_seconds()) : piece_seconds(now);
  const double most = is_first ? kMostSamples : double{kGrowth} * r.measured_samples;
  return static_cast<uint32_t>(std::clamp(std::round(seconds / per_sample), 1.0, most));
}

bool WorkSchedule::is_late(int rank, double now) const {
  const Rank& r = rank_at(rank);
  if (!r.piece || now - r.begun <= options_.shortest_patience || typical_seconds_per_sample_ <= 0) return false;
  double allowed = options_.patience * r.planned + options_.shortest_patience;
  if (r.seconds_per_sample <= 0) allowed += options_.first_patience;
  return now - r.begun > allowed;
}

bool WorkSchedule::is_expected_late(const OpenPiece& open, double now) const {
  return std::ranges::all_of(open.ranks, [&](int rank) {
    const Rank& r = rank_at(rank);
    return r.planned > 0 && now - r.begun > kLateAtEnd * r.planned + options_.shortest_piece;
  });
}

// A piece whose ranks are all late.
const WorkSchedule::OpenPiece* WorkSchedule::late_piece(double now) const {
  for (const OpenPiece& open : open_)
    if (std::ranges::all_of(open.ranks, [&](int rank) { return is_late(rank, now); })) return &open;
  return nullptr;
}

Piece WorkSchedule::assign(int rank, const Piece& piece, double now) {
  Rank& r = rank_at(rank);
  r.piece = piece;
  r.piece->collector = collectors_.collector_of(rank);
  r.begun = now;
  r.planned = seconds_per_sample(rank) * piece.samples.size();
  const auto index = find(piece.id);
  if (index)
    open_[*index].ranks.push_back(rank);
  else
    open_.push_back({piece, {rank}});
  if (index) ++repeated_pieces_;
  begun_.add(piece.samples);
  return *r.piece;
}

std::optional<Piece> WorkSchedule::next(int rank, double now) {
  const Rank& r = rank_at(rank);
  if (!r.is_active || r.piece || now < no_work_until_ || is_finished()) return std::nullopt;
  if (const OpenPiece* late = late_piece(now)) return assign(rank, Piece(late->piece), now);
  // At least one sample is rendered, however short the time is.
  if (begun_.end() > 0 && now + 0.5 * seconds_per_sample(rank) >= deadline_) close();
  const SampleRange gap = begun_.first_gap(samples_ > 0 ? samples_ : kMostSamples);
  if (seconds_per_sample(rank) <= 0 && open_.size() >= kPilots) return std::nullopt;
  if (!gap.is_empty()) {
    const uint32_t size = std::min(gap.size(), piece_samples(rank, now));
    return assign(rank, {.id = ++last_id_, .samples = {gap.first, gap.first + size}}, now);
  }
  for (const OpenPiece& open : open_)
    if (open.ranks.size() == 1 && is_expected_late(open, now)) return assign(rank, Piece(open.piece), now);
  no_work_until_ = now + kLookInterval;
  return std::nullopt;
}

void WorkSchedule::measure(Rank& rank, const SampleRange& range, double seconds) {
  // Short pieces measure overhead, so they do not replace the result of longer ones.
  const double measured = std::max(seconds, 1e-6) / range.size();
  const double weight = rank.seconds_per_sample > 0 && range.size() < rank.measured_samples
                            ? static_cast<double>(range.size()) / rank.measured_samples
                            : 1;
  rank.seconds_per_sample += weight * (measured - rank.seconds_per_sample);
  rank.measured_samples = std::max(rank.measured_samples, range.size());
  update_speeds();
}

// The rank does not render the piece any more. Without another rank its samples have to be begun again.
void WorkSchedule::release(int rank, uint64_t id) {
  Rank& r = rank_at(rank);
  if (r.piece && r.piece->id == id) r.piece.reset();
  const auto index = find(id);
  if (!index) return;
  OpenPiece& open = open_[*index];
  std::erase(open.ranks, rank);
  if (!open.ranks.empty()) return;
  begun_.remove(open.piece.samples);
  open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(*index));
}

bool WorkSchedule::complete(int rank, uint64_t piece, double now) {
  Rank& r = rank_at(rank);
  if (!r.piece || r.piece->id != piece) return false;
  const Piece answered = *r.piece;
  const SampleRange& samples = answered.samples;
  const auto index = find(piece);
  const bool is_at_collector = answered.collector > 0;
  if (is_at_collector && !collectors_.is_usable(answered.collector)) {
    release(rank, piece);
    return false;
  }
  r.piece.reset();
  measure(r, samples, now - r.begun);
  if (!index) return false;  // another rank has completed it
  open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(*index));
  if (is_at_collector)
    collectors_.hold(answered.collector, samples);
  else
    done_.add(samples);
  r.samples += samples.size();
  return true;
}

bool WorkSchedule::has_open_piece_for(int collector) const {
  return std::ranges::any_of(ranks_, [&](const Rank& r) { return r.piece && r.piece->collector == collector; });
}

// Once all samples have been begun, a collector sends its sum when its group has no work any more.
std::optional<int> WorkSchedule::next_to_collect(double now) {
  if (collectors_.count() == 0) return std::nullopt;
  int asked = 0;
  for (int c = 1; c <= collectors_.count(); ++c) asked += collectors_.is_asked(c) ? 1 : 0;
  if (asked >= kMostAsked) return std::nullopt;
  const bool is_ending = begun_.first_gap(samples_ > 0 ? samples_ : kMostSamples).is_empty();
  for (int c = 1; c <= collectors_.count(); ++c) {
    const bool is_due = collectors_.is_due(c, now, collecting_seconds()) ||
                        (is_ending && collectors_.has_samples(c) && !has_open_piece_for(c));
    if (!is_due) continue;
    collectors_.ask(c, now);
    return c;
  }
  return std::nullopt;
}

bool WorkSchedule::deliver(int collector) {
  const SampleRanges delivered = collectors_.deliver(collector);
  for (const SampleRange& range : delivered.ranges()) done_.add(range);
  return delivered.count() > 0;
}

// An answer may have to wait until the collector has added the results of its group, and rank 0 other sums.
std::optional<int> WorkSchedule::late_collector(double now) const {
  const double patience =
      options_.patience * (options_.shortest_patience + kMostAsked * merge_seconds_ + merging_seconds());
  for (int c = 1; c <= collectors_.count(); ++c)
    if (collectors_.is_usable(c) && (is_late(c, now) || collectors_.is_overdue(c, now, patience))) return c;
  return std::nullopt;
}

// The results that are on their way to the collector are lost too. Their ranks receive other pieces.
void WorkSchedule::retire(int collector) {
  if (!collectors_.is_usable(collector)) return;
  const SampleRanges lost = collectors_.retire(collector);
  for (const SampleRange& range : lost.ranges()) begun_.remove(range);
  for (size_t i = 0; i < ranks_.size(); ++i)
    if (ranks_[i].piece && ranks_[i].piece->collector == collector && static_cast<int>(i) != collector)
      release(static_cast<int>(i), ranks_[i].piece->id);
  ++retired_collectors_;
  no_work_until_ = 0;
}

void WorkSchedule::reject(int rank) {
  ++damaged_results_;
  Rank& r = rank_at(rank);
  if (r.piece) release(rank, r.piece->id);
  if (++r.damaged >= options_.most_damaged) {
    r.is_active = false;
    retire(rank);
  }
  update_speeds();
}

void WorkSchedule::remove(int rank) {
  Rank& r = rank_at(rank);
  r.is_active = false;
  if (r.piece) release(rank, r.piece->id);
  retire(rank);
  update_speeds();
}

void WorkSchedule::close() {
  const uint32_t begun = begun_.end();
  samples_ = samples_ > 0 ? std::min(samples_, begun) : begun;
}

}  // namespace etendue::cluster
