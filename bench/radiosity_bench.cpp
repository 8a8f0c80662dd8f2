// Growth of form factors over the number of patches: flat, by rays of every patch, and hierarchical, by links.
//
//   radiosity_bench [SCENE [LARGEST]]
//
// SCENE is a built-in scene (cornell), LARGEST the largest number of patches (100,000). Every line doubles the edges of a
// quadtree mesh. Time is the processor time of one thread for form factors without direct light. Links have a form factor
// of at most 0.01. Last come the exponents of the power laws through the last two lines.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "radiosity/form_factor_assembly.h"
#include "radiosity/hierarchy.h"
#include "radiosity/scene_solution.h"
#include "scene/builtin/builtin.h"

namespace {

using namespace etendue;
using namespace etendue::radiosity;

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Measured {
  double patches = 0;
  double factors = 0, factor_bytes = 0, factor_seconds = 0;
  double links = 0, link_bytes = 0, link_seconds = 0;
  double gather_flat = 0, gather_links = 0;  // seconds of one sweep
};

FormFactors flat_factors(const scene::CompiledScene& scene, const PatchMesh& mesh, uint32_t rays) {
  const auto sampler = make_sampler("sobol");
  RowBuilder builder;
  std::vector<FormFactorRow> rows;
  for (uint32_t e = 0; e < mesh.element_count(); ++e) {
    builder.begin(mesh.element_count());
    info_of(FormFactorMethod::hemisphere).add_row({scene, mesh, *sampler, e, rays, 1, builder});
    rows.push_back(builder.finish());
  }
  return {std::move(rows), element_areas(mesh)};
}

Measured measure(const scene::CompiledScene& scene, int patches) {
  constexpr uint32_t kRays = 256;
  const PatchMesh mesh(scene, {Meshing::quadtree, patches, 0});
  Measured m;
  m.patches = static_cast<double>(mesh.patches().size());
  {
    const double start = processor_seconds();
    const FormFactors factors = flat_factors(scene, mesh, kRays);
    m.factor_seconds = processor_seconds() - start;
    for (size_t i = 0; i < factors.size(); ++i) m.factors += static_cast<double>(factors.exchanges(i).size());
    m.factor_bytes = static_cast<double>(factors.memory());
    std::vector<double> ones(factors.size(), 1), sums(factors.size());
    const double begin = processor_seconds();
    for (size_t i = 0; i < factors.size(); ++i) sums[i] = factors.row_times(i, ones);
    m.gather_flat = processor_seconds() - begin;
  }
  const double start = processor_seconds();
  Hierarchy hierarchy(mesh, {.error = 0.01, .rays = 4});
  for (int task = 0; task < hierarchy.tasks(); ++task) hierarchy.run(scene, task, nullptr);
  hierarchy.finish();
  m.link_seconds = processor_seconds() - start;
  m.links = static_cast<double>(hierarchy.links());
  m.link_bytes = static_cast<double>(hierarchy.memory());
  const std::vector<Rgb> ones(mesh.element_count(), Rgb(1));
  const double begin = processor_seconds();
  hierarchy.gather(ones);
  m.gather_links = processor_seconds() - begin;
  return m;
}

double exponent(const std::vector<Measured>& list, double Measured::*value) {
  const Measured &a = list[list.size() - 2], &b = list.back();
  return std::log(b.*value / (a.*value)) / std::log(b.patches / a.patches);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "cornell";
  const double largest = argc > 2 ? std::atof(argv[2]) : 100'000;
  const auto* builtin = scene::find_builtin(name);
  if (!builtin) {
    std::fprintf(stderr, "radiosity_bench: there is no built-in scene %s\n", name.c_str());
    return 2;
  }
  const auto scene = scene::compile(std::make_shared<const scene::Scene>(builtin->make()), Camera(), nullptr);
  std::printf("%9s %12s %9s %9s %9s %12s %9s %9s %9s\n", "patches", "factors", "MiB", "s", "sweep s", "links", "MiB",
              "s", "sweep s");
  std::vector<Measured> list;
  for (double patches = 400; patches <= largest; patches *= 4) {
    list.push_back(measure(*scene, static_cast<int>(patches)));
    const Measured& m = list.back();
    std::printf("%9.0f %12.0f %9.1f %9.2f %9.4f %12.0f %9.1f %9.2f %9.4f\n", m.patches, m.factors,
                m.factor_bytes / (1 << 20), m.factor_seconds, m.gather_flat, m.links, m.link_bytes / (1 << 20),
                m.link_seconds, m.gather_links);
    std::fflush(stdout);
  }
  if (list.size() < 2) return 0;
  std::printf("exponent  %12.2f %9.2f %9.2f %9.2f %12.2f %9.2f %9.2f %9.2f\n", exponent(list, &Measured::factors),
              exponent(list, &Measured::factor_bytes), exponent(list, &Measured::factor_seconds),
              exponent(list, &Measured::gather_flat), exponent(list, &Measured::links),
              exponent(list, &Measured::link_bytes), exponent(list, &Measured::link_seconds),
              exponent(list, &Measured::gather_links));
  return 0;
}
