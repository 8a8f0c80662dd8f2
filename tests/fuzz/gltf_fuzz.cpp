// Mutation fuzzing of the loader: files are damaged at random and opened; a crash, a hang or a sanitizer report is the
// finding.
//
//   gltf_fuzz SEED ITERATIONS FILE...
//
// Bits are flipped, runs are deleted or doubled, numbers in the JSON become absurd ones, lengths lie. Where binary
// files lie beside a file of JSON, every second time they are damaged instead of it. The same seed gives the same
// files.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>

#include "base/file.h"
#include "scene/compiled_scene.h"
#include "scene/gltf/gltf.h"

namespace {

using Bytes = std::vector<std::byte>;

class Mutator {
 public:
  explicit Mutator(uint32_t seed) : engine_(seed) {}

  void mutate(Bytes& bytes) {
    const int times = 1 + below(4);
    for (int i = 0; i < times && !bytes.empty(); ++i) switch (below(5)) {
        case 0:
          bytes[at(bytes)] ^= std::byte(1U << below(8));
          break;
        case 1:
          bytes.resize(at(bytes));
          break;
        case 2:
          absurd_number(bytes);
          break;
        case 3:
          lying_word(bytes);
          break;
        default:
          bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at(bytes)));
          break;
      }
  }

 private:
  int below(int n) { return static_cast<int>(engine_() % static_cast<uint32_t>(n)); }
  size_t at(const Bytes& bytes) { return engine_() % bytes.size(); }

  // Replaces a digit run near a random place by a number nobody expects.
  void absurd_number(Bytes& bytes) {
    static constexpr const char* kNumbers[] = {"-1",    "4294967295", "1e38", "0", "99999999999999999999",
                                               "65536", "0.5",        "-0"};
    size_t i = at(bytes);
    const auto digit = [&](size_t k) { return k < bytes.size() && std::isdigit(static_cast<int>(bytes[k])); };
    while (i < bytes.size() && !digit(i)) ++i;
    size_t end = i;
    while (digit(end)) ++end;
    const char* number = kNumbers[below(8)];
    bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(i), bytes.begin() + static_cast<std::ptrdiff_t>(end));
    const auto* first = reinterpret_cast<const std::byte*>(number);
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(i), first, first + std::strlen(number));
  }

  void lying_word(Bytes& bytes) {
    if (bytes.size() < 24) return;
    const uint32_t word = below(2) ? 0xffffffffU : engine_();
    std::memcpy(bytes.data() + 4 * static_cast<size_t>(1 + below(5)), &word, sizeof word);
  }

  std::mt19937 engine_;
};

std::vector<std::filesystem::path> binaries_beside(const std::filesystem::path& source) {
  std::vector<std::filesystem::path> binaries;
  if (source.extension() == ".gltf")
    for (const auto& entry : std::filesystem::directory_iterator(source.parent_path()))
      if (entry.path().extension() == ".bin") binaries.push_back(entry.path());
  return binaries;
}

// The file, and what it needs, in a folder of their own; damaged.
bool write_damaged(const std::filesystem::path& source, const std::filesystem::path& folder, Mutator mutator,
                   bool json) {
  const auto binaries = binaries_beside(source);
  for (auto files = binaries; const auto& file : (files.push_back(source), files)) {
    auto bytes = etendue::read_file(file);
    if (!bytes) return std::fprintf(stderr, "%s\n", bytes.error().message.c_str()), false;
    if (json || binaries.empty() ? file == source : file != source) mutator.mutate(*bytes);
    if (!etendue::write_file(folder / file.filename(), bytes->data(), bytes->size())) return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return std::fprintf(stderr, "usage: gltf_fuzz SEED ITERATIONS FILE...\n"), 2;
  const auto seed = static_cast<uint32_t>(std::atoi(argv[1]));
  const int iterations = std::atoi(argv[2]);
  const auto folder = std::filesystem::temp_directory_path() / ("etendue-fuzz-" + std::to_string(seed));
  std::filesystem::create_directories(folder);
  int opened = 0;
  for (int i = 0; i < iterations; ++i) {
    const std::filesystem::path source = argv[3 + i % (argc - 3)];
    if (!write_damaged(source, folder, Mutator(seed + static_cast<uint32_t>(i)), i / (argc - 3) % 2 == 0)) return 4;
    const auto scene = etendue::scene::load_gltf(folder / source.filename());
    if (scene) {
      etendue::scene::compile(std::make_shared<const etendue::scene::Scene>(*scene), etendue::Camera{}, nullptr);
      ++opened;
    }
  }
  std::filesystem::remove_all(folder);
  std::printf("%d files, %d opened, %d refused\n", iterations, opened, iterations - opened);
  return 0;
}
