// Operators of light transport as matrices: closed forms of parallel plates and concentric spheres.
#include "equations/transport_matrices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace etendue::equations {
namespace {

// Two infinite parallel plates of equal areas see nothing but each other.
TransportMatrices plates(double rho0, double rho1) {
  return {.propagation = {{0, 1}, {1, 0}}, .reflectance = {rho0, rho1}, .area = {1, 1}};
}
// The outside of a sphere of area 1 in a sphere of area 4.
TransportMatrices spheres(double rho0, double rho1) {
  return {.propagation = {{0, 1}, {0.25, 0.75}}, .reflectance = {rho0, rho1}, .area = {1, 4}};
}
// An open arrangement of three elements with reciprocal form factors.
TransportMatrices open_scene() {
  return {.propagation = {{0, 0.3, 0.4}, {0.15, 0, 0.6}, {0.1, 0.3, 0.2}},
          .reflectance = {0.8, 0.3, 0.6},
          .area = {1, 2, 4}};
}

TEST(TransportMatrices, RadianceHasItsClosedForms) {
  const Vector light{1, 0};
  const Vector between = *exitant_radiance(plates(0.5, 0.8), light);
  EXPECT_NEAR(between[0], 1 / 0.6, 1e-12);
  EXPECT_NEAR(between[1], 0.8 / 0.6, 1e-12);
  const Vector inner = *exitant_radiance(spheres(0.5, 0.8), light);
  EXPECT_NEAR(inner[0], 4.0 / 3, 1e-12);
  EXPECT_NEAR(inner[1], 2.0 / 3, 1e-12);
  const Vector outer = *exitant_radiance(spheres(0.5, 0.8), {0, 1});
  EXPECT_NEAR(outer[0], 5.0 / 3, 1e-12);
  EXPECT_NEAR(outer[1], 10.0 / 3, 1e-12);
  const Vector bright = *exitant_radiance(spheres(0.9, 0.9), light);
  EXPECT_NEAR(bright[0], 2.653061, 1e-6);
  EXPECT_NEAR(bright[1], 1.836735, 1e-6);
}

TEST(TransportMatrices, FormulationsOfAMeasurementAreEqual) {
  for (const TransportMatrices& t : {spheres(0.5, 0.8), spheres(0.9, 0.9)}) {
    const Measurements m = *measurements(t, {1, 0.2}, {0.3, 0.1});
    for (const double value : {m.incident_radiance, m.exitant_importance, m.incident_importance})
      EXPECT_NEAR(value, m.exitant_radiance, 1e-12 * m.exitant_radiance);
  }
  const Measurements m = *measurements(open_scene(), {1, 0, 2}, {0, 0.5, 0.1});
  for (const double value : {m.incident_radiance, m.exitant_importance, m.incident_importance})
    EXPECT_NEAR(value, m.exitant_radiance, 1e-12 * m.exitant_radiance);
}

// Without reciprocity G is not self-adjoint; the formulations with adjoints are still equal.
TEST(TransportMatrices, AdjointsNeedNoReciprocity) {
  TransportMatrices t = open_scene();
  t.propagation[0][1] = 0.05;
  const Measurements m = *measurements(t, {1, 0, 2}, {0, 0.5, 0.1});
  EXPECT_NEAR(m.exitant_importance, m.exitant_radiance, 1e-12);
  EXPECT_NEAR(m.incident_importance, m.exitant_radiance, 1e-12);
}

TEST(TransportMatrices, NormsAndSpectralRadius) {
  const OperatorNorms norms = transport_norms(plates(0.5, 0.8));
  EXPECT_NEAR(norms.supremum, 0.8, 1e-12);
  EXPECT_NEAR(norms.integral, 0.8, 1e-12);
  EXPECT_NEAR(norms.spectral_radius, std::sqrt(0.4), 1e-12);
  // The larger root of x^2 - 0.6 x - 0.1, the characteristic polynomial of K G of the spheres.
  EXPECT_NEAR(transport_norms(spheres(0.5, 0.8)).spectral_radius, 0.3 + std::sqrt(0.19), 1e-12);
}

TEST(TransportMatrices, LeadingEigenvectorIsOne) {
  const TransportMatrices t = spheres(0.5, 0.8);
  const Vector v = leading_eigenvector(t);
  const double radius = transport_norms(t).spectral_radius;
  const Vector transported = neumann_terms(t, v, 2)[1];
  for (size_t i = 0; i < 2; ++i) EXPECT_NEAR(transported[i], radius * v[i], 1e-12);
}

// The two eigenvalues of the spheres are 0.3 +- sqrt(0.19).
TEST(TransportMatrices, EigenpairsOfSpheres) {
  const TransportMatrices t = spheres(0.5, 0.8);
  const auto pairs = leading_eigenpairs(t, 5);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_NEAR(pairs[0].value, 0.3 + std::sqrt(0.19), 1e-12);
  EXPECT_NEAR(pairs[1].value, 0.3 - std::sqrt(0.19), 1e-12);
  const Rows transport = transport_operator(t);
  for (const Eigenpair& pair : pairs)
    for (size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(transport[i][0] * pair.vector[0] + transport[i][1] * pair.vector[1], pair.value * pair.vector[i],
                  1e-12);
}

TEST(TransportMatrices, SeriesSumsToTheSolution) {
  const TransportMatrices t = open_scene();
  const Vector light{1, 0, 2}, solution = *exitant_radiance(t, light);
  Vector sum(3, 0.0);
  for (const Vector& term : neumann_terms(t, light, 200))
    for (size_t i = 0; i < 3; ++i) sum[i] += term[i];
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(sum[i], solution[i], 1e-12);
}

TEST(TransportMatrices, GlobalReflectanceIsReciprocal) {
  const TransportMatrices t = open_scene();
  const Rows r = *global_reflectance(t);
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) EXPECT_NEAR(t.area[i] * r[i][j], t.area[j] * r[j][i], 1e-12);
}

TEST(TransportMatrices, EnergyIsConserved) {
  const Vector light{1, 0, 2};
  const EnergyBalance open = energy_balance(open_scene(), light, *exitant_radiance(open_scene(), light));
  EXPECT_NEAR(open.emitted, 9 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(open.absorbed + open.escaped, open.emitted, 1e-12);
  EXPECT_GT(open.escaped, 1);
  const TransportMatrices closed = spheres(0.5, 0.8);
  EXPECT_NEAR(energy_balance(closed, {1, 0}, *exitant_radiance(closed, {1, 0})).escaped, 0, 1e-12);
}

TEST(TransportMatrices, ClosedWhiteScenesHaveNoSolution) {
  const auto solution = exitant_radiance(plates(1, 1), {1, 0});
  ASSERT_FALSE(solution);
  EXPECT_NE(solution.error().message.find("no solution"), std::string::npos);
  EXPECT_FALSE(solution_operator(spheres(1, 1)));
}

}  // namespace
}  // namespace etendue::equations
