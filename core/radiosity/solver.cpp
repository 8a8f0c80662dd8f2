#include "radiosity/solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace etendue::radiosity {

#define ETENDUE_SOLVER_DECLARATION(ID, NAME, LABEL) SolverInfo ID##_info();
ETENDUE_RADIOSITY_SOLVERS(ETENDUE_SOLVER_DECLARATION)
#undef ETENDUE_SOLVER_DECLARATION

const SolverInfo& info_of(SolverKind kind) {
#define ETENDUE_SOLVER_INFO(ID, NAME, LABEL) ID##_info(),
  static const std::array infos{ETENDUE_RADIOSITY_SOLVERS(ETENDUE_SOLVER_INFO)};
#undef ETENDUE_SOLVER_INFO
  return infos[static_cast<size_t>(kind)];
}

Solution solve(SolverKind kind, const RadiositySystem& system, const SolverSettings& settings) {
  return info_of(kind).solve(system, settings);
}

double RadiositySystem::contraction() const {
  double most = 0;
  for (size_t i = 0; i < size(); ++i)
    if (reflectance[i] > 0) most = std::max(most, reflectance[i] * factors->closure(i));
  return most;
}

double RadiositySystem::residual(std::span<const double> radiosity) const {
  double most = 0;
  for (size_t i = 0; i < size(); ++i) {
    const double r = std::abs(residual_at(i, radiosity));
    if (!(r <= most)) most = r;  // also if r is not a number
  }
  return most;
}

namespace {

constexpr double kGrowth = 1e4;      // of the residual over the source, which counts as divergence
constexpr size_t kStagnation = 200;  // sweeps in which the residual has to fall, by 1 % at least
constexpr double kRounding = 1e-14;  // of the residual relative to the radiosity

bool stagnates(const std::vector<double>& residuals) {
  if (residuals.size() < 2 * kStagnation) return false;
  const auto middle = residuals.end() - kStagnation;
  return *std::max_element(middle, residuals.end()) >= 0.99 * *std::max_element(middle - kStagnation, middle);
}

double largest(std::span<const double> values) {
  double most = 0;
  for (const double x : values) most = std::max(most, std::abs(x));
  return most;
}

}  // namespace

SolverProgress::SolverProgress(const RadiositySystem& system, const SolverSettings& settings)
    : system_(system), settings_(settings), contraction_(system.contraction()), scale_(largest(system.source)) {}

bool SolverProgress::should_continue(std::span<const double> radiosity) {
  const double residual = system_.residual(radiosity), size = std::max(largest(radiosity), scale_);
  solution_.residuals.push_back(scale_ > 0 ? residual / scale_ : 0);
  solution_.error_bound = residual == 0      ? 0
                          : contraction_ < 1 ? residual / (1 - contraction_) / size
                                             : std::numeric_limits<double>::infinity();
  solution_.status = SolverStatus::converged;
  // Without a bound, the residual alone decides.
  const double measure = contraction_ < 1 ? solution_.error_bound : residual / size;
  if (measure <= settings_.tolerance || residual <= kRounding * size) return false;
  const auto sweeps = static_cast<int>(solution_.residuals.size()) - 1;
  if (!std::isfinite(residual) || residual > kGrowth * scale_ || stagnates(solution_.residuals))
    solution_.status = SolverStatus::diverged;
  else if (sweeps >= settings_.max_sweeps)
    solution_.status = SolverStatus::unfinished;
  return solution_.status == SolverStatus::converged;
}

Solution SolverProgress::finish(std::vector<double> radiosity) {
  solution_.radiosity = std::move(radiosity);
  const auto sweeps = std::to_string(solution_.residuals.size() - 1);
  if (solution_.status == SolverStatus::diverged)
    solution_.problem = "the residual does not fall: the solution diverges after " + sweeps +
                        " sweeps; use a relaxation factor between 0 and 2, or another solver";
  if (solution_.status == SolverStatus::unfinished)
    solution_.problem = "the tolerance was not reached in " + sweeps +
                        " sweeps; allow more sweeps or a larger tolerance, or use another solver";
  if (contraction_ >= 1 && scale_ > 0)
    solution_.problem +=
        std::string(solution_.problem.empty() ? "" : "; ") +
        "a patch with reflectance 1 reflects all light, so the residual does not bound the error: lower "
        "reflectances below 1";
  return std::move(solution_);
}

}  // namespace etendue::radiosity
