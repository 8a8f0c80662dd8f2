// How much of the rays' own speed is left: rays per second of `path` against a bare loop over the very same rays.
//
// Printed are ratios, measured interleaved on one thread.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "bench/ray_log.h"
#include "integrator/integrator.h"
#include "render/document.h"
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

struct Rig {
  render::Document document;
  std::shared_ptr<const scene::CompiledScene> scene;
  transport::Model model;
  std::unique_ptr<Sampler> sampler;
  std::unique_ptr<integrator::Integrator> integrator;
  CameraRays camera;
  film::Filter filter;
  std::unique_ptr<integrator::Work> work;

  explicit Rig(render::Document d)
      : document(std::move(d)),
        scene(scene::compile(document.scene, document.camera, nullptr)),
        model(transport::model_for(*scene)),
        sampler(make_sampler("sobol")),
        integrator(integrator::make_integrator("path", document.method.settings_of("path"))),
        camera(document.camera, document.width, document.height) {
    sampler->prepare(0, 64);
    work = integrator->begin(
        {scene.get(), &model, sampler.get(), &camera, &filter, 0, document.width, document.height}, nullptr);
  }
  Rig(const Rig&) = delete;

  uint64_t render(uint32_t sample) const {
    using integrator::PixelBlock;
    std::array<Rgb, PixelBlock::kMostPixels> out;
    uint64_t rays = 0;
    for (int y = 0; y < document.height; y += PixelBlock::kHeight)
      for (int x = 0; x < document.width; x += PixelBlock::kWidth)
        rays += work->sample({x, y, PixelBlock::kWidth, PixelBlock::kHeight, sample}, out, {}).value_or(0);
    return rays;
  }
};

void compare_rays(const char* name, render::Document d) {
  d.width = d.height = 256;
  const Rig rig(std::move(d));
  RayLog log;
  log.start();
  rig.render(0);
  log.stop();
  std::vector<double> ratios;
  double fastest_path = 1e30, fastest_bare = 1e30;
  constexpr int kRounds = 9;
  uint64_t hits = 0;
  for (int i = 0; i < kRounds; ++i) {
    uint64_t rays = 0;
    const double path = seconds([&] { rays = rig.render(0); });
    const double bare = seconds([&] { hits += log.replay(); });
    fastest_path = std::min(fastest_path, path), fastest_bare = std::min(fastest_bare, bare);
    ratios.push_back((static_cast<double>(rays) / path) / (static_cast<double>(log.size()) / bare));
    if (i == 0)
      std::printf("%-16s %8llu rays, replayed %8zu\n", name, static_cast<unsigned long long>(rays), log.size());
  }
  std::sort(ratios.begin(), ratios.end());
  std::printf("%-16s path / bare loop: median %.3f (min %.3f, max %.3f), fastest against fastest %.3f, %llu hits\n",
              name, ratios[kRounds / 2], ratios.front(), ratios.back(), fastest_bare / fastest_path,
              static_cast<unsigned long long>(hits));
}

}  // namespace
}  // namespace etendue

int main() {
  using namespace etendue;
  prepare_thread_for_rays();
  compare_rays("cornell", *render::new_document("cornell"));
  auto d = *render::new_document("cornell");
  d.scene = std::make_shared<const scene::Scene>(million());
  compare_rays("million", d);
}
