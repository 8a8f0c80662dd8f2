// Latency of edits in an interactive session, and its cost without edits.
//
// A session renders as that of the viewer does, at 1280 x 720 and at 2560 x 1440. It is edited at random moments: first a
// material, then the camera, then the place of the largest object. The table shows milliseconds from `submit` to the
// first frame of the edit, and to the moment when the workers stop. A second test edits the camera sixty times per
// second and measures the age of the newest frame. A third test measures the throughput of a session that delivers frames,
// relative to a batch renderer, and that after an object was moved, relative to a session that begins with it there.
//
//   latency_bench [EDITS] [FILE...]
//
// The default is 200 edits of each kind, on staircase2 and ToyCar from ETENDUE_TEST_DATA. The exit code is 1 if a bound
// is exceeded.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <thread>

#include "render/session.h"
#include "support/scenes.h"

namespace etendue {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

// Bounds in milliseconds.
constexpr double kRestartP50 = 2, kRestartP99 = 10;
// Of the first frame of an edit: a refresh of the display, or two at 2560 x 1440.
double frame_p95(const render::Document& d) { return d.width <= 1280 ? 16 : 33; }

double quantile(const std::vector<double>& sorted, double q) {
  return sorted.empty() ? 0 : sorted[static_cast<size_t>(q * static_cast<double>(sorted.size() - 1) + 0.5)];
}

struct Bounds {
  double p50 = kInfinity, p95 = kInfinity, p99 = kInfinity;
};

// Prints a row. Returns false if it exceeds its bounds.
bool row(const char* what, std::vector<double> values, const Bounds& bounds) {
  std::sort(values.begin(), values.end());
  const double p50 = quantile(values, 0.5), p95 = quantile(values, 0.95), p99 = quantile(values, 0.99);
  const bool fine = p50 < bounds.p50 && p95 < bounds.p95 && p99 < bounds.p99;
  std::printf("  %-28s %5zu %8.2f %8.2f %8.2f %8.2f  %s\n", what, values.size(), p50, p95, p99,
              values.empty() ? 0 : values.back(), fine ? "" : "MISSED");
  return fine;
}

render::Document roughened(const render::Document& d, int step) {
  const size_t materials = d.scene->materials.size();
  const std::string name = "material." + std::to_string(static_cast<size_t>(step) % materials) + ".roughness";
  return *render::with(d, name, Value(0.2 + 0.005 * (step % 100)));
}

render::Document moved(render::Document d, int step) {
  const float angle = 0.01f * static_cast<float>(step % 20 - 10);
  d.camera.to_world = d.camera.to_world * glm::rotate(Mat4(1), angle, Vec3(0, 1, 0));
  return d;
}

// The object with the most triangles, moved by up to a thousandth of a metre.
render::Document with_moved_object(const render::Document& d, int step) {
  const scene::Scene& scene = *d.scene;
  size_t most = 0, node = 0;
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].mesh < 0) continue;
    size_t triangles = 0;
    for (const auto& primitive : scene.meshes[static_cast<size_t>(scene.nodes[i].mesh)].primitives)
      triangles += primitive.mesh->triangles.size();
    if (triangles <= most) continue;
    most = triangles;
    node = i;
  }
  const std::string name = "node." + std::to_string(node) + ".translation.x";
  return *render::with(d, name, Value(0.001 * (step % 20) / 20));
}

class Bench {
 public:
  Bench(const std::string& name, render::Document document, int edits) : document_(std::move(document)), edits_(edits) {
    std::printf("%s, %d x %d\n  %-28s %5s %8s %8s %8s %8s\n", name.c_str(), document_.width, document_.height,
                "milliseconds", "n", "p50", "p95", "p99", "max");
  }

  bool run() {
    bool fine = true;
    {
      render::Session session({.interactive = true});
      session.submit(document_);
      wait_for_frame(session, 1);
      std::this_thread::sleep_for(std::chrono::seconds(1));
      fine = edit(session, "material edit to frame", [](const auto& d, int i) { return roughened(d, i); }) && fine;
      fine = edit(session, "camera move to frame", [](const auto& d, int i) { return moved(d, i); }) && fine;
      fine =
          edit(session, "object move to frame", [](const auto& d, int i) { return with_moved_object(d, i); }) && fine;
      fine = row("cancel and restart", std::move(restarts_), {kRestartP50, kInfinity, kRestartP99}) && fine;
      drag(session);
    }
    share();
    return fine;
  }

