// etendue radiosity: the mesh, the form factors and the solvers of the radiosity equation of a scene.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <optional>

#include "base/file.h"
#include "base/json_text.h"
#include "command.h"
#include "interrupt.h"
#include "json.h"
#include "metrics/function_chart.h"
#include "radiosity/mesh_refinement.h"
#include "radiosity/parameters.h"
#include "radiosity/reflectance.h"
#include "radiosity_links.h"
#include "render/document.h"
#include "render/thread_pool.h"
#include "scene/compiled_scene.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

struct RadiosityArguments {
  SceneArguments scene;
  std::string solver;
  uint64_t seed = 0;
  int threads = 0, sweeps = 1000;
  std::string chart, chart_axis = "sweeps", patches;
  double link_error = 0;  // of hierarchical form factors; 0: none
  bool json = false;
};

using radiosity::PatchMesh;
using radiosity::SolverKind;

double elapsed_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The scene with everything that its solvers need.
struct Prepared {
  PatchMesh mesh;
  std::vector<Rgb> reflectance;
  std::shared_ptr<const radiosity::FormFactors> factors;
  std::vector<Rgb> direct;
  uint64_t rays = 0;
  double seconds = 0;  // of form factors and direct light
};

// One solver's solution of the colour component with the largest source.
struct SolverRun {
  std::string name;
  radiosity::Solution solution;
  double seconds = 0;
  double difference = 0;  // the largest difference to the reference, relative to its largest radiosity
};

// The reduction of the residual per sweep, over the second half of the sweeps.
double reduction_per_sweep(const std::vector<double>& residuals) {
  const size_t last = residuals.size() - 1, first = last / 2;
  if (last == first || !(residuals[first] > 0)) return 0;
  return std::pow(residuals[last] / residuals[first], 1.0 / static_cast<double>(last - first));
}

Result<radiosity::Parameters> parameters_of(const render::Document& document, const std::string& solver) {
  radiosity::Parameters parameters;
  const auto members = parameters.solution_parameters();
  for (const Setting& setting : document.method.settings_of("radiosity"))
    assign_by_name(members, setting.name, setting.value);
  if (solver.empty() || solver == "all") return parameters;
  const auto value = parse_value(describe(parameters.solver), solver);
  if (!value) return usage_error("--solver: " + value.error().message + ", or all");
  assign(parameters.solver, *value);
  return parameters;
}

Result<void> check(const scene::CompiledScene& scene, const radiosity::Parameters& parameters, const std::string& name,
                   double link_error) {
  if (!scene.solids().empty())
    return input_error(name + ": radiosity does not support media between surfaces; give a scene without them");
  if (const std::string reason = radiosity::too_many_patches(scene, parameters, 1); !reason.empty())
    return input_error(name + ": " + reason);
  if (link_error > 0 && parameters.meshing != radiosity::Meshing::quadtree)
    return usage_error(
        "--links needs a mesh whose triangles are divided into quadtrees: give "
        "--set radiosity.meshing=quadtree");
  if (radiosity::count_patches(scene, parameters.mesh_settings()) == 0)
    return input_error(name + ": the scene has no triangles with an area; give one with surfaces");
  return {};
}

// False if it was interrupted.
bool prepare(const scene::CompiledScene& scene, const radiosity::Parameters& parameters,
             const radiosity::SamplerChoice& sampler, const RadiosityArguments& a, Prepared& prepared) {
  const std::atomic<bool>& interrupted = watch_interrupts();
  prepared.mesh = radiosity::complete_mesh(scene, parameters.mesh_settings(), a.seed);
  prepared.reflectance = radiosity::patch_reflectances(scene, prepared.mesh);
  const auto start = std::chrono::steady_clock::now();
  radiosity::SceneSolution solution(parameters.plan(a.seed, sampler), prepared.mesh.element_count());
  const std::function<bool()> keep_going = [&] { return !interrupted; };
  render::ThreadPool workers(a.threads);
  std::atomic<uint64_t> rays{0};
  // The last stage solves for all colour components. The solvers are run and compared one by one instead.
  const auto stages = solution.stages();
  for (size_t stage = 0; stage + 1 < stages.size(); ++stage) {
    workers.run(
        0, stages[stage].tasks,
        [&](int task) {
          prepare_thread_for_rays();
          rays += solution.run_stage(scene, prepared.mesh, stage, task, &keep_going).value_or(0);
        },
        keep_going);
    if (interrupted) return false;
    solution.complete_stage(prepared.mesh, prepared.reflectance, stage);
  }
  prepared.rays = rays;
  prepared.seconds = elapsed_since(start);
  prepared.factors = solution.factors();
  prepared.direct = solution.direct();
  return true;
}

