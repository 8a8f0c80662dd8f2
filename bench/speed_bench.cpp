// Time of one sample per pixel, and speed-up by a second thread.
//
// Scenes: the Cornell box, and the Cornell box with a glossy box and a glass sphere, 512 x 512, paths of at most 8
// edges, `path` with default parameters. The table shows seconds for one sample of every pixel on two threads, for
// comparison with other renderers, and the speed-up of two threads over one. Both are measured alternately.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include "film/film_image.h"
#include "image/display.h"
#include "image/image.h"
#include "render/session.h"
#include "scene/builtin/cornell.h"
#include "support/scenes.h"

namespace etendue {
namespace {

using Clock = std::chrono::steady_clock;

// A glass sphere replaces the short box; the tall box becomes a glossy metal.
scene::Scene glossy_box_and_glass_sphere() {
  scene::Scene scene = scene::cornell_box();
  for (auto& node : scene.nodes)
    if (node.name == "short box") node.visible = false;
  for (const auto& group : scene.meshes) {
    if (group.name != "tall box") continue;
    Material& metal = scene.materials[static_cast<size_t>(group.primitives[0].material)];
    metal.metallic = 1;
    metal.roughness = 0.3f;
    metal.specular = 1;
    metal.base_color = Rgb(0.9f);
  }
  Mat4 place(1);
  place[3] = Vec4(1.86f, 1.0f, 1.69f, 1);
  test::add(scene, test::sphere(1, 64, false), scene::glass(), place);
  return scene;
}

double seconds_per_sample(const render::Document& document, int threads, uint32_t samples) {
  const auto start = Clock::now();
  test::rendered(document, samples, threads);
  return std::chrono::duration<double>(Clock::now() - start).count() / samples;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void clock_samples(const char* name, render::Document document) {
  document.method.settings = {{"path.max-depth", Value(8)}};
  constexpr int kRounds = 7;
  constexpr uint32_t kSamples = 8;
  std::vector<double> two, ratios;
  for (int i = 0; i < kRounds; ++i) {
    const double alone = seconds_per_sample(document, 1, kSamples);
    two.push_back(seconds_per_sample(document, 2, kSamples));
    ratios.push_back(alone / two.back());
  }
  std::printf("%-28s %.4f s per sample of every pixel on 2 threads; 2 threads against 1: %.2f\n", name, median(two),
              median(ratios));
}

int save_picture(const render::Document& document, const char* file) {
  const film::Film film = test::rendered(document, 64);
  const auto shown = image::display_pixels(film::radiance_of(film), 0, image::ToneCurve::none);
  return image::write_png(file, film.width(), film.height(), shown) ? 0 : 4;
}

}  // namespace
}  // namespace etendue

// speed_bench [image.png]: with a name, renders the second scene to that file instead of measuring.
int main(int argc, char** argv) {
  using namespace etendue;
  auto document = *render::new_document("cornell");
  document.width = document.height = 512;
  if (argc == 1) clock_samples("cornell", document);
  document.scene = std::make_shared<const scene::Scene>(glossy_box_and_glass_sphere());
  if (argc > 1) return save_picture(document, argv[1]);
  clock_samples("glossy box, glass sphere", document);
}
