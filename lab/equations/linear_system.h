// Systems of linear equations A x = b: direct solution and splitting iterations [Lang, eq. 2.481-2.524].
#pragma once
#include <functional>
#include <vector>

#include "base/result.h"

namespace etendue::equations {

struct LinearSystem {
  std::vector<std::vector<double>> matrix;  // rows
  std::vector<double> right;
  size_t size() const { return right.size(); }
};

// The system of this size with a zero matrix.
LinearSystem zero_system(size_t size);

// By LU decomposition. An input error if the matrix is singular to working precision.
Result<std::vector<double>> solve(const LinearSystem& system);

enum class Iteration {
  jacobi,        // [Lang, eq. 2.502]
  gauss_seidel,  // [Lang, eq. 2.514]
};

// One sweep over all unknowns. Relaxation mixes the new and the old value: 1 is the plain method, more is
// over-relaxation [Lang, eq. 2.523].
void sweep(const LinearSystem& system, Iteration iteration, double relaxation, std::vector<double>& x);

// The largest modulus of the eigenvalues of a square matrix.
double spectral_radius(const std::vector<std::vector<double>>& rows);

// The maximum norm of b - A x.
double residual_norm(const LinearSystem& system, const std::vector<double>& x);

// The spectral radius of the iteration matrix: the factor of the error per sweep in the end. Below 1 the iteration
// converges from every start.
double iteration_radius(const LinearSystem& system, Iteration iteration, double relaxation);

// Whether each |a_ii| exceeds the sum of the other moduli of its row [Lang, eq. 2.521].
bool is_row_dominant(const LinearSystem& system);

}  // namespace etendue::equations
