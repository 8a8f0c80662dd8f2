// Coverage of the error intervals that an image states, and false alarms of the block test on unmodified images: a
// hundred small renderings of each scene against a long one.
//
//   certificate_bench [RENDERINGS] [SCENE...]
#include <cstdio>
#include <cstdlib>

#include "advisor/block_test.h"
#include "advisor/true_error.h"
#include "film/film_image.h"
#include "film/relative_error.h"
#include "render/session.h"
#include "support/scenes.h"

namespace etendue {
namespace {

constexpr int kWidth = 96, kHeight = 72;
constexpr uint32_t kSamples = 16, kReference = 2048;

bool holds(const film::Interval& interval, double truth) { return truth >= interval.low && truth <= interval.high; }

void cover(const std::string& scene, int renderings) {
  auto opened = render::new_document(scene);
  if (!opened) return static_cast<void>(std::fprintf(stderr, "%s\n", opened.error().message.c_str()));
  render::Document d = *opened;
  d.width = kWidth;
  d.height = kHeight;
  d.seed = 1u << 30;
  const film::Film reference = render::rendered(d, kReference);
  int held = 0, held_relative = 0, unchanged = 0;
  double width = 0, width_relative = 0;
  for (int i = 0; i < renderings; ++i) {
    d.seed = static_cast<uint64_t>(i);
    const film::Film film = render::rendered(d, kSamples);
    const auto picture = film::layered_image_of(film);
    const auto& rgb = picture.find("")->pixels;
    const auto error = film.error();
    const auto relative = *film::relative_error(film);
    const auto true_error = advisor::true_error(rgb, reference);
    held += holds(error.rmse_interval, true_error.absolute.root());
    held_relative += holds(relative.interval, true_error.relative.value);
    width += error.rmse_interval.high / error.rmse_interval.low / renderings;
    width_relative += relative.interval.high / relative.interval.low / renderings;
    unchanged += advisor::test_blocks({rgb, picture.find("variance")->pixels, kSamples}, reference).changed.empty();
  }
  std::printf(
      "%-60s RMSE covered %d, relMSE covered %d, block test passed %d of %d; high / low %.3f, %.3f; reference %.2g\n",
      scene.c_str(), held, held_relative, unchanged, renderings, width, width_relative, reference.error().rmse);
  std::fflush(stdout);
}

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) {
  const int renderings = argc > 1 ? std::atoi(argv[1]) : 100;
  std::vector<std::string> scenes(argv + std::min(argc, 2), argv + argc);
  const std::string data = etendue::test::data_folder();
  if (scenes.empty()) scenes = {"cornell"};
  if (argc <= 2 && !data.empty())
    for (const char* file : {"/scenes/cornell-box/cornell-box.glb", "/scenes/staircase2/staircase2.glb",
                             "/gltf/TransmissionTest.glb", "/scenes/veach-bidir/veach-bidir.glb"})
      scenes.push_back(data + file);
  for (const auto& scene : scenes) etendue::cover(scene, renderings);
}
