// Serialisation of states for checkpoints and partial results: values as in memory, lists preceded by their lengths.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace etendue {

class StateWriter {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    append(&v, sizeof v);
  }
  template <class T>
  void list(std::span<const T> items) {
    static_assert(std::is_trivially_copyable_v<T>);
    value<uint64_t>(items.size());
    append(items.data(), items.size_bytes());
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void append(const void* data, size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }

  std::vector<std::byte> bytes_;
};

// Reading functions return false if too few bytes are left.
class StateReader {
 public:
  explicit StateReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  bool value(T& v) {
    return take(&v, sizeof v);
  }
  template <class T>
  bool list(std::vector<T>& items) {
    uint64_t size = 0;
    if (!value(size) || size > bytes_.size() / sizeof(T)) return false;
    items.resize(size);
    return take(items.data(), size * sizeof(T));
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  bool take(void* to, size_t size) {
    if (bytes_.size() < size) return false;
    if (size > 0) std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
    return true;
  }

  std::span<const std::byte> bytes_;
};

}  // namespace etendue
