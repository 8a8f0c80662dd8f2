// Peak memory of a rendering relative to the data it must hold: arrays of the scene, Embree, images, film.
//
// Each scene is loaded and rendered in its own process. The exit code is 1 if the peak exceeds 2.5 times the arrays.
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "geometry/embree_scene.h"
#include "render/session.h"
#include "support/child_process.h"
#include "support/large_glb.h"
#include "support/scenes.h"

namespace etendue {
namespace {

namespace fs = std::filesystem;

constexpr double kMostRatio = 2.5;

double mib(size_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

int measure_memory(const char* name, const std::string& file) {
  const size_t before = test::resident_bytes();
  auto document = render::new_document(file);
  if (!document) return std::fprintf(stderr, "%s\n", document.error().message.c_str()), 2;
  const size_t loaded = test::resident_bytes(), peak_of_loading = test::peak_resident_bytes();
  document->width = 1280;
  document->height = 720;
  document->limits.samples = 1;
  render::Session session({});
  session.submit(*document);
  session.finish();
  const size_t embree = embree_memory(), arrays = session.status().memory, peak = test::peak_resident_bytes();
  const double ratio = static_cast<double>(peak) / static_cast<double>(arrays);
  std::printf("%-12s %8.1f %8.1f %8.1f %8.1f %8.1f %8.1f %8.1f %7.2f  %s\n", name, mib(before), mib(loaded),
              mib(peak_of_loading), mib(arrays), mib(embree), mib(test::resident_bytes()), mib(peak), ratio,
              ratio <= kMostRatio ? "" : "MISSED");
  return ratio <= kMostRatio ? 0 : 1;
}

}  // namespace
}  // namespace etendue

int main() {
  using namespace etendue;
  const std::string data = test::data_folder();
  if (data.empty()) return std::fprintf(stderr, "memory_bench: set ETENDUE_TEST_DATA\n"), 2;
  const fs::path large = fs::temp_directory_path() / ("etendue-memory-" + std::to_string(getpid()) + ".glb");
  test::write_large_glb(large, 5'000'000);
  std::printf("%-12s %8s %8s %8s %8s %8s %8s %8s %7s\n", "MiB", "before", "loaded", "load peak", "arrays", "(Embree)",
              "rendered", "peak", "ratio");
  const std::pair<const char*, std::string> scenes[] = {{"staircase2", data + "/scenes/staircase2/staircase2.glb"},
                                                        {"ToyCar", data + "/gltf/ToyCar/glTF/ToyCar.gltf"},
                                                        {"large", large.string()}};
  int code = 0;
  for (const auto& [name, file] : scenes)
    if (test::run_in_child_process([&] { return measure_memory(name, file); }) != 0) code = 1;
  fs::remove(large);
  return code;
}
