// The instruments, on surfaces whose readings are known.
#include <gtest/gtest.h>

#include "bsdf_analysis/checks.h"
#include "bsdf_analysis/drawings.h"
#include "scene/builtin/shapes.h"

namespace etendue::bsdf_analysis {
namespace {

Material modelled(const char* model, std::initializer_list<std::pair<const char*, double>> settings = {}) {
  Material m;
  m.model.model = make_bsdf_model(model);
  for (const auto& [name, value] : settings) m.model.model = m.model->with(name, value);
  return m;
}

bool holds(const SurfaceAnalysis& analysis, std::string_view name) {
  for (const Check& b : analysis.checks)
    if (b.name == name) return b.holds;
  ADD_FAILURE() << "no check " << name;
  return false;
}

// A white Lambertian surface gives back all light from everywhere, and its weights are all alike.
TEST(SurfaceAnalysis, Lambert) {
  const SurfaceAnalysis a = analyze(lobes_of(modelled("lambert")));
  for (const Check& b : a.checks) EXPECT_TRUE(b.holds) << b.name << ' ' << b.reason;
  for (const Albedo& point : a.albedo) {
    EXPECT_NEAR(point.value.r, 1, 1e-5) << point.degrees;
    EXPECT_NEAR(point.diffuse.r, 1, 1e-5);
  }
  EXPECT_NEAR(hemispherical_albedo(a.albedo), 1, 1e-5);
  for (const auto& q : a.sampling) EXPECT_LT(q.deviation, 1e-3);
}

// The albedo of Phong's BRDF, as the thesis's formula gives it by quadrature, and its axioms.
TEST(SurfaceAnalysis, PhongIsNeitherReciprocalNorConserving) {
  const Material phong =
      modelled("phong", {{"diffuse", 0}, {"specular.r", 1}, {"specular.g", 1}, {"specular.b", 1}, {"exponent", 10}});
  const SurfaceAnalysis a = analyze(lobes_of(phong));
  EXPECT_FALSE(holds(a, "reciprocal"));
  EXPECT_FALSE(holds(a, "conserves-energy"));
  EXPECT_TRUE(holds(a, "non-negative"));
  EXPECT_TRUE(holds(a, "well-sampled"));
  for (const auto& [degrees, expected] :
       {std::pair{0.0, 0.5236}, {60.0, 0.5286}, {80.0, 0.6877}, {85.0, 1.0290}, {89.0, 3.959}}) {
    const Albedo point = albedo_at(lobes_of(phong), degrees, {20, 1 << 16});
    EXPECT_NEAR(static_cast<double>(point.value.r), expected, 5 * point.error + 1e-4 * expected) << degrees;
  }
}

TEST(SurfaceAnalysis, ModifiedPhongIsPlausible) {
  const SurfaceAnalysis a = analyze(lobes_of(modelled("modified-phong", {{"diffuse", 0.5}, {"exponent", 50}})));
  EXPECT_TRUE(holds(a, "reciprocal"));
  EXPECT_TRUE(holds(a, "conserves-energy"));
}

// A boundary of glass keeps all power from either side, and is reciprocal by the law of squared indices.
TEST(SurfaceAnalysis, RoughGlass) {
  Material glass = scene::glass();
  glass.roughness = 0.15f;
  const SurfaceAnalysis a = analyze(lobes_of(glass));
  EXPECT_TRUE(holds(a, "reciprocal")) << a.plausibility.asymmetry;
  EXPECT_TRUE(holds(a, "conserves-energy"));
  ASSERT_FALSE(a.albedo_inside.empty());
  EXPECT_NEAR(a.albedo.front().value.g, 1, 2e-3);
  EXPECT_GT(a.albedo.front().transmitted.g, 0.95f);
  EXPECT_NEAR(relative_eta(lobes_of(glass)), 1.5f, 1e-6f);
}

// Deltas are energy too: smooth glass lets 96 % through at a right angle, and reflects totally from inside.
TEST(SurfaceAnalysis, SmoothGlass) {
  const auto lobes = lobes_of(scene::glass());
  const Albedo straight = albedo_at(lobes, 0, {20, 1 << 16}), inside = albedo_at(lobes, 180 - 45);
  EXPECT_NEAR(straight.value.g, 1, 2e-3);
  EXPECT_NEAR(straight.transmitted.g, 0.96, 2e-3);
  EXPECT_NEAR(straight.specular.g, straight.value.g, 1e-6);
  EXPECT_NEAR(inside.value.g, 1, 1e-5);
  EXPECT_EQ(inside.transmitted.g, 0);
}

// The samples of one lobe with the density that another lobe claims; the weights f cos / pdf follow from the claim.
SampledSurface with_claimed_density(const Lobes& lobes, const Lobes& claimed) {
  SampledSurface surface = sampled_surface(lobes);
  surface.pdf = [&](const Vec3& wo, const Vec3& wi) { return claimed.pdf(wo, wi, TransportMode::radiance); };
  surface.sample = [&](const Vec3& wo, const LobeRandom& random, LobeSample<Rgb>& s) {
    if (!lobes.sample(wo, random, TransportMode::radiance, s)) return false;
    s.pdf_solid_angle = claimed.pdf(wo, s.wi, TransportMode::radiance);
    s.weight = lobes.eval(wo, s.wi, TransportMode::radiance) * (std::abs(s.wi.z) / s.pdf_solid_angle);
    return true;
  };
  return surface;
}

// Negative control of the check "well-sampled": it holds for the right density, and fails for that of a slightly
// narrower lobe, although all weights are moderate.
TEST(SurfaceAnalysis, WrongDensitiesAreDetected) {
  const auto lobe = [](double exponent) {
    return lobes_of(modelled("modified-phong", {{"diffuse", 0.5}, {"exponent", exponent}}));
  };
  const Lobes lobes = lobe(3), narrower = lobe(4);
  for (const double degrees : {0.0, 30.0, 45.0, 60.0}) {
    const SamplingQuality right = sampling_quality_at(with_claimed_density(lobes, lobes), degrees);
    EXPECT_TRUE(is_well_sampled({right})) << degrees << ": " << right.discrepancy;
    const SamplingQuality wrong = sampling_quality_at(with_claimed_density(lobes, narrower), degrees);
    EXPECT_GT(std::abs(wrong.discrepancy), 2 * kMaxDiscrepancy) << degrees;
    EXPECT_FALSE(is_well_sampled({wrong})) << degrees;
  }
}

// The slice of a Lambertian surface times the cosine is a circle through the origin.
TEST(SurfaceAnalysis, SliceOfLambert) {
  const Slice s = slice(lobes_of(modelled("lambert")), 30);
  ASSERT_EQ(s.angles.size(), s.values.size());
  for (size_t i = 0; i < s.angles.size(); ++i) {
    const double cosine = std::cos(s.angles[i] * 3.14159265358979 / 180);
    EXPECT_NEAR(static_cast<double>(s.values[i].r), std::max(0.0, cosine) / 3.14159265358979, 1e-5);
  }
}

// A mirror's peak lies where a mirror would send the eye.
TEST(SurfaceAnalysis, NarrowLobesAreSeenInSpace) {
  const LobeSurface lobe = lobe_surface(lobes_of(modelled("modified-phong", {{"diffuse", 0}, {"exponent", 1e4}})), 50);
  size_t best = 0;
  for (size_t i = 0; i < lobe.values.size(); ++i)
    if (lobe.values[i] > lobe.values[best]) best = i;
  EXPECT_GT(glm::dot(lobe.directions[best], direction(50, 180)), 0.9999f);
  EXPECT_GT(lobe.largest, 100);
}

TEST(SurfaceAnalysis, StopsWhenNobodyWantsIt) {
  const SurfaceAnalysis a = analyze(lobes_of(modelled("phong")), [] { return false; });
  EXPECT_TRUE(a.albedo.empty());
  EXPECT_EQ(a.plausibility.pairs, 0u);
}

TEST(SurfaceAnalysis, DrawingsHoldWhatIsDrawn) {
  const auto lobes = lobes_of(modelled("blinn-phong"));
  const std::vector<Slice> slices{slice(lobes, 45)};
  const std::vector<std::string> names{"Blinn & Phong"};
  const auto svg = metrics::to_svg(polar_drawing(slices, names));
  EXPECT_NE(svg.find("Blinn &amp; Phong"), std::string::npos);
  const std::vector<std::vector<Albedo>> curves{albedo_curve(lobes)};
  EXPECT_NE(metrics::to_svg(albedo_drawing(curves, names)).find("90\u00b0"), std::string::npos);
  const std::vector<LobeSurface> sides{lobe_surface(lobes, 45)};
  EXPECT_GT(lobe_drawing(sides, 45).shapes.size(), 1000u);
}

}  // namespace
}  // namespace etendue::bsdf_analysis
