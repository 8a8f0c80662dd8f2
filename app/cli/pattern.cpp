// etendue pattern: the points of a sampler and their quality.
#include <cmath>
#include <cstdio>
#include <memory>

#include "base/file.h"
#include "base/number_text.h"
#include "command.h"
#include "image/image.h"
#include "json.h"
#include "metrics/drawing.h"
#include "patterns/cube_discrepancy.h"
#include "patterns/pattern_drawing.h"
#include "patterns/pattern_report.h"
#include "patterns/sampler_points.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

struct PatternArguments {
  std::string sampler, out;
  std::vector<std::string> settings;
  std::vector<int> dimensions, intervals;
  int points = 64, repeats = 1;
  uint64_t seed = 0;
  bool json = false;
};

// The sets of all repeats, with different seeds.
Result<std::vector<patterns::CubePoints>> sets_of(const PatternArguments& a) {
  patterns::PointRequest request{.sampler = a.sampler, .count = static_cast<uint32_t>(a.points), .seed = a.seed};
  if (const SamplerInfo* info = find_sampler(a.sampler)) {
    const auto settings =
        parse_settings(a.settings, info->parameters, "the sampler '" + a.sampler + "'", "etendue list samplers");
    if (!settings) return settings.error();
    request.settings = *settings;
  }
  if (a.dimensions.size() == 1) return usage_error("--dimensions needs at least two dimensions, such as 0 1");
  if (!a.dimensions.empty()) request.dimensions.assign(a.dimensions.begin(), a.dimensions.end());
  std::vector<patterns::CubePoints> sets;
  for (int repeat = 0; repeat < a.repeats; ++repeat) {
    auto set = patterns::cube_points_of(request);
    if (!set) return set.error();
    sets.push_back(std::move(*set));
    ++request.seed;
  }
  return sets;
}

std::vector<patterns::PointSet> planes_of(const std::vector<patterns::CubePoints>& sets) {
  std::vector<patterns::PointSet> planes;
  for (const auto& set : sets) planes.push_back(patterns::first_two_dimensions(set));
  return planes;
}

// A column for each dimension: x, y, and x2, x3, ... for the others.
Result<void> write_points(const std::string& file, const patterns::CubePoints& set) {
  std::string text = "x,y";
  for (size_t k = 2; k < set.front().size(); ++k) text += ",x" + std::to_string(k);
  text += '\n';
  for (const auto& p : set)
    for (size_t k = 0; k < p.size(); ++k) {
      char number[32];
      std::snprintf(number, sizeof number, "%.9g%c", p[k], k + 1 < p.size() ? ',' : '\n');
      text += number;
    }
  return write_file(file, text.data(), text.size());
}

Result<void> write_pattern(const PatternArguments& a, const std::vector<patterns::CubePoints>& sets) {
  const std::filesystem::path file = a.out;
  if (file.extension() == ".csv") return write_points(a.out, sets.front());
  patterns::PatternDrawingOptions options;
  if (!a.intervals.empty()) options.cells = {a.intervals[0], a.intervals[1]};
  const metrics::Drawing drawing = patterns::pattern_drawing(planes_of(sets), options);
  if (file.extension() == ".svg") {
    const std::string svg = metrics::to_svg(drawing);
    return write_file(file, svg.data(), svg.size());
  }
  if (file.extension() == ".png")
    return image::write_png(file, drawing.width, drawing.height, metrics::rasterize(drawing));
  return usage_error(a.out + ": a pattern is written as .svg, .png or .csv; give a name with one of these endings");
}

int run_pattern(const PatternArguments& a) {
  const auto sets = sets_of(a);
  if (!sets) return fail(sets.error());
  const bool is_plane = sets->front().front().size() == 2;
  const auto report = is_plane ? patterns::report_of(planes_of(*sets)) : patterns::report_of(*sets);
  if (!a.out.empty())
    if (const auto written = write_pattern(a, *sets); !written) return fail(written.error());
  if (a.json) {
    json all = json::array();
    for (const auto& value : report)
      all.push_back({{"name", value.name},
                     {"mean", number_json(value.mean)},
                     {"standard_error", number_json(value.standard_error)}});
    std::printf("%s\n", all.dump(2).c_str());
    return 0;
  }
  std::printf("%s, %d points", a.sampler.c_str(), a.points);
  std::printf(a.repeats > 1 ? ", mean of %d sets\n" : "\n", a.repeats);
  for (const auto& value : report) {
    std::printf("  %-36s %.6g", value.name.c_str(), value.mean);
    if (a.repeats > 1) std::printf(" +- %.2g", value.standard_error);
    std::printf("\n");
  }
  return 0;
}

}  // namespace

Command pattern_command() {
  const auto a = std::make_shared<PatternArguments>();
  return {
      .name = "pattern",
      .summary = "Analyse the points of a sampler: discrepancy, distances, nets, errors of integrals, spectrum",
      .options =
          {{.names = "sampler", .target = &a->sampler, .doc = "A sampler; see etendue list samplers", .required = true},
           {.names = "--points",
            .target = &a->points,
            .doc = "Number of points. Default 64",
            .bounds = between(1, 65536)},
           {.names = "--dimensions",
            .target = &a->dimensions,
            .doc = "X Y...: two or more dimensions of a path, from 0. Default 0 1. Drawings show the first two",
            .bounds = kNonNegative},
           {.names = "--intervals",
            .target = &a->intervals,
            .doc = "COLUMNS ROWS of a grid that is drawn, such as 4 16",
            .bounds = between(1, 4096),
            .count = 2},
           {.names = "--repeats",
            .target = &a->repeats,
            .doc = "Number of pixels: the values are means over their sets. Default 1",
            .bounds = between(1, 10000)},
           {.names = "--set", .target = &a->settings, .doc = "NAME=VALUE: sets a parameter; may be repeated"},
           {.names = "-o,--out",
            .target = &a->out,
            .doc = "File: points and spectrum as .svg or .png, the points as .csv"},
           seed_option(a->seed),
           json_flag(a->json)},
      .run = [a] { return run_pattern(*a); }};
}

}  // namespace etendue::cli
