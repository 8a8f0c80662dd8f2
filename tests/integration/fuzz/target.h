// A fuzz target: one reader with valid inputs and mutations for it. A crash, a sanitizer report, a hang, unbounded
// memory and a failed `require` are findings.
//
// A target is one source file NAME_target.cpp that defines `kTarget`, and one line in CMakeLists.txt. The driver is
// libFuzzer (libfuzzer_driver.cpp) or a loop over random mutations (standalone_driver.cpp).
#pragma once
#include <filesystem>
#include <span>

#include "integration/fuzz/mutation.h"

namespace etendue::fuzz {

using Input = std::span<const std::byte>;

struct Target {
  // Reads the input and uses what was read.
  void (*run)(Input input);

  // Small valid inputs, from which mutation starts.
  std::vector<Bytes> (*seeds)();

  // Changes the structure of the input; returns false if the input has no structure. Null: only bytes are mutated.
  bool (*mutate)(Bytes& input, Mutator& mutator) = nullptr;

  // Corrects checksums after bytes were mutated. Null: there are none.
  void (*repair)(Bytes& input) = nullptr;

  // The input that a file of the test data gives.
  Bytes (*input_of)(const std::filesystem::path& file) = nullptr;
};

extern const Target kTarget;

// The seeds of a target and the inputs that these files give. Files that are missing or larger than `most` bytes as an
// input are left out.
std::vector<Bytes> corpus(const Target& target, const std::vector<std::filesystem::path>& files, size_t most);

// Prints `what` and aborts unless `holds`.
void require(bool holds, const char* what);

Bytes bytes_of(std::string_view text);
std::string_view text_of(Input input);

// A number that depends on all bytes, which selects what is done with an input.
uint64_t number_of(Input input);

}  // namespace etendue::fuzz
