// The records of one sample, by blocks of pixels, in an order that does not depend on threads.
//
// Every block sorts its records into groups of regions. A task then adds one group of all blocks, in the order of the
// blocks, so that groups are added in parallel.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "integrator/guiding/radiance_guide.h"
#include "integrator/pixel_block.h"

namespace etendue::guiding {

class BlockRecords {
 public:
  static constexpr int kGroups = 32;

  // Replaces the records. Records keep their order within each group.
  void assign(std::span<const Record> records) {
    ends_.fill(0);
    for (const Record& r : records) ++ends_[group_of(r)];
    uint32_t begin = 0;
    for (uint32_t& end : ends_) {
      const uint32_t count = end;
      end = begin;
      begin += count;
    }
    records_.resize(records.size());
    for (const Record& r : records) records_[ends_[group_of(r)]++] = r;
  }
  void clear() { assign({}); }

  void add_to(RadianceGuide& guide, int group) const {
    const auto g = static_cast<size_t>(group);
    for (uint32_t i = g == 0 ? 0 : ends_[g - 1]; i < ends_[g]; ++i) guide.add(records_[i]);
  }

  const std::vector<Record>& records() const { return records_; }
  size_t memory() const { return records_.capacity() * sizeof(Record); }

 private:
  static size_t group_of(const Record& record) { return record.region % kGroups; }

  std::vector<Record> records_;
  std::array<uint32_t, kGroups> ends_{};
};

}  // namespace etendue::guiding
