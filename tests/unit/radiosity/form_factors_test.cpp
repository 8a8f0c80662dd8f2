// Meshes of patches, and all form factor methods against closed forms.
#include "radiosity/form_factors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "radiosity/closed_forms.h"
#include "radiosity/hemicube.h"
#include "radiosity/irradiance_field.h"
#include "radiosity/parameters.h"
#include "radiosity/reconstruction.h"
#include "radiosity/reflectance.h"
#include "sampling/random.h"
#include "sampling/sobol.h"
#include "scene/builtin/shapes.h"

namespace etendue::radiosity {
namespace {

using scene::add;
using scene::diffuse;

constexpr FormFactorMethod kMethods[] = {FormFactorMethod::hemisphere,       FormFactorMethod::nusselt,
                                         FormFactorMethod::hemicube,         FormFactorMethod::area_sampling,
                                         FormFactorMethod::point_to_polygon, FormFactorMethod::contour_integration};
static_assert(std::size(kMethods) == Options<FormFactorMethod>::kOptions.size());

const char* name_of(FormFactorMethod method) {
  return Options<FormFactorMethod>::kOptions[static_cast<size_t>(method)].name;
}

std::shared_ptr<const scene::CompiledScene> compiled(scene::Scene scene) {
  return scene::compile(std::make_shared<const scene::Scene>(std::move(scene)), Camera(), nullptr);
}

// A closed cube of edge 1 seen from inside.
std::shared_ptr<const scene::CompiledScene> unit_cube() {
  scene::Scene s;
  add(s, scene::cube(0.5f, true), diffuse(Rgb(0.5f)));
  return compiled(std::move(s));
}

std::vector<FormFactorRow> rows_of(const scene::CompiledScene& scene, const PatchMesh& mesh,
                                   const FormFactorSettings& settings, const Sampler& sampler, uint64_t seed = 1) {
  std::vector<FormFactorRow> rows;
  RowBuilder builder;
  for (uint32_t e = 0; e < mesh.element_count(); ++e) {
    builder.begin(mesh.element_count());
    info_of(settings.method).add_row({scene, mesh, sampler, e, settings.samples, seed, builder});
    rows.push_back(builder.finish());
  }
  return rows;
}

FormFactors factors_of(const scene::CompiledScene& scene, const PatchMesh& mesh, const FormFactorSettings& settings) {
  return {rows_of(scene, mesh, settings, SobolSampler()), element_areas(mesh)};
}

// The factor between the sides of a cube with these inward normals, from the estimated rows of their patches.
double side_factor(const PatchMesh& mesh, const std::vector<FormFactorRow>& rows, const Vec3& from, const Vec3& to) {
  double sum = 0, area = 0;
  for (uint32_t i = 0; i < mesh.element_count(); ++i) {
    if (glm::dot(mesh.normal_of(i), from) < 0.99f || !PatchMesh::is_front(i)) continue;
    const double a = mesh.patch_of(i).area;
    area += a;
    for (const FormFactor& f : rows[i])
      if (glm::dot(mesh.normal_of(f.element), to) > 0.99f) sum += a * static_cast<double>(f.value);
  }
  return sum / area;
}

// How each method is used for the cube, and its accuracy for opposite and adjacent sides.
struct Accuracy {
  int steps;
  uint32_t samples;
  double opposite, adjacent;
};
Accuracy accuracy_of(FormFactorMethod method) {
  switch (method) {
    // 5 standard deviations sqrt(F (1 - F) / N) of N independent rays from the two patches of a side.
    case FormFactorMethod::hemisphere:
      return {1, 16'384, 5 * 0.4 / std::sqrt(2 * 16'384.0), 5 * 0.4 / std::sqrt(2 * 16'384.0)};
    // One point stands for a patch.
    case FormFactorMethod::nusselt:
      return {6, 96 * 96, 3e-3, 3e-3};
    case FormFactorMethod::hemicube:
      return {6, 3 * 64 * 64, 3e-3, 3e-3};
    // 5 standard deviations of 0.0693 for opposite sides; infinite variance for adjacent ones.
    case FormFactorMethod::area_sampling:
      return {1, 16'384, 5 * 0.0693 / 128, 0.02};
    case FormFactorMethod::point_to_polygon:
      return {1, 4096, 2e-3, 2e-3};
    case FormFactorMethod::contour_integration:
      return {1, 4, 1e-6, 1e-6};
  }
  return {};
}

TEST(FormFactors, UnitCubeByEveryMethod) {
  const auto scene = unit_cube();
  for (const FormFactorMethod method : kMethods) {
    const Accuracy a = accuracy_of(method);
    const PatchMesh mesh(*scene, {Meshing::uniform, 0, a.steps});
    const auto rows = rows_of(*scene, mesh, {method, a.samples}, SobolSampler());
    const double opposite = side_factor(mesh, rows, {0, 1, 0}, {0, -1, 0});
    const double adjacent = side_factor(mesh, rows, {0, 1, 0}, {1, 0, 0});
    EXPECT_NEAR(opposite, 0.1998248957, a.opposite) << name_of(method);
    EXPECT_NEAR(adjacent, 0.2000437761, a.adjacent) << name_of(method);
    EXPECT_NEAR(opposite, parallel_rectangles(1, 1, 1), a.opposite);
  }
}

// Two rectangles with a closed form.
struct RectanglePair {
  const char* name;
  scene::Scene scene;
  double factor;  // from the first to the second
};
std::vector<RectanglePair> rectangle_pairs() {
  std::vector<RectanglePair> list;
  // Side a along x, b along z; the floor faces up, the ceiling at height c faces down.
  const auto parallel = [&](const char* name, float a, float b, float c) {
    scene::Scene s;
    add(s, scene::rectangle({0, 0, 0}, {0, 0, b}, {a, 0, 0}), diffuse(Rgb(0.5f)));
    add(s, scene::rectangle({0, c, 0}, {a, 0, 0}, {0, 0, b}), diffuse(Rgb(0.5f)));
    list.push_back({name, std::move(s),
                    parallel_rectangles(static_cast<double>(a), static_cast<double>(b), static_cast<double>(c))});
  };
  // A floor of this depth along x, a wall of this height at x = 0, an edge of length 1 along z.
  const auto perpendicular = [&](const char* name, float depth, float height) {
    scene::Scene s;
    add(s, scene::rectangle({0, 0, 0}, {0, 0, 1}, {depth, 0, 0}), diffuse(Rgb(0.5f)));
    add(s, scene::rectangle({0, 0, 0}, {0, height, 0}, {0, 0, 1}), diffuse(Rgb(0.5f)));
    list.push_back(
        {name, std::move(s), perpendicular_rectangles(static_cast<double>(depth), static_cast<double>(height))});
  };
  parallel("parallel 1 x 1 at 0.5", 1, 1, 0.5f);
  parallel("parallel 1 x 1 at 2", 1, 1, 2);
  parallel("parallel 2 x 1 at 1", 2, 1, 1);
  parallel("parallel 1 x 2 at 3", 1, 2, 3);
  perpendicular("perpendicular 2, 1", 2, 1);
  perpendicular("perpendicular 0.25, 1.5", 0.25f, 1.5f);
  perpendicular("perpendicular 3, 0.25", 3, 0.25f);
  return list;
}

// The factor of one estimate between the rectangles, whose patches are the first and the second half of the mesh.
double pair_factor(const scene::CompiledScene& scene, const PatchMesh& mesh, const FormFactorSettings& settings,
                   const Sampler& sampler, uint64_t seed) {
  const auto rows = rows_of(scene, mesh, settings, sampler, seed);
  const size_t half = mesh.element_count() / 2;
  double sum = 0, area = 0;
  for (size_t i = 0; i < half; i += 2) {
    const double a = mesh.patches()[i / 2].area;
    area += a;
    for (const FormFactor& f : rows[i])
      if (f.element >= half) sum += a * static_cast<double>(f.value);
  }
  return sum / area;
}

// Deterministic methods stay below a stated error. The mean of eight independent estimates of the others is within five
// of its standard errors, which hemisphere sampling states itself: sqrt(F (1 - F) / N) for N rays.
TEST(FormFactors, RectanglesByEveryMethod) {
  for (RectanglePair& pair : rectangle_pairs()) {
    const auto scene = compiled(std::move(pair.scene));
    const RandomSampler random;
    for (const FormFactorMethod method : kMethods) {
      const bool from_centroid = method == FormFactorMethod::hemicube || method == FormFactorMethod::nusselt;
      const PatchMesh mesh(*scene, {Meshing::uniform, 0, from_centroid ? 6 : 1});
      const uint32_t samples = from_centroid ? 4096 : method == FormFactorMethod::contour_integration ? 1 : 2048;
      const std::string what = std::string(name_of(method)) + ", " + pair.name;
      if (from_centroid || method == FormFactorMethod::contour_integration) {
        const double bound = from_centroid ? 6e-3 : 1e-6;
        EXPECT_NEAR(pair_factor(*scene, mesh, {method, samples}, random, 1), pair.factor, bound) << what;
        continue;
      }
      constexpr int kRuns = 8;
      double mean = 0, squares = 0;
      for (int run = 0; run < kRuns; ++run) {
        const double f = pair_factor(*scene, mesh, {method, samples}, random, static_cast<uint64_t>(run));
        mean += f / kRuns;
        squares += f * f / kRuns;
      }
      const double error = std::sqrt(std::max(0.0, squares - mean * mean) / (kRuns - 1));
      const bool heavy_tailed = method == FormFactorMethod::area_sampling && pair.name[1] == 'e';
      // The mean of a distribution of infinite variance is dominated by rare large values, which may be missing.
      EXPECT_NEAR(mean, pair.factor, 6 * error + (heavy_tailed ? 0.05 * pair.factor : 1e-5)) << what;
      if (method == FormFactorMethod::hemisphere) {
        const double expected = std::sqrt(pair.factor * (1 - pair.factor) / (2.0 * samples * kRuns));
        EXPECT_LT(error, 2.5 * expected) << what;
        EXPECT_NEAR(mean, pair.factor, 5 * expected) << what;
      }
    }
  }
}

// The standard deviation of one pair of points between opposite unit squares is 0.0693 by area sampling, of one ray
// 0.3999 by hemisphere sampling.
TEST(FormFactors, StandardDeviations) {
  scene::Scene s;
  add(s, scene::rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), diffuse(Rgb(0.5f)));
  add(s, scene::rectangle({0, 1, 0}, {1, 0, 0}, {0, 0, 1}), diffuse(Rgb(0.5f)));
  const auto scene = compiled(std::move(s));
  const PatchMesh mesh(*scene, {Meshing::uniform, 0, 1});
  const RandomSampler random;
  const auto deviation = [&](FormFactorMethod method, double points) {
    constexpr int kRuns = 400;
    double mean = 0, squares = 0;
    for (int run = 0; run < kRuns; ++run) {
      const double f = pair_factor(*scene, mesh, {method, 64}, random, static_cast<uint64_t>(run));
      mean += f / kRuns;
      squares += f * f / kRuns;
    }
    return std::sqrt((squares - mean * mean) * points);
  };
  // Two triangles share the rays; four pairs of triangles stratify the pairs of points, which can only reduce the
  // deviation. The relative error of a deviation from 400 runs is 3.5 %.
  EXPECT_NEAR(deviation(FormFactorMethod::hemisphere, 2 * 64), 0.3999, 0.06);
  EXPECT_LT(deviation(FormFactorMethod::area_sampling, 4 * 64), 1.15 * 0.0693);
  EXPECT_GT(deviation(FormFactorMethod::area_sampling, 4 * 64), 0.6 * 0.0693);
}

TEST(FormFactors, SumOfTheHemicube) {
  const auto sum = [](int resolution) {
    double all = 0;
    for (const HemicubeCell& cell : hemicube_cells(resolution)) all += cell.factor;
    return all;
  };
  EXPECT_NEAR(sum(8), 1.00857, 1e-5);
  EXPECT_NEAR(sum(16), 1.00212, 1e-5);
  EXPECT_NEAR(sum(64), 1.00013, 1e-5);
  double top = 0;
  for (const HemicubeCell& cell : hemicube_cells(256))
    if (cell.direction.z >= std::max(std::abs(cell.direction.x), std::abs(cell.direction.y))) top += cell.factor;
  EXPECT_NEAR(top, 4 * point_to_rectangle(1, 1, 1), 1e-5);
}

// Reciprocity, closure in a closed room, and signs, for each method.
TEST(FormFactors, Properties) {
  const auto scene = unit_cube();
  const PatchMesh mesh(*scene, {Meshing::uniform, 0, 3});
  for (const FormFactorMethod method : kMethods) {
    const bool by_pair = info_of(method).samples_pairs;
    const FormFactors factors = factors_of(*scene, mesh, {method, by_pair ? 16u : 1024u});
    for (size_t i = 0; i < factors.size(); ++i) {
      if (!PatchMesh::is_front(static_cast<uint32_t>(i))) {
        EXPECT_TRUE(factors.exchanges(i).empty()) << "back sides see nothing";
        continue;
      }
      const double tolerance = method == FormFactorMethod::area_sampling ? 0.3 : 0.03;
      EXPECT_NEAR(factors.closure(i), 1, tolerance) << name_of(method);
      EXPECT_EQ(factors.factor(i, i), 0);
      for (const FormFactor& f : factors.exchanges(i)) {
        EXPECT_GT(f.value, 0);
        const double back = factors.factor(f.element, i) * factors.areas()[f.element];
        EXPECT_NEAR(back, static_cast<double>(f.value), 1e-12) << name_of(method);
      }
    }
    if (by_pair) continue;
    EXPECT_NEAR(factors.quality().mean_closure, 1, 1e-4) << name_of(method);
    EXPECT_LT(factors.quality().scaling_error, 1e-4) << name_of(method);
  }
}

// A sphere: F_ij = A_j / A for any i and j. The chi-square statistic of one row is compared with its distribution at a
// false-alarm rate of 1e-4 for all rows.
TEST(FormFactors, Sphere) {
  scene::Scene s;
  add(s, scene::sphere(1, 96, true), diffuse(Rgb(0.5f)));
  const auto scene = compiled(std::move(s));
  const PatchMesh mesh(*scene, {Meshing::uniform, 0, 1});
  constexpr uint32_t kRays = 40'000, kRows = 8;
  const RandomSampler random;
  RowBuilder builder;
  for (uint32_t n = 0; n < kRows; ++n) {
    const uint32_t element = 2 * static_cast<uint32_t>(n * mesh.patches().size() / kRows);
    builder.begin(mesh.element_count());
    info_of(FormFactorMethod::hemisphere).add_row({*scene, mesh, random, element, kRays, 5, builder});
    // Cells of 128 consecutive patches. The cell with the element itself, which a flat patch cannot see, is left out.
    std::map<uint32_t, std::pair<double, double>> cells;  // observed and expected rays
    for (uint32_t p = 0; p < mesh.patches().size(); ++p)
      cells[p / 128].second += kRays * static_cast<double>(mesh.patches()[p].area) / mesh.quality().area;
    for (const FormFactor& f : builder.finish()) cells[f.element / 256].first += kRays * static_cast<double>(f.value);
    cells.erase(element / 256);
    double chi2 = 0;
    for (const auto& [cell, rays] : cells) chi2 += sqr(rays.first - rays.second) / rays.second;
    const auto degrees = static_cast<double>(cells.size());
    // Wilson and Hilferty's normal approximation; 4.3 standard deviations.
    const double z = (std::cbrt(chi2 / degrees) - (1 - 2 / (9 * degrees))) / std::sqrt(2 / (9 * degrees));
    EXPECT_LT(z, 4.3) << "element " << element;
  }
}

// A wall between two squares blocks all light; a part of it blocks as much for every method.
TEST(FormFactors, Occlusion) {
  const auto squares = [](float wall) {
    scene::Scene s;
    add(s, scene::rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), diffuse(Rgb(0.5f)));
    add(s, scene::rectangle({0, 1, 0}, {1, 0, 0}, {0, 0, 1}), diffuse(Rgb(0.5f)));
    if (wall > 0) add(s, scene::rectangle({-4, 0.5f, -4}, {4 + wall, 0, 0}, {0, 0, 9}), diffuse(Rgb(0.5f)));
    return compiled(std::move(s));
  };
  const auto factor = [](const scene::CompiledScene& scene, FormFactorMethod method) {
    const PatchMesh mesh(scene, {Meshing::uniform, 0, 3});
    const FormFactors factors = factors_of(scene, mesh, {method, info_of(method).samples_pairs ? 64u : 8192u});
    double sum = 0;
    for (uint32_t i = 0; i < 18; ++i)
      for (uint32_t j = 18; j < 36; ++j) sum += factors.areas()[2 * i] * factors.factor(2 * i, 2 * j);
    return sum;
  };
  for (const FormFactorMethod method : kMethods) {
    EXPECT_NEAR(factor(*squares(0), method), parallel_rectangles(1, 1, 1), 5e-3) << name_of(method);
    EXPECT_EQ(factor(*squares(5), method), 0) << name_of(method);
    // These replace each patch by a point, and with it half-shadows by steps.
    const bool from_centroid = method == FormFactorMethod::hemicube || method == FormFactorMethod::nusselt;
    const double tolerance = from_centroid ? 0.02 : 3e-3;
    EXPECT_NEAR(factor(*squares(0.45f), method), factor(*squares(0.45f), FormFactorMethod::point_to_polygon), tolerance)
        << name_of(method);
  }
}

TEST(PatchMesh, DividesTrianglesAndFindsPoints) {
  scene::Scene s;
  add(s, scene::rectangle({0, 0, 0}, {0, 0, 2}, {3, 0, 0}), diffuse(Rgb(0.5f)));
  const auto scene = compiled(std::move(s));
  for (const int steps : {1, 2, 5, 13}) {
    const PatchMesh mesh(*scene, {Meshing::uniform, 0, steps});
    EXPECT_EQ(mesh.patches().size(), static_cast<size_t>(2 * steps * steps));
    EXPECT_NEAR(mesh.quality().area, 6, 1e-5);
    EXPECT_NEAR(mesh.quality().smallest, mesh.quality().largest, 1e-6);
    for (uint32_t p = 0; p < mesh.patches().size(); ++p)
      for (const Vec2 b : {Vec2(0.3f, 0.3f), Vec2(0.1f, 0.8f), Vec2(0.05f, 0.05f)}) {
        const Vec2 in_triangle = mesh.in_triangle(p, b);
        const auto at = mesh.locate(0, mesh.patches()[p].triangle, in_triangle.x, in_triangle.y, false);
        EXPECT_EQ(at.element, 2 * p + 1);
        EXPECT_NEAR(at.barycentric.x, b.x, 1e-4f);
        EXPECT_NEAR(at.barycentric.y, b.y, 1e-4f);
      }
  }
  EXPECT_EQ(count_patches(*scene, {Meshing::area, 200, 0}), 200u);
}

TEST(PatchMesh, DropsTrianglesWithoutArea) {
  auto mesh = std::make_shared<Mesh>(*scene::rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}));
  mesh->triangles.push_back({0, 0, 1});
  mesh->triangles.push_back({1, 1, 1});
  scene::Scene s;
  add(s, mesh, diffuse(Rgb(0.5f)));
  const auto scene = compiled(std::move(s));
  const PatchMesh patches(*scene, {Meshing::area, 10, 0});
  EXPECT_EQ(patches.quality().degenerate, 2u);
  EXPECT_EQ(patches.locate(0, 2, 0.3f, 0.3f, true).element, kNoElement);
  EXPECT_GT(patches.element_count(), 0u);
}

