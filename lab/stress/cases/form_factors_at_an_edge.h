// Form factors of patches with a common edge, by area sampling and by hemisphere sampling.   [Lang, eq. 10.90-10.93]
#pragma once
#include <cmath>

#include "radiosity/closed_forms.h"
#include "radiosity/form_factors.h"
#include "sampling/random.h"
#include "stress/case.h"

namespace etendue::stress {

// The root mean square error of the factor from the first to the second of two unit squares with a common edge.
inline double error_at_an_edge(const scene::CompiledScene& scene, const radiosity::PatchMesh& mesh,
                               radiosity::FormFactorMethod method, uint32_t samples, int runs, uint64_t seed) {
  using namespace radiosity;
  const RandomSampler random;
  RowBuilder builder;
  double squares = 0;
  for (int run = 0; run < runs; ++run) {
    double factor = 0;
    for (uint32_t e = 0; e < 4; e += 2) {  // the front sides of the two triangles of the first square
      builder.begin(mesh.element_count());
      info_of(method).add_row({scene, mesh, random, e, samples, seed + static_cast<uint64_t>(run), builder});
      for (const FormFactor& f : builder.finish())
        if (f.element >= 4) factor += 0.5 * static_cast<double>(f.value);
    }
    squares += sqr(factor - perpendicular_rectangles(1, 1)) / runs;
  }
  return std::sqrt(squares);
}

inline void form_factors_at_an_edge(TestContext& test) {
  using namespace radiosity;
  scene::Scene squares;
  scene::add(squares, scene::rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), scene::diffuse(Rgb(0.5f)));
  scene::add(squares, scene::rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1}), scene::diffuse(Rgb(0.5f)));
  const auto scene = scene::compile(std::make_shared<const scene::Scene>(std::move(squares)), Camera(), nullptr);
  const PatchMesh mesh(*scene, {Meshing::uniform, 0, 1});
  constexpr uint32_t kFew = 64, kMany = 16'384;
  constexpr int kRuns = 40;
  const auto slope = [&](FormFactorMethod method, double& many) {
    const double few = error_at_an_edge(*scene, mesh, method, kFew, kRuns, test.options().seed);
    many = error_at_an_edge(*scene, mesh, method, kMany, kRuns, test.options().seed + 1000);
    return std::log(many / few) / std::log(static_cast<double>(kMany) / kFew);
  };
  double hemisphere = 0, area = 0, points = 0;
  test.expect_between("hemisphere", "slope of the error over samples", slope(FormFactorMethod::hemisphere, hemisphere),
                      -0.56, -0.44);
  // Rare pairs next to the edge dominate: the error falls slower, and irregularly.
  test.expect_between("area", "slope of the error over samples", slope(FormFactorMethod::area_sampling, area), -0.5,
                      -0.1);
  test.expect_between("point-polygon", "slope of the error over samples",
                      slope(FormFactorMethod::point_to_polygon, points), -0.56, -0.44);
  test.expect_between("area", "error relative to point-polygon", area / points, 3, 1e9);
}

inline constexpr Case kFormFactorsAtAnEdge{.name = "form-factors-at-an-edge",
                                           .kind = Kind::heavy_tails,
                                           .theory =
                                               "Between patches with a common edge, the kernel of area sampling has "
                                               "infinite variance, so its error falls slower "
                                               "than the square root of the samples; rays and closed forms keep it",
                                           .run = form_factors_at_an_edge};

}  // namespace etendue::stress
