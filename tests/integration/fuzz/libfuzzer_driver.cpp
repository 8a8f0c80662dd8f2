// Connects a target to libFuzzer.
//
//   fuzz_NAME --write-corpus FOLDER [FILE...]    writes the seeds, and what the files give, to a folder
//   fuzz_NAME [-runs=N ...] FOLDER               options of libFuzzer
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "base/file.h"
#include "integration/fuzz/target.h"

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most);

namespace etendue::fuzz {
namespace {

constexpr size_t kMostBytes = 65536;  // of an input

int write_corpus(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files) {
  std::filesystem::create_directories(folder);
  int number = 0;
  for (const Bytes& input : corpus(kTarget, files, kMostBytes)) {
    const auto file = folder / ("seed-" + std::to_string(number++));
    if (auto written = write_file(file, input.data(), input.size()); !written)
      return std::fprintf(stderr, "%s\n", written.error().message.c_str()), 1;
  }
  return 0;
}

// Three of four mutations of an input with structure change the structure.
bool change_structure(Bytes& input, uint32_t seed) {
  Mutator mutator(seed);
  return kTarget.mutate && mutator.below(4) != 0 && kTarget.mutate(input, mutator);
}

}  // namespace
}  // namespace etendue::fuzz

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  const std::vector<std::string> words(*arguments + 1, *arguments + *count);
  if (words.size() >= 2 && words[0] == "--write-corpus")
    std::exit(etendue::fuzz::write_corpus(words[1], {words.begin() + 2, words.end()}));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  etendue::fuzz::kTarget.run({reinterpret_cast<const std::byte*>(data), size});
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
  const auto* first = reinterpret_cast<const std::byte*>(data);
  etendue::fuzz::Bytes input(first, first + size);
  if (etendue::fuzz::change_structure(input, seed) && input.size() <= most) {
    std::memcpy(data, input.data(), input.size());
    return input.size();
  }
  const size_t changed = LLVMFuzzerMutate(data, size, most);
  if (!etendue::fuzz::kTarget.repair) return changed;
  input.assign(first, first + changed);
  etendue::fuzz::kTarget.repair(input);
  std::memcpy(data, input.data(), changed);
  return changed;
}