// Instances of one mesh have patches of their own, also if they are mirrored.
TEST(PatchMesh, Instances) {
  scene::Scene s;
  const auto square = scene::rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  const auto mirror = glm::mat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1);
  add(s, square, diffuse(Rgb(0.5f)));
  s.nodes.push_back(s.nodes.back());
  s.nodes.back().transform.matrix = mirror;
  s.roots.push_back(static_cast<int>(s.nodes.size()) - 1);
  const auto scene = compiled(std::move(s));
  const PatchMesh mesh(*scene, {Meshing::uniform, 0, 2});
  ASSERT_EQ(scene->instances().size(), 2u);
  ASSERT_EQ(mesh.patches().size(), 16u);
  EXPECT_NEAR(mesh.quality().area, 2, 1e-6);
  EXPECT_NEAR(glm::dot(mesh.patches()[0].normal, mesh.patches()[8].normal), 1, 1e-6f) << "the front stays the front";
  EXPECT_LT(mesh.patches()[8].p0.x, 0);
}

// Linear reconstruction of a constant is constant, and of a linear function exact inside a convex surface.
TEST(Reconstruction, ConstantAndLinearFunctions) {
  scene::Scene s;
  add(s, scene::rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), diffuse(Rgb(0.5f)));
  const auto scene = compiled(std::move(s));
  const PatchMesh mesh(*scene, {Meshing::uniform, 0, 8});
  const PatchVertices vertices(mesh);
  const std::vector<Rgb> constant(mesh.element_count(), Rgb(3));
  std::vector<Rgb> ramp;
  for (uint32_t e = 0; e < mesh.element_count(); ++e)
    ramp.push_back(Rgb(mesh.patch_of(e).point(Vec2(1.0f / 3)).x + (PatchMesh::is_front(e) ? 0.0f : 10.0f)));
  const auto flat = vertices.at_vertices(mesh, constant), sloped = vertices.at_vertices(mesh, ramp);
  for (uint32_t e = 0; e < mesh.element_count(); ++e) {
    const Patch& patch = mesh.patch_of(e);
    const Vec2 b(0.2f, 0.5f);
    EXPECT_NEAR(vertices.interpolate(flat, {e, b}).r, 3, 1e-5f);
    const Vec3 at = patch.point(b);
    if (std::min({at.x, at.z, 1 - at.x, 1 - at.z}) < 0.2f) continue;
    EXPECT_NEAR(vertices.interpolate(sloped, {e, b}).r, at.x + (PatchMesh::is_front(e) ? 0 : 10), 0.02f);
  }
}

