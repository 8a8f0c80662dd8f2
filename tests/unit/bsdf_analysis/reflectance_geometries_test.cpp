// Reflectance and transmittance in nine geometries against closed forms.
#include "bsdf_analysis/reflectance_geometries.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bsdf/bsdf_model.h"

namespace etendue::bsdf_analysis {
namespace {

constexpr double kStandardErrors = 4.5;

Material lambert(const Rgb& albedo) {
  Material material;
  material.model.model = make_bsdf_model("lambert");
  material.base_color = albedo;
  return material;
}

void expect_factor(const Reflectance& r, double expected, double largest_error = 0.02) {
  const std::string what =
      std::string(kExtentNames[static_cast<size_t>(r.from)]) + " to " + kExtentNames[static_cast<size_t>(r.to)];
  EXPECT_NEAR(static_cast<double>(r.factor.g), expected, kStandardErrors * r.error + 2e-3 * expected) << what;
  EXPECT_LE(r.error, largest_error * std::max(expected, 1e-3)) << what;
}

// All nine factors of a Lambertian surface are its albedo, at any angle and for any cone, and the fractions are in proportion to
// the projected solid angle of the detector: sin^2 of the half angle times the cosine of its axis.
TEST(Reflectance, LambertHasTheSameFactorInAllGeometries) {
  const Lobes lobes = lobes_of(lambert(Rgb(0.6f)));
  for (const double degrees : {0.0, 45.0, 70.0})
    for (const double half_angle : {5.0, 15.0}) {
      const auto all = reflectances(lobes, {.degrees = degrees, .half_angle = half_angle});
      for (const Reflectance& r : all) expect_factor(r, 0.6);
      constexpr double kRadians = 3.14159265358979323846 / 180;
      const double share = std::pow(std::sin(half_angle * kRadians), 2) * std::cos(degrees * kRadians);
      for (size_t from = 0; from < 3; ++from) {
        EXPECT_EQ(all[3 * from].fraction.g, 0);
        EXPECT_NEAR(static_cast<double>(all[3 * from + 1].fraction.g), 0.6 * share, 0.03 * 0.6 * share);
        EXPECT_NEAR(static_cast<double>(all[3 * from + 2].fraction.g), 0.6, 2e-3);
      }
      for (const Reflectance& r : reflectances(lobes, {.degrees = degrees, .transmission = true}))
        EXPECT_EQ(r.factor.g, 0);
    }
}

// A perfect mirror reflects all light of a cone into the mirrored cone; nothing is found in a single direction.
TEST(Reflectance, Mirror) {
  Material mirror;
  mirror.metallic = 1;
  mirror.roughness = 0;
  mirror.base_color = Rgb(1);
  const auto all = reflectances(lobes_of(mirror), {.degrees = 40, .half_angle = 10});
  const auto fraction = [&](Extent from, Extent to) {
    return static_cast<double>(all[3 * static_cast<size_t>(from) + static_cast<size_t>(to)].fraction.g);
  };
  using enum Extent;
  EXPECT_NEAR(fraction(directional, conical), 1, 1e-3);
  EXPECT_NEAR(fraction(directional, hemispherical), 1, 1e-3);
  EXPECT_NEAR(fraction(conical, hemispherical), 1, 1e-3);
  EXPECT_NEAR(fraction(hemispherical, hemispherical), 1, 1e-3);
  EXPECT_GT(fraction(conical, conical), 0.99);
  // Of the hemisphere, the part of the cone arrives: sin^2 10 cos 40.
  EXPECT_NEAR(fraction(hemispherical, conical), 0.0231, 0.002);
  for (const Extent from : {directional, conical, hemispherical})
    EXPECT_EQ(all[3 * static_cast<size_t>(from)].factor.g, 0);
}

// Reciprocity exchanges source and detector: R(cone -> hemisphere) = R(hemisphere -> cone) at equal angles.
TEST(Reflectance, ReciprocalModelsExchangeSourceAndDetector) {
  Material rough;
  rough.metallic = 1;
  rough.roughness = 0.5f;
  rough.base_color = Rgb(0.9f);
  const auto all = reflectances(lobes_of(rough), {.degrees = 30, .half_angle = 12, .samples = 1 << 18});
  for (size_t from = 0; from < 3; ++from)
    for (size_t to = 0; to < from; ++to) {
      const Reflectance &a = all[3 * from + to], &b = all[3 * to + from];
      EXPECT_NEAR(static_cast<double>(a.factor.g), static_cast<double>(b.factor.g),
                  kStandardErrors * std::hypot(a.error, b.error) + 3e-3)
          << from << ' ' << to;
    }
}

// A sheet that transmits diffusely: all nine transmittance factors are equal.
TEST(Reflectance, DiffuseTransmission) {
  Material sheet;
  sheet.metallic = 0;
  sheet.roughness = 1;
  sheet.specular = 0;
  sheet.base_color = Rgb(0.5f);
  sheet.diffuse_transmission = 1;
  sheet.diffuse_transmission_color = Rgb(0.7f);
  const Lobes lobes = lobes_of(sheet);
  for (const Reflectance& r : reflectances(lobes, {.degrees = 20, .transmission = true})) expect_factor(r, 0.7);
}

}  // namespace
}  // namespace etendue::bsdf_analysis
