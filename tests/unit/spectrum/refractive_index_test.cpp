// Indices of refraction by wavelength against catalogues.
#include "spectrum/refractive_index.h"

#include <gtest/gtest.h>

namespace etendue {
namespace {

TEST(RefractiveIndex, SellmeierFormulasHaveThePublishedValues) {
  struct Published {
    Glass glass;
    double index_d, abbe, abbe_tolerance;
  };
  // [Schott glass catalogue], [Malitson 1965], [Peter 1923], [Daimon and Masumura 2007].
  for (const Published& p : {Published{Glass::n_bk7, 1.51680, 64.17, 0.05},
                             {Glass::n_sf11, 1.78472, 25.68, 0.05},
                             {Glass::fused_silica, 1.45846, 67.82, 0.1},
                             {Glass::diamond, 2.4175, 55.3, 0.6},
                             {Glass::water, 1.33340, 55.8, 0.6}}) {
    const SellmeierFormula& formula = *find_sellmeier(p.glass);
    EXPECT_NEAR(formula.index_d(), p.index_d, 2e-4) << formula.name;
    EXPECT_NEAR(20 / formula.dispersion(), p.abbe, p.abbe_tolerance) << formula.name;
    EXPECT_FLOAT_EQ((RefractiveIndex{1.2f, 9, p.glass}).at(589.3f), static_cast<float>(formula.index(589.3f)));
  }
}

// By definition of the Abbe number.
TEST(RefractiveIndex, CauchyFormulaHasTheAbbeNumber) {
  const RefractiveIndex index{1.6f, 20 / 35.0f};
  EXPECT_TRUE(index.varies());
  EXPECT_NEAR(index.at(587.56f), 1.6, 1e-6);
  EXPECT_NEAR(0.6 / (double{index.at(486.13f)} - double{index.at(656.27f)}), 35, 0.01);
  EXPECT_GT(index.at(400), index.at(500));
}

TEST(RefractiveIndex, StaysAtLeastOne) {
  const RefractiveIndex strange{1.01f, 100};
  for (float wavelength = 380; wavelength <= 780; wavelength += 10) {
    EXPECT_GE(strange.at(wavelength), 1);
    EXPECT_TRUE(std::isfinite(strange.at(wavelength)));
  }
  EXPECT_FALSE((RefractiveIndex{1.5f}).varies());
  EXPECT_FALSE((RefractiveIndex{1.0f, 5}).varies());
  EXPECT_EQ((RefractiveIndex{1.5f}).at(400), 1.5f);
}

}  // namespace
}  // namespace etendue
