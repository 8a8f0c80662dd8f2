#include "equations/transport_matrices.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace etendue::equations {
namespace {

using Matrix = Eigen::MatrixXd;
using Column = Eigen::VectorXd;

constexpr double kLeastConditionNumber = 1e-13;  // reciprocal

Column column(const Vector& v) { return Eigen::Map<const Column>(v.data(), static_cast<Eigen::Index>(v.size())); }
Vector vector_of(const Column& c) { return {c.begin(), c.end()}; }

Matrix propagation(const TransportMatrices& t) {
  const auto n = static_cast<Eigen::Index>(t.size());
  Matrix m(n, n);
  for (Eigen::Index i = 0; i < n; ++i) m.row(i) = column(t.propagation[static_cast<size_t>(i)]).transpose();
  return m;
}
Matrix scattering(const TransportMatrices& t) { return column(t.reflectance).asDiagonal(); }

// A^-1 M^T A
Matrix adjoint(const TransportMatrices& t, const Matrix& m) {
  const Column area = column(t.area);
  return area.cwiseInverse().asDiagonal() * m.transpose() * area.asDiagonal();
}

// (I - M)^-1 applied to b.
Result<Matrix> resolvent_times(const Matrix& m, const Matrix& b) {
  const Eigen::PartialPivLU<Matrix> lu(Matrix::Identity(m.rows(), m.cols()) - m);
  if (!(lu.rcond() > kLeastConditionNumber))
    return input_error("light transport has no solution: 1 is an eigenvalue, as in a closed scene of reflectance 1");
  return Matrix(lu.solve(b));
}

Rows rows_of(const Matrix& m) {
  Rows rows;
  for (Eigen::Index i = 0; i < m.rows(); ++i) rows.push_back(vector_of(m.row(i).transpose()));
  return rows;
}

// The symmetric matrix that is similar to K G if all reflectances are positive; otherwise with the same eigenvalues, since
// elements of reflectance 0 add zeros.
Matrix symmetric_transport(const TransportMatrices& t) {
  const Column root = (column(t.reflectance).array() * column(t.area).array()).sqrt();
  const Column inverse = root.unaryExpr([](double x) { return x > 0 ? 1 / x : 0; });
  const Matrix similar = root.asDiagonal() * propagation(t) * scattering(t) * inverse.asDiagonal();
  return 0.5 * (similar + similar.transpose());
}

}  // namespace

double inner_product(const TransportMatrices& t, const Vector& a, const Vector& b) {
  double sum = 0;
  for (size_t i = 0; i < t.size(); ++i) sum += t.area[i] * a[i] * b[i];
  return std::numbers::pi * sum;
}

Result<Measurements> measurements(const TransportMatrices& t, const Vector& emitted, const Vector& detector) {
  const Matrix g = propagation(t), k = scattering(t), g_adjoint = adjoint(t, g), k_adjoint = adjoint(t, k);
  const Column light = column(emitted), importance = column(detector);
  const Column incident_light = g * light, incident_importance_source = g_adjoint * importance;
  const auto l_i = resolvent_times(g * k, incident_light);
  const auto w_o = resolvent_times(k_adjoint * g_adjoint, importance);
  const auto l_o = resolvent_times(k * g, light);
  const auto w_i = resolvent_times(g_adjoint * k_adjoint, incident_importance_source);
  for (const auto* solution : {&l_i, &w_o, &l_o, &w_i})
    if (!*solution) return solution->error();
  const auto product = [&](const Column& a, const Matrix& b) {
    return inner_product(t, vector_of(a), vector_of(b.col(0)));
  };
  return Measurements{.incident_radiance = product(importance, *l_i),
                      .exitant_importance = product(incident_light, *w_o),
                      .exitant_radiance = product(incident_importance_source, *l_o),
                      .incident_importance = product(light, *w_i)};
}

Result<Vector> exitant_radiance(const TransportMatrices& t, const Vector& emitted) {
  const auto solution = resolvent_times(scattering(t) * propagation(t), column(emitted));
  if (!solution) return solution.error();
  return vector_of(solution->col(0));
}

