// Sets of sample numbers.
#pragma once
#include <cstdint>
#include <vector>

namespace etendue::cluster {

// The samples from `first` to `end` - 1 of each pixel.
struct SampleRange {
  uint32_t first = 0, end = 0;

  uint32_t size() const { return end - first; }
  bool is_empty() const { return end <= first; }
  friend bool operator==(const SampleRange&, const SampleRange&) = default;
};

class SampleRanges {
 public:
  // In ascending order; they neither overlap nor touch.
  const std::vector<SampleRange>& ranges() const { return ranges_; }
  uint32_t count() const;
  // One more than the largest number; 0 if the set is empty.
  uint32_t end() const { return ranges_.empty() ? 0 : ranges_.back().end; }
  bool contains(const SampleRange& range) const;
  // The first consecutive samples below `end` that the set does not contain; empty if it contains all.
  SampleRange first_gap(uint32_t end) const;

  void add(const SampleRange& range);
  void remove(const SampleRange& range);

 private:
  std::vector<SampleRange> ranges_;
};

}  // namespace etendue::cluster
