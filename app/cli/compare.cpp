// etendue compare: how far an image is from a reference.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "metrics/flip.h"
#include "metrics/heat_map.h"
#include "metrics/metrics.h"
#include "render/image_output.h"

namespace etendue::cli {
namespace {

struct Options {
  std::string image, reference, heatmap, heatmap_of = "absolute";
  bool json = false;
  double most_rmse = INFINITY, pixels_per_degree = metrics::kPixelsPerDegree;
};

// As the reference was shown; a file without settings is shown as it is.
metrics::ViewingConditions look_of(const image::LayeredImage& reference, double pixels_per_degree) {
  const auto state = reference.attributes.find(render::kStateAttribute);
  const auto display =
      state != reference.attributes.end() ? render::display_from_state(state->second) : render::Display();
  return {display.exposure, display.curve, pixels_per_degree};
}

metrics::HeatMap kind_of(const std::string& name) {
  const auto& kinds = etendue::Options<metrics::HeatMap>::kOptions;
  const auto found = std::ranges::find(kinds, name, &Option::name);
  return static_cast<metrics::HeatMap>(found - kinds.begin());
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const auto& kind : etendue::Options<metrics::HeatMap>::kOptions) names.emplace_back(kind.name);
  return names;
}

void print(const std::vector<std::pair<const char*, double>>& rows, bool as_json) {
  nlohmann::json j;
  for (const auto& [name, value] : rows) {
    j[name] = std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
    if (!as_json) std::printf("%-7s %.6g\n", name, value);
  }
  if (as_json) std::printf("%s\n", j.dump(2).c_str());
}

int run(const Options& o) {
  const auto picture = image::read_linear(o.image);
  if (!picture) return fail(picture.error());
  const auto reference = image::read_linear(o.reference);
  if (!reference) return fail(reference.error());
  const auto m = metrics::compare(*picture, *reference);
  if (!m) return fail(m.error());
  const auto flip = metrics::flip_map(*picture, *reference, look_of(*reference, o.pixels_per_degree));
  if (!flip) return fail(flip.error());
  if (!o.heatmap.empty()) {
    const auto kind = kind_of(o.heatmap_of);
    const auto map =
        kind == metrics::HeatMap::flip ? metrics::color_mapped(*flip) : metrics::heat_map(*picture, *reference, kind);
    if (auto ok = image::write_png(o.heatmap, picture->width, picture->height, map); !ok) return fail(ok.error());
  }
  print({{"mse", m->mse},
         {"rmse", m->rmse},
         {"relmse", m->relmse},
         {"mae", m->mae},
         {"smape", m->smape},
         {"psnr", m->psnr},
         {"bias", m->bias},
         {"flip", metrics::mean_of(*flip)}},
        o.json);
  return m->rmse <= o.most_rmse ? 0 : 1;
}

}  // namespace

Command add_compare(CLI::App& app) {
  auto o = std::make_shared<Options>();
  app.add_option("image", o->image, "The picture to judge")->required();
  app.add_option("reference", o->reference, "What it should be")->required();
  app.add_flag("--json", o->json, "Print JSON");
  app.add_option("--heatmap", o->heatmap, "Write where they differ, as .png");
  app.add_option("--heatmap-of", o->heatmap_of, "What the heat map shows")->check(CLI::IsMember(kind_names()));
  app.add_option("--pixels-per-degree", o->pixels_per_degree, "Of the eye's field, for FLIP")
      ->check(CLI::Range(1.0, 1000.0));
  app.add_option("--max-rmse", o->most_rmse, "Exit with 1 if the RMSE is above this");
  return [o] { return run(*o); };
}

}  // namespace etendue::cli