// Patches at the same place and patches that intersect: factors stay within their bounds, and the light of a room that
// contains them is finite.
TEST(FormFactors, CoincidentAndInterpenetratingPatches) {
  for (const bool coincident : {true, false}) {
    scene::Scene s;
    add(s, scene::cube(0.5f, true), diffuse(Rgb(0.5f)));
    add(s, scene::rectangle({-0.3f, 0, -0.3f}, {0, 0, 0.6f}, {0.6f, 0, 0}), diffuse(Rgb(0.5f)));
    if (coincident)
      add(s, scene::rectangle({-0.3f, 0, -0.3f}, {0, 0, 0.6f}, {0.6f, 0, 0}), diffuse(Rgb(0.9f)));
    else
      add(s, scene::rectangle({0, -0.3f, -0.3f}, {0, 0, 0.6f}, {0, 0.6f, 0}), diffuse(Rgb(0.9f)));
    const auto scene = compiled(std::move(s));
    const PatchMesh mesh(*scene, {Meshing::area, 150, 0});
    for (const FormFactorMethod method : kMethods) {
      const FormFactors factors = factors_of(*scene, mesh, {method, info_of(method).samples_pairs ? 8u : 512u});
      for (size_t i = 0; i < factors.size(); ++i) {
        EXPECT_LE(factors.closure(i), 1.01) << name_of(method);
        for (const FormFactor& f : factors.exchanges(i)) EXPECT_TRUE(f.value > 0 && std::isfinite(f.value));
      }
      const std::vector<Rgb> reflectance = patch_reflectances(*scene, mesh), direct(mesh.element_count(), Rgb(1));
      const IrradianceField field = solve_field(factors, reflectance, direct, {});
      EXPECT_EQ(field.problem, "") << name_of(method);
      for (const Rgb& h : field.total) EXPECT_TRUE(h.r >= 1 && h.r < 20) << name_of(method) << ' ' << h.r;
    }
  }
}

