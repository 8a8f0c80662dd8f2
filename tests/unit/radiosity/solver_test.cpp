// Solvers of the radiosity equation against closed-form solutions and against each other.
#include "radiosity/solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "radiosity/closed_forms.h"
#include "radiosity/solvers/shooting.h"

namespace etendue::radiosity {
namespace {

constexpr SolverKind kAll[] = {SolverKind::gauss_seidel,        SolverKind::jacobi,       SolverKind::neumann,
                               SolverKind::over_relaxation,     SolverKind::southwell,    SolverKind::progressive,
                               SolverKind::conjugate_gradients, SolverKind::direct_solver};
static_assert(std::size(kAll) == Options<SolverKind>::kOptions.size());

const char* name_of(SolverKind kind) { return Options<SolverKind>::kOptions[static_cast<size_t>(kind)].name; }

FormFactors dense(const std::vector<std::vector<double>>& factors, std::vector<double> areas) {
  std::vector<FormFactorRow> rows(factors.size());
  for (size_t i = 0; i < factors.size(); ++i)
    for (uint32_t j = 0; j < factors.size(); ++j)
      if (factors[i][j] > 0) rows[i].push_back({j, static_cast<float>(factors[i][j])});
  return {std::move(rows), std::move(areas)};
}

// Unit cube: element 0 is the top, element 1 the bottom.
FormFactors cube() {
  constexpr double kOpposite = 0.1998248957, kAdjacent = 0.2000437761;
  std::vector<std::vector<double>> f(6, std::vector<double>(6, kAdjacent));
  for (size_t i = 0; i < 6; ++i) {
    f[i][i] = 0;
    f[i][i ^ 1] = kOpposite;
  }
  return dense(f, std::vector<double>(6, 1));
}

RadiositySystem cube_system(const FormFactors& factors, double reflectance) {
  RadiositySystem system{&factors, std::vector<double>(6, reflectance), std::vector<double>(6, 0)};
  system.source[0] = 1;
  return system;
}

SolverSettings exact() { return {.tolerance = 1e-12, .max_sweeps = 20'000, .relaxation = 1.1}; }

TEST(RadiositySolver, CubeWithOneEmittingSide) {
  constexpr double kTable[][4] = {{0.2, 1.009615386, 0.048044545, 0.048085017},
                                  {0.5, 1.090909098, 0.181745826, 0.181836269},
                                  {0.8, 1.551724154, 0.689551071, 0.689681194},
                                  {0.9, 2.372881375, 1.525310551, 1.525452019}};
  const FormFactors factors = cube();
  for (const auto& [rho, top, bottom, side] : kTable)
    for (const SolverKind kind : kAll) {
      const Solution s = solve(kind, cube_system(factors, rho), exact());
      ASSERT_EQ(s.status, SolverStatus::converged) << name_of(kind);
      EXPECT_EQ(s.problem, "");
      const double expected[] = {top, bottom, side, side, side, side};
      // Factors are stored in single precision.
      for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(s.radiosity[i], expected[i], 3e-7 / (1 - rho)) << name_of(kind);
      double sum = 0;
      for (const double b : s.radiosity) sum += b;
      EXPECT_NEAR(sum, 1 / (1 - rho), 1e-6 / (1 - rho)) << name_of(kind);
    }
}

// A closed box of uniform emission and reflectance: B = E / (1 - rho).
TEST(RadiositySolver, Furnace) {
  const FormFactors factors = cube();
  for (const double rho : {0.0, 0.3, 0.9, 0.99})
    for (const SolverKind kind : kAll) {
      RadiositySystem system = cube_system(factors, rho);
      system.source.assign(6, 2);
      const Solution s = solve(kind, system, exact());
      EXPECT_EQ(s.status, SolverStatus::converged) << name_of(kind);
      for (const double b : s.radiosity)
        EXPECT_NEAR(b, 2 / (1 - rho), 1e-6 / sqr(1 - rho)) << name_of(kind) << ' ' << rho;
    }
}

// Concentric spheres of areas 1 and 4. The outer one sees itself, so the diagonal of the matrix is not 1.
TEST(RadiositySolver, ConcentricSpheres) {
  const FormFactors factors = dense({{0, 1}, {0.25, 0.75}}, {1, 4});
  struct Case {
    double rho[2], source[2], radiosity[2];
  };
  const Case cases[] = {{{0.5, 0.8}, {1, 0}, {4.0 / 3, 2.0 / 3}},
                        {{0.5, 0.8}, {0, 1}, {5.0 / 3, 10.0 / 3}},
                        {{0.9, 0.9}, {1, 0}, {2.653061224, 1.836734694}}};
  for (const Case& c : cases)
    for (const SolverKind kind : kAll) {
      const RadiositySystem system{&factors, {c.rho[0], c.rho[1]}, {c.source[0], c.source[1]}};
      const Solution s = solve(kind, system, exact());
      EXPECT_EQ(s.status, SolverStatus::converged) << name_of(kind);
      for (size_t i = 0; i < 2; ++i) EXPECT_NEAR(s.radiosity[i], c.radiosity[i], 1e-6) << name_of(kind);
    }
}

// A sphere of equal parts has the factors A_j / A and the solution B_i = S_i + rho_i mean(S) / (1 - mean(rho)).
TEST(RadiositySolver, SphereOfUnequalPatches) {
  constexpr size_t kParts = 12;
  std::vector<double> areas(kParts);
  double total = 0;
  for (size_t i = 0; i < kParts; ++i) total += areas[i] = 1 + static_cast<double>(i % 4);
  std::vector<std::vector<double>> f(kParts, std::vector<double>(kParts));
  for (auto& row : f)
    for (size_t j = 0; j < kParts; ++j) row[j] = areas[j] / total;
  const FormFactors factors = dense(f, areas);
  RadiositySystem system{&factors, std::vector<double>(kParts), std::vector<double>(kParts)};
  double mean_source = 0, mean_reflectance = 0;
  for (size_t i = 0; i < kParts; ++i) {
    system.source[i] = static_cast<double>(i) / 5;
    system.reflectance[i] = 0.05 * static_cast<double>(i);
    mean_source += areas[i] * system.source[i] / total;
    mean_reflectance += areas[i] * system.reflectance[i] / total;
  }
  for (const SolverKind kind : kAll) {
    const Solution s = solve(kind, system, exact());
    for (size_t i = 0; i < kParts; ++i)
      EXPECT_NEAR(s.radiosity[i], system.source[i] + system.reflectance[i] * mean_source / (1 - mean_reflectance), 1e-6)
          << name_of(kind);
  }
}

TEST(RadiositySolver, NeumannSeriesHasTheIteratesOfJacobi) {
  const FormFactors factors = cube();
  for (int sweeps = 0; sweeps < 6; ++sweeps) {
    const SolverSettings some{.tolerance = 0, .max_sweeps = sweeps};
    const Solution a = solve(SolverKind::neumann, cube_system(factors, 0.8), some),
                   b = solve(SolverKind::jacobi, cube_system(factors, 0.8), some);
    for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(a.radiosity[i], b.radiosity[i], 1e-14);
  }
}

// The residual falls by the spectral radius, which is rho in a closed room, per sweep of Jacobi's method.
TEST(RadiositySolver, OrdersOfConvergence) {
  const FormFactors factors = cube();
  const auto rate = [&](SolverKind kind, double rho) {
    const Solution s = solve(kind, cube_system(factors, rho), {.tolerance = 0, .max_sweeps = 20});
    return std::pow(s.residuals[20] / s.residuals[10], 0.1);
  };
  for (const double rho : {0.5, 0.8}) {
    EXPECT_NEAR(rate(SolverKind::jacobi, rho), rho, 1e-3);
    EXPECT_LT(rate(SolverKind::gauss_seidel, rho), 0.95 * rate(SolverKind::jacobi, rho));
  }
  EXPECT_NEAR(rate(SolverKind::gauss_seidel, 0.5), 0.27, 0.02);
}

TEST(RadiositySolver, SweepsOfOverRelaxation) {
  const FormFactors factors = cube();
  const auto sweeps = [&](double relaxation) {
    const Solution s = solve(SolverKind::over_relaxation, cube_system(factors, 0.5),
                             {.tolerance = 1e-10, .max_sweeps = 5000, .relaxation = relaxation});
    return s.status == SolverStatus::converged ? s.residuals.size() - 1 : 0;
  };
  EXPECT_NEAR(static_cast<double>(sweeps(0.8)), 31, 3);
  EXPECT_NEAR(static_cast<double>(sweeps(1)), 18, 3);
  EXPECT_NEAR(static_cast<double>(sweeps(1.1)), 11, 3);
  EXPECT_NEAR(static_cast<double>(sweeps(1.4)), 27, 3);
  EXPECT_NEAR(static_cast<double>(sweeps(1.9)), 229, 20);
}

TEST(RadiositySolver, DivergenceIsReported) {
  const FormFactors factors = cube();
  for (const double relaxation : {2.0, 2.2, 3.0}) {
    const Solution s = solve(SolverKind::over_relaxation, cube_system(factors, 0.5),
                             {.tolerance = 1e-10, .max_sweeps = 100'000, .relaxation = relaxation});
    EXPECT_EQ(s.status, SolverStatus::diverged) << relaxation;
    EXPECT_NE(s.problem.find("between 0 and 2"), std::string::npos) << s.problem;
    EXPECT_LT(s.residuals.size(), 2000u);
  }
}

TEST(RadiositySolver, TooFewSweepsAreReported) {
  const FormFactors factors = cube();
  const Solution s = solve(SolverKind::jacobi, cube_system(factors, 0.9), {.tolerance = 1e-10, .max_sweeps = 3});
  EXPECT_EQ(s.status, SolverStatus::unfinished);
  EXPECT_NE(s.problem.find("3 sweeps"), std::string::npos) << s.problem;
}

// The error bound must hold at any time.
TEST(RadiositySolver, TheErrorIsBelowItsBound) {
  const FormFactors factors = cube();
  const RadiositySystem system = cube_system(factors, 0.8);
  const Solution reference = solve(SolverKind::direct_solver, system, exact());
  for (const SolverKind kind : kAll)
    for (int sweeps = 0; sweeps < 12; ++sweeps) {
      const Solution s = solve(kind, system, {.tolerance = 0, .max_sweeps = sweeps, .relaxation = 1.3});
      double error = 0, scale = 1;
      for (size_t i = 0; i < 6; ++i) {
        error = std::max(error, std::abs(s.radiosity[i] - reference.radiosity[i]));
        scale = std::max(scale, std::abs(s.radiosity[i]));
      }
      EXPECT_LE(error, s.error_bound * scale * (1 + 1e-9) + 1e-13) << name_of(kind) << ' ' << sweeps;
    }
}

// A solver that is stopped at any point and continued gives the same bits.
TEST(RadiositySolver, CanBeStopped) {
  // Large enough that a sweep polls the stop condition several times.
  constexpr size_t kParts = 900;
  std::vector<double> areas(kParts);
  double total = 0;
  for (size_t i = 0; i < kParts; ++i) total += areas[i] = 1 + static_cast<double>(i % 4);
  std::vector<std::vector<double>> f(kParts, std::vector<double>(kParts));
  for (size_t i = 0; i < kParts; ++i)
    for (size_t j = 0; j < kParts; ++j) f[i][j] = i == j ? 0 : areas[j] / total;
  const FormFactors factors = dense(f, areas);
  RadiositySystem system{&factors, std::vector<double>(kParts, 0.7), std::vector<double>(kParts, 0)};
  for (size_t i = 0; i < kParts; i += 50) system.source[i] = 1 + static_cast<double>(i);
  for (const SolverKind kind : kAll) {
    const SolverSettings settings{.tolerance = 1e-6, .max_sweeps = 30, .relaxation = 1.05};
    const Solution whole = solve(kind, system, settings);
    SolverRun run(kind, system, settings);
    int polls = 0, stops = 0;
    const KeepGoing every_third = [&] { return ++polls % 3 != 0; };
    while (!run.run(&every_third)) ++stops;
    EXPECT_GT(stops, 2) << name_of(kind);
    EXPECT_EQ(run.solution().radiosity, whole.radiosity) << name_of(kind);
    EXPECT_EQ(run.solution().residuals, whole.residuals) << name_of(kind);
    EXPECT_EQ(run.solution().seconds.size(), whole.residuals.size());
    EXPECT_TRUE(std::ranges::is_sorted(run.solution().seconds));
  }
}

// Shots until the unshot power is 1e-10 of the source.
size_t shots_of(const RadiositySystem& system) {
  Shooting shooting(system);
  const double begin = shooting.unshot_power();
  while (shooting.unshot_power() > 1e-10 * begin) shooting.shoot();
  return shooting.shots();
}

TEST(RadiositySolver, ShotsOfSouthwell) {
  const FormFactors factors = cube();
  EXPECT_EQ(shots_of(cube_system(factors, 0.5)), 106u);
  // Every shot absorbs the share 1 - rho of the strongest of six powers, so the power falls at least by this factor.
  for (const double rho : {0.2, 0.5, 0.8, 0.9})
    EXPECT_LE(static_cast<double>(shots_of(cube_system(factors, rho))),
              1 + std::log(1e-10) / std::log(1 - (1 - rho) / 6));
}

// Reflectances above 1: the light grows with every reflection.
TEST(RadiositySolver, ReflectanceAboveOne) {
  const FormFactors factors = cube();
  for (const SolverKind kind : kAll) {
    const Solution s = solve(kind, cube_system(factors, 1.2), {.tolerance = 1e-6, .max_sweeps = 5000});
    // Elimination and conjugate gradients find a solution of the equation, which has negative radiosities.
    const bool solves_any_system = kind == SolverKind::direct_solver || kind == SolverKind::conjugate_gradients;
    if (!solves_any_system) {
      EXPECT_EQ(s.status, SolverStatus::diverged) << name_of(kind);
    }
    EXPECT_NE(s.problem.find("reflectance 1 or more"), std::string::npos) << name_of(kind) << s.problem;
    EXPECT_TRUE(std::isinf(s.error_bound)) << name_of(kind);
  }
}

// Reflectance 1 in a closed room has no solution; a message says so, and nothing crashes.
TEST(RadiositySolver, ReflectanceOne) {
  const FormFactors factors = cube();
  for (const SolverKind kind : kAll) {
    const Solution s = solve(kind, cube_system(factors, 1), {.tolerance = 1e-6, .max_sweeps = 50});
    EXPECT_NE(s.problem.find("reflectance 1 or more"), std::string::npos) << name_of(kind);
  }
}

TEST(RadiositySolver, WithoutLightOrElements) {
  const FormFactors factors = cube(), none;
  for (const SolverKind kind : kAll) {
    RadiositySystem dark = cube_system(factors, 0.5);
    dark.source.assign(6, 0);
    for (const double b : solve(kind, dark, {}).radiosity) EXPECT_EQ(b, 0) << name_of(kind);
    const RadiositySystem empty{&none, {}, {}};
    EXPECT_TRUE(solve(kind, empty, {}).radiosity.empty()) << name_of(kind);
  }
}

// Shooting by power: the unshot power falls although areas differ by a factor of 64.
TEST(RadiositySolver, UnshotPowerFalls) {
  constexpr size_t kSmall = 64;
  std::vector<std::vector<double>> f(kSmall + 1, std::vector<double>(kSmall + 1));
  std::vector<double> areas(kSmall + 1, 1.0 / kSmall);
  areas[kSmall] = 1;
  for (size_t i = 0; i < kSmall; ++i) {
    f[i][kSmall] = 0.9;
    f[kSmall][i] = 0.9 / kSmall;
  }
  const FormFactors factors = dense(f, areas);
  RadiositySystem system{&factors, std::vector<double>(kSmall + 1, 0.8), std::vector<double>(kSmall + 1, 0)};
  system.source[kSmall] = 1;
  Shooting shooting(system);
  double power = shooting.unshot_power();
  for (int sweep = 0; sweep < 20; ++sweep) {
    shooting.sweep(nullptr);
    EXPECT_LT(shooting.unshot_power(), power);
    power = shooting.unshot_power();
  }
  const Solution reference = solve(SolverKind::direct_solver, system, exact());
  for (const SolverKind kind : {SolverKind::southwell, SolverKind::progressive}) {
    const Solution s = solve(kind, system, exact());
    EXPECT_EQ(s.status, SolverStatus::converged);
    for (size_t i = 0; i <= kSmall; ++i) EXPECT_NEAR(s.radiosity[i], reference.radiosity[i], 1e-9);
  }
}

// A rectangle with the corner `at` and the edges u and v; its front is on the side of u x v.
Polygon rectangle(const DVec3& at, const DVec3& u, const DVec3& v) { return {at, at + u, at + u + v, at + v}; }

// The unit cube from inside, with its ceiling divided into 8 x 8 squares. The first five elements are floor and walls.
FormFactors cube_with_divided_ceiling() {
  constexpr int kSteps = 8;
  std::vector<Polygon> sides{rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1}),
                             rectangle({1, 0, 0}, {0, 0, 1}, {0, 1, 0}), rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                             rectangle({0, 0, 1}, {0, 1, 0}, {1, 0, 0})};
  std::vector<double> areas(sides.size(), 1);
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      sides.push_back(rectangle({i / 8.0, 1, j / 8.0}, {1 / 8.0, 0, 0}, {0, 0, 1 / 8.0}));
      areas.push_back(1 / 64.0);
    }
  std::vector<std::vector<double>> f(sides.size(), std::vector<double>(sides.size()));
  for (size_t i = 0; i < sides.size(); ++i)
    for (size_t j = 0; j < 5; ++j)
      if (i != j) {
        f[i][j] = contour_exchange(sides[i], sides[j]) / areas[i];
        f[j][i] = areas[i] * f[i][j] / areas[j];
      }
  return dense(f, areas);
}

// With unequal areas, the columns of rho F are not bounded by the reflectance, and the sum of the residuals can grow. The
// unshot power cannot: a shot takes away the share 1 - rho of the largest of n powers at least.
TEST(RadiositySolver, TheNormOfSouthwellIsPower) {
  constexpr double kReflectance = 0.8;
  const FormFactors factors = cube_with_divided_ceiling();
  const size_t n = factors.size();
  double largest_column = 0;
  for (size_t j = 0; j < n; ++j) {
    double sum = 0;
    for (size_t i = 0; i < n; ++i) sum += i == j ? 0 : kReflectance * factors.factor(i, j);
    largest_column = std::max(largest_column, sum);
    EXPECT_NEAR(factors.closure(j), 1, 1e-6);
  }
  EXPECT_NEAR(largest_column, 10.9, 0.05);

  RadiositySystem system{&factors, std::vector<double>(n, kReflectance), std::vector<double>(n, 0)};
  system.source[0] = 1;
  Shooting shooting(system);
  const auto sum_of_residuals = [&] {
    double sum = 0;
    for (const double r : shooting.unshot()) sum += std::abs(r);
    return sum;
  };
  double power = shooting.unshot_power(), residuals = sum_of_residuals(), largest_growth = 0;
  const double first = power;
  while (power > 1e-8 * first && shooting.shots() < 100'000) {
    shooting.shoot();
    EXPECT_LE(shooting.unshot_power(), power * (1 - (1 - kReflectance) / static_cast<double>(n)) * (1 + 1e-6));
    largest_growth = std::max(largest_growth, sum_of_residuals() / residuals);
    power = shooting.unshot_power();
    residuals = sum_of_residuals();
  }
  EXPECT_GT(largest_growth, 10) << "the first shot, from the floor, is that of the largest column";
  EXPECT_LT(largest_growth, largest_column);
}

}  // namespace
}  // namespace etendue::radiosity
