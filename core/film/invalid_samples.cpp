#include "film/invalid_samples.h"

#include <algorithm>

namespace etendue::film {
namespace {

uint64_t sort_key(const InvalidSample& s) {
  return uint64_t{s.sample} << 32 | static_cast<uint64_t>(s.y) << 16 | static_cast<uint64_t>(s.x);
}

InvalidReason reason_of(const Rgb& c) {
  if (std::isnan(c.r) || std::isnan(c.g) || std::isnan(c.b)) return InvalidReason::nan;
  return is_finite(c) ? InvalidReason::negative : InvalidReason::infinite;
}

}  // namespace

bool is_visible_color(const Rgb& c) {
  constexpr float kRounding = 2e-3f;
  if (!is_finite(c)) return false;
  const float least = -kRounding * (std::abs(c.r) + std::abs(c.g) + std::abs(c.b));
  // Linear Rec. 709 to XYZ [IEC 61966-2-1].
  return 0.4124564f * c.r + 0.3575761f * c.g + 0.1804375f * c.b >= least &&
         0.2126729f * c.r + 0.7151522f * c.g + 0.0721750f * c.b >= least &&
         0.0193339f * c.r + 0.1191920f * c.g + 0.9503041f * c.b >= least;
}

std::string_view reason_name(InvalidReason reason) {
  switch (reason) {
    case InvalidReason::nan:
      return "nan";
    case InvalidReason::infinite:
      return "infinite";
    case InvalidReason::negative:
      return "negative";
  }
  return "";
}

void merge(InvalidSamples& samples, const InvalidSamples& other) {
  samples.nan += other.nan;
  samples.infinite += other.infinite;
  samples.negative += other.negative;
  samples.first.insert(samples.first.end(), other.first.begin(), other.first.end());
  std::ranges::sort(samples.first, {}, sort_key);
  if (samples.first.size() > kListedInvalidSamples) samples.first.resize(kListedInvalidSamples);
}

void InvalidSampleCounter::count(int x, int y, uint32_t sample, const Rgb& radiance) {
  const InvalidSample invalid{.x = x, .y = y, .sample = sample, .reason = reason_of(radiance)};
  auto& counter = invalid.reason == InvalidReason::nan        ? nan_
                  : invalid.reason == InvalidReason::infinite ? infinite_
                                                              : negative_;
  counter.fetch_add(1, std::memory_order_relaxed);
  // This test avoids the lock for all samples but the first ones, which matters if every sample is invalid.
  if (sort_key(invalid) >= last_listed_.load(std::memory_order_relaxed)) return;
  const std::scoped_lock lock(mutex_);
  first_.insert(std::ranges::upper_bound(first_, sort_key(invalid), {}, sort_key), invalid);
  if (first_.size() > kListedInvalidSamples) first_.pop_back();
  if (first_.size() == kListedInvalidSamples) last_listed_ = sort_key(first_.back());
}

InvalidSamples InvalidSampleCounter::get() const {
  const std::scoped_lock lock(mutex_);
  return {.nan = nan_.load(), .infinite = infinite_.load(), .negative = negative_.load(), .first = first_};
}

void InvalidSampleCounter::set(const InvalidSamples& samples) {
  const std::scoped_lock lock(mutex_);
  nan_ = samples.nan;
  infinite_ = samples.infinite;
  negative_ = samples.negative;
  first_ = samples.first;
  last_listed_ = first_.size() < kListedInvalidSamples ? kListNotFull : sort_key(first_.back());
}

}  // namespace etendue::film
