#include "integration/fuzz/target.h"

#include <cstdio>
#include <cstdlib>

#include "base/file.h"
#include "base/hash.h"

namespace etendue::fuzz {

std::vector<Bytes> corpus(const Target& target, const std::vector<std::filesystem::path>& files, size_t most) {
  std::vector<Bytes> inputs = target.seeds();
  for (const auto& file : files) {
    if (target.input_of) {
      inputs.push_back(target.input_of(file));
    } else if (auto bytes = read_file(file)) {
      inputs.push_back(std::move(*bytes));
    }
  }
  std::erase_if(inputs, [&](const Bytes& input) { return input.empty() || input.size() > most; });
  return inputs;
}

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "finding: %s\n", what);
  std::abort();
}

Bytes bytes_of(std::string_view text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

std::string_view text_of(Input input) { return {reinterpret_cast<const char*>(input.data()), input.size()}; }

uint64_t number_of(Input input) { return hash_bytes(text_of(input).data(), input.size()); }

}  // namespace etendue::fuzz
