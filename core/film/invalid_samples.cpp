#include "film/invalid_samples.h"

#include <algorithm>

namespace etendue::film {
namespace {

uint64_t place(const InvalidSample& r) {
  return uint64_t{r.sample} << 32 | static_cast<uint64_t>(r.y) << 16 | static_cast<uint64_t>(r.x);
}

InvalidReason flaw_of(const Rgb& c) {
  if (std::isnan(c.r) || std::isnan(c.g) || std::isnan(c.b)) return InvalidReason::nan;
  return is_finite(c) ? InvalidReason::negative : InvalidReason::infinite;
}

}  // namespace

std::string_view reason_name(InvalidReason reason) {
  return reason == InvalidReason::nan ? "nan" : reason == InvalidReason::infinite ? "infinite" : "negative";
}

void InvalidSampleCounter::count(int x, int y, uint32_t sample, const Rgb& radiance) {
  const InvalidSample rejection{x, y, sample, flaw_of(radiance)};
  auto& counter = rejection.reason == InvalidReason::nan        ? nan_
                  : rejection.reason == InvalidReason::infinite ? infinite_
                                                                : negative_;
  counter.fetch_add(1, std::memory_order_relaxed);
  // Where every sample is refused, nobody waits for the list.
  if (place(rejection) >= last_.load(std::memory_order_relaxed)) return;
  const std::scoped_lock lock(mutex_);
  first_.insert(std::ranges::upper_bound(first_, place(rejection), {}, place), rejection);
  if (first_.size() > kListedInvalidSamples) first_.pop_back();
  if (first_.size() == kListedInvalidSamples) last_ = place(first_.back());
}

InvalidSamples InvalidSampleCounter::get() const {
  const std::scoped_lock lock(mutex_);
  return {nan_.load(), infinite_.load(), negative_.load(), first_};
}

void InvalidSampleCounter::set(const InvalidSamples& rejected) {
  const std::scoped_lock lock(mutex_);
  nan_ = rejected.nan, infinite_ = rejected.infinite, negative_ = rejected.negative;
  first_ = rejected.first;
  last_ = first_.size() < kListedInvalidSamples ? kNone : place(first_.back());
}

}  // namespace etendue::film
