// Time to a given error in a region of the image: with a focus (render/focus.h), and while the whole image is sampled.
//
// The Cornell box and staircase2, path tracing, regions of a twentieth of the image. Times are seconds of sampling. The
// exit code is 1 if the focus is not faster than the whole image.
//
//   focus_bench [RELATIVE_ERROR]    default: 0.02
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "film/error_measure.h"
#include "film/film_crop.h"
#include "render/session.h"
#include "support/scenes.h"

namespace etendue {
namespace {

constexpr int kWidth = 640, kHeight = 360;
constexpr auto kPollInterval = std::chrono::milliseconds(100);

struct Outcome {
  double seconds;
  uint32_t samples;  // per pixel of the region
};

Outcome time_to_error(const render::Document& document, const render::PixelRect& region, bool focused, double target) {
  render::Session session({});
  if (focused) session.set_focus(region);
  session.submit(document);
  while (true) {
    std::this_thread::sleep_for(kPollInterval);
    const double seconds = session.status().seconds;
    const auto film = film::cropped(session.film_copy(), region.x, region.y, region.width, region.height);
    const auto error = film::measured_error(film, film::ErrorMeasure::relative, {});
    if (error.known && error.value <= target) return {seconds, film.samples(0, 0)};
  }
}

// Returns whether the focus is faster.
bool compare(const std::string& scene, const render::PixelRect& region, double target) {
  auto document = render::new_document(scene);
  if (!document) {
    std::fprintf(stderr, "%s\n", document.error().message.c_str());
    return false;
  }
  document->width = kWidth;
  document->height = kHeight;
  const Outcome whole = time_to_error(*document, region, false, target);
  const Outcome focused = time_to_error(*document, region, true, target);
  const double share = region.width * region.height / (double{kWidth} * kHeight);
  std::printf("%-24s region %4.1f %%  whole %7.2f s %5u spp  focus %7.2f s %5u spp  ratio %5.1f\n",
              document->scene_name.substr(document->scene_name.rfind('/') + 1).c_str(), 100 * share, whole.seconds,
              whole.samples, focused.seconds, focused.samples, whole.seconds / focused.seconds);
  std::fflush(stdout);
  return focused.seconds < whole.seconds;
}

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) {
  using namespace etendue;
  const double target = argc > 1 ? std::atof(argv[1]) : 0.02;
  if (!(target > 0)) return std::fprintf(stderr, "the error has to be positive\n"), 2;
  bool faster = compare("cornell", {320, 200, 128, 90}, target);
  if (const std::string data = test::data_folder(); !data.empty())
    faster = compare(data + "/scenes/staircase2/staircase2.glb", {256, 180, 128, 90}, target) && faster;
  return faster ? 0 : 1;
}
