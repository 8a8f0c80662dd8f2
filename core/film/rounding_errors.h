// What rounding has removed from the sums of a film.
//
// The sum of a channel and its rounding errors is exact, so that parts of a rendering can be added in any order. Sums
// of few samples have no errors, because a double has 29 bits more than a sample. Memory is allocated for pixels whose
// sums were rounded, in segments of rows. The errors are added up in further doubles, whose own rounding errors belong
// to the next level. Samples are multiples of 2^-149 and each level is smaller than the one before by a factor of at
// least 2^21, so the number of levels is bounded; there is rarely more than one.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace etendue::film {

class RoundingErrors {
 public:
  using Channels = std::array<double, 3>;

  RoundingErrors() = default;
  RoundingErrors(int width, int height);
  RoundingErrors(const RoundingErrors& other);
  RoundingErrors(RoundingErrors&&) noexcept = default;
  RoundingErrors& operator=(const RoundingErrors& other);
  RoundingErrors& operator=(RoundingErrors&&) noexcept = default;

  // Whether there may be errors at this pixel.
  bool any_at(int x, int y) const { return segments_[segment_of(x, y)].load() != nullptr; }
  // Threads may add to different pixels concurrently.
  void add(int x, int y, size_t half_buffer, const Channels& errors);

  // The exact sum of a rounded sum and its errors, rounded once. It does not depend on the order of the samples.
  Channels rounded(int x, int y, size_t half_buffer, const Channels& sum) const;
  // The errors of one channel, one per level.
  std::vector<double> errors(int x, int y, size_t half_buffer, size_t channel) const;
  // Calls visit(const Channels&) for each level, the largest errors first.
  template <class Visit>
  void for_each_level(int x, int y, size_t half_buffer, Visit visit) const {
    for (const Segment* s = segments_[segment_of(x, y)].load(); s; s = s->next.load())
      visit(s->errors[static_cast<uint32_t>(x) % kWidth][half_buffer]);
  }

  // Removes the errors of the rows [first, end).
  void clear_rows(int first, int end);
  size_t memory() const;  // bytes

  // The complete state, for checkpoints. `restore` returns false if the bytes do not fit the image.
  std::vector<std::byte> bytes() const;
  bool restore(std::span<const std::byte> bytes);

 private:
  static constexpr uint32_t kWidth = 32;  // pixels of a segment
  struct Segment;
  // An owned segment that threads create when they first need it.
  class Link {
   public:
    Link() = default;
    Link(Link&& other) noexcept : segment_(other.segment_.exchange(nullptr)) {}
    Link& operator=(Link&& other) noexcept;
    ~Link() { clear(); }
    Segment* load() const { return segment_.load(std::memory_order_acquire); }
    Segment& obtain();
    void clear();

   private:
    std::atomic<Segment*> segment_{nullptr};
  };
  struct Segment {
    std::array<std::array<Channels, 2>, kWidth> errors{};
    Link next;  // of the next level
  };
  struct Record;

  size_t segment_of(int x, int y) const {
    return static_cast<uint32_t>(y) * segments_per_row_ + static_cast<uint32_t>(x) / kWidth;
  }

  size_t segments_per_row_ = 0;
  std::vector<Link> segments_;  // row by row
};

}  // namespace etendue::film
