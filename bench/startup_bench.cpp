// Time to the first pixel: staircase2, ToyCar, a sphere of five million triangles, and sixteen squares with textures of
// 4096 x 4096 pixels. The picture while textures are being read counts as well.
//
// Measured within a process, phase by phase, and through `etendue view --offscreen`, from its start to the first
// displayed frame. The start of the Cornell box is measured with and without the plugins of OpenImageIO and OpenVDB, in
// turns. The exit code is 1 if a bound is exceeded.
//
//   startup_bench [plugins]    default: all measurements
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "render/session.h"
#include "support/child_process.h"
#include "support/large_glb.h"
#include "support/scenes.h"
#include "support/textured_gltf.h"

namespace etendue {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

int phases(const std::string& file) {
  const auto start = Clock::now();
  auto document = render::new_document(file);
  if (!document) return std::fprintf(stderr, "%s\n", document.error().message.c_str()), 2;
  const double loaded = seconds_since(start);
  document->width = 1280;
  document->height = 720;
  render::Session session({.interactive = true});
  session.submit(*document);
  while (!session.frame()) std::this_thread::sleep_for(std::chrono::microseconds(500));
  const double first = seconds_since(start), compiled = session.status().build.seconds;
  std::printf("load %6.3f  compile %6.3f  first frame %6.3f  together %6.3f\n", loaded, compiled,
              first - loaded - compiled, first);
  return 0;
}

struct ViewerStart {
  double first = -1;     // seconds to the first picture, also of a scene without its textures; negative if it failed
  double complete = -1;  // seconds to the first image of the complete scene
};

ViewerStart viewer_start(const std::string& file, const fs::path& folder, const std::string& environment = "") {
  const fs::path script = folder / "script.json", state = folder / "state.json";
  std::ofstream(script) << nlohmann::json::array({{{"do", "state"}, {"file", state.string()}}});
  const std::string command =
      environment + " '" + ETENDUE_BINARY + "' view '" + file + "' --offscreen --script '" + script.string() + "'";
  if (std::system(command.c_str()) != 0) return {};
  const auto report = nlohmann::json::parse(std::ifstream(state));
  const double complete = report.value("first_picture_seconds", -1.0);
  const double early = report.value("loading_picture_seconds", 0.0);
  return {early > 0 ? early : complete, complete};
}

// Compares the start with plugins that are found and with a folder of plugins that does not exist, in turns.
bool compare_plugins(const fs::path& folder) {
  constexpr int kPairs = 21;
  constexpr double kBound = 1.1;
  std::vector<double> ratios, found, missing;
  for (int i = 0; i < kPairs; ++i) {
    found.push_back(viewer_start("cornell", folder).first);
    missing.push_back(viewer_start("cornell", folder, "ETENDUE_PLUGIN_PATH=/nonexistent").first);
    ratios.push_back(found.back() / missing.back());
  }
  for (auto* list : {&ratios, &found, &missing}) std::ranges::sort(*list);
  constexpr size_t kMiddle = kPairs / 2, kQuarter = kPairs / 4;
  const bool fine = found.front() > 0 && missing.front() > 0 && ratios[kMiddle] < kBound;
  std::printf("cornell      with plugins %.3f s, without %.3f s; ratio: median %.3f, quartiles %.3f .. %.3f  %s\n",
              found[kMiddle], missing[kMiddle], ratios[kMiddle], ratios[kQuarter], ratios[kPairs - 1 - kQuarter],
              fine ? "" : "MISSED");
  return fine;
}

bool clock_start(const char* name, const std::string& file, double bound, const fs::path& folder) {
  std::vector<double> starts, complete;
  for (int i = 0; i < 5; ++i) {
    std::printf("%-12s ", name);
    if (test::run_in_child_process([&] { return phases(file); }) != 0) return false;
    const ViewerStart start = viewer_start(file, folder);
    starts.push_back(start.first);
    complete.push_back(start.complete);
  }
  std::sort(starts.begin(), starts.end());
  std::sort(complete.begin(), complete.end());
  const bool fine = starts.front() > 0 && starts.back() < bound;
  std::printf("%-12s viewer: median %.3f s, longest %.3f s, bound %.0f s; complete scene: median %.3f s  %s\n", name,
              starts[2], starts.back(), bound, complete[2], fine ? "" : "MISSED");
  return fine;
}

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) {
  using namespace etendue;
  const bool plugins_only = argc > 1 && std::string(argv[1]) == "plugins";
  const std::string data = test::data_folder();
  if (data.empty() && !plugins_only) return std::fprintf(stderr, "startup_bench: set ETENDUE_TEST_DATA\n"), 2;
  const fs::path folder = fs::temp_directory_path() / ("etendue-startup-" + std::to_string(getpid()));
  fs::create_directories(folder);
  bool fine = compare_plugins(folder);
  if (plugins_only) {
    fs::remove_all(folder);
    return fine ? 0 : 1;
  }
  const fs::path large = folder / "large.glb";
  const size_t triangles = test::write_large_glb(large, 5'000'000);
  std::printf("seconds; the large file has %zu triangles\n", triangles);
  fine = clock_start("staircase2", data + "/scenes/staircase2/staircase2.glb", 1, folder) && fine;
  fine = clock_start("ToyCar", data + "/gltf/ToyCar/glTF/ToyCar.gltf", 1, folder) && fine;
  fine = clock_start("large", large, 8, folder) && fine;
  const fs::path textured = folder / "textured.gltf";
  test::write_textured_gltf(textured, 16, 4096);
  fine = clock_start("textured", textured, 1, folder) && fine;
  fs::remove_all(folder);
  return fine ? 0 : 1;
}
