// Analysis of BSDFs, on surfaces with known values.
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

// A white Lambertian surface has albedo one at all angles and constant sample weights.
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

// The albedo of Phong's BRDF from its formula by quadrature [Lang, sec. 4.2.2.5.2], and its properties.
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

// A rough dielectric boundary preserves power from both sides, and is reciprocal up to the squared ratio of the
// indices.
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

// Deltas contribute to the albedo: smooth glass transmits 96 % at normal incidence and has total internal reflection.
TEST(SurfaceAnalysis, SmoothGlass) {
  const auto lobes = lobes_of(scene::glass());
  const Albedo straight = albedo_at(lobes, 0, {20, 1 << 16}), inside = albedo_at(lobes, 180 - 45);
  EXPECT_NEAR(straight.value.g, 1, 2e-3);
  EXPECT_NEAR(straight.transmitted.g, 0.96, 2e-3);
  EXPECT_NEAR(straight.specular.g, straight.value.g, 1e-6);
  EXPECT_NEAR(inside.value.g, 1, 1e-5);
  EXPECT_EQ(inside.transmitted.g, 0);
}

// A density that differs from that of the samples is detected where both are common.
TEST(SurfaceAnalysis, WrongDensitiesAreDetected) {
  const Material wide = modelled("modified-phong", {{"diffuse", 0.5}, {"exponent", 3}});
  const SamplingQuality honest = sampling_quality_at(lobes_of(wide), 45);
  EXPECT_LT(std::abs(honest.discrepancy), kMaxDiscrepancy);
  // A curve of another surface: 20 % above the cosine.
  std::vector<SamplingQuality> curve{honest};
  EXPECT_TRUE(is_well_sampled(curve));
  curve[0].discrepancy = 40;
  EXPECT_FALSE(is_well_sampled(curve));
}

// The polar plot of f cos for a Lambertian surface is a circle through the origin.
TEST(SurfaceAnalysis, SliceOfLambert) {
  const Slice s = slice(lobes_of(modelled("lambert")), 30);
  ASSERT_EQ(s.angles.size(), s.values.size());
  for (size_t i = 0; i < s.angles.size(); ++i) {
    const double cosine = std::cos(s.angles[i] * 3.14159265358979 / 180);
    EXPECT_NEAR(static_cast<double>(s.values[i].r), std::max(0.0, cosine) / 3.14159265358979, 1e-5);
  }
}

// The peak of a mirror lobe is in the mirror direction.
TEST(SurfaceAnalysis, NarrowLobesAreResolved) {
  const LobeSurface lobe = lobe_surface(lobes_of(modelled("modified-phong", {{"diffuse", 0}, {"exponent", 1e4}})), 50);
  size_t best = 0;
  for (size_t i = 0; i < lobe.values.size(); ++i)
    if (lobe.values[i] > lobe.values[best]) best = i;
  EXPECT_GT(glm::dot(lobe.directions[best], direction(50, 180)), 0.9999f);
  EXPECT_GT(lobe.largest, 100);
}

TEST(SurfaceAnalysis, StopsOnRequest) {
  const SurfaceAnalysis a = analyze(lobes_of(modelled("phong")), [] { return false; });
  EXPECT_TRUE(a.albedo.empty());
  EXPECT_EQ(a.plausibility.pairs, 0u);
}

TEST(SurfaceAnalysis, DrawingsContainTheirElements) {
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
