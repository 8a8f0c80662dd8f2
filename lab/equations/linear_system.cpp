#include "equations/linear_system.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace etendue::equations {
namespace {

constexpr double kSingular = 1e-13;  // reciprocal condition number

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

RowMajor matrix_of(const std::vector<std::vector<double>>& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  RowMajor matrix(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    matrix.row(i) = Eigen::Map<const Eigen::RowVectorXd>(rows[static_cast<size_t>(i)].data(), n);
  return matrix;
}

// A value of row i that would solve equation i.
double solved_row(const LinearSystem& system, size_t i, const std::vector<double>& x) {
  double sum = system.right[i];
  for (size_t j = 0; j < x.size(); ++j)
    if (j != i) sum -= system.matrix[i][j] * x[j];
  return sum / system.matrix[i][i];
}

}  // namespace

LinearSystem zero_system(size_t size) {
  return {.matrix = std::vector(size, std::vector(size, 0.0)), .right = std::vector(size, 0.0)};
}

Result<std::vector<double>> solve(const LinearSystem& system) {
  const Eigen::PartialPivLU<RowMajor> lu(matrix_of(system.matrix));
  if (!(lu.rcond() > kSingular))
    return input_error("the system of linear equations is singular: 1 is an eigenvalue of the kernel");
  const Eigen::VectorXd x =
      lu.solve(Eigen::Map<const Eigen::VectorXd>(system.right.data(), static_cast<Eigen::Index>(system.size())));
  return std::vector<double>(x.begin(), x.end());
}

void sweep(const LinearSystem& system, Iteration iteration, double relaxation, std::vector<double>& x) {
  const std::vector<double> previous = x;
  const std::vector<double>& known = iteration == Iteration::jacobi ? previous : x;
  for (size_t i = 0; i < x.size(); ++i) x[i] += relaxation * (solved_row(system, i, known) - x[i]);
}

double spectral_radius(const std::vector<std::vector<double>>& rows) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix_of(rows), false).eigenvalues().cwiseAbs().maxCoeff();
}

double residual_norm(const LinearSystem& system, const std::vector<double>& x) {
  double largest = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    double residual = system.right[i];
    for (size_t j = 0; j < x.size(); ++j) residual -= system.matrix[i][j] * x[j];
    // A residual that is not a number is larger than all numbers.
    largest = std::isnan(residual) ? INFINITY : std::max(largest, std::abs(residual));
  }
  return largest;
}

double iteration_radius(const LinearSystem& system, Iteration iteration, double relaxation) {
  const Eigen::MatrixXd a = matrix_of(system.matrix);
  Eigen::MatrixXd split = a.diagonal().asDiagonal();
  if (iteration == Iteration::gauss_seidel) {
    // x + w D^-1 (b - L x' - D x - U x) = x' has the splitting matrix D / w + L.
    split = a.triangularView<Eigen::StrictlyLower>();
    split.diagonal() = a.diagonal() / relaxation;
  } else {
    split /= relaxation;
  }
  const Eigen::MatrixXd iterated = Eigen::MatrixXd::Identity(a.rows(), a.cols()) - split.partialPivLu().solve(a);
  return Eigen::EigenSolver<Eigen::MatrixXd>(iterated, false).eigenvalues().cwiseAbs().maxCoeff();
}

bool is_row_dominant(const LinearSystem& system) {
  for (size_t i = 0; i < system.size(); ++i) {
    double others = 0;
    for (size_t j = 0; j < system.size(); ++j)
      if (j != i) others += std::abs(system.matrix[i][j]);
    if (std::abs(system.matrix[i][i]) <= others) return false;
  }
  return true;
}

}  // namespace etendue::equations
