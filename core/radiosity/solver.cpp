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

size_t solver_memory(SolverKind kind, size_t elements) {
  const SolverInfo& info = info_of(kind);
  // The system, and the radiosity whose residual is measured.
  const size_t vectors = 3 * sizeof(double) + info.bytes_per_element;
  return elements * (vectors + (info.has_dense_matrix ? elements * sizeof(double) : 0));
}

Solution solve(SolverKind kind, const RadiositySystem& system, const SolverSettings& settings) {
  SolverRun run(kind, system, settings);
  run.run(nullptr);
  return run.solution();
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

SolverRun::SolverRun(SolverKind kind, const RadiositySystem& system, const SolverSettings& settings)
    : system_(system), settings_(settings), contraction_(system.contraction()), scale_(largest(system.source)) {
  const SolverInfo& info = info_of(kind);
  if (info.most_elements > 0 && system.size() > info.most_elements) {
    refuse();
    return;
  }
  iteration_ = info.begin(system_, settings_);
  radiosity_ = iteration_->radiosity();
}

void SolverRun::refuse() {
  solution_.radiosity = system_.source;
  solution_.residuals = {system_.residual(system_.source)};
  solution_.seconds = {0};
  solution_.status = SolverStatus::unfinished;
  solution_.error_bound = std::numeric_limits<double>::infinity();
  const auto& info = info_of(SolverKind::direct_solver);
  solution_.problem = "the dense matrix of " + std::to_string(system_.size()) + " elements is too large: at most " +
                      std::to_string(info.most_elements / 2) + " patches fit; use fewer patches or an iterative solver";
  is_complete_ = true;
}

bool SolverRun::run(const KeepGoing* keep_going) {
  using Clock = std::chrono::steady_clock;
  while (!is_complete_) {
    if (stops(keep_going)) return false;
    if (needs_sweep_) {
      const auto start = Clock::now();
      const bool swept = iteration_->sweep(keep_going);
      time_ += Clock::now() - start;
      if (!swept) return false;
      needs_sweep_ = false;
      radiosity_ = iteration_->radiosity();
    }
    if (!measure(keep_going)) return false;
    judge();
  }
  return true;
}

// The residual of the current radiosity.
bool SolverRun::measure(const KeepGoing* keep_going) {
  const auto cost = [&](size_t i) { return 1 + system_.factors->exchanges(i).size(); };
  const bool complete = continue_loop(measured_, system_.size(), keep_going, cost, [&](size_t i) {
    const double r = std::abs(system_.residual_at(i, radiosity_));
    if (!(r <= residual_)) residual_ = r;  // also if r is not a number
  });
  return complete;
}

// Decides by the residual whether to continue.
void SolverRun::judge() {
  const double residual = residual_, size = std::max(largest(radiosity_), scale_);
  measured_ = 0;
  residual_ = 0;
  solution_.residuals.push_back(scale_ > 0 ? residual / scale_ : 0);
  solution_.seconds.push_back(std::chrono::duration<double>(time_).count());
  solution_.error_bound = residual == 0      ? 0
                          : contraction_ < 1 ? residual / (1 - contraction_) / size
                                             : std::numeric_limits<double>::infinity();
  // Without a bound, the residual alone decides.
  const double measure = contraction_ < 1 ? solution_.error_bound : residual / size;
  const auto sweeps = static_cast<int>(solution_.residuals.size()) - 1;
  if (measure <= settings_.tolerance || residual <= kRounding * size)
    solution_.status = SolverStatus::converged;
  else if (!std::isfinite(residual) || residual > kGrowth * scale_ || stagnates(solution_.residuals))
    solution_.status = SolverStatus::diverged;
  else if (sweeps >= settings_.max_sweeps)
    solution_.status = SolverStatus::unfinished;
  else
    needs_sweep_ = iteration_->can_improve();
  if (!needs_sweep_) finish();
}

void SolverRun::finish() {
  is_complete_ = true;
  iteration_ = nullptr;
  solution_.radiosity = std::move(radiosity_);
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
        "a patch with reflectance 1 or more reflects all light that it receives, so the residual does not bound the "
        "error: lower reflectances below 1";
}

}  // namespace etendue::radiosity
