// Random damage for files: to their bytes, or to one value of their JSON.
//
// Everything follows from the seed, so that a finding can be repeated.
#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

namespace etendue::fuzz {

using Bytes = std::vector<std::byte>;

class Mutator {
 public:
  explicit Mutator(uint32_t seed) : engine_(seed) {}

  // Applies one to four of: flip a bit, cut off the end, remove a byte, replace a decimal number in the text, replace a
  // 32-bit word near the beginning (where the lengths of a GLB are).
  void damage_bytes(Bytes& bytes);

  // Applies one or two of: replace a value by one of another type or range or by a copy of another value, remove a
  // member or element, copy a member under another name or an element behind itself.
  void damage_json(nlohmann::json& root);

  // A random integer in [0, n).
  int below(int n) { return static_cast<int>(engine_() % static_cast<uint32_t>(n)); }

 private:
  size_t index_into(size_t size) { return engine_() % size; }
  void replace_number(Bytes& bytes);
  void replace_length(Bytes& bytes);
  nlohmann::json unexpected_value(const std::vector<nlohmann::json*>& values);
  void change_member(nlohmann::json& container, const std::vector<nlohmann::json*>& values);

  std::mt19937 engine_;
};

}  // namespace etendue::fuzz
