// The largest eigenvalue of light transport by paths: the ratio of successive bounces
//
// The light that a camera sees after n reflections is <W, T^n L_e>, where T is the transport operator. The ratio of
// successive terms is a power iteration: it approaches the largest eigenvalue of T among the distributions of light that the
// emitters reach and the camera sees. Path tracing records all terms in one rendering (bounce layers).
//
// In a closed cube of albedo rho that emits everywhere, every ratio is rho. In other scenes the ratios are compared with those of
// matrices of form factors between patches (transport-operators), whose error is that of the mesh.
#include <algorithm>
#include <cmath>

#include "experiments/error_curves.h"
#include "experiments/moments.h"
#include "experiments/operator_model.h"
#include "render/light_path_layers.h"
#include "scene/compiled_scene.h"

namespace etendue::experiments {
namespace {

using equations::Vector;

constexpr int kRepeats = 16;           // renderings, for the standard error
constexpr double kMeshError = 0.02;    // of ratios by matrices
constexpr double kShareOfPaths = 0.5;  // of the time

struct PowerIteration {
  static constexpr ExperimentDescription kDescription{
      .name = "power-iteration",
      .label = "Power iteration by paths",
      .summary = "The largest eigenvalue of light transport from the ratio of successive bounces",
      .source = "[Lang, sec. 2.3, 5.2]"};

  Text scene{"scene",
             "Scene",
             "furnace",
             "Diffuse scene: furnace, a built-in scene, or a .gltf or .glb file",
             check_operator_scene,
             {{"furnace", "Closed cube"}, {"cornell", "Cornell box"}}};
  Number<float> albedo{"albedo", "Albedo", 0.75f, {0.05f, 0.95f}, "Albedo of the furnace"};
  Number<int> bounces{"bounces", "Bounces", 8, {2, 30}, "Number of reflections"};
  Number<int> samples{"samples", "Samples",         64, {4, 4096}, "Paths per pixel of each of 16 renderings",
                      "",        Scale::logarithmic};
  Number<int> patches{"patches", "Patches", 200, {20, 600}, "Approximate number of patches of the matrices"};

  auto parameters() { return std::tie(scene, albedo, bounces, samples, patches); }

  Result<ExperimentResult> run(const RunContext& context) const {
    const auto given = operator_scene(scene, static_cast<double>(albedo));
    if (!given) return given.error();
    auto model = OperatorModel::make(*given, patches);
    if (!model) return model.error();
    if (auto ok =
            model->build({.seed = context.seed,
                          .progress = [&](double share) { return context.proceed((1 - kShareOfPaths) * share); }});
        !ok)
      return ok.error();
    const auto terms = measure_terms(*given, context);
    if (!terms) return terms.error();
    return result_of(*model, *terms);
  }

 private:
  // The mean of each bounce over the image, by rendering.
  Result<std::vector<Vector>> measure_terms(const OperatorScene& given, const RunContext& context) const {
    render::Document document;
    document.scene = given.scene;
    document.camera = given.camera;
    document.width = document.height = kViewSize;
    document.method.integrator = "path";
    document.method.sampler = "random";
    const auto compiled = scene::compile(given.scene, given.camera, nullptr);
    const std::vector<std::string> names{"bounces:" + std::to_string(bounces + 1)};
    std::vector<Vector> terms;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
      if (!context.proceed(1 - kShareOfPaths + kShareOfPaths * repeat / kRepeats)) return interrupted();
      document.seed = context.seed * kRepeats + static_cast<uint64_t>(repeat);
      const auto layers =
          render::render_light_path_layers(compiled, document, names, static_cast<uint32_t>(samples), 0);
      if (layers.empty()) return input_error("the scene cannot be rendered by path tracing");
      Vector means;
      for (int n = 0; n <= bounces; ++n) {
        const auto& pixels = layers[static_cast<size_t>(n)].pixels;
        double sum = 0;
        for (size_t i = 1; i < pixels.size(); i += 3) sum += double{pixels[i]};  // green, as in the matrices
        means.push_back(sum / (static_cast<double>(pixels.size()) / 3));
      }
      terms.push_back(std::move(means));
    }
    return terms;
  }

  ExperimentResult result_of(const OperatorModel& model, const std::vector<Vector>& terms) const {
    ExperimentResult result;
    const auto& t = model.matrices();
    const Vector importance = model.camera_importance();
    // Light that is not emitted by surfaces has one reflection already.
    const int offset = model.has_external_lights() ? 1 : 0;
    Vector of_matrices;
    for (const Vector& term : equations::neumann_terms(t, model.emitted(), bounces + 1))
      of_matrices.push_back(equations::inner_product(t, importance, term));
    metrics::FunctionCurve paths{.name = "paths", .points = {}},
        matrices{.name = "matrices", .style = metrics::CurveStyle::dashed, .points = {}};
    result.table.columns = {"bounce", "mean radiance", "ratio", "standard error", "ratio of matrices"};
    const bool is_furnace = scene.value == kFurnaceScene;
    for (int n = 1 + offset; n <= bounces; ++n) {
      const auto now = static_cast<size_t>(n);
      Moments before, after, ratio;
      for (const Vector& repeat : terms) {
        before.add(repeat[now - 1]);
        after.add(repeat[now]);
        if (repeat[now - 1] > 0) ratio.add(repeat[now] / repeat[now - 1]);
      }
      const double measured = after.mean() / before.mean();
      const auto k = static_cast<size_t>(n - offset);
      const double expected = is_furnace ? static_cast<double>(albedo) : of_matrices[k] / of_matrices[k - 1];
      result.table.rows.push_back({static_cast<double>(n), after.mean(), measured, ratio.mean_error(), expected});
      paths.points.push_back({static_cast<double>(n), measured});
      matrices.points.push_back({static_cast<double>(n), expected});
      // The first bounce depends on the visibility of the light within patches.
      if (n == 1 && !is_furnace) continue;
      result.checks.push_back({"ratio of bounce " + std::to_string(n), measured, expected,
                               kStandardErrors * ratio.mean_error() + (is_furnace ? 1e-5 : kMeshError) * expected});
    }
    const double radius = equations::transport_norms(t).spectral_radius;
    result.table.rows.push_back({std::string("spectral radius of the matrices"), NAN, radius, NAN, radius});
    if (is_furnace)
      result.checks.push_back({"spectral radius of the matrices", radius, static_cast<double>(albedo), 1e-4});
    else
      result.notes.push_back(
          "The spectral radius belongs to all of the scene, including cavities that no light reaches.");
    result.charts.push_back(metrics::FunctionChart{
        .title = "Ratio of successive bounces", .x_label = "bounce", .y_label = "ratio", .curves = {paths, matrices}});
    return result;
  }
};

}  // namespace

Experiment power_iteration_experiment() { return make_experiment<PowerIteration>(); }

}  // namespace etendue::experiments
