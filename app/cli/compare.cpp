// etendue compare: error metrics of an image against a reference.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "base/json_text.h"
#include "command.h"
#include "json.h"
#include "metrics/flip.h"
#include "metrics/heat_map.h"
#include "metrics/low_pass.h"
#include "metrics/metrics.h"
#include "render/image_output.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

struct CompareArguments {
  std::string image, reference, heat_map, heat_map_metric = "absolute";
  bool json = false;
  double max_rmse = INFINITY, pixels_per_degree = metrics::kPixelsPerDegree, low_pass = 0;
};

// FLIP compares displayed images. The display settings are those that the reference carries, or the defaults.
metrics::ViewingConditions look_of(const image::LayeredImage& reference, double pixels_per_degree) {
  const auto state = reference.attributes.find(render::kStateAttribute);
  const auto display =
      state != reference.attributes.end() ? render::display_from_state(state->second) : render::Display();
  return {display.exposure, display.curve, pixels_per_degree};
}

metrics::HeatMap heat_map_of(const std::string& name) {
  const auto& options = Options<metrics::HeatMap>::kOptions;
  const auto found = std::ranges::find(options, name, &Option::name);
  return static_cast<metrics::HeatMap>(found - options.begin());
}

std::vector<std::string> heat_map_names() {
  std::vector<std::string> names;
  for (const auto& option : Options<metrics::HeatMap>::kOptions) names.emplace_back(option.name);
  return names;
}

using Rows = std::vector<std::pair<const char*, double>>;

// NaN stands for a value that is not available.
void print(const Rows& rows, bool as_json, bool equal) {
  json j;
  for (const auto& [name, value] : rows) {
    j[name] = number_json(value);
    if (as_json) continue;
    if (std::isnan(value))
      std::printf("%-9s n/a\n", name);
    else
      std::printf(name == std::string("bias") && value != 0 ? "%-9s %+.6g\n" : "%-9s %.6g\n", name, value);
  }
  j["equal"] = equal;
  if (as_json) std::printf("%s\n", json_text(j, 2).c_str());
  if (!as_json && equal) std::printf("the images are equal\n");
}

bool is_black_image(const image::LayeredImage& image) {
  return std::ranges::all_of(image.find("")->pixels, [](float v) { return v == 0; });
}

int run_compare(const CompareArguments& a) {
  auto image = image::read_linear(a.image);
  if (!image) return fail(image.error());
  auto reference = image::read_linear(a.reference);
  if (!reference) return fail(reference.error());
  if (a.low_pass > 0) {
    *image = metrics::low_passed(*image, a.low_pass);
    *reference = metrics::low_passed(*reference, a.low_pass);
  }
  const auto m = metrics::compare(*image, *reference);
  if (!m) return fail(m.error());
  const auto flip = metrics::flip_map(*image, *reference, look_of(*reference, a.pixels_per_degree));
  if (!flip) return fail(flip.error());
  if (!a.heat_map.empty()) {
    const auto metric = heat_map_of(a.heat_map_metric);
    const auto map =
        metric == metrics::HeatMap::flip ? metrics::color_mapped(*flip) : metrics::heat_map(*image, *reference, metric);
    if (auto ok = image::write_png(a.heat_map, image->width, image->height, map); !ok) return fail(ok.error());
  }
  const metrics::ViewingConditions look = look_of(*reference, a.pixels_per_degree);
  const double displayed = std::sqrt(metrics::displayed_mse(image->find("")->pixels, reference->find("")->pixels,
                                                            {look.exposure, look.curve}));
  Rows rows{{"mse", m->mse},
            {"rmse", m->rmse},
            {"relmse", m->relmse},
            {"relative", std::sqrt(m->relmse)},
            {"displayed", displayed},
            {"mae", m->mae},
            {"smape", m->smape},
            {"psnr", m->psnr},
            {"bias", m->bias},
            {"flip", metrics::mean_of(*flip)}};
  // Two images without any light do not agree about anything.
  const bool both_are_black = is_black_image(*image) && is_black_image(*reference);
  if (both_are_black) {
    for (auto& [name, value] : rows) value = NAN;
    std::fprintf(stderr, "etendue: both images are black; there is nothing to compare\n");
  }
  print(rows, a.json, m->mse == 0 && !both_are_black);
  if (both_are_black) return 1;
  return m->rmse <= a.max_rmse ? 0 : 1;
}

}  // namespace

Command compare_command() {
  const auto a = std::make_shared<CompareArguments>();
  return {.name = "compare",
          .summary = "Compute error metrics of an image against a reference",
          .options = {{.names = "image", .target = &a->image, .doc = "The image", .required = true},
                      {.names = "reference", .target = &a->reference, .doc = "The reference image", .required = true},
                      json_flag(a->json),
                      {.names = "--heatmap", .target = &a->heat_map, .doc = "Write a map of the differences, a .png"},
                      {.names = "--heatmap-of",
                       .target = &a->heat_map_metric,
                       .doc = "Metric of the heat map (absolute)",
                       .choices = heat_map_names()},
                      {.names = "--pixels-per-degree",
                       .target = &a->pixels_per_degree,
                       .doc = "Resolution of the display for FLIP, in pixels per degree of visual angle",
                       .bounds = between(1, 1000)},
                      {.names = "--low-pass",
                       .target = &a->low_pass,
                       .doc = "Compare after a Gaussian filter of this standard deviation, in pixels: the error that is "
                              "seen from a distance. 0: no filter",
                       .bounds = between(0, 100)},
                      {.names = "--max-rmse",
                       .target = &a->max_rmse,
                       .doc = "Exit with code 1 if the RMSE exceeds this value"}},
          .run = [a] { return run_compare(*a); }};
}

}  // namespace etendue::cli
