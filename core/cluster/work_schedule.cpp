#include "cluster/work_schedule.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace etendue::cluster {
namespace {

// The fraction of the remaining time that a piece takes.
constexpr double kGuidedFraction = 0.5;
// The largest number of samples in the first piece of a rank whose speed is not known.
constexpr uint32_t kFirstPiece = 1;
// The ratio of the sizes of consecutive pieces is limited, because short measurements are inaccurate.
constexpr uint32_t kGrowth = 8;
// Where no work is left, a piece that takes this many times as long as planned is given to a further rank.
constexpr double kLateAtEnd = 1.5;
constexpr uint32_t kMostSamples = 1'000'000;  // per pixel

}  // namespace

WorkSchedule::WorkSchedule(int ranks, uint32_t samples, SampleRanges done, const ScheduleOptions& options)
    : options_(options), samples_(samples), ranks_(static_cast<size_t>(ranks)), done_(std::move(done)), begun_(done_) {}

std::optional<size_t> WorkSchedule::find(uint64_t id) const {
  const auto found = std::ranges::find(open_, id, [](const OpenPiece& open) { return open.piece.id; });
  if (found == open_.end()) return std::nullopt;
  return static_cast<size_t>(found - open_.begin());
}

int WorkSchedule::active_ranks() const {
  return static_cast<int>(std::ranges::count_if(ranks_, [](const Rank& r) { return r.is_active; }));
}

// The mean over the ranks with a known speed; 0 if there are none.
double WorkSchedule::typical_seconds_per_sample() const {
  double sum = 0;
  int count = 0;
  for (const Rank& r : ranks_)
    if (r.is_active && r.seconds_per_sample > 0) {
      sum += r.seconds_per_sample;
      ++count;
    }
  return count > 0 ? sum / count : 0;
}

double WorkSchedule::seconds_per_sample(int rank) const {
  const double measured = rank_at(rank).seconds_per_sample;
  return measured > 0 ? measured : typical_seconds_per_sample();
}

double WorkSchedule::samples_per_second() const {
  const double typical = typical_seconds_per_sample();
  double speed = 0;
  for (const Rank& r : ranks_) {
    const double seconds = r.seconds_per_sample > 0 ? r.seconds_per_sample : typical;
    if (r.is_active && seconds > 0) speed += 1 / seconds;
  }
  return speed;
}

double WorkSchedule::piece_seconds(double now) const {
  double seconds = options_.longest_piece;
  if (const double speed = samples_per_second(); samples_ > 0 && speed > 0) {
    const double rest = samples_ - std::min(samples_, begun_.count());
    seconds = std::min(seconds, kGuidedFraction * rest / speed);
  }
  const double merging = merge_seconds_ * active_ranks() / options_.merge_load;
  seconds = std::max({seconds, options_.shortest_piece, merging});
  return std::min(seconds, std::max(0.0, deadline_ - now));
}

uint32_t WorkSchedule::piece_samples(int rank, double now) const {
  const Rank& r = rank_at(rank);
  if (r.seconds_per_sample <= 0) return kFirstPiece;
  const double samples = std::round(piece_seconds(now) / r.seconds_per_sample);
  return static_cast<uint32_t>(std::clamp(samples, 1.0, double{kGrowth} * r.measured_samples));
}

bool WorkSchedule::is_late(int rank, double now) const {
  const Rank& r = rank_at(rank);
  if (!r.piece) return false;
  if (r.seconds_per_sample <= 0 && typical_seconds_per_sample() <= 0) return false;
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
  r.begun = now;
  r.planned = seconds_per_sample(rank) * piece.samples.size();
  const auto index = find(piece.id);
  if (index)
    open_[*index].ranks.push_back(rank);
  else
    open_.push_back({piece, {rank}});
  if (index) ++repeated_pieces_;
  begun_.add(piece.samples);
  return piece;
}

std::optional<Piece> WorkSchedule::next(int rank, double now) {
  const Rank& r = rank_at(rank);
  if (!r.is_active || r.piece || is_finished()) return std::nullopt;
  if (const OpenPiece* late = late_piece(now)) return assign(rank, Piece(late->piece), now);
  // At least one sample is rendered, however short the time is.
  if (begun_.end() > 0 && now + 0.5 * seconds_per_sample(rank) >= deadline_) close();
  const SampleRange gap = begun_.first_gap(samples_ > 0 ? samples_ : kMostSamples);
  if (!gap.is_empty()) {
    const uint32_t size = std::min(gap.size(), piece_samples(rank, now));
    return assign(rank, {++last_id_, {gap.first, gap.first + size}}, now);
  }
  for (const OpenPiece& open : open_)
    if (open.ranks.size() == 1 && is_expected_late(open, now)) return assign(rank, Piece(open.piece), now);
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
  const SampleRange samples = r.piece->samples;
  r.piece.reset();
  measure(r, samples, now - r.begun);
  const auto index = find(piece);
  if (!index) return false;  // another rank has completed it
  open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(*index));
  done_.add(samples);
  r.samples += samples.size();
  return true;
}

void WorkSchedule::reject(int rank) {
  ++damaged_results_;
  Rank& r = rank_at(rank);
  if (r.piece) release(rank, r.piece->id);
  if (++r.damaged >= options_.most_damaged) r.is_active = false;
}

void WorkSchedule::remove(int rank) {
  Rank& r = rank_at(rank);
  r.is_active = false;
  if (r.piece) release(rank, r.piece->id);
}

void WorkSchedule::close() {
  const uint32_t begun = begun_.end();
  samples_ = samples_ > 0 ? std::min(samples_, begun) : begun;
}

}  // namespace etendue::cluster
