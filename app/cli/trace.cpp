// etendue trace: one sample of a pixel, as the integrator computed it.
#include <charconv>
#include <cstdio>
#include <memory>

#include "base/file.h"
#include "base/json_text.h"
#include "command.h"
#include "image/display.h"
#include "image/image.h"
#include "json.h"
#include "render/pixel_trace.h"
#include "scene/compiled_scene.h"
#include "scene_options.h"
#include "trace/trace_drawing.h"
#include "trace/trace_json.h"
#include "trace/trace_text.h"

namespace etendue::cli {
namespace {

struct TraceArguments {
  SceneArguments scene;
  std::string pixel, svg, background;
  uint32_t sample = 0;
  int64_t seed = -1;
  bool json = false;
};

// The pixel in a text like "320,240"; without a text the centre of the image.
Result<Vec2i> parse_pixel(const std::string& text, const render::Document& document) {
  if (text.empty()) return Vec2i(document.width / 2, document.height / 2);
  Vec2i pixel(0);
  const char* const end = text.data() + text.size();
  const auto x = std::from_chars(text.data(), end, pixel.x);
  if (x.ec == std::errc() && x.ptr != end && *x.ptr == ',') {
    const auto y = std::from_chars(x.ptr + 1, end, pixel.y);
    if (y.ec == std::errc() && y.ptr == end) return pixel;
  }
  return usage_error("--pixel: '" + text + "' is not a pixel; give X,Y, for example 320,240");
}

// Writes the paths over the background, if there is one.
Result<void> write_figure(const TraceArguments& a, const render::PixelTrace& trace, const render::Document& document) {
  const Vec2i size(document.width, document.height);
  std::vector<std::byte> png;
  if (!a.background.empty()) {
    const auto picture = image::read_linear(a.background);
    if (!picture) return picture.error();
    if (Vec2i(picture->width, picture->height) != size)
      return usage_error(a.background + ": the image has " + std::to_string(picture->width) + "x" +
                         std::to_string(picture->height) + " pixels; give one with " + std::to_string(size.x) + "x" +
                         std::to_string(size.y) + " pixels");
    const auto& display = document.display;
    auto encoded = image::encode_png(size.x, size.y,
                                     image::display_pixels(picture->layers[0].pixels, display.exposure, display.curve));
    if (!encoded) return encoded.error();
    png = std::move(*encoded);
  }
  const std::string svg = trace::path_figure(trace, document.camera, size, png);
  return write_file(a.svg, svg.data(), svg.size());
}

int run_trace(const TraceArguments& a) {
  auto document = open_document(a.scene);
  if (!document) return fail(document.error());
  if (a.seed >= 0) document->seed = static_cast<uint64_t>(a.seed);
  const auto pixel = parse_pixel(a.pixel, *document);
  if (!pixel) return fail(pixel.error());
  const auto scene = scene::compile(document->scene, document->camera, nullptr);
  const auto trace = render::trace_pixel(*document, scene, *pixel, a.sample);
  if (!trace) return fail(trace.error());
  if (!a.svg.empty())
    if (const auto written = write_figure(a, *trace, *document); !written) return fail(written.error());
  if (a.json)
    std::printf("%s\n", json_text(trace::to_json(*trace), 2).c_str());
  else
    std::fputs(trace::to_text(*trace).c_str(), stdout);
  return 0;
}

}  // namespace

Command trace_command() {
  const auto a = std::make_shared<TraceArguments>();
  return {
      .name = "trace",
      .summary = "Show one sample of a pixel: vertices, densities, weights and contributions",
      .options = {scene_option(a->scene.scene),
                  {.names = "--pixel", .target = &a->pixel, .doc = "X,Y from the upper left corner; default: centre"},
                  {.names = "--sample", .target = &a->sample, .doc = "Index of the sample, from 0"},
                  size_option(a->scene.size),
                  camera_option(a->scene.camera),
                  set_option(a->scene.settings),
                  environment_option(a->scene.environment),
                  paths_option(a->scene.paths),
                  seed_option(a->seed),
                  {.names = "--svg", .target = &a->svg, .doc = "Draw the paths as seen by the camera to this file"},
                  {.names = "--background",
                   .target = &a->background,
                   .doc = "Image of the same size to draw the paths over",
                   .needs = "--svg"},
                  json_flag(a->json)},
      .run = [a] { return run_trace(*a); }};
}

}  // namespace etendue::cli
