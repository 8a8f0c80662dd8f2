// The solution of the radiosity equation in the form that rendering reads: irradiance of every element.
//
// With H_1 the direct irradiance, rho the reflectance, and H_(n+1) = F rho H_n, the irradiance after n reflections more,
// the irradiance is the sum of all H_n. A path E D^n L, with n diffuse reflections, reaches the camera by H_n of the visible
// element. If only some numbers of reflections count, the terms are added one by one; otherwise a solver computes the
// sum.
#pragma once
#include <vector>

#include "radiosity/solver.h"
#include "spectrum/rgb.h"

namespace etendue::radiosity {

// Whether paths with n diffuse reflections count, for n = 0, 1, ... up to the last entry; longer ones do not.
// Empty: all paths.
using CountedReflections = std::vector<bool>;

struct FieldSettings {
  SolverKind solver = SolverKind::gauss_seidel;
  SolverSettings settings;
  CountedReflections counted;
};

// Irradiances in W/m^2, by element.
struct IrradianceField {
  std::vector<Rgb> total;     // on visible surfaces: H_n for all n that count
  std::vector<Rgb> indirect;  // the same without direct light: n >= 2
  std::vector<Rgb> gathered;  // on surfaces that are seen by one more reflection: H_n if n + 1 counts
  int sweeps = 0;             // of the solver, the most of all colour components
  double error_bound = 0;     // of the solver, relative
  std::string problem;        // of the solver; empty if it converged
};

// `reflectance` is by patch, `direct` (H_1) by element.
IrradianceField solve_field(const FormFactors& factors, const std::vector<Rgb>& reflectance,
                            const std::vector<Rgb>& direct, const FieldSettings& settings);

// The system of one colour component: B is the reflected radiosity, its source the reflected direct light.
RadiositySystem reflected_light_system(const FormFactors& factors, const std::vector<Rgb>& reflectance,
                                       const std::vector<Rgb>& direct, int component);

}  // namespace etendue::radiosity