Result<Vector> incident_importance(const TransportMatrices& t, const Vector& incident_source) {
  const Matrix g = adjoint(t, propagation(t)), k = adjoint(t, scattering(t));
  const auto solution = resolvent_times(g * k, column(incident_source));
  if (!solution) return solution.error();
  return vector_of(solution->col(0));
}

Result<Rows> solution_operator(const TransportMatrices& t) {
  const Matrix g = propagation(t);
  const auto inverse = resolvent_times(scattering(t) * g, Matrix::Identity(g.rows(), g.cols()));
  if (!inverse) return inverse.error();
  return rows_of(*inverse);
}

Result<Rows> global_reflectance(const TransportMatrices& t) {
  const Matrix g = propagation(t), k = scattering(t);
  const auto inverse = resolvent_times(g * k, Matrix::Identity(g.rows(), g.cols()));
  if (!inverse) return inverse.error();
  return rows_of(k * *inverse);
}

std::vector<Vector> neumann_terms(const TransportMatrices& t, const Vector& emitted, int count) {
  const Matrix transport = scattering(t) * propagation(t);
  std::vector<Vector> terms;
  Column term = column(emitted);
  for (int n = 0; n < count; ++n) {
    terms.push_back(vector_of(term));
    term = transport * term;
  }
  return terms;
}

OperatorNorms transport_norms(const TransportMatrices& t) {
  const Matrix transport = scattering(t) * propagation(t);
  const Column area = column(t.area);
  const double supremum = transport.cwiseAbs().rowwise().sum().maxCoeff();
  // The largest ratio of power: sum over i of A_i |T_ij| / A_j.
  const double integral = (area.transpose() * transport.cwiseAbs()).cwiseQuotient(area.transpose()).maxCoeff();
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(symmetric_transport(t), Eigen::EigenvaluesOnly);
  return {supremum, integral, solver.eigenvalues().cwiseAbs().maxCoeff()};
}

Vector leading_eigenvector(const TransportMatrices& t) { return leading_eigenpairs(t, 1)[0].vector; }

std::vector<Eigenpair> leading_eigenpairs(const TransportMatrices& t, int count) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(symmetric_transport(t));
  std::vector<Eigen::Index> order(t.size());
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, std::greater(), [&](Eigen::Index k) { return std::abs(solver.eigenvalues()(k)); });
  order.resize(std::min(order.size(), static_cast<size_t>(count)));
  const Column root = (column(t.reflectance).array() / column(t.area).array()).sqrt();
  std::vector<Eigenpair> pairs;
  for (const Eigen::Index k : order) {
    // v of the symmetric matrix belongs to sqrt(rho / A) v of K G.
    const Column scaled = root.array() * solver.eigenvectors().col(k).array();
    Eigen::Index largest = 0;
    scaled.cwiseAbs().maxCoeff(&largest);
    pairs.push_back({solver.eigenvalues()(k), vector_of(scaled / scaled(largest))});
  }
  return pairs;
}

Rows transport_operator(const TransportMatrices& t) { return rows_of(scattering(t) * propagation(t)); }

EnergyBalance energy_balance(const TransportMatrices& t, const Vector& emitted, const Vector& exitant) {
  EnergyBalance balance{0, 0, 0};
  const Vector ones(t.size(), 1.0);
  balance.emitted = inner_product(t, emitted, ones);
  const Column incident = propagation(t) * column(exitant);
  for (size_t i = 0; i < t.size(); ++i) {
    const double factor = std::numbers::pi * t.area[i];
    balance.absorbed += factor * (1 - t.reflectance[i]) * incident(static_cast<Eigen::Index>(i));
    double arriving = 0;
    for (const double f : t.propagation[i]) arriving += f;
    balance.escaped += factor * (1 - arriving) * exitant[i];
  }
  return balance;
}

}  // namespace etendue::equations
