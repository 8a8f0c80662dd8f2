// Mutation fuzzing of the glTF loader: damaged files are opened and rendered. A crash, a sanitizer report, a hang and a
// sample that is not a number are findings.
//
//   gltf_fuzz [--json | --bytes] SEED ITERATIONS FILE...
//
// --json damages values of the JSON and leaves the container intact; --bytes damages the bytes of the file, or those of
// the binary files next to it. Without either, both take turns. The same seed gives the same files. The damaged file of
// a finding remains in the temporary folder that the first line of output names. Exit code 77 means that a FILE does
// not exist: CTest reports the test as skipped.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "base/file.h"
#include "integration/fuzz/mutation.h"
#include "render/session.h"
#include "scene/scene.h"

namespace etendue::fuzz {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kSkipped = 77;
constexpr unsigned kSecondsPerFile = 60;  // a file that takes longer is a hang

enum class Kind { values, bytes, alternating };

// The JSON text of a .gltf or .glb file and the bytes that follow it in a GLB.
struct Container {
  json root;
  Bytes rest;
  bool binary = false;
};

Container read_container(const fs::path& file) {
  constexpr size_t kHeader = 12, kChunkHeader = 8;
  const auto bytes = read_file(file);
  if (!bytes) return {};
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  if (!text.starts_with("glTF")) return {json::parse(text, nullptr, false), {}, false};
  uint32_t length = 0;
  std::memcpy(&length, text.data() + kHeader, sizeof length);
  const auto rest = static_cast<std::ptrdiff_t>(kHeader + kChunkHeader + length);
  return {json::parse(text.substr(kHeader + kChunkHeader, length), nullptr, false),
          {bytes->begin() + rest, bytes->end()},
          true};
}

std::string word(size_t value) {
  const auto small = static_cast<uint32_t>(value);
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &small, sizeof small);
  return bytes;
}

// The file with other JSON and lengths that match it.
std::string file_text(const Container& container, const json& root) {
  std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
  if (!container.binary) return text;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string rest(reinterpret_cast<const char*>(container.rest.data()), container.rest.size());
  return "glTF" + word(2) + word(20 + text.size() + rest.size()) + word(text.size()) + "JSON" + text + rest;
}

// A copy of a glTF file, and of what lies next to it, in a folder of its own.
class Target {
 public:
  Target(const fs::path& source, const fs::path& folder)
      : file_(folder / source.filename()), container_(read_container(source)) {
    fs::create_directories(folder);
    if (source.extension() == ".gltf") {
      for (const auto& entry : fs::directory_iterator(source.parent_path()))
        if (entry.is_regular_file()) copy(entry.path(), folder);
    } else {
      copy(source, folder);
    }
  }

  const fs::path& file() const { return file_; }

  void damage_json(Mutator& mutator) {
    restore();
    json root = container_.root;
    mutator.damage_json(root);
    const std::string text = file_text(container_, root);
    write(file_, {reinterpret_cast<const std::byte*>(text.data()),
                  reinterpret_cast<const std::byte*>(text.data()) + text.size()});
  }

  void damage_bytes(Mutator& mutator) {
    restore();
    const bool other = originals_.size() > 1 && mutator.below(2) == 0;
    for (const auto& [path, bytes] : originals_) {
      const bool damaged = other ? path.extension() == ".bin" : path == file_;
      if (!damaged) continue;
      Bytes changed = bytes;
      mutator.damage_bytes(changed);
      write(path, changed);
    }
  }

 private:
  void copy(const fs::path& from, const fs::path& folder) {
    auto bytes = read_file(from);
    if (!bytes) return;
    const fs::path to = folder / from.filename();
    (void)write_file(to, bytes->data(), bytes->size());
    if (to == file_ || to.extension() == ".bin") originals_.emplace_back(to, std::move(*bytes));
  }

  void write(const fs::path& path, const Bytes& bytes) {
    (void)write_file(path, bytes.data(), bytes.size());
    changed_.push_back(path);
  }

