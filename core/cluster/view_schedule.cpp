#include "cluster/view_schedule.h"

#include <algorithm>
#include <cmath>

namespace etendue::cluster {
namespace {

constexpr uint32_t kLastViewSample = 1'000'000;  // per pixel
constexpr uint32_t kLargestPiece = 4096;
// A rank that has this many pieces waits until it has delivered some.
constexpr size_t kMostUndelivered = 8;
// The ratio of the sizes of consecutive pieces of a rank is limited, because short measurements are inaccurate.
constexpr uint32_t kPieceGrowth = 4;

}  // namespace

void ViewSchedule::begin(uint32_t limit) {
  limit_ = limit;
  given_out_ = {};
  own_samples_ = delivered_samples_ = 0;
  for (Rank& rank : ranks_) {
    rank.pieces.clear();
    rank.pieces_of_document = 0;
    rank.has_rendered = false;
  }
}

void ViewSchedule::set_limit(uint32_t limit) {
  limit_ = limit;
  if (limit == 0) return;
  for (Rank& rank : ranks_)
    std::erase_if(rank.pieces, [&](const Piece& piece) {
      if (piece.samples.end <= limit) return false;
      given_out_.remove(piece.samples);
      return true;
    });
}

uint32_t ViewSchedule::remaining() const {
  return limit_ > 0 ? limit_ - std::min(limit_, given_out_.count()) : UINT32_MAX;
}

std::optional<SampleRange> ViewSchedule::take(uint32_t most) {
  SampleRange range = given_out_.first_gap(limit_ > 0 ? limit_ : kLastViewSample);
  if (range.is_empty()) return std::nullopt;
  range.end = std::min(range.end, range.first + most);
  given_out_.add(range);
  return range;
}

std::optional<uint32_t> ViewSchedule::next_own() {
  const auto range = take(1);
  if (!range) return std::nullopt;
  ++own_samples_;
  return range->first;
}

std::optional<Piece> ViewSchedule::next(int rank, double seconds) {
  Rank& r = ranks_[static_cast<size_t>(rank)];
  if (r.pieces.size() >= kMostUndelivered) return std::nullopt;
  // Towards the limit pieces become smaller, so that all ranks end at about the same time.
  uint32_t most = std::max(1U, remaining() / static_cast<uint32_t>(2 * ranks_.size()));
  if (r.pieces_of_document == 0 || r.seconds_per_sample <= 0) {
    most = 1;
  } else {
    const uint32_t previous = r.pieces.empty() ? kLargestPiece : r.pieces.back().samples.size();
    const double planned = std::clamp(std::round(seconds / r.seconds_per_sample), 1.0, double{kLargestPiece});
    most = std::min({most, static_cast<uint32_t>(planned), kPieceGrowth * previous});
  }
  const auto range = take(most);
  if (!range) return std::nullopt;
  ++r.pieces_of_document;
  return r.pieces.emplace_back(Piece{++last_id_, *range});
}

void ViewSchedule::measure(int rank, uint32_t samples, double seconds) {
  ranks_[static_cast<size_t>(rank)].has_rendered = true;
  if (samples == 0 || seconds <= 0) return;
  double& known = ranks_[static_cast<size_t>(rank)].seconds_per_sample;
  const double measured = seconds / samples;
  known = known > 0 ? 0.5 * (known + measured) : measured;
}

bool ViewSchedule::deliver(int rank, std::span<const uint64_t> pieces) {
  auto& open = ranks_[static_cast<size_t>(rank)].pieces;
  std::vector<uint64_t> ids(pieces.begin(), pieces.end());
  std::ranges::sort(ids);
  if (std::ranges::adjacent_find(ids) != ids.end()) return false;
  const auto is_delivered = [&](const Piece& piece) { return std::ranges::binary_search(ids, piece.id); };
  const bool is_complete = std::ranges::count_if(open, is_delivered) == static_cast<std::ptrdiff_t>(ids.size());
  for (const Piece& piece : open) {
    if (!is_delivered(piece)) continue;
    if (is_complete)
      delivered_samples_ += piece.samples.size();
    else
      given_out_.remove(piece.samples);
  }
  std::erase_if(open, is_delivered);
  return is_complete;
}

void ViewSchedule::give_up(int rank) {
  auto& open = ranks_[static_cast<size_t>(rank)].pieces;
  for (const Piece& piece : open) given_out_.remove(piece.samples);
  open.clear();
}

}  // namespace etendue::cluster
