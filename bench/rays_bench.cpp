// Ray throughput: rays per second of integrators relative to a loop that only traces the same rays.
//
//   rays_bench [METHOD...]      METHOD as in `etendue bench`; the default is `path`
//
// The table shows ratios, measured alternately on one thread, and the time of a ray in the bare loop. That time depends
// on the integrator, because the coherence of the rays does.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "integrator_harness.h"
#include "bench/method_spec.h"
#include "ray_log.h"
#include "scene/builtin/cornell.h"
#include "support/scenes.h"

namespace etendue {
namespace {

using Clock = std::chrono::steady_clock;

double seconds(const auto& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A sphere of about a million triangles, bumpy, in a diffuse room with an area light.
scene::Scene million() {
  scene::Scene scene = scene::cornell_box();
  auto mesh = std::make_shared<Mesh>(*test::sphere(1.2f, 500, false));
  for (auto& p : mesh->positions) p *= 1 + 0.02f * std::sin(40 * p.x) * std::sin(37 * p.y) * std::sin(43 * p.z);
  Mat4 place(1);
  place[3] = Vec4(2.8f, 2.5f, 2.2f, 1);
  test::add(scene, mesh, test::diffuse(Rgb(0.7f)), place);
  return scene;
}

void compare_rays(const char* scene_name, const std::string& name, render::Document d) {
  d.width = d.height = 256;
  const auto method = bench::parse_method(name, d);
  if (!method) return static_cast<void>(std::fprintf(stderr, "%s\n", method.error().message.c_str()));
  IntegratorHarness harness(method->document, scene::compile(d.scene, d.camera, nullptr));
  RayLog log;
  log.start();
  harness.step();
  log.stop();
  std::vector<double> ratios, without;
  constexpr int kRounds = 9;
  double bare = 0;
  uint64_t hits = 0;
  for (int i = 0; i < kRounds; ++i) {
    const IntegratorHarness::Part before = harness.total();
    harness.step();
    const IntegratorHarness::Part after = harness.total();
    bare = seconds([&] { hits += log.replay(); }) / static_cast<double>(log.size());
    const auto rays = static_cast<double>(after.rays - before.rays);
    const double took = after.seconds - before.seconds, bookkeeping = after.bookkeeping - before.bookkeeping;
    ratios.push_back(bare * rays / took);
    without.push_back(bare * rays / (took - bookkeeping));
  }
  std::sort(ratios.begin(), ratios.end());
  std::sort(without.begin(), without.end());
  std::printf(
      "%-8s %-28s over the bare loop: median %.3f (min %.3f, max %.3f), without bookkeeping %.3f; bare %.1f ns "
      "per ray, %llu hits\n",
      scene_name, name.c_str(), ratios[kRounds / 2], ratios.front(), ratios.back(), without[kRounds / 2], 1e9 * bare,
      static_cast<unsigned long long>(hits));
}

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) {
  using namespace etendue;
  prepare_thread_for_rays();
  std::vector<std::string> methods(argv + 1, argv + argc);
  if (methods.empty()) methods = {"path"};
  for (const std::string& method : methods) compare_rays("cornell", method, *render::new_document("cornell"));
  auto d = *render::new_document("cornell");
  d.scene = std::make_shared<const scene::Scene>(million());
  for (const std::string& method : methods) compare_rays("million", method, d);
}