// The colour component with the most direct light.
int brightest_component(const std::vector<Rgb>& direct) {
  const Rgb sum = std::accumulate(direct.begin(), direct.end(), Rgb(0));
  return sum.r >= sum.g && sum.r >= sum.b ? 0 : sum.g >= sum.b ? 1 : 2;
}

SolverRun run_solver(SolverKind kind, const radiosity::RadiositySystem& system,
                     const radiosity::SolverSettings& settings) {
  const auto start = std::chrono::steady_clock::now();
  SolverRun run{.name = Options<SolverKind>::kOptions[static_cast<size_t>(kind)].name,
                .solution = radiosity::solve(kind, system, settings)};
  run.seconds = elapsed_since(start);
  return run;
}

// The residuals of all solvers over the sweeps or over the time.
Result<void> write_chart(const std::string& scene, const std::vector<SolverRun>& runs, const RadiosityArguments& a) {
  const bool by_time = a.chart_axis == "seconds";
  metrics::FunctionChart chart{.title = "Residual of radiosity solvers, " + scene,
                               .x_label = by_time ? "seconds" : "sweeps",
                               .y_label = "residual, relative to the largest source",
                               .curves = {},
                               .logarithmic_y = true};
  for (const SolverRun& run : runs) {
    metrics::FunctionCurve curve{.name = run.name, .points = {}};
    for (size_t n = 0; n < run.solution.residuals.size(); ++n)
      curve.points.push_back({by_time ? run.solution.seconds[n] : static_cast<double>(n), run.solution.residuals[n]});
    chart.curves.push_back(std::move(curve));
  }
  const std::string svg = metrics::to_svg(metrics::function_drawing(chart, {}));
  return write_file(a.chart, svg.data(), svg.size());
}

// A line per side of a patch that sees another one: its place, its form factors, and the most accurate solution of the
// colour component with the most light.
Result<void> write_patches(const Prepared& p, const std::vector<SolverRun>& runs, const RadiosityArguments& a) {
  const auto best = std::ranges::min_element(runs, {}, [](const SolverRun& run) { return run.solution.error_bound; });
  const auto system =
      radiosity::reflected_light_system(*p.factors, p.reflectance, p.direct, brightest_component(p.direct));
  std::string text = "patch,side,x,y,z,area,closure,asymmetry,radiosity,unshot\n";
  for (uint32_t e = 0; e < p.mesh.element_count(); ++e) {
    if (p.factors->exchanges(e).empty()) continue;
    const radiosity::Patch& patch = p.mesh.patch_of(e);
    const Vec3 centre = patch.point(Vec2(1.0f / 3));
    const auto& quality = p.factors->row_quality()[e];
    char line[240];
    std::snprintf(line, sizeof line, "%u,%s,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", e / 2,
                  PatchMesh::is_front(e) ? "front" : "back", static_cast<double>(centre.x),
                  static_cast<double>(centre.y), static_cast<double>(centre.z), static_cast<double>(patch.area),
                  static_cast<double>(quality.closure), static_cast<double>(quality.asymmetry),
                  best->solution.radiosity[e], system.residual_at(e, best->solution.radiosity));
    text += line;
  }
  return write_file(a.patches, text.data(), text.size());
}

// All solvers, or the selected one. Differences refer to the solution with the smallest error bound.
std::vector<SolverRun> run_solvers(const Prepared& prepared, const radiosity::Parameters& parameters,
                                   const RadiosityArguments& a) {
  const auto system = radiosity::reflected_light_system(*prepared.factors, prepared.reflectance, prepared.direct,
                                                        brightest_component(prepared.direct));
  radiosity::SolverSettings settings = parameters.solver_settings();
  settings.max_sweeps = a.sweeps;
  std::vector<SolverRun> runs;
  const size_t count = Options<SolverKind>::kOptions.size();
  for (size_t k = 0; k < count; ++k)
    if (a.solver == "all" || static_cast<SolverKind>(k) == parameters.solver)
      runs.push_back(run_solver(static_cast<SolverKind>(k), system, settings));
  const auto best = std::ranges::min_element(runs, {}, [](const SolverRun& run) {
    return run.solution.problem.empty() ? run.solution.error_bound : HUGE_VAL;
  });
  const std::vector<double>& reference = best->solution.radiosity;
  double scale = 0;
  for (const double b : reference) scale = std::max(scale, std::abs(b));
  for (SolverRun& run : runs) {
    for (size_t i = 0; i < reference.size(); ++i)
      run.difference = std::max(run.difference, std::abs(run.solution.radiosity[i] - reference[i]));
    run.difference = scale > 0 ? run.difference / scale : 0;
  }
  return runs;
}

