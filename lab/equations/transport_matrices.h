// The operators of light transport between elements of constant radiance, as matrices.      [Lang, sec. 5.2-5.5, 10.1]
//
// Radiance, importance and their sources are vectors with one number per diffuse element. With form factors F, reflectances
// rho and areas A,
//
//   G   propagation      (G L)_i = sum over j of  F_ij L_j      exitant radiance to the mean incident radiance
//   K   scattering       (K L)_i = rho_i L_i                    incident to reflected radiance
//
// and the inner product is <a, b> = pi sum of A_i a_i b_i, the integral over positions and projected solid angles. With
// respect to it the adjoint of a matrix M is M* = A^-1 M^T A; reciprocity, A_i F_ij = A_j F_ji, makes G and K self-adjoint.
#pragma once
#include <vector>

#include "base/result.h"

namespace etendue::equations {

using Vector = std::vector<double>;
using Rows = std::vector<Vector>;

struct TransportMatrices {
  Rows propagation;    // G
  Vector reflectance;  // the diagonal of K
  Vector area;         // m^2, all positive

  size_t size() const { return area.size(); }
};

// <a, b>
double inner_product(const TransportMatrices& t, const Vector& a, const Vector& b);

// A measurement by its four equivalent formulations [Lang, eq. 5.122-5.135].
struct Measurements {
  double incident_radiance;    // <W_eo, L_i>,  L_i = (I - G K)^-1 G L_eo
  double exitant_importance;   // <W_o, L_ei>,  W_o = (I - K* G*)^-1 W_eo,  L_ei = G L_eo
  double exitant_radiance;     // <W_ei, L_o>,  L_o = (I - K G)^-1 L_eo,    W_ei = G* W_eo
  double incident_importance;  // <W_i, L_eo>,  W_i = (I - G* K*)^-1 G* W_eo
};
// `emitted` is L_eo, `detector` W_eo. An input error if 1 is an eigenvalue.
Result<Measurements> measurements(const TransportMatrices& t, const Vector& emitted, const Vector& detector);

// Exitant radiance and incident importance for these sources.
Result<Vector> exitant_radiance(const TransportMatrices& t, const Vector& emitted);
Result<Vector> incident_importance(const TransportMatrices& t, const Vector& incident_source);

// The solution operator (I - K G)^-1.
Result<Rows> solution_operator(const TransportMatrices& t);
// The part of it that answers incident radiance with reflected radiance: K (I - G K)^-1. Its elements over pi A_j are the
// global reflectance distribution function, which is reciprocal: A_i R_ij = A_j R_ji.
Result<Rows> global_reflectance(const TransportMatrices& t);

// The terms (K G)^n L_e of the Neumann series for n = 0, ..., count - 1.
std::vector<Vector> neumann_terms(const TransportMatrices& t, const Vector& emitted, int count);

// Norms of T = K G as an operator on L^infinity and L^1, and its spectral radius.
struct OperatorNorms {
  double supremum, integral, spectral_radius;
};
OperatorNorms transport_norms(const TransportMatrices& t);

// The eigenvector of T = K G for the eigenvalue of largest modulus, scaled to a largest value of one.
Vector leading_eigenvector(const TransportMatrices& t);

// The eigenpairs of T = K G whose eigenvalues have the largest moduli, in descending order. They are real, because K and G are
// self-adjoint. Each vector has the largest value one.
struct Eigenpair {
  double value = 0;
  Vector vector;
};
std::vector<Eigenpair> leading_eigenpairs(const TransportMatrices& t, int count);

// The matrix of T = K G.
Rows transport_operator(const TransportMatrices& t);

// Powers in W, from radiances in W/(m^2 sr).
struct EnergyBalance {
  double emitted, absorbed, escaped;  // what is neither absorbed nor arrives at an element escapes
};
EnergyBalance energy_balance(const TransportMatrices& t, const Vector& emitted, const Vector& exitant);

}  // namespace etendue::equations
