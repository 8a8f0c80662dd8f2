#include "cluster/collectors.h"

#include <algorithm>
#include <utility>

namespace etendue::cluster {

int Collectors::usable() const {
  return static_cast<int>(std::ranges::count(collectors_, false, &Collector::has_failed));
}

// The next collector that is usable takes the place of one that has failed.
int Collectors::collector_of(int rank) const {
  for (int i = 0; rank > 0 && i < count(); ++i) {
    const int collector = 1 + (rank - 1 + i) % count();
    if (is_usable(collector)) return collector;
  }
  return 0;
}

bool Collectors::is_due(int rank, double now, double interval) const {
  return has_samples(rank) && now - at(rank).asked_at >= interval;
}

void Collectors::ask(int rank, double now) {
  Collector& collector = at(rank);
  collector.asked = std::exchange(collector.held, {});
  collector.asked_at = now;
}

bool Collectors::is_overdue(int rank, double now, double patience) const {
  return is_asked(rank) && now - at(rank).asked_at > patience;
}

SampleRanges Collectors::deliver(int rank) {
  if (!is_usable(rank)) return {};
  return std::exchange(at(rank).asked, {});
}

SampleRanges Collectors::retire(int rank) {
  Collector& collector = at(rank);
  collector.has_failed = true;
  SampleRanges lost = std::exchange(collector.held, {});
  for (const SampleRange& range : collector.asked.ranges()) lost.add(range);
  collector.asked = {};
  return lost;
}

}  // namespace etendue::cluster
