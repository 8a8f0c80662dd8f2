#include "film/rounding_errors.h"

#include <cstring>

#include "base/error_free.h"
#include "base/state_bytes.h"

namespace etendue::film {

// A segment in `bytes`. Levels of one segment follow each other.
struct RoundingErrors::Record {
  uint64_t segment;
  decltype(Segment::errors) errors;
};

RoundingErrors::Link& RoundingErrors::Link::operator=(Link&& other) noexcept {
  if (this == &other) return *this;
  clear();
  segment_ = other.segment_.exchange(nullptr);
  return *this;
}

RoundingErrors::Segment& RoundingErrors::Link::obtain() {
  if (Segment* segment = load()) return *segment;
  auto created = std::make_unique<Segment>();
  Segment* present = nullptr;
  if (segment_.compare_exchange_strong(present, created.get(), std::memory_order_acq_rel)) return *created.release();
  return *present;  // of another thread
}

void RoundingErrors::Link::clear() { delete segment_.exchange(nullptr); }

RoundingErrors::RoundingErrors(int width, int height)
    : segments_per_row_((static_cast<uint32_t>(width) + kWidth - 1) / kWidth),
      segments_(segments_per_row_ * static_cast<size_t>(height)) {}

RoundingErrors::RoundingErrors(const RoundingErrors& other)
    : segments_per_row_(other.segments_per_row_), segments_(other.segments_.size()) {
  for (size_t i = 0; i < segments_.size(); ++i) {
    Link* target = &segments_[i];
    for (const Segment* s = other.segments_[i].load(); s; s = s->next.load()) {
      Segment& copy = target->obtain();
      copy.errors = s->errors;
      target = &copy.next;
    }
  }
}

RoundingErrors& RoundingErrors::operator=(const RoundingErrors& other) {
  if (this != &other) *this = RoundingErrors(other);
  return *this;
}

void RoundingErrors::add(int x, int y, size_t half_buffer, const Channels& errors) {
  for (size_t c = 0; c < errors.size(); ++c) {
    double error = errors[c];
    for (Link* link = &segments_[segment_of(x, y)]; error != 0;) {
      Segment& segment = link->obtain();
      error = add_exactly(segment.errors[static_cast<uint32_t>(x) % kWidth][half_buffer][c], error);
      link = &segment.next;
    }
  }
}

std::vector<double> RoundingErrors::errors(int x, int y, size_t half_buffer, size_t channel) const {
  std::vector<double> levels;
  for (const Segment* s = segments_[segment_of(x, y)].load(); s; s = s->next.load())
    levels.push_back(s->errors[static_cast<uint32_t>(x) % kWidth][half_buffer][channel]);
  return levels;
}

RoundingErrors::Channels RoundingErrors::rounded(int x, int y, size_t half_buffer, const Channels& sum) const {
  const Segment* first = segments_[segment_of(x, y)].load();
  if (!first) return sum;
  Channels result;
  for (size_t c = 0; c < result.size(); ++c) {
    if (first->next.load()) {
      std::vector<double> terms = errors(x, y, half_buffer, c);
      terms.push_back(sum[c]);
      result[c] = rounded_sum(terms);
    } else {
      result[c] = sum[c] + first->errors[static_cast<uint32_t>(x) % kWidth][half_buffer][c];
    }
  }
  return result;
}

void RoundingErrors::clear_rows(int first, int end) {
  for (size_t i = segment_of(0, first); i < segment_of(0, end); ++i) segments_[i].clear();
}

size_t RoundingErrors::memory() const {
  size_t count = 0;
  for (const Link& link : segments_)
    for (const Segment* s = link.load(); s; s = s->next.load()) ++count;
  return segments_.size() * sizeof(Link) + count * sizeof(Segment);
}

std::vector<std::byte> RoundingErrors::bytes() const {
  StateWriter out;
  for (size_t i = 0; i < segments_.size(); ++i)
    for (const Segment* s = segments_[i].load(); s; s = s->next.load()) out.value(Record{i, s->errors});
  return out.take();
}

bool RoundingErrors::restore(std::span<const std::byte> bytes) {
  for (Link& link : segments_) link.clear();
  for (StateReader in(bytes); !in.at_end();) {
    Record record;
    if (!in.value(record) || record.segment >= segments_.size()) return false;
    Link* link = &segments_[record.segment];
    while (Segment* s = link->load()) link = &s->next;
    link->obtain().errors = record.errors;
  }
  return true;
}

}  // namespace etendue::film
