#include "radiosity_links.h"

#include <chrono>
#include <cmath>
#include <cstdio>

#include "interrupt.h"
#include "render/thread_pool.h"

namespace etendue::cli {

std::optional<HierarchyRun> run_hierarchy(const FlatSolution& p, const radiosity::HierarchySettings& settings,
                                          int threads) {
  const std::atomic<bool>& interrupted = watch_interrupts();
  const std::function<bool()> keep_going = [&] { return !interrupted; };
  const auto start = std::chrono::steady_clock::now();
  radiosity::Hierarchy hierarchy(p.mesh, settings);
  std::atomic<uint64_t> rays{0};
  render::ThreadPool workers(threads);
  workers.run(
      0, hierarchy.tasks(),
      [&](int task) {
        prepare_thread_for_rays();
        rays += hierarchy.run(p.scene, task, &keep_going).value_or(0);
      },
      keep_going);
  if (interrupted) return {};
  hierarchy.finish();
  HierarchyRun run{.links = hierarchy.links(),
                   .memory = hierarchy.memory(),
                   .seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                   .rays = rays,
                   .problem = {}};
  const auto field = radiosity::solve_hierarchically(hierarchy, p.reflectance, p.direct, p.settings);
  const auto flat = radiosity::solve_field(p.factors, p.reflectance, p.direct, {.settings = p.settings, .counted = {}});
  const std::vector<double>& closures = hierarchy.closures();
  double area = 0, difference = 0, sum = 0;
  for (uint32_t e = 0; e < p.mesh.element_count(); ++e) {
    const double weight = p.mesh.patch_of(e).area;
    difference += weight * std::abs(static_cast<double>(luminance(field.indirect[e] - flat.indirect[e])));
    sum += weight * static_cast<double>(luminance(flat.indirect[e]));
    if (p.factors.exchanges(e).empty()) continue;
    run.mean_closure += weight * closures[e];
    area += weight;
  }
  run.mean_closure = area > 0 ? run.mean_closure / area : 0;
  run.difference = sum > 0 ? difference / sum : 0;
  run.problem = field.problem;
  return run;
}

void print(const HierarchyRun& run) {
  std::printf("hierarchy      %zu links, %.1f MiB, %.3g rays, %.2f s, closure %.4f, difference %.4f\n", run.links,
              static_cast<double>(run.memory) / (1 << 20), static_cast<double>(run.rays), run.seconds, run.mean_closure,
              run.difference);
  if (!run.problem.empty()) std::fprintf(stderr, "etendue: hierarchy: %s\n", run.problem.c_str());
}

json hierarchy_json(const HierarchyRun& run) {
  return {{"links", run.links},     {"bytes", run.memory},         {"rays", run.rays},
          {"seconds", run.seconds}, {"closure", run.mean_closure}, {"difference", run.difference},
          {"problem", run.problem}};
}

}  // namespace etendue::cli