// Reflectance above 1 in a closed room: the field says so and holds direct light only.
TEST(IrradianceField, DivergenceLeavesDirectLight) {
  const auto scene = unit_cube();
  const PatchMesh mesh(*scene, {Meshing::uniform, 0, 2});
  const FormFactors factors = factors_of(*scene, mesh, {FormFactorMethod::hemisphere, 256});
  // Only green diverges.
  const std::vector<Rgb> reflectance(mesh.patches().size(), Rgb(0.5f, 1.3f, 0.2f)),
      direct(mesh.element_count(), Rgb(2, 3, 4));
  for (const auto& counted : {CountedReflections{}, CountedReflections(1001, true)}) {
    FieldSettings settings;
    settings.counted = counted;
    const IrradianceField field = solve_field(factors, reflectance, direct, settings);
    EXPECT_TRUE(field.has_diverged);
    EXPECT_NE(field.problem, "");
    EXPECT_EQ(field.total, direct);
    for (const Rgb& h : field.indirect) EXPECT_EQ(h, Rgb(0));
  }
  // A room that reflects everything has no solution, and a limit of the path length makes it finite.
  const std::vector<Rgb> white(mesh.patches().size(), Rgb(1));
  EXPECT_TRUE(solve_field(factors, white, direct, {}).has_diverged);
  FieldSettings ten;
  ten.counted = CountedReflections(11, true);
  ten.counted.push_back(false);
  const IrradianceField limited = solve_field(factors, white, direct, ten);
  EXPECT_EQ(limited.problem, "");
  EXPECT_NEAR(limited.total[0].r, 20, 1e-3f);
}

