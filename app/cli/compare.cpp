// etendue compare: how far an image is from a reference.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "measure/metrics.h"

namespace etendue::cli {
namespace {

struct Options {
  std::string image, reference, heatmap;
  bool json = false;
  double most_rmse = INFINITY;
};

int run(const Options& o) {
  const auto picture = image::read_linear(o.image);
  if (!picture) return fail(picture.error());
  const auto reference = image::read_linear(o.reference);
  if (!reference) return fail(reference.error());
  const auto m = measure::compare(*picture, *reference);
  if (!m) return fail(m.error());
  if (!o.heatmap.empty())
    if (auto ok = image::write_png(o.heatmap, picture->width, picture->height, measure::heat_map(*picture, *reference));
        !ok)
      return fail(ok.error());
  const std::pair<const char*, double> rows[] = {{"mse", m->mse},  {"rmse", m->rmse},   {"relmse", m->relmse},
                                                 {"mae", m->mae},  {"smape", m->smape}, {"psnr", m->psnr},
                                                 {"bias", m->bias}};
  if (o.json) {
    nlohmann::json j;
    for (const auto& [name, value] : rows) j[name] = std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
    j["flip"] = nullptr;
    std::printf("%s\n", j.dump(2).c_str());
  } else {
    for (const auto& [name, value] : rows) std::printf("%-7s %.6g\n", name, value);
  }
  return m->rmse <= o.most_rmse ? 0 : 1;
}

}  // namespace

Command add_compare(CLI::App& app) {
  auto o = std::make_shared<Options>();
  app.add_option("image", o->image, "The picture to judge")->required();
  app.add_option("reference", o->reference, "What it should be")->required();
  app.add_flag("--json", o->json, "Print JSON");
  app.add_option("--heatmap", o->heatmap, "Write where they differ, as .png");
  app.add_option("--max-rmse", o->most_rmse, "Exit with 1 if the RMSE is above this");
  return [o] { return run(*o); };
}

}  // namespace etendue::cli
