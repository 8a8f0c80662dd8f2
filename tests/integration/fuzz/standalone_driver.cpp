// Runs a target on random mutations of its seeds, without libFuzzer.
//
//   fuzz_NAME SEED INPUTS [FILE...]    mutates the seeds of the target, and what the files give
//   fuzz_NAME INPUT                    runs one input, to reproduce a finding
//
// The same seed gives the same inputs. The input of a finding remains in the file that the first line of output names.
// Exit code 77 means that a FILE does not exist: CTest reports the test as skipped.
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/file.h"
#include "integration/fuzz/target.h"

namespace etendue::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr int kSkipped = 77;
constexpr unsigned kSecondsPerInput = 60;  // an input that takes longer is a hang
constexpr size_t kMostBytes = size_t{1} << 20;

Bytes mutated(Bytes input, Mutator& mutator) {
  if (kTarget.mutate && mutator.below(2) == 0 && kTarget.mutate(input, mutator)) return input;
  mutator.damage_bytes(input);
  if (kTarget.repair) kTarget.repair(input);
  return input;
}

// A file that holds the input that is being run, also after a crash.
class CurrentInput {
 public:
  CurrentInput()
      : path_(fs::temp_directory_path() / ("etendue-fuzz-" + std::to_string(::getpid()))),
        descriptor_(::open(path_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600)) {
    require(descriptor_ >= 0, "a file in the temporary folder cannot be written");
    std::printf("the current input is in %s\n", path_.c_str());
    std::fflush(stdout);
  }
  CurrentInput(const CurrentInput&) = delete;
  CurrentInput& operator=(const CurrentInput&) = delete;
  ~CurrentInput() {
    ::close(descriptor_);
    fs::remove(path_);
  }

  void set(const Bytes& input) const {
    const auto size = static_cast<ssize_t>(input.size());
    require(::pwrite(descriptor_, input.data(), input.size(), 0) == size && ::ftruncate(descriptor_, size) == 0,
            "the current input cannot be written");
  }

 private:
  fs::path path_;
  int descriptor_;
};

void run_bounded(const Bytes& input) {
  alarm(kSecondsPerInput);
  kTarget.run(input);
  alarm(0);
}

int fuzz(uint32_t seed, int inputs, const std::vector<fs::path>& files) {
  for (const fs::path& file : files)
    if (!fs::exists(file)) return std::printf("skipped: %s does not exist\n", file.c_str()), kSkipped;
  const CurrentInput current;
  const std::vector<Bytes> originals = corpus(kTarget, files, kMostBytes);
  for (const Bytes& original : originals) run_bounded(original);
  for (int i = 0; i < inputs; ++i) {
    Mutator mutator(seed + static_cast<uint32_t>(i));
    const Bytes input = mutated(originals[static_cast<size_t>(i) % originals.size()], mutator);
    current.set(input);
    run_bounded(input);
  }
  std::printf("%d mutations of %zu inputs: no finding\n", inputs, originals.size());
  return 0;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() == 1) {
    const auto bytes = read_file(arguments[0]);
    if (!bytes) return std::fprintf(stderr, "%s\n", bytes.error().message.c_str()), 2;
    run_bounded(*bytes);
    return 0;
  }
  if (arguments.empty()) return std::fprintf(stderr, "usage: fuzz_NAME SEED INPUTS [FILE...] | fuzz_NAME INPUT\n"), 2;
  return fuzz(static_cast<uint32_t>(std::atoi(arguments[0].c_str())), std::atoi(arguments[1].c_str()),
              {arguments.begin() + 2, arguments.end()});
}

}  // namespace
}  // namespace etendue::fuzz

int main(int argc, char** argv) { return etendue::fuzz::run({argv + 1, argv + argc}); }
