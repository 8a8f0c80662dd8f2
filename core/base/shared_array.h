// An array whose copies share their elements in blocks.
//
// A copy costs time proportional to the number of blocks, and a change of one element copies one block. This makes a
// scene of a million nodes a value that an edit may copy. Comparing an array with an edited copy skips the blocks that
// both share.
//
// Access through a non-const array copies the block of the element if another array shares it. References are valid
// until this array is copied, resized or destroyed.
#pragma once
#include <algorithm>
#include <atomic>
#include <compare>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace etendue {

template <class T>
class SharedArray {
  // Random access by index, so that an iterator copies blocks only when it is dereferenced.
  template <class Array, class Element>
  class Iterator {
   public:
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = Element*;
    using reference = Element&;
    using iterator_category = std::random_access_iterator_tag;

    Iterator() = default;
    Iterator(Array* array, difference_type index) : array_(array), index_(index) {}

    Element& operator*() const { return (*array_)[static_cast<size_t>(index_)]; }
    Element* operator->() const { return &**this; }
    Element& operator[](difference_type n) const { return *(*this + n); }
    Iterator& operator+=(difference_type n) { return index_ += n, *this; }
    Iterator& operator-=(difference_type n) { return index_ -= n, *this; }
    Iterator& operator++() { return *this += 1; }
    Iterator& operator--() { return *this -= 1; }
    Iterator operator++(int) { return std::exchange(*this, *this + 1); }
    Iterator operator--(int) { return std::exchange(*this, *this - 1); }
    friend Iterator operator+(Iterator i, difference_type n) { return i += n; }
    friend Iterator operator+(difference_type n, Iterator i) { return i += n; }
    friend Iterator operator-(Iterator i, difference_type n) { return i -= n; }
    friend difference_type operator-(const Iterator& a, const Iterator& b) { return a.index_ - b.index_; }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.index_ == b.index_; }
    friend auto operator<=>(const Iterator& a, const Iterator& b) { return a.index_ <=> b.index_; }

   private:
    Array* array_ = nullptr;
    difference_type index_ = 0;
  };

 public:
  static constexpr size_t kBlockSize = 128;
  using value_type = T;
  using iterator = Iterator<SharedArray, T>;
  using const_iterator = Iterator<const SharedArray, const T>;

  SharedArray() = default;
  explicit SharedArray(size_t size) { resize(size); }

  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  const T& operator[](size_t i) const { return blocks_[i / kBlockSize][static_cast<std::ptrdiff_t>(i % kBlockSize)]; }
  T& operator[](size_t i) { return own(i / kBlockSize)[i % kBlockSize]; }
  const T& front() const { return (*this)[0]; }
  T& front() { return (*this)[0]; }
  const T& back() const { return (*this)[size_ - 1]; }
  T& back() { return (*this)[size_ - 1]; }

  const_iterator begin() const { return {this, 0}; }
  const_iterator end() const { return {this, static_cast<std::ptrdiff_t>(size_)}; }
  iterator begin() { return {this, 0}; }
  iterator end() { return {this, static_cast<std::ptrdiff_t>(size_)}; }

  T& push_back(T value) { return emplace_back() = std::move(value); }
  T& emplace_back() {
    resize(size_ + 1);
    return back();
  }

  // New elements are value-initialised.
  void resize(size_t size) {
    for (size_t i = size; i < size_ && i % kBlockSize != 0; ++i) (*this)[i] = T();  // the rest of the last block
    const size_t blocks = (size + kBlockSize - 1) / kBlockSize;
    if (blocks < blocks_.size()) blocks_.resize(blocks);
    while (blocks_.size() < blocks) blocks_.push_back(std::make_shared<T[]>(kBlockSize));
    size_ = size;
  }

  // Whether differs(i) is false for all elements that the two arrays do not share. Their sizes must be equal.
  template <class Differs>
  bool unshared_agree(const SharedArray& other, Differs&& differs) const {
    for (size_t block = 0; block < blocks_.size(); ++block) {
      if (blocks_[block] == other.blocks_[block]) continue;
      const size_t end = std::min(size_, (block + 1) * kBlockSize);
      for (size_t i = block * kBlockSize; i < end; ++i)
        if (differs(i)) return false;
    }
    return true;
  }

  friend bool operator==(const SharedArray& a, const SharedArray& b) {
    return a.size_ == b.size_ && a.unshared_agree(b, [&](size_t i) { return !(a[i] == b[i]); });
  }

 private:
  T* own(size_t block) {
    std::shared_ptr<T[]>& elements = blocks_[block];
    if (elements.use_count() > 1) {
      auto copy = std::make_shared<T[]>(kBlockSize);
      std::copy_n(elements.get(), kBlockSize, copy.get());
      elements = std::move(copy);
    }
    // Another thread may have released its share: what it read must not be written before.
    std::atomic_thread_fence(std::memory_order_acquire);
    return elements.get();
  }

  std::vector<std::shared_ptr<T[]>> blocks_;
  size_t size_ = 0;
};

}  // namespace etendue
