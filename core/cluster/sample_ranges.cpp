#include "cluster/sample_ranges.h"

#include <algorithm>

namespace etendue::cluster {

uint32_t SampleRanges::count() const {
  uint32_t samples = 0;
  for (const SampleRange& r : ranges_) samples += r.size();
  return samples;
}

bool SampleRanges::contains(const SampleRange& range) const {
  return range.is_empty() || std::ranges::any_of(ranges_, [&](const SampleRange& r) {
           return r.first <= range.first && range.end <= r.end;
         });
}

SampleRange SampleRanges::first_gap(uint32_t end) const {
  SampleRange gap{0, end};
  for (const SampleRange& r : ranges_) {
    if (r.first > gap.first) {
      gap.end = std::min(end, r.first);
      break;
    }
    gap.first = r.end;
  }
  return gap.is_empty() ? SampleRange{} : gap;
}

void SampleRanges::add(const SampleRange& range) {
  if (range.is_empty()) return;
  SampleRange joined = range;
  std::erase_if(ranges_, [&](const SampleRange& r) {
    if (r.end < joined.first || joined.end < r.first) return false;
    joined = {std::min(joined.first, r.first), std::max(joined.end, r.end)};
    return true;
  });
  ranges_.insert(std::ranges::lower_bound(ranges_, joined.first, {}, &SampleRange::first), joined);
}

void SampleRanges::remove(const SampleRange& range) {
  if (range.is_empty()) return;
  std::vector<SampleRange> rest;
  for (const SampleRange& r : ranges_) {
    if (const SampleRange before{r.first, std::min(r.end, range.first)}; !before.is_empty()) rest.push_back(before);
    if (const SampleRange after{std::max(r.first, range.end), r.end}; !after.is_empty()) rest.push_back(after);
  }
  ranges_ = std::move(rest);
}

}  // namespace etendue::cluster