const char* status_name(radiosity::SolverStatus status) {
  return status == radiosity::SolverStatus::converged  ? "converged"
         : status == radiosity::SolverStatus::diverged ? "diverged"
                                                       : "unfinished";
}

json solver_json(const SolverRun& run) {
  json residuals = json::array(), seconds = json::array();
  for (const double s : run.solution.seconds) seconds.push_back(s);
  for (const double r : run.solution.residuals) residuals.push_back(number_json(r));
  return {{"solver", run.name},
          {"status", status_name(run.solution.status)},
          {"problem", run.solution.problem},
          {"sweeps", run.solution.residuals.size() - 1},
          {"residuals", residuals},
          {"seconds_of_sweeps", seconds},
          {"reduction_per_sweep", number_json(reduction_per_sweep(run.solution.residuals))},
          {"error_bound", number_json(run.solution.error_bound)},
          {"difference", number_json(run.difference)},
          {"seconds", run.seconds}};
}

json report_json(const std::string& name, const Prepared& p, const std::vector<SolverRun>& runs,
                 const std::optional<HierarchyRun>& hierarchy) {
  const radiosity::MeshQuality& mesh = p.mesh.quality();
  const radiosity::FormFactors::Quality& factors = p.factors->quality();
  json solvers = json::array();
  for (const SolverRun& run : runs) solvers.push_back(solver_json(run));
  return {
      {"scene", name},
      {"patches", p.mesh.patches().size()},
      {"elements", p.mesh.element_count()},
      {"triangles", mesh.triangles},
      {"dropped_triangles", mesh.degenerate},
      {"analytic_shapes", mesh.shapes},
      {"slivers", mesh.slivers},
      {"area", mesh.area},
      {"smallest_patch", mesh.smallest},
      {"largest_patch", mesh.largest},
      {"longest_edge", mesh.longest_edge},
      {"closure", {{"mean", factors.mean_closure}, {"least", factors.least_closure}, {"most", factors.most_closure}}},
      {"asymmetry", factors.asymmetry},
      {"scaling_error", factors.scaling_error},
      {"form_factor_bytes", p.factors->memory()},
      {"rays", p.rays},
      {"seconds", p.seconds},
      {"solvers", solvers},
      {"hierarchy", hierarchy ? hierarchy_json(*hierarchy) : json()}};
}

void print(const Prepared& p, const std::vector<SolverRun>& runs) {
  const radiosity::MeshQuality& mesh = p.mesh.quality();
  const radiosity::FormFactors::Quality& factors = p.factors->quality();
  std::printf("mesh           %zu patches of %zu triangles, %.3g to %.3g m^2, edges up to %.3g m\n",
              p.mesh.patches().size(), mesh.triangles, mesh.smallest, mesh.largest, mesh.longest_edge);
  if (mesh.degenerate > 0) std::printf("               %zu triangles without area are left out\n", mesh.degenerate);
  if (mesh.shapes > 0)
    std::printf("               %zu spheres, disks or cylinders of lights absorb the light that they receive\n",
                mesh.shapes);
  if (mesh.slivers > 0) std::printf("               %zu patches are slivers\n", mesh.slivers);
  std::printf("form factors   %.1f MiB, %.3g rays, %.2f s\n", static_cast<double>(p.factors->memory()) / (1 << 20),
              static_cast<double>(p.rays), p.seconds);
  std::printf("closure        %.6f on average, %.6f to %.6f\n", factors.mean_closure, factors.least_closure,
              factors.most_closure);
  std::printf("reciprocity    %.3g relative difference of both estimates before symmetrization\n", factors.asymmetry);
  std::printf("solver         sweeps  residual  per sweep  error bound  difference  seconds\n");
  for (const SolverRun& run : runs)
    std::printf("  %-12s %6zu  %8.2g  %9.4f  %11.2g  %10.2g  %7.3f\n", run.name.c_str(),
                run.solution.residuals.size() - 1, run.solution.residuals.back(),
                reduction_per_sweep(run.solution.residuals), run.solution.error_bound, run.difference, run.seconds);
  if (runs.size() == 1) {
    std::printf("residuals     ");
    for (const double r : runs[0].solution.residuals) std::printf(" %.3g", r);
    std::printf("\n");
  }
}

