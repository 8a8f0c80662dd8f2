// The parameters of a radiosity solution.
#pragma once
#include <string>

#include "radiosity/scene_solution.h"

namespace etendue::radiosity {

struct Parameters {
  Number<int> patches{
      "patches",
      "Patches",
      2000,
      {1, 1'000'000},
      "Approximate number of patches, of similar area. Raising it reduces blur and leaks; time and memory "
      "of form factors grow at least in proportion",
      "",
      Scale::logarithmic};
  Choice<Meshing> meshing{
      "meshing", "Subdivision", Meshing::area,
      "How triangles are divided: into patches of similar area, all alike, with powers of two as parts of each edge, "
      "which hierarchical form factors need, or finer where direct light varies, as at the edges of shadows"};
  Number<int> steps{
      "steps",
      "Subdivision steps",
      4,
      {1, 256},
      "With uniform subdivision: parts of each edge. A triangle has the square of this number of patches"};
  Choice<FormFactorMethod> factors{
      "factors", "Form factors", FormFactorMethod::hemisphere,
      "Method that computes form factors. Hemisphere sampling suits all scenes; the guide compares the methods"};
  Number<int> rays{"rays",
                   "Rays per patch",
                   256,
                   {1, 1'000'000},
                   "Rays per patch side, for the methods that do not treat pairs. Raising it reduces noise and takes "
                   "longer",
                   "",
                   Scale::logarithmic};
  Number<int> pair_rays{
      "pair-rays", "Rays per pair",   4, {1, 10'000}, "Rays per pair of patches, for the other form factor methods",
      "",          Scale::logarithmic};
  Number<int> light_samples{"light-samples",
                            "Light samples",
                            64,
                            {1, 1'000'000},
                            "Shadow rays per patch side for direct irradiance. Raising it reduces noise",
                            "",
                            Scale::logarithmic};
  Choice<SolverKind> solver{"solver", "Solver", SolverKind::gauss_seidel,
                            "Solver of the linear system. They differ in time, not in the solution"};
  Number<float> tolerance{"tolerance",
                          "Tolerance",
                          1e-4f,
                          {1e-10f, 1},
                          "Bound of the solver's error relative to the largest radiosity. Lower takes more sweeps",
                          "",
                          Scale::logarithmic};
  Number<float> relaxation{"relaxation",
                           "Relaxation factor",
                           1,
                           {0.01f, 4},
                           "Factor of successive over-relaxation; the iteration can converge between 0 and 2"};
  Number<int> memory_limit{"memory-limit",
                           "Memory limit",
                           2048,
                           {1, 1 << 20},
                           "Scenes whose radiosity may need more are refused with the number of patches that fit",
                           "MiB",
                           Scale::logarithmic};

  auto solution_parameters() {
    return std::tie(patches, meshing, steps, factors, rays, pair_rays, light_samples, solver, tolerance, relaxation,
                    memory_limit);
  }

  MeshSettings mesh_settings() const { return {meshing, patches, steps}; }
  FormFactorSettings factor_settings() const {
    const bool by_pair = info_of(factors).samples_pairs;
    return {factors, static_cast<uint32_t>(by_pair ? pair_rays : rays)};
  }
  SolverSettings solver_settings() const {
    SolverSettings settings;
    settings.tolerance = static_cast<double>(tolerance);
    settings.relaxation = static_cast<double>(relaxation);
    return settings;
  }
  SolutionPlan plan(uint64_t seed, SamplerChoice sampler) const {
    return {.factors = factor_settings(),
            .light_samples = static_cast<uint32_t>(light_samples),
            .seed = seed,
            .field = {.solver = solver, .settings = solver_settings(), .counted = {}},
            .sampler = std::move(sampler)};
  }
};

// Bytes that `solutions` of a mesh with so many patches need at most: the mesh, the form factors of all solutions, those
// of one more while they are built, and the solver.
size_t memory_of(size_t patches, const Parameters& parameters, size_t solutions);

// Why the solutions of a scene do not fit into the memory limit, with the number of patches that do; empty if they fit.
// There are `solutions` at the same time.
std::string too_many_patches(const scene::CompiledScene& scene, const Parameters& parameters, size_t solutions);

}  // namespace etendue::radiosity