  void restore() {
    for (const fs::path& path : changed_)
      for (const auto& [original, bytes] : originals_)
        if (original == path) (void)write_file(path, bytes.data(), bytes.size());
    changed_.clear();
  }

  fs::path file_;
  Container container_;
  std::vector<std::pair<fs::path, Bytes>> originals_;  // the file itself and binary buffers
  std::vector<fs::path> changed_;
};

struct Outcome {
  bool opened = false;
  film::InvalidSamples invalid;
};

// Opens the file and renders a few pixels of it.
Outcome open_and_render(const fs::path& file, const char* integrator) {
  constexpr int kSize = 4;
  Outcome outcome;
  auto document = render::new_document(file.string());
  if (!document) return outcome;
  outcome.opened = true;
  document->width = document->height = kSize;
  document->method.integrator = integrator;
  outcome.invalid = render::rendered(*document, 1, 1).invalid_samples();
  return outcome;
}

int fuzz(Kind kind, uint32_t seed, int iterations, const std::vector<fs::path>& sources) {
  for (const fs::path& source : sources)
    if (!fs::exists(source)) return std::printf("skipped: %s does not exist\n", source.c_str()), kSkipped;
  const fs::path folder = fs::temp_directory_path() / ("etendue-fuzz-" + std::to_string(seed));
  std::printf("damaged files are in %s\n", folder.c_str());
  std::fflush(stdout);
  std::vector<Target> targets;
  for (size_t i = 0; i < sources.size(); ++i) targets.emplace_back(sources[i], folder / std::to_string(i));

  static constexpr const char* kIntegrators[] = {"path", "bdpt"};
  int opened = 0, invalid = 0;
  for (int i = 0; i < iterations; ++i) {
    const size_t number = static_cast<size_t>(i) % targets.size();
    const size_t round = static_cast<size_t>(i) / targets.size();
    Mutator mutator(seed + static_cast<uint32_t>(i));
    Target& target = targets[number];
    if (kind == Kind::values || (kind == Kind::alternating && round % 2 == 0))
      target.damage_json(mutator);
    else
      target.damage_bytes(mutator);
    alarm(kSecondsPerFile);
    const Outcome outcome = open_and_render(target.file(), kIntegrators[round / 2 % 2]);
    alarm(0);
    opened += outcome.opened ? 1 : 0;
    if (outcome.invalid.total() == 0) continue;
    ++invalid;
    const fs::path kept = folder / ("invalid-" + std::to_string(i) + target.file().extension().string());
    fs::copy_file(target.file(), kept, fs::copy_options::overwrite_existing);
    std::printf("%s: %llu NaN, %llu infinite, %llu negative samples (%s)\n", kept.c_str(),
                static_cast<unsigned long long>(outcome.invalid.nan),
                static_cast<unsigned long long>(outcome.invalid.infinite),
                static_cast<unsigned long long>(outcome.invalid.negative), sources[number].c_str());
    std::fflush(stdout);
  }
  std::printf("%d files: %d opened and rendered, %d rejected, %d with invalid samples\n", iterations, opened,
              iterations - opened, invalid);
  if (invalid == 0) fs::remove_all(folder);
  return invalid == 0 ? 0 : 1;
}

int run(std::vector<std::string> args) {
  const auto take = [&](const char* option) { return std::erase(args, option) > 0; };
  const Kind kind = take("--json") ? Kind::values : take("--bytes") ? Kind::bytes : Kind::alternating;
  if (args.size() < 3) {
    std::fprintf(stderr, "usage: gltf_fuzz [--json | --bytes] SEED ITERATIONS FILE...\n");
    return 2;
  }
  return fuzz(kind, static_cast<uint32_t>(std::atoi(args[0].c_str())), std::atoi(args[1].c_str()),
              {args.begin() + 2, args.end()});
}

}  // namespace
}  // namespace etendue::fuzz

int main(int argc, char** argv) { return etendue::fuzz::run({argv + 1, argv + argc}); }
