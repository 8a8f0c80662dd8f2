// The bound of memory against the allocations of whole solutions. The global operators new and delete of this program
// count bytes.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <thread>

#include "radiosity/mesh_refinement.h"
#include "radiosity/parameters.h"
#include "radiosity/reconstruction.h"
#include "radiosity/reflectance.h"
#include "scene/builtin/shapes.h"

namespace {

std::atomic<size_t> live_bytes{0}, peak_bytes{0};

void* counted_allocation(size_t size) {
  void* p = std::malloc(size);
  if (!p) throw std::bad_alloc();
  const size_t live = live_bytes.fetch_add(malloc_usable_size(p)) + malloc_usable_size(p);
  size_t peak = peak_bytes;
  while (peak < live && !peak_bytes.compare_exchange_weak(peak, live)) {
  }
  return p;
}

void counted_free(void* p) {
  if (!p) return;
  live_bytes -= malloc_usable_size(p);
  std::free(p);
}

}  // namespace

void* operator new(size_t size) { return counted_allocation(size); }
void* operator new[](size_t size) { return counted_allocation(size); }
void* operator new(size_t size, const std::nothrow_t&) noexcept { return counted_allocation(size); }
void* operator new[](size_t size, const std::nothrow_t&) noexcept { return counted_allocation(size); }
void operator delete(void* p) noexcept { counted_free(p); }
void operator delete[](void* p) noexcept { counted_free(p); }
void operator delete(void* p, size_t) noexcept { counted_free(p); }
void operator delete[](void* p, size_t) noexcept { counted_free(p); }

namespace etendue::radiosity {
namespace {

// Everything that an integrator keeps and builds for this many half-buffers, in two threads.
void solve_scene(const scene::CompiledScene& scene, const Parameters& parameters, int solutions) {
  const PatchMesh mesh(scene, parameters.mesh_settings());
  const std::vector<Rgb> reflectance = patch_reflectances(scene, mesh);
  const PatchVertices vertices(mesh);
  std::vector<std::unique_ptr<SceneSolution>> all;
  for (int n = 0; n < solutions; ++n) {
    all.push_back(std::make_unique<SceneSolution>(parameters.plan(static_cast<uint64_t>(n), {}), mesh.element_count()));
    SceneSolution& solution = *all.back();
    const auto stages = solution.stages();
    for (size_t stage = 0; stage < stages.size(); ++stage) {
      const auto run = [&](int first) {
        prepare_thread_for_rays();
        for (int task = first; task < stages[stage].tasks; task += 2)
          solution.run_stage(scene, mesh, stage, task, nullptr);
      };
      std::thread other(run, 1);
      run(0);
      other.join();
      solution.complete_stage(mesh, reflectance, stage);
    }
  }
}

TEST(Memory, IsBounded) {
  scene::Scene s;
  scene::add(s, scene::cube(0.5f, true), scene::diffuse(Rgb(0.5f)));
  scene::add(s, scene::cube(0.1f, false), scene::diffuse(Rgb(0.5f)));
  const auto scene = scene::compile(std::make_shared<const scene::Scene>(std::move(s)), Camera(), nullptr);
  for (const auto& [method, solver, patches] :
       {std::tuple{FormFactorMethod::hemisphere, SolverKind::gauss_seidel, 3000},
        {FormFactorMethod::hemisphere, SolverKind::conjugate_gradients, 500},
        {FormFactorMethod::point_to_polygon, SolverKind::jacobi, 300},
        {FormFactorMethod::hemisphere, SolverKind::direct_solver, 300}}) {
    Parameters parameters;
    parameters.patches.value = patches;
    parameters.factors.value = method;
    parameters.solver.value = solver;
    parameters.rays.value = 64;
    parameters.pair_rays.value = 1;
    parameters.light_samples.value = 1;
    for (const int solutions : {1, 2}) {
      const size_t count = count_patches(*scene, parameters.mesh_settings());
      const size_t before = live_bytes;
      peak_bytes = before;
      solve_scene(*scene, parameters, solutions);
      const size_t used = peak_bytes - before, bound = memory_of(count, parameters, static_cast<size_t>(solutions));
      EXPECT_LE(used, bound) << patches << " patches, " << solutions << " solutions";
      // The bound is useful: rays seldom all hit different elements, and patches seldom see all others.
      EXPECT_GT(40 * used, bound) << patches << " patches, " << solutions << " solutions";
    }
  }
}

// While a mesh is refined there are two of them.
TEST(Memory, OfAnAdaptiveMeshIsBounded) {
  scene::Scene s;
  scene::add(s, scene::cube(0.5f, true), scene::diffuse(Rgb(0.5f)));
  scene::add(s, scene::cube(0.1f, false), scene::diffuse(Rgb(0.5f)));
  s.lights.push_back(make_light("point"));
  scene::Node node;
  node.light = 0;
  glm::mat4 raised(1.0f);
  raised[3] = glm::vec4(0, 0.4f, 0, 1);
  node.transform.matrix = raised;
  s.nodes.push_back(node);
  s.roots.push_back(static_cast<int>(s.nodes.size()) - 1);
  const auto scene = scene::compile(std::make_shared<const scene::Scene>(std::move(s)), Camera(), nullptr);
  for (const int patches : {3000, 20'000}) {
    const size_t before = live_bytes;
    peak_bytes = before;
    const PatchMesh mesh = complete_mesh(*scene, {Meshing::adaptive, patches, 0}, 1);
    EXPECT_GT(mesh.patches().size(), static_cast<size_t>(patches) * 9 / 10);
    EXPECT_LE(peak_bytes - before, static_cast<size_t>(patches) * PatchMesh::kBytesPerRefinedPatch);
  }
}

}  // namespace
}  // namespace etendue::radiosity