TEST(Memory, TheNumberOfPatchesThatFit) {
  const auto scene = unit_cube();
  Parameters parameters;
  EXPECT_EQ(too_many_patches(*scene, parameters, 2), "");
  for (const FormFactorMethod method : {FormFactorMethod::hemisphere, FormFactorMethod::contour_integration}) {
    parameters.factors.value = method;
    parameters.memory_limit.value = 1;
    const std::string message = too_many_patches(*scene, parameters, 2);
    EXPECT_NE(message.find("radiosity.memory-limit (1 MiB)"), std::string::npos) << message;
    const size_t at = message.find("at most ") + 8;
    const size_t most = std::stoul(message.substr(at));
    EXPECT_LE(memory_of(most, parameters, 2), size_t{1} << 20);
    EXPECT_GT(memory_of(most + 1, parameters, 2), size_t{1} << 20);
  }
}

// Reflectances are means over patches; emission of a textured or vertex-coloured surface enters by light samples.
TEST(Reflectance, MeanOfVertexColors) {
  auto colored = std::make_shared<Mesh>(*scene::rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}));
  for (const Vec3& p : colored->positions) colored->colors.push_back(Vec4(p.x, p.x, p.x, 1));
  scene::Scene s;
  add(s, colored, diffuse(Rgb(1)));
  const auto scene = compiled(std::move(s));
  const PatchMesh mesh(*scene, {Meshing::uniform, 0, 2});
  const auto reflectance = patch_reflectances(*scene, mesh);
  for (size_t p = 0; p < reflectance.size(); ++p)
    EXPECT_NEAR(reflectance[p].g, mesh.patches()[p].point(Vec2(1.0f / 3)).x, 1e-5f);
}

}  // namespace
}  // namespace etendue::radiosity
