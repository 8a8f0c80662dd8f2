// The radiosity equation of one colour component, and the solvers of linear systems that solve it.
//
//    B_i = S_i + rho_i  sum over j of  F_ij B_j                               [Lang, sec. 10.1.5, eq. 10.32-10.36]
//
// B is radiosity (W/m^2), S the source: emitted radiosity, or the direct light that element i reflects, rho reflectance.
// The matrix I - rho F is strictly diagonally dominant if every rho_i times the row sum of F_ij is below 1. Then
//
//    |B - B*|  <=  |r| / (1 - q),      r = S - B + rho F B,    q = max rho_i sum of F_ij,
//
// with the maximum norm, bounds the error of an approximation B of the solution B* by its residual. All solvers stop when
// this bound is small.
//
// Solvers can be stopped within a sweep and continued, with the same result bit for bit.
//
// A solver is a .cpp file in solvers/ and a line below.
#pragma once
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "radiosity/form_factors.h"
#include "radiosity/keep_going.h"

namespace etendue::radiosity {

// The identifier, the name in commands and files, and the label.
// clang-format off
#define ETENDUE_RADIOSITY_SOLVERS(ENTRY)                            \
  ENTRY(gauss_seidel, "gauss-seidel", "Gauss-Seidel")               \
  ENTRY(jacobi, "jacobi", "Jacobi")                                 \
  ENTRY(neumann, "neumann", "Neumann series")                       \
  ENTRY(over_relaxation, "sor", "Successive over-relaxation")       \
  ENTRY(conjugate_gradients, "cg", "Conjugate gradients")           \
  ENTRY(southwell, "southwell", "Southwell relaxation (shooting)")  \
  ENTRY(progressive, "progressive", "Progressive refinement")       \
  ENTRY(direct_solver, "direct", "LU decomposition")
// clang-format on

#define ETENDUE_SOLVER_ENUMERATOR(ID, NAME, LABEL) ID,
enum class SolverKind : uint8_t { ETENDUE_RADIOSITY_SOLVERS(ETENDUE_SOLVER_ENUMERATOR) };
#undef ETENDUE_SOLVER_ENUMERATOR

struct RadiositySystem {
  const FormFactors* factors;
  std::vector<double> reflectance, source;  // by element

  size_t size() const { return source.size(); }
  // q: the largest reflectance times row sum.
  double contraction() const;
  // The largest |r_i|.
  double residual(std::span<const double> radiosity) const;
  double reflected_at(size_t i, std::span<const double> radiosity) const {
    return reflectance[i] > 0 ? reflectance[i] * factors->row_times(i, radiosity) : 0;
  }
  double diagonal(size_t i) const { return 1 - reflectance[i] * factors->factor(i, i); }
  double residual_at(size_t i, std::span<const double> radiosity) const {
    return source[i] - radiosity[i] + reflected_at(i, radiosity);
  }
};

struct SolverSettings {
  double tolerance = 1e-4;  // of the error bound, relative to the largest radiosity
  int max_sweeps = 1000;
  double relaxation = 1;  // of over-relaxation; it can converge between 0 and 2
};

enum class SolverStatus : uint8_t {
  converged,
  diverged,   // the residual grows, or has not fallen for many sweeps
  unfinished  // max_sweeps was reached
};

// A sweep costs about as much as one multiplication by the matrix.
struct Solution {
  std::vector<double> radiosity;
  std::vector<double> residuals;  // the largest |r_i| before the first sweep and after every sweep, relative to max S
  std::vector<double> seconds;    // when each residual was reached, of solving without measuring residuals
  SolverStatus status = SolverStatus::converged;
  double error_bound = 0;  // of the radiosity, relative to its maximum; infinite if q is 1 or more
  std::string problem;     // why it did not converge, and what to change; empty if it did
};

// A solver at work on a system.
class SolverIteration {
 public:
  virtual ~SolverIteration() = default;
  // Completes the current sweep. False if it was stopped; the next call continues there.
  virtual bool sweep(const KeepGoing* keep_going) = 0;
  // The radiosity between two sweeps.
  virtual std::vector<double> radiosity() const = 0;
  // Whether another sweep would change anything.
  virtual bool can_improve() const { return true; }
};

struct SolverInfo {
  const char* doc;  // the method, its convergence, its cost
  std::unique_ptr<SolverIteration> (*begin)(const RadiositySystem& system, const SolverSettings& settings);
  size_t bytes_per_element;       // of the iteration
  size_t most_elements = 0;       // larger systems are refused; 0: no limit
  bool has_dense_matrix = false;  // 8 bytes per pair of elements besides
};
const SolverInfo& info_of(SolverKind kind);
// Bytes that the solution of a system of one colour component needs, without the form factors.
size_t solver_memory(SolverKind kind, size_t elements);

// The solution of a system by one solver, with the residual per sweep and the decision to stop. The system must outlive
// it.
class SolverRun {
 public:
  SolverRun(SolverKind kind, const RadiositySystem& system, const SolverSettings& settings);

  // False if it was stopped; the next call continues. True if the solution is complete.
  bool run(const KeepGoing* keep_going);
  // Without the radiosity until it is complete.
  const Solution& solution() const { return solution_; }

 private:
  bool measure(const KeepGoing* keep_going);
  void judge();
  void finish();
  void refuse();
  double bound() const;

  const RadiositySystem& system_;
  SolverSettings settings_;
  double contraction_, scale_;  // q, max S
  std::unique_ptr<SolverIteration> iteration_;
  std::vector<double> radiosity_;  // whose residual is measured
  size_t measured_ = 0;            // elements
  double residual_ = 0;            // of these
  bool needs_sweep_ = false, is_complete_ = false;
  std::chrono::steady_clock::duration time_{0};  // of sweeps
  Solution solution_;
};

// Solves by the given method.
Solution solve(SolverKind kind, const RadiositySystem& system, const SolverSettings& settings);

}  // namespace etendue::radiosity

#define ETENDUE_SOLVER_OPTION(ID, NAME, LABEL) etendue::Option{NAME, LABEL},
template <>
struct etendue::Options<etendue::radiosity::SolverKind> {
  static constexpr std::array kOptions{ETENDUE_RADIOSITY_SOLVERS(ETENDUE_SOLVER_OPTION)};
};
#undef ETENDUE_SOLVER_OPTION
