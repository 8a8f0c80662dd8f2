// Convergence rate: the slope of the error over the number of samples, and its limit for biased estimators.
//
// The slope of log RMSE over log samples is fitted for `path` with random numbers, where theory predicts -1/2, and with
// Sobol' points, where it is steeper for smoother integrands. Five repeats with different seeds are compared with a
// reference, whose own error is subtracted. Where the distribution of samples has a heavy tail (khat), the variance is
// infinite or nearly so, and theory predicts no slope.
//
// A second test renders a furnace of albedo a = 1/2 with paths cut after d edges. The Neumann series E (1 + a + ... +
// a^(d-1)) differs from E / (1 - a) by a^d / (1 - a), where the error curve becomes flat. The reference is the closed
// form.
//
//   slopes_bench [FILE.svg]   writes the chart of the furnace to FILE.svg
#include <cmath>
#include <cstdio>

#include "base/file.h"
#include "bench/benchmark.h"
#include "bench/summary.h"
#include "metrics/convergence_chart.h"
#include "support/scenes.h"

namespace etendue {
namespace {

constexpr int kRepeats = 5;
constexpr double kReferenceSeconds = 20;

bool never_stop(double, const std::string&) { return true; }

std::string with_error(const metrics::Estimate& f) {
  char text[48];
  std::snprintf(text, sizeof text, "%.3f +- %.3f", f.value, f.standard_error);
  return text;
}

void slopes(render::Session& session, const char* name, const std::string& file, uint32_t samples) {
  auto document = render::new_document(file);
  if (!document) return;
  document->width = 128;
  document->height = 96;
  const auto methods = bench::parse_methods("path:sampler=random,path:sampler=sobol", *document);
  const auto reference = bench::render_reference(session, *document, {kReferenceSeconds, 0}, {}, never_stop);
  const bench::Plan plan{*methods, 0, samples, kRepeats, 0};
  const auto outcome = bench::run(session, plan, reference, never_stop);
  const auto random = bench::summary_of(outcome.methods[0], reference, {});
  const auto sobol = bench::summary_of(outcome.methods[1], reference, {});
  std::printf("%-14s %8u %18s %18s %8.2f%-8s %6.1f\n", name, samples, with_error(random.slope_over_samples).c_str(),
              with_error(sobol.slope_over_samples).c_str(), random.khat.value_or(NAN),
              random.has_heavy_tail ? " heavy" : "", random.rmse / reference.standard_error());
  std::fflush(stdout);
}

// A reference image with constant radiance and no error.
bench::Reference constant(double radiance, int size) {
  bench::Reference reference;
  const auto count = static_cast<size_t>(size) * static_cast<size_t>(size) * 3;
  reference.image.width = reference.image.height = size;
  reference.image.layers.push_back({"", {"R", "G", "B"}, std::vector<float>(count, static_cast<float>(radiance))});
  reference.noise = metrics::ReferenceNoise{};
  return reference;
}

int biases(render::Session& session, const char* chart) {
  constexpr int kSize = 48;
  constexpr double kAlbedo = 0.5;
  const auto d = test::document(test::furnace(static_cast<float>(kAlbedo)),
                                look_at({0.3f, 0.1f, 0}, {0, 0, 1}, {0, 1, 0}, 1), kSize, kSize);
  const auto reference = constant(1 / (1 - kAlbedo), kSize);
  std::string names = "path:sampler=random";
  for (const char* depth : {"6", "4", "2"}) names += std::string(",path:sampler=random:max-depth=") + depth;
  const bench::Plan plan{*bench::parse_methods(names, d), 0, 1024, kRepeats, 0};
  const auto outcome = bench::run(session, plan, reference, never_stop);
  std::printf("\n%-32s %24s %10s %10s\n", "furnace of albedo 1/2", "bias", "theory", "last RMSE");
  const double depths[] = {INFINITY, 6, 4, 2};
  for (size_t i = 0; i < outcome.methods.size(); ++i) {
    const auto summary = bench::summary_of(outcome.methods[i], reference, {});
    std::printf("%-32s %14.6f +- %.6f %10.6f %10.6f\n", summary.name.c_str(), summary.bias.value,
                summary.bias.standard_error, -std::pow(kAlbedo, depths[i]) / (1 - kAlbedo), summary.rmse);
  }
  if (!chart) return 0;
  const metrics::ChartOptions options{"A furnace, paths cut after 6, 4 and 2 edges", metrics::Abscissa::samples};
  const std::string svg =
      metrics::to_svg(metrics::convergence_chart(bench::corrected_curves(outcome, reference), options));
  return write_file(chart, svg.data(), svg.size()) ? 0 : 4;
}

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) {
  using namespace etendue;
  render::Session session({});
  std::printf("%-14s %8s %18s %18s %16s %6s\n", "scene", "samples", "random", "sobol", "khat", "error");
  slopes(session, "cornell", "cornell", 64);
  if (const std::string data = test::data_folder(); !data.empty()) {
    slopes(session, "cornell-box", data + "/scenes/cornell-box/cornell-box.glb", 64);
    slopes(session, "staircase2", data + "/scenes/staircase2/staircase2.glb", 32);
    slopes(session, "veach-bidir", data + "/scenes/veach-bidir/veach-bidir.glb", 32);
    slopes(session, "ToyCar", data + "/gltf/ToyCar/glTF/ToyCar.gltf", 64);
    slopes(session, "Duck", data + "/gltf/Duck.glb", 64);
    slopes(session, "Avocado", data + "/gltf/Avocado/glTF/Avocado.gltf", 64);
  }
  return biases(session, argc > 1 ? argv[1] : nullptr);
}
