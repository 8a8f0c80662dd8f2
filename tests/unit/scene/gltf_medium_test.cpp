// Participating media in glTF files: KHR_materials_volume_scatter and ETENDUE_transport.
#include "unit/scene/gltf_builder.h"

namespace etendue::test {
namespace {

class Media : public GltfTest {
 protected:
  static Gltf with(const json& extensions) {
    Gltf gltf;
    gltf.tetrahedron()["material"] = 0;
    gltf.root["materials"] = {{{"extensions", extensions}}};
    return gltf;
  }
};

// sigma_t = -ln(color) / distance; sigma_s is its product with the single-scattering albedo of the extension.
TEST_F(Media, VolumeScatterDividesTheAttenuation) {
  Gltf gltf =
      with({{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
            {"KHR_materials_volume",
             {{"thicknessFactor", 1}, {"attenuationDistance", 0.5}, {"attenuationColor", {0.5, 0.25, 1}}}},
            {"KHR_materials_volume_scatter", {{"multiscatterColor", {1, 0.5, 0}}, {"scatterAnisotropy", 0.25}}}});
  const auto scene = opened(gltf);
  EXPECT_EQ(all(scene.warnings), "");
  const Material& m = scene.materials[0];
  EXPECT_TRUE(m.is_solid());
  EXPECT_EQ(m.attenuation_color, Rgb(1));
  const float extinction[] = {std::log(2.0f) / 0.5f, std::log(4.0f) / 0.5f, 0};
  // 1 - (4.09712 + 4.20863 c - sqrt(9.59217 + 41.6808 c + 17.7126 c^2))^2 at 1 and at 1/2, to the accuracy of the fit.
  const float albedo[] = {1, 0.911709f, 0};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(m.medium.scattering[c], extinction[c] * albedo[c], 3e-3f) << c;
    EXPECT_NEAR(m.medium.scattering[c] + m.medium.absorption[c], extinction[c], 1e-5f) << c;
  }
  EXPECT_STREQ(m.medium.phase->info().description.name, "henyey-greenstein");
  EXPECT_NEAR(m.medium.phase->mean_cosine(), 0.25, 1e-6);
}

TEST_F(Media, OwnExtension) {
  Gltf gltf = with({{"ETENDUE_transport",
                     {{"medium",
                       {{"scattering", {1, 2, 3}},
                        {"absorption", {0.5, 0, 0}},
                        {"phaseFunction", {{"name", "schlick"}, {"parameters", {{"k", -0.5}}}}},
                        {"boundaryOnly", true},
                        {"priority", 4}}}}}});
  gltf.root["extensions"]["ETENDUE_transport"]["atmosphere"] = {{"scattering", {0.1, 0.1, 0.2}}, {"radius", 30}};
  const auto scene = opened(gltf);
  EXPECT_EQ(all(scene.warnings), "");
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.medium.scattering, Rgb(1, 2, 3));
  EXPECT_EQ(m.medium.absorption, Rgb(0.5f, 0, 0));
  EXPECT_LT(m.medium.phase->mean_cosine(), 0);
  EXPECT_TRUE(m.boundary_only);
  EXPECT_EQ(m.medium_priority, 4);
  EXPECT_EQ(scene.atmosphere.medium.scattering, Rgb(0.1f, 0.1f, 0.2f));
  EXPECT_EQ(scene.atmosphere.radius, 30);
  EXPECT_TRUE(has_scattering_media(scene));
}

TEST_F(Media, DensityAndEmission) {
  Gltf gltf = with({{"ETENDUE_transport",
                     {{"medium",
                       {{"absorption", {1, 2, 3}},
                        {"emission", {4, 5, 6}},
                        {"temperature", 2000},
                        {"density", {{"name", "flame"}, {"parameters", {{"turbulence", 0.25}, {"seed", 5}}}}},
                        {"transmittance", "regular"}}}}}});
  const auto scene = opened(gltf);
  EXPECT_EQ(all(scene.warnings), "");
  const MediumDescription& m = scene.materials[0].medium;
  EXPECT_EQ(m.emission, Rgb(4, 5, 6));
  EXPECT_EQ(m.temperature, 2000);
  EXPECT_EQ(m.density, DensityRef{*make_density("flame", {{"turbulence", 0.25}, {"seed", int64_t{5}}})});
  EXPECT_EQ(m.estimator, TransmittanceEstimator::regular);
}

// Each defect is reported with its place and replaced by a value that renders.
TEST_F(Media, InvalidValuesAreReportedAndIgnored) {
  struct Defect {
    json medium;
    const char* message;
  };
  for (const Defect& defect :
       {Defect{{{"scattering", {-1, 0, 0}}}, "medium.scattering: has to be three numbers from 0 to 1e6"},
        Defect{{{"scattering", {1, 2}}}, "medium.scattering"}, Defect{{{"absorption", "dark"}}, "medium.absorption"},
        Defect{{{"absorption", {0, 1e9, 0}}}, "medium.absorption"}, Defect{{{"priority", 1e9}}, "medium.priority"},
        Defect{{{"emission", {1, -1, 1}}}, "medium.emission"}, Defect{{{"temperature", "hot"}}, "medium.temperature"},
        Defect{{{"transmittance", "magic"}}, "medium.transmittance"},
        Defect{{{"density", "thick"}}, "medium.density.name"},
        Defect{{{"density", {{"name", "steam"}}}}, "there is no density 'steam'"},
        Defect{{{"density", {{"name", "cloud"}, {"parameters", {{"octaves", 99}}}}}}, "density.parameters.octaves"},
        Defect{{{"density", {{"name", "file"}, {"parameters", {{"file", "no.nvdb"}}}}}}, "no.nvdb: cannot be read"},
        Defect{{{"phaseFunction", {{"name", "magic"}}}}, "there is no phase function 'magic'"},
        Defect{{{"phaseFunction", {{"name", "henyey-greenstein"}, {"parameters", {{"g", 1.5}}}}}}, "parameters.g"},
        Defect{{{"phaseFunction", {{"name", "henyey-greenstein"}, {"parameters", {{"h", 0.5}}}}}}, "parameters.h"},
        Defect{{{"phaseFunction", {{"name", "tabulated"}, {"parameters", {{"values", "1 -1"}}}}}}, "value 2"}}) {
    Gltf gltf = with({{"ETENDUE_transport", {{"medium", defect.medium}}}});
    const auto scene = opened(gltf);
    EXPECT_TRUE(warns(scene, defect.message)) << defect.message << '\n' << all(scene.warnings);
    EXPECT_TRUE(warns(scene, "materials[0].extensions.ETENDUE_transport")) << all(scene.warnings);
    EXPECT_TRUE(scene.materials[0].medium.is_clear());
  }
  Gltf gltf = with({{"KHR_materials_volume_scatter", {{"multiscatterColor", {2, 0, 0}}, {"scatterAnisotropy", -7}}}});
  gltf.root["extensions"]["ETENDUE_transport"]["atmosphere"] = {{"radius", -1}};
  const auto scene = opened(gltf);
  EXPECT_TRUE(warns(scene, "multiscatterColor: has to be three numbers from 0 to 1")) << all(scene.warnings);
  EXPECT_TRUE(warns(scene, "scatterAnisotropy")) << all(scene.warnings);
  EXPECT_TRUE(warns(scene, "atmosphere.radius")) << all(scene.warnings);
}

TEST_F(Media, BoundariesThatAreNotClosedAreReported) {
  const json boundary = {{"boundaryOnly", true}, {"scattering", {1, 1, 1}}};
  Gltf closed = with({{"ETENDUE_transport", {{"medium", boundary}}}});
  EXPECT_EQ(all(opened(closed).warnings), "");
  Gltf open;
  open.triangle()["material"] = 0;
  open.root["materials"] = closed.root["materials"];
  EXPECT_TRUE(warns(opened(open), "meshes[0]: encloses a medium, but is not closed"));
  open.root["materials"] = json::array({json::object()});
  EXPECT_EQ(all(opened(open).warnings), "");
}

}  // namespace
}  // namespace etendue::test
