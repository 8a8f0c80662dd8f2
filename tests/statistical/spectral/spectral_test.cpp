// Spectral rendering: agreement with RGB where both are exact, refraction by wavelength, refusals, reproducibility.
//
// Comparisons of images use expect_agreement, which states its false-alarm rate. Other means are compared within 4.5
// standard errors: one false alarm in 150,000 comparisons.
#include <gtest/gtest.h>

#include <cmath>

#include "integrator/integrator.h"
#include "integrator/shared/camera_paths.h"
#include "render/incompatibility.h"
#include "scene/builtin/prism.h"
#include "support/independent_estimates.h"
#include "support/integrator_scenes.h"
#include "support/media_scenes.h"
#include "transport/wavefront/path_estimators.h"

namespace etendue {
namespace {

using render::Document;
using test::with;
using test::with_integrator;

Document spectral(const Document& d) { return with(d, "render.color", "spectral"); }

// Replaces all colours of materials and lights by grey.
Document without_color(Document d) {
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  const auto grey = [](Rgb& c) { c = Rgb(luminance(c)); };
  for (Material& m : scene->materials) {
    grey(m.base_color);
    grey(m.emission);
    grey(m.attenuation_color);
  }
  grey(scene->environment.tint);
  d.scene = std::move(scene);
  return d;
}

TEST(Spectral, EqualsRgbWithoutColor) {
  const Document cornell = without_color(test::cornell(test::kSize));
  const Document solids = without_color(test::stone_in_tinted_water());
  for (const char* integrator : {"path", "path-pure"}) {
    const Document a = with_integrator(cornell, integrator);
    test::expect_same_mean(a, 64, spectral(a), 128, std::string("Cornell box, ") + integrator, 6);
    const Document b = with_integrator(solids, integrator);
    test::expect_same_mean(b, 64, spectral(b), 128, std::string("solids, ") + integrator, 6);
  }
  const Document glossy = without_color(test::glossy_scene());
  test::expect_same_mean(glossy, 64, spectral(glossy), 128, "glossy scene", 6);
  const Document classes = with(cornell, "film.paths", "EDDL");
  test::expect_same_mean(classes, 64, spectral(classes), 128, "path classes", 6);
}

// The mean of an image over seeds, with the standard error of each component.
struct MeanColor {
  double value[3]{}, standard_error[3]{};
};
MeanColor mean_over_seeds(Document d, uint32_t samples) {
  constexpr int kSeeds = 12;
  double squares[3]{};
  MeanColor mean;
  for (int seed = 0; seed < kSeeds; ++seed) {
    d.seed = static_cast<uint64_t>(100 + seed);
    const Rgb color = test::mean_color(test::rendered(d, samples));
    for (int c = 0; c < 3; ++c) {
      mean.value[c] += double{color[c]} / kSeeds;
      squares[c] += double{color[c]} * double{color[c]} / kSeeds;
    }
  }
  for (int c = 0; c < 3; ++c)
    mean.standard_error[c] = std::sqrt(std::max(0.0, squares[c] - mean.value[c] * mean.value[c]) / (kSeeds - 1));
  return mean;
}

// A diffuse surface in white light of radiance 1 shows its colour, up to the error of the conversion (uplift_test.cpp).
TEST(Spectral, DirectLightShowsTheColorOfASurface) {
  for (const Rgb& color : {Rgb(0.8f, 0.2f, 0.1f), Rgb(0.1f, 0.5f, 0.7f), Rgb(0.9f, 0.85f, 0.3f)}) {
    scene::Scene scene;
    add(scene, test::quad(50), test::diffuse(color));
    scene.environment.tint = Rgb(1);
    Camera camera = look_at({0, 1, 0}, {0, 0, 0}, {0, 0, 1}, 0.1f);
    const MeanColor mean = mean_over_seeds(spectral(test::document(std::move(scene), camera, 8, 8)), 64);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(mean.value[c], double{color[c]}, 4.5 * mean.standard_error[c] + 0.003);
      EXPECT_LT(mean.standard_error[c], 0.01);
    }
  }
}

// Traces rays of many wavelengths through a prism. Paths that leave after two refractions have the direction of
// Snell's law, computed in double precision.
TEST(Spectral, PrismRefractsEachWavelengthBySnellsLaw) {
  const scene::Scene scene = scene::prism_scene();
  Camera camera = look_at({0, 0.4f, 3}, {0, 0.4f, 0}, {0, 1, 0}, 1e-3f);
  const auto compiled = scene::compile(std::make_shared<scene::Scene>(scene), camera, nullptr);
  const auto sampler = make_sampler("random");
  const transport::PathExpression all = transport::PathExpression::all();

  using M = transport::Spectral;
  auto& paths = integrator::thread_wavefront<M>();
  paths.begin(*compiled, *sampler, 0);
  paths.filter_paths(all.automaton());
  constexpr int kPaths = transport::PathWavefront<M>::kCapacity;
  for (int i = 0; i < kPaths; ++i) paths.add(static_cast<uint32_t>(i));
  const SellmeierFormula& flint = *find_sellmeier(Glass::n_sf11);
  const scene::prism::Directions to(static_cast<float>(flint.index_d()));
  // Towards the centre of the entry face.
  Ray ray;
  ray.origin = to.entry;
  ray.origin.y = 0.4f, ray.origin.z = 3;
  ray.direction = Vec3(0, 0, -1);
  for (int i = 0; i < kPaths; ++i) {
    paths.color().start(i, (static_cast<float>(i) + 0.5f) / kPaths);
    paths.launch(i, ray, compiled->media_at_camera(ray, 0));
  }

  // Snell's law in the plane of incidence; n is the unit normal against d.
  using Direction = glm::dvec3;
  const auto refracted = [](const Direction& d, const Direction& n, double eta) {
    const double cosine = -glm::dot(d, n), sine2 = (1 - cosine * cosine) / (eta * eta);
    return d / eta + n * (cosine / eta - std::sqrt(1 - sine2));
  };
  const Direction apex(to.apex), inside(to.inside);
  // The faces meet at the apex with 60 degrees.
  const Direction entry = glm::normalize(apex * 0.5 - inside * (std::sqrt(3.0) / 2)),
                  exit = glm::normalize(-(apex * 0.5 + inside * (std::sqrt(3.0) / 2)));

  int leaving = 0;
  double least = 1, greatest = -1;  // cosine of the deviation
  while (paths.trace()) {
    for (int i = 0; paths.length() == 3 && i < paths.miss_count(); ++i) {
      const int path = paths.path_of_miss(i);
      const double wavelength = double{paths.color().wavelengths(path).hero()};
      const Direction expected = refracted(refracted(Direction(ray.direction), entry, flint.index(wavelength)), exit,
                                           1 / flint.index(wavelength));
      const Direction found(paths.miss_direction(i));
      EXPECT_LT(glm::length(found - expected), 2e-6) << wavelength;
      const SampledSpectrum throughput = paths.missed_path(i).throughput;
      EXPECT_GT(throughput[0], 0);
      EXPECT_EQ(throughput[1] + throughput[2] + throughput[3], 0);
      least = std::min(least, -found.z);
      greatest = std::max(greatest, -found.z);
      ++leaving;
    }
    while (paths.next_hits()) {
      // The slit lies in the direction of minimum deviation.
      if (paths.length() < 3) transport::sample_bsdf(paths, 64);
    }
  }
  EXPECT_GT(leaving, kPaths / 4);
  EXPECT_GT(std::acos(least) - std::acos(greatest), 0.05) << "the spectrum is narrower than three degrees";
}

TEST(Spectral, IsChosenOnlyForDispersion) {
  const auto decision = [](const Document& d) {
    const auto compiled = scene::compile(d.scene, d.camera, nullptr);
    const auto model = transport::model_for(*compiled, {}, {}, d.method.color);
    return model.decisions.front().value + ": " + model.decisions.front().reason;
  };
  const Document glass = test::bubble();
  EXPECT_EQ(decision(glass), "RGB: no material disperses light, and no emitter or medium has a spectrum");
  EXPECT_EQ(decision(spectral(glass)),
            "spectral: no material disperses light, and no emitter or medium has a spectrum; spectral selected");
  auto scene = std::make_shared<scene::Scene>(*glass.scene);
  for (Material& m : scene->materials)
    if (m.is_solid()) m.dispersion = 0.5f, m.name = "flint";
  Document dispersive = glass;
  dispersive.scene = scene;
  EXPECT_EQ(decision(dispersive), "spectral: material 'flint' disperses light");
  EXPECT_EQ(decision(with(dispersive, "render.color", "rgb")),
            "RGB: material 'flint' disperses light; RGB selected, dispersion ignored");
}

TEST(Spectral, OtherIntegratorsRefuse) {
  const Document cornell = test::cornell(8);
  const auto compiled = scene::compile(cornell.scene, cornell.camera, nullptr);
  for (const auto& info : integrator::integrator_infos()) {
    const std::string message = render::incompatibility(spectral(with_integrator(cornell, info.name)), *compiled);
    if (info.spectral)
      EXPECT_EQ(message, "") << info.name;
    else
      EXPECT_NE(message.find("(path-pure, path)"), std::string::npos) << info.name << ": " << message;
  }
}

TEST(Spectral, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const char* sampler : {"sobol", "random"}) {
    Document d = spectral(test::cornell(53));
    d.method.sampler = sampler;
    const auto one = test::rendered(d, 5, 1);
    EXPECT_TRUE(test::same_bits(one, test::rendered(d, 5, 2))) << sampler;
    EXPECT_TRUE(test::same_bits(one, test::rendered(d, 5, 7))) << sampler;
  }
}

}  // namespace
}  // namespace etendue
