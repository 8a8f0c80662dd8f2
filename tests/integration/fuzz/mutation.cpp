#include "integration/fuzz/mutation.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace etendue::fuzz {
namespace {

using nlohmann::json;

// All values of the tree below `root`, which must outlive the pointers.
void collect(json& root, std::vector<json*>& values) {
  for (json& value : root) {
    values.push_back(&value);
    if (value.is_structured()) collect(value, values);
  }
}

std::ptrdiff_t signed_index(size_t i) { return static_cast<std::ptrdiff_t>(i); }

}  // namespace

void Mutator::damage_bytes(Bytes& bytes) {
  const int times = 1 + below(4);
  for (int i = 0; i < times && !bytes.empty(); ++i) switch (below(5)) {
      case 0:
        bytes[index_into(bytes.size())] ^= std::byte(1U << below(8));
        break;
      case 1:
        bytes.resize(index_into(bytes.size()));
        break;
      case 2:
        replace_number(bytes);
        break;
      case 3:
        replace_length(bytes);
        break;
      default:
        bytes.erase(bytes.begin() + signed_index(index_into(bytes.size())));
        break;
    }
}

// Replaces the first run of digits behind a random place.
void Mutator::replace_number(Bytes& bytes) {
  static constexpr const char* kNumbers[] = {"-1",    "4294967295", "1e38", "0", "99999999999999999999",
                                             "65536", "0.5",        "-0"};
  const auto is_digit = [&](size_t k) { return k < bytes.size() && std::isdigit(static_cast<int>(bytes[k])); };
  size_t first = index_into(bytes.size());
  while (first < bytes.size() && !is_digit(first)) ++first;
  size_t end = first;
  while (is_digit(end)) ++end;
  const char* number = kNumbers[below(8)];
  bytes.erase(bytes.begin() + signed_index(first), bytes.begin() + signed_index(end));
  const auto* text = reinterpret_cast<const std::byte*>(number);
  bytes.insert(bytes.begin() + signed_index(first), text, text + std::strlen(number));
}

void Mutator::replace_length(Bytes& bytes) {
  if (bytes.size() < 24) return;
  const uint32_t word = below(2) ? 0xffffffffU : engine_();
  std::memcpy(bytes.data() + 4 * static_cast<size_t>(1 + below(5)), &word, sizeof word);
}

json Mutator::unexpected_value(const std::vector<json*>& values) {
  static const json kValues[] = {"x",
                                 json::object(),
                                 json::array(),
                                 nullptr,
                                 true,
                                 false,
                                 -1,
                                 0,
                                 0.5,
                                 int64_t{1} << 32,
                                 1e39,
                                 1e30,
                                 -1e30,
                                 1e-30,
                                 5121,
                                 99999,
                                 uint64_t{1} << 63,
                                 json::array({1, 2}),
                                 ""};
  const int choice = below(static_cast<int>(std::size(kValues)) + 4);
  if (choice < static_cast<int>(std::size(kValues))) return kValues[choice];
  return *values[index_into(values.size())];
}

void Mutator::change_member(json& container, const std::vector<json*>& values) {
  const auto member = std::next(container.begin(), signed_index(index_into(container.size())));
  const bool remove = below(2) == 0;
  if (remove) {
    container.erase(member);
  } else if (container.is_array()) {
    json copy = *member;
    container.insert(member, std::move(copy));
  } else {
    // The name is that of some member of some object of the file.
    const json* other = values[index_into(values.size())];
    const bool has_names = other->is_object() && !other->empty();
    const std::string name = has_names ? std::next(other->begin(), signed_index(index_into(other->size()))).key() : "x";
    json copy = *member;
    container[name] = std::move(copy);
  }
}

void Mutator::damage_json(json& root) {
  const int times = 1 + below(2);
  for (int i = 0; i < times; ++i) {
    std::vector<json*> values;
    collect(root, values);
    if (values.empty()) return;
    json& value = *values[index_into(values.size())];
    if (value.is_structured() && !value.empty() && below(2) == 0)
      change_member(value, values);
    else
      value = unexpected_value(values);
  }
}

}  // namespace etendue::fuzz
