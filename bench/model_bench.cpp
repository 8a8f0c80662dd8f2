// Savings of the specialised scene model. For each flag of the model, the cost of a sample with the flag forced on is
// divided by the cost with the flags that the scene needs, on scenes that do not need the flag. The same is measured
// for features that are selected by data: a lens, transparency, and textures without effect.
//
// One thread, 128 x 128 pixels, `path`. The cost of a sample is the difference between a long and a short rendering, so
// that work done once does not count. The two models are rendered alternately. The table shows the median of the ratios
// of processor time, their 10 % and 90 % quantiles, and the ratio of instructions.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

#include "instruction_counter.h"
#include "metrics/convergence.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "support/independent_estimates.h"
#include "support/scenes.h"
#include "transport/model.h"

namespace etendue {
namespace {

using Change = render::Document (*)(render::Document);

struct Cost {
  double seconds = 0, instructions = 0;
};

Cost operator-(const Cost& a, const Cost& b) { return {a.seconds - b.seconds, a.instructions - b.instructions}; }

class Bench {
 public:
  // Prints the ratios of the costs of two documents.
  void compare(const std::string& scene, const std::string& what, const render::Document& small,
               const render::Document& large) {
    constexpr int kRounds = 9;
    std::vector<double> seconds, instructions;
    for (int i = 0; i < kRounds; ++i) {
      const Cost a = cost_of(small), b = cost_of(large);
      seconds.push_back(b.seconds / a.seconds);
      instructions.push_back(b.instructions / a.instructions);
    }
    using metrics::quantile;
    std::printf("%-24s %-14s %6.3f  (%5.3f to %5.3f) %12.4f\n", scene.c_str(), what.c_str(), quantile(seconds, 0.5),
                quantile(seconds, 0.1), quantile(seconds, 0.9), quantile(instructions, 0.5));
    std::fflush(stdout);
  }

 private:
  Cost cost_of(const render::Document& d) const { return rendering(d, 40) - rendering(d, 8); }

  Cost rendering(const render::Document& d, uint32_t samples) const {
    const uint64_t before = counter_.count().value_or(0);
    const std::clock_t start = std::clock();
    test::rendered(d, samples, 1);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    return {seconds, static_cast<double>(counter_.count().value_or(0) - before)};
  }

  Instructions counter_;
};

// True if the scene needs the flag: forcing it on does not change the model.
bool needs(const scene::CompiledScene& scene, const std::string& flag) {
  const auto forced = std::vector{flag};
  const auto decisions = transport::model_for(scene, forced).decisions;
  return std::ranges::all_of(decisions, [&](const auto& d) { return d.flag != flag || d.value == d.needed; });
}

void flags(Bench& bench, const std::string& scene, render::Document d) {
  d.width = d.height = 128;
  const auto compiled = scene::compile(d.scene, d.camera, nullptr);
  for (const auto& flag : transport::model_flags()) {
    if (needs(*compiled, flag)) continue;
    auto forced = d;
    forced.forced_flags = {flag};
    bench.compare(scene, flag, d, forced);
  }
}

render::Document with_a_lens(render::Document d) {
  d.camera.lens_radius = 1e-6f;
  return d;
}

template <class F>
render::Document with_materials(render::Document d, F&& change) {
  auto scene = *d.scene;
  for (auto& m : scene.materials) change(scene, m);
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return d;
}

render::Document with_alpha_of_one(render::Document d) {
  return with_materials(std::move(d), [](auto&, Material& m) { m.alpha_mode = AlphaMode::blend; });
}

render::Document with_white_textures(render::Document d) {
  auto white = std::make_shared<image::Image>();
  white->width = white->height = 1;
  white->channels = 3;
  white->bytes = {255, 255, 255};
  return with_materials(std::move(d), [&](scene::Scene& scene, Material& m) {
    if (scene.textures.empty()) scene.textures.emplace_back().image = white;
    m.base_color_texture.texture = 0;
  });
}

void data(Bench& bench, const std::string& scene, render::Document d) {
  d.width = d.height = 128;
  const std::pair<const char*, Change> changes[] = {
      {"lens", with_a_lens}, {"transparency", with_alpha_of_one}, {"textures", with_white_textures}};
  for (const auto& [name, change] : changes) bench.compare(scene, name, d, change(d));
}

void file(Bench& bench, const std::string& name, const std::string& file) {
  if (const auto d = render::new_document(file)) flags(bench, name, *d);
}

}  // namespace
}  // namespace etendue

int main() {
  using namespace etendue;
  Bench bench;
  std::printf("%-24s %-14s %6s  %16s %12s\n", "scene", "flag or feature", "time", "10 % to 90 %", "instructions");
  flags(bench, "cornell", *render::new_document("cornell"));
  flags(bench, "glass, glaze, metal", test::glossy_scene());
  const std::string folder = test::data_folder();
  if (!folder.empty()) {
    file(bench, "cornell-box", folder + "/scenes/cornell-box/cornell-box.glb");
    file(bench, "staircase2", folder + "/scenes/staircase2/staircase2.glb");
    file(bench, "veach-bidir", folder + "/scenes/veach-bidir/veach-bidir.glb");
  }
  data(bench, "cornell", *render::new_document("cornell"));
}