 private:
  static void wait_for_frame(const render::Session& session, uint64_t version) {
    while (!session.frame() || session.frame()->version < version)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  template <class Edit>
  bool edit(render::Session& session, const char* what, Edit&& edited) {
    std::uniform_real_distribution<double> pause(0, 300);
    session.take_latencies();
    session.take_restart_latencies();
    for (int i = 0; i < edits_; ++i) {
      wait_for_frame(session, session.submit(edited(document_, i)));
      std::this_thread::sleep_for(Milliseconds(pause(random_)));
    }
    const auto restarts = session.take_restart_latencies();
    restarts_.insert(restarts_.end(), restarts.begin(), restarts.end());
    return row(what, session.take_latencies(), {kInfinity, frame_p95(document_), kInfinity});
  }

  // The age of the displayed frame while the camera is dragged, sampled at every refresh of the display.
  void drag(render::Session& session) {
    std::vector<Clock::time_point> submitted(1);
    std::vector<double> ages;
    const uint64_t first = session.submit(document_);
    wait_for_frame(session, first);
    auto next = Clock::now();
    for (int i = 0; i < 240; ++i) {
      session.submit(moved(document_, i));
      submitted.push_back(Clock::now());
      next += std::chrono::microseconds(16'667);
      std::this_thread::sleep_until(next);
      const uint64_t shown = session.frame()->version - first;
      if (shown + 1 < submitted.size())
        ages.push_back(Milliseconds(Clock::now() - submitted[shown + 1]).count());
      else
        ages.push_back(0);
    }
    row("unseen edits, dragging", std::move(ages), {});
  }

  // Of a session that shows `document` after it has rendered `earlier`, unless that is null.
  static double paths_per_second(const render::Document& document, bool interactive,
                                 const render::Document* earlier = nullptr) {
    render::Session session({.interactive = interactive});
    if (earlier) {
      session.submit(*earlier);
      while (session.status().paths == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const uint64_t version = session.submit(document);
    while (session.status().version < version) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const auto start = Clock::now();
    const uint64_t before = session.status().paths;
    std::this_thread::sleep_for(std::chrono::seconds(4));
    const uint64_t paths = session.status().paths - before;
    return static_cast<double>(paths) / (Milliseconds(Clock::now() - start).count() * 1e-3);
  }

  void share() const {
    const double batch = paths_per_second(document_, false), shown = paths_per_second(document_, true);
    std::printf("  paths per second: batch %.3g, shown %.3g: ratio %.3f\n", batch, shown, shown / batch);
    const render::Document moved = with_moved_object(document_, 1);
    std::vector<double> ratios;
    for (int i = 0; i < 3; ++i) {
      const double anew = paths_per_second(moved, false);
      ratios.push_back(paths_per_second(moved, false, &document_) / anew);
    }
    std::sort(ratios.begin(), ratios.end());
    std::printf("  paths per second after an object was moved, relative to a new session: %.3f (%.3f to %.3f)\n",
                ratios[1], ratios[0], ratios[2]);
  }

  render::Document document_;
  int edits_;
  std::mt19937 random_{1};
  std::vector<double> restarts_;
};

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) {
  using namespace etendue;
  const int edits = argc > 1 ? std::atoi(argv[1]) : 200;
  std::vector<std::string> files(argv + std::min(argc, 2), argv + argc);
  if (files.empty()) {
    const std::string data = test::data_folder();
    if (data.empty()) return std::fprintf(stderr, "latency_bench: set ETENDUE_TEST_DATA\n"), 2;
    files = {data + "/scenes/staircase2/staircase2.glb", data + "/gltf/ToyCar/glTF/ToyCar.gltf"};
  }
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a run takes minutes
  bool fine = true;
  for (const std::string& file : files) {
    auto document = render::new_document(file);
    if (!document) return std::fprintf(stderr, "%s\n", document.error().message.c_str()), 2;
    for (const int scale : {1, 2}) {
      document->width = scale * 1280;
      document->height = scale * 720;
      fine = Bench(std::filesystem::path(file).stem(), *document, edits).run() && fine;
    }
  }
  return fine ? 0 : 1;
}
