// The solution of the radiosity equation in the form that rendering reads: irradiance of every element.
//
// With H_1 the direct irradiance, rho the reflectance, and H_(n+1) = F rho H_n, the irradiance after n reflections more,
// the irradiance is the sum of all H_n. A path E D^n L, with n diffuse reflections, reaches the camera by H_n of the visible
// element. If only some numbers of reflections count, the terms are added one by one; otherwise a solver computes the
// sum.
#pragma once
#include <array>
#include <memory>
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

// The residual per sweep of one colour component; empty if terms were added one by one.
struct ResidualHistory {
  std::vector<double> residuals, seconds;  // as in Solution
};

// Irradiances in W/m^2, by element.
struct IrradianceField {
  std::vector<Rgb> total;     // on visible surfaces: H_n for all n that count
  std::vector<Rgb> indirect;  // the same without direct light: n >= 2
  std::vector<Rgb> gathered;  // on surfaces that are seen by one more reflection: H_n if n + 1 counts
  std::vector<Rgb> unshot;    // residual of the radiosity equation, W/m^2: light that the solution leaves out
  std::array<ResidualHistory, 3> history;
  int sweeps = 0;          // of the solver, the most of all colour components
  double error_bound = 0;  // of the solver, relative
  // Of the solver: why it did not converge, or why the bound is unknown; empty if it converged.
  std::string problem;
  bool has_diverged = false;  // only direct light is left then
};

// The solution of one colour component, which can be stopped and continued.
class ComponentSolution {
 public:
  // `reflectance` is by patch, `direct` (H_1) by element.
  ComponentSolution(const FormFactors& factors, const std::vector<Rgb>& reflectance, const std::vector<Rgb>& direct,
                    int component, const FieldSettings& settings);
  ComponentSolution(const ComponentSolution&) = delete;
  ComponentSolution& operator=(const ComponentSolution&) = delete;

  // False if it was stopped.
  bool run(const KeepGoing* keep_going);
  bool has_diverged() const { return has_diverged_; }
  // Removes all light but direct light.
  void keep_direct_light();
  // The residuals so far.
  ResidualHistory history() const;
  // Writes the complete solution into a field of the right size.
  void write_to(IrradianceField& field) const;

  static constexpr size_t kBytesPerElement = 6 * sizeof(double);

 private:
  bool counts(size_t n) const { return n < settings_.counted.size() && settings_.counted[n]; }
  bool add_counted_terms(const KeepGoing* keep_going);
  void add_term();
  bool is_last_term();
  void finish_solution();

  FieldSettings settings_;
  int component_;
  RadiositySystem system_;
  std::vector<double> direct_;
  std::unique_ptr<SolverRun> run_;  // null if terms are added one by one
  std::vector<double> total_, indirect_, gathered_, unshot_;
  std::vector<double> term_, next_term_;
  size_t term_number_ = 1, next_ = 0;
  bool term_is_added_ = false;
  int sweeps_ = 0;
  double error_bound_ = 0;
  std::string problem_;
  bool has_diverged_ = false;
};

// `reflectance` is by patch, `direct` (H_1) by element.
IrradianceField solve_field(const FormFactors& factors, const std::vector<Rgb>& reflectance,
                            const std::vector<Rgb>& direct, const FieldSettings& settings);
// The field of three complete components. If one of them has diverged, it has direct light only.
IrradianceField combined_field(const std::array<std::unique_ptr<ComponentSolution>, 3>& components, size_t elements);

// The system of one colour component: B is the reflected radiosity, its source the reflected direct light.
RadiositySystem reflected_light_system(const FormFactors& factors, const std::vector<Rgb>& reflectance,
                                       const std::vector<Rgb>& direct, int component);

}  // namespace etendue::radiosity
