// Radiosity in a closed sphere whose patches are up to a thousand times longer than wide.
#pragma once
#include <cmath>

#include "radiosity/form_factors.h"
#include "radiosity/irradiance_field.h"
#include "sampling/sobol.h"
#include "stress/case.h"

namespace etendue::stress {

inline void radiosity_slivers(TestContext& test) {
  using namespace radiosity;
  for (const float ratio : {1.0f, 30.0f, 1000.0f}) {
    auto sphere = std::make_shared<Mesh>(*scene::sphere(1, 8, true));
    for (auto& p : sphere->positions) p.x /= ratio;
    scene::Scene squeezed;
    scene::add(squeezed, sphere, scene::diffuse(Rgb(0.5f)));
    const auto scene = scene::compile(std::make_shared<const scene::Scene>(std::move(squeezed)), Camera(), nullptr);
    const PatchMesh mesh(*scene, {Meshing::uniform, 0, 1});
    const SobolSampler sampler;
    RowBuilder builder;
    std::vector<FormFactorRow> rows;
    for (uint32_t e = 0; e < mesh.element_count(); ++e) {
      builder.begin(mesh.element_count());
      info_of(FormFactorMethod::hemisphere).add_row({*scene, mesh, sampler, e, 256, test.options().seed, builder});
      rows.push_back(builder.finish());
    }
    const FormFactors factors(std::move(rows), element_areas(mesh));
    const std::string point = "squeezed by " + number(static_cast<double>(ratio));
    test.expect_near("hemisphere", point + ", mean sum of form factors", factors.quality().mean_closure, 1, 1e-3);
    // Uniform direct irradiance 1 and reflectance 0.5: the irradiance is 2 everywhere.
    const std::vector<Rgb> grey(mesh.patches().size(), Rgb(0.5f)), direct(mesh.element_count(), Rgb(1));
    const IrradianceField field = solve_field(factors, grey, direct, {.settings = {.tolerance = 1e-6}, .counted = {}});
    double largest = 0, mean = 0, area = 0;
    for (uint32_t e = 0; e < mesh.element_count(); ++e) {
      if (factors.exchanges(e).empty()) continue;
      const double error = std::abs(static_cast<double>(field.total[e].r) - 2);
      largest = std::max(largest, error);
      mean += error * factors.areas()[e];
      area += factors.areas()[e];
    }
    test.expect_between("radiosity", point + ", mean error of the irradiance 2", mean / area, 0, 2e-3);
    // The scaling of rows is an iteration, which converges slowly for elements of very different areas.
    test.expect_between("radiosity", point + ", largest error of the irradiance 2", largest, 0, 0.05);
  }
}

inline constexpr Case kRadiositySlivers{.name = "radiosity-slivers",
                                        .kind = Kind::geometry,
                                        .theory =
                                            "Cosine-distributed rays find every patch in proportion to its form "
                                            "factor, and rows of closed rooms are scaled "
                                            "to the sum 1, so that a furnace of slivers keeps its light",
                                        .run = radiosity_slivers};

}  // namespace etendue::stress