int run_radiosity(const RadiosityArguments& a) {
  const auto document = open_document(a.scene);
  if (!document) return fail(document.error());
  const auto parameters = parameters_of(*document, a.solver);
  if (!parameters) return fail(parameters.error());
  const auto scene = scene::compile(document->scene, document->camera, nullptr);
  if (const auto ok = check(*scene, *parameters, a.scene.scene, a.link_error); !ok) return fail(ok.error());
  if (const std::string name = radiosity::non_diffuse_material(*scene); !name.empty())
    std::fprintf(stderr, "etendue: %s: %s is not diffuse; all surfaces are taken as diffuse with their base colour\n",
                 a.scene.scene.c_str(), name.c_str());
  if (scene->lights().empty())
    std::fprintf(stderr, "etendue: %s: the scene has no light, so the radiosity is zero\n", a.scene.scene.c_str());
  Prepared prepared;
  const radiosity::SamplerChoice sampler{document->method.sampler,
                                         document->method.settings_of(document->method.sampler)};
  if (!prepare(*scene, *parameters, sampler, a, prepared)) return static_cast<int>(Fault::interrupted);
  const std::vector<SolverRun> runs = run_solvers(prepared, *parameters, a);
  std::optional<HierarchyRun> hierarchy;
  if (a.link_error > 0) {
    hierarchy = run_hierarchy({*scene, prepared.mesh, prepared.reflectance, prepared.direct, *prepared.factors,
                               parameters->solver_settings()},
                              {.error = a.link_error, .seed = a.seed}, a.threads);
    if (!hierarchy) return static_cast<int>(Fault::interrupted);
  }
  if (a.json) {
    std::printf("%s\n", json_text(report_json(document->scene_name, prepared, runs, hierarchy), 2).c_str());
  } else {
    print(prepared, runs);
    if (hierarchy) print(*hierarchy);
  }
  if (!a.chart.empty())
    if (const auto written = write_chart(document->scene_name, runs, a); !written) return fail(written.error());
  if (!a.patches.empty())
    if (const auto written = write_patches(prepared, runs, a); !written) return fail(written.error());
  bool all_converged = true;
  for (const SolverRun& run : runs) {
    if (!run.solution.problem.empty())
      std::fprintf(stderr, "etendue: %s: %s\n", run.name.c_str(), run.solution.problem.c_str());
    all_converged = all_converged && run.solution.status == radiosity::SolverStatus::converged;
  }
  return all_converged ? 0 : 1;
}

}  // namespace

Command radiosity_command() {
  const auto a = std::make_shared<RadiosityArguments>();
  return {.name = "radiosity",
          .summary = "Form factors of a scene and the convergence of radiosity solvers",
          .options = {scene_option(a->scene.scene),
                      {.names = "--solver",
                       .target = &a->solver,
                       .doc = "A solver, or all to compare them; the default is radiosity.solver"},
                      {.names = "--sweeps",
                       .target = &a->sweeps,
                       .doc = "Largest number of sweeps of a solver (1000)",
                       .bounds = kPositive},
                      {.names = "--chart",
                       .target = &a->chart,
                       .doc = "Write the residuals of the solvers as a chart, an SVG file"},
                      {.names = "--chart-axis",
                       .target = &a->chart_axis,
                       .doc = "What the chart counts: sweeps (default) or seconds of solving",
                       .choices = {"sweeps", "seconds"}},
                      {.names = "--links",
                       .target = &a->link_error,
                       .doc = "Also compute hierarchical form factors, with links of at most this form factor",
                       .bounds = kPositive},
                      {.names = "--patches",
                       .target = &a->patches,
                       .doc = "Write closure, reciprocity and radiosity of all patch sides, a CSV file"},
                      set_option(a->scene.settings),
                      environment_option(a->scene.environment),
                      seed_option(a->seed),
                      threads_option(a->threads),
                      json_flag(a->json)},
          .run = [a] { return run_radiosity(*a); }};
}

}  // namespace etendue::cli
