// The parameters of participating media: presets, coefficients, phase functions; saved states.
#include <gtest/gtest.h>

#include "medium/medium_presets.h"
#include "render/document.h"

namespace etendue {
namespace {

render::Document edited(render::Document d, std::initializer_list<std::pair<const char*, const char*>> settings) {
  for (const auto& [name, value] : settings) {
    auto next = render::with_text(d, name, value);
    EXPECT_TRUE(next) << name << ": " << next.error().message;
    if (next) d = *next;
  }
  return d;
}

render::Document cornell_box() { return *render::new_document("cornell"); }

TEST(MediaParameters, PresetsSetCoefficientsAndPhaseFunction) {
  for (const MediumPreset& preset : medium_presets()) {
    const auto d = edited(cornell_box(), {{"atmosphere.medium", preset.name.c_str()}});
    EXPECT_EQ(d.scene->atmosphere.medium, preset.medium) << preset.name;
  }
  const auto d = edited(cornell_box(), {{"atmosphere.medium", "fog"}, {"atmosphere.scattering.g", "0.5"}});
  EXPECT_EQ(preset_of(d.scene->atmosphere.medium), kNoMediumPreset);
}

TEST(MediaParameters, OfMaterials) {
  const auto d = edited(cornell_box(), {{"material.4.boundary-only", "true"},
                                    {"material.4.scattering.r", "2"},
                                    {"material.4.absorption.b", "0.25"},
                                    {"material.4.phase-function", "schlick"},
                                    {"material.4.phase.k", "-0.5"},
                                    {"material.4.medium-priority", "3"}});
  const Material& m = d.scene->materials[4];
  EXPECT_TRUE(m.boundary_only);
  EXPECT_EQ(m.medium.scattering, Rgb(2, 0, 0));
  EXPECT_EQ(m.medium.absorption, Rgb(0, 0, 0.25f));
  EXPECT_LT(m.medium.phase->mean_cosine(), 0);
  EXPECT_EQ(m.medium_priority, 3);
}

TEST(MediaParameters, DensityAndEmission) {
  const auto d = edited(cornell_box(), {{"atmosphere.absorption.g", "0.5"},
                                        {"atmosphere.medium-emission.r", "3"},
                                        {"atmosphere.medium-emission.g", "2"},
                                        {"atmosphere.medium-temperature", "2500"},
                                        {"atmosphere.radius", "9"},
                                        {"atmosphere.density", "cloud"},
                                        {"atmosphere.density.seed", "12"},
                                        {"atmosphere.medium-transmittance", "regular"}});
  const MediumDescription& m = d.scene->atmosphere.medium;
  EXPECT_EQ(m.emission, Rgb(3, 2, 0));
  EXPECT_EQ(m.temperature, 2500);
  EXPECT_EQ(m.density, DensityRef{*make_density("cloud", {{"seed", int64_t{12}}})});
  EXPECT_EQ(m.estimator, TransmittanceEstimator::regular);
  EXPECT_TRUE(m.emits() && m.is_heterogeneous());
  const auto again = render::document_from_state(render::state_json(d, 1), "test");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->scene->atmosphere, d.scene->atmosphere);
  EXPECT_FALSE(edited(d, {{"atmosphere.density", "homogeneous"}}).scene->atmosphere.medium.density);
  for (const auto& [name, value] :
       {std::pair("atmosphere.density", "steam"), std::pair("atmosphere.density.seed", "-1"),
        std::pair("atmosphere.medium-emission.r", "-1"), std::pair("atmosphere.medium-temperature", "nan")})
    EXPECT_FALSE(render::with_text(d, name, value)) << name << '=' << value;
  const auto file = edited(d, {{"atmosphere.density", "file"}});
  const auto missing = render::with_text(file, "atmosphere.density.file", "/nonexistent/smoke.nvdb");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("/nonexistent/smoke.nvdb: cannot be read"), std::string::npos)
      << missing.error().message;
}

TEST(MediaParameters, InvalidValuesAreErrors) {
  const auto d = cornell_box();
  for (const auto& [name, value] : {std::pair("atmosphere.scattering.r", "-1"), std::pair("atmosphere.absorption.g", "nan"),
                                    std::pair("atmosphere.scattering.b", "1e9"), std::pair("atmosphere.medium", "soup"),
                                    std::pair("atmosphere.phase-function", "mie"), std::pair("atmosphere.radius", "0")})
    EXPECT_FALSE(render::with_text(d, name, value)) << name << '=' << value;
  const auto forward = edited(d, {{"atmosphere.phase-function", "henyey-greenstein"}});
  for (const char* g : {"1.5", "-1.01", "nan", "inf"})
    EXPECT_FALSE(render::with_text(forward, "atmosphere.phase.g", g)) << g;
}

TEST(MediaParameters, StatesKeepMedia) {
  const auto d = edited(cornell_box(), {{"atmosphere.medium", "smoke"},
                                    {"atmosphere.radius", "12"},
                                    {"atmosphere.phase-function", "double-henyey-greenstein"},
                                    {"atmosphere.phase.g2", "-0.75"},
                                    {"material.4.boundary-only", "true"},
                                    {"material.4.medium", "milk"},
                                    {"material.4.phase-function", "tabulated"},
                                    {"material.4.phase.values", "1 2 3"}});
  const auto again = render::document_from_state(render::state_json(d, 1), "test");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->scene->atmosphere, d.scene->atmosphere);
  EXPECT_EQ(again->scene->materials[4].medium, d.scene->materials[4].medium);
  EXPECT_TRUE(again->scene->materials[4].boundary_only);
}

}  // namespace
}  // namespace etendue
