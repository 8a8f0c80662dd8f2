// A scene that is saved and loaded again is unchanged.
#include "bsdf/bsdf_model.h"
#include "image/image.h"
#include "light/environments/sky.h"
#include "render/scene_saving.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/shapes.h"
#include "scene/gltf/save_gltf.h"
#include "scene/variants.h"
#include "support/scene_compare.h"
#include "support/scenes.h"
#include "unit/scene/gltf_builder.h"

namespace etendue::test {
namespace {

namespace fs = std::filesystem;

class Saving : public GltfTest {
 protected:
  scene::Scene saved(const scene::Scene& scene, const std::string& name = "saved.glb") const {
    const auto written = scene::save_gltf(scene, folder_ / name);
    EXPECT_TRUE(written) << written.error().message;
    auto opened = scene::load_gltf(folder_ / name);
    if (opened) return std::move(*opened);
    ADD_FAILURE() << opened.error().message;
    return {};
  }
  // The JSON of a saved .glb.
  json description(const scene::Scene& scene) const {
    EXPECT_TRUE(scene::save_gltf(scene, folder_ / "described.gltf"));
    std::ifstream in(folder_ / "described.gltf");
    return json::parse(in);
  }
};

TEST_F(Saving, ComparisonFindsDifferences) {
  const scene::Scene a = scene::find_builtin("cornell")->make();
  EXPECT_EQ(difference(a, a), "");
  scene::Scene b = a;
  b.nodes[1].name = "other";
  EXPECT_EQ(difference(a, b), "nodes[1].name");
  b = a;
  auto mesh = std::make_shared<Mesh>(*a.meshes[0].primitives[0].mesh);
  mesh->positions[0].x = std::nextafter(mesh->positions[0].x, 9.0f);
  b.meshes[0].primitives[0].mesh = mesh;
  EXPECT_EQ(difference(a, b), "meshes[0].primitives[0].positions: other bits");
  b = a;
  b.materials[0].roughness = 0.123f;
  EXPECT_TRUE(difference(a, b).starts_with("materials[0]")) << difference(a, b);
  b = a;
  b.environment.tint = Rgb(0.5f);
  EXPECT_EQ(difference(a, b), "environment");
}

TEST_F(Saving, BuiltInScenesInBothFormats) {
  for (const auto& builtin : scene::builtins()) {
    const scene::Scene before = builtin.make();
    EXPECT_EQ(difference(before, saved(before)), "") << builtin.name;
    EXPECT_EQ(difference(before, saved(before, "saved.gltf")), "") << builtin.name;
  }
}

// A material without default values; all numbers differ.
Material rich_material() {
  Material m;
  float next = 0.01f;
  const auto number = [&] { return next += 0.0061f; };
  const auto color = [&] { return Rgb(number(), number(), number()); };
  const auto use = [&](int texture) {
    TextureUse u;
    u.texture = texture;
    u.uv_set = texture;
    u.rotation = number();
    u.offset = Vec2(number(), -number());
    u.scale = Vec2(number(), number());
    return u;
  };
  m.name = "rich \"♻\"";
  m.base_color = color();
  m.alpha = number();
  m.base_color_texture = use(0);
  m.metallic = number();
  m.roughness = number();
  m.metallic_roughness_texture = use(1);
  m.normal_texture = use(0);
  m.normal_scale = -number();
  m.emission = color() * 37.0f;
  m.emission_texture = use(1);
  m.emission_spectrum = *find_emission_spectrum("fl2");
  m.alpha_mode = AlphaMode::mask;
  m.alpha_cutoff = number();
  m.double_sided = true;
  m.unlit = true;
  m.layering = Layering::energy_conserving;
  m.ior = 1 + number();
  m.specular = number();
  m.specular_color = color() * 3.0f;
  m.specular_texture = use(0);
  m.specular_color_texture = use(1);
  m.transmission = number();
  m.transmission_texture = use(0);
  m.thickness = number();
  m.attenuation_color = color();
  m.attenuation_distance = number();
  m.medium = {color() * 7.0f, color(), {make_phase_function("double-henyey-greenstein")->with("g2", -0.625)}};
  m.boundary_only = true;
  m.medium_priority = -3;
  m.anisotropy = number();
  m.anisotropy_rotation = -number();
  m.anisotropy_texture = use(1);
  m.clearcoat = number();
  m.clearcoat_roughness = number();
  m.clearcoat_texture = use(0);
  m.clearcoat_roughness_texture = use(1);
  m.clearcoat_normal_texture = use(0);
  m.clearcoat_normal_scale = number();
  m.sheen_color = color();
  m.sheen_roughness = number();
  m.sheen_color_texture = use(1);
  m.sheen_roughness_texture = use(0);
  m.dispersion = 5 * number();
  m.glass = Glass::diamond;
  m.iridescence = number();
  m.iridescence_ior = 1 + number();
  m.iridescence_thickness_min = 1000 * number();
  m.iridescence_thickness_max = 1000 * number();
  m.iridescence_texture = use(1);
  m.iridescence_thickness_texture = use(0);
  m.diffuse_transmission = number();
  m.diffuse_transmission_color = color();
  m.diffuse_transmission_texture = use(1);
  m.diffuse_transmission_color_texture = use(0);
  return m;
}

scene::Scene with_material(const Material& material) {
  scene::Scene scene = scene::find_builtin("cornell")->make();
  scene.textures.resize(2);
  for (size_t t = 0; t < 2; ++t) {
    auto picture = std::make_shared<image::Image>();
    picture->width = 3;
    picture->height = 2;
    picture->channels = t == 0 ? 4 : 2;
    for (int i = 0; i < 6 * picture->channels; ++i) picture->bytes.push_back(static_cast<uint8_t>(37 * i + 11));
    scene.textures[t].image = picture;
    scene.textures[t].name = "t" + std::to_string(t);
  }
  scene.textures[0].wrap_u = Wrap::mirror;
  scene.textures[0].wrap_v = Wrap::clamp;
  scene.textures[1].nearest = true;
  scene.materials[0] = material;
  return scene;
}

TEST_F(Saving, Atmosphere) {
  scene::Scene scene = with_material({});
  scene.atmosphere = {{Rgb(0.1f, 0.2f, 0.3f), Rgb(0.05f), {make_phase_function("rayleigh")}}, 12.5f};
  EXPECT_EQ(difference(scene, saved(scene)), "");
  EXPECT_EQ(saved(scene).atmosphere, scene.atmosphere);
  scene.atmosphere.medium.emission = {1, 2, 0.5f};
  scene.atmosphere.medium.temperature = 1800;
  scene.atmosphere.medium.density.field = *make_density("exponential", {{"scale-height", 0.125}});
  scene.atmosphere.medium.estimator = TransmittanceEstimator::delta;
  EXPECT_EQ(saved(scene).atmosphere, scene.atmosphere);
  scene.atmosphere.radius = kInfinity;
  scene.atmosphere.medium.phase.function = make_phase_function("tabulated")->with("values", std::string("1 0.5 3"));
  EXPECT_EQ(saved(scene).atmosphere, scene.atmosphere);
}

TEST_F(Saving, EveryFieldOfAMaterial) {
  const scene::Scene scene = with_material(rich_material());
  const scene::Scene again = saved(scene);
  EXPECT_EQ(again.materials[0], rich_material());
  EXPECT_EQ(difference(scene, again), "");
  EXPECT_EQ(all(again.unsupported), "");
  EXPECT_FALSE(warns(again, "has to be")) << all(again.warnings);
}

TEST_F(Saving, SpecularGlossiness) {
  Material m;
  m.specular_glossiness = true;
  m.base_color = Rgb(0.1f, 0.2f, 0.3f);
  m.alpha = 0.4f;
  m.specular_color = Rgb(0.5f, 0.6f, 0.7f);
  m.metallic = 0;
  m.base_color_texture.texture = 0;
  m.specular_color_texture.texture = m.metallic_roughness_texture.texture = 1;
  for (const float roughness : {0.0f, 1e-7f, 0.1f, 0.3f, 0.7f, 1.0f}) {
    m.roughness = roughness;
    EXPECT_EQ(saved(with_material(m)).materials[0], m) << roughness;
  }
}

TEST_F(Saving, LensShutterEnvironmentAndTimeAreSaved) {
  image::LayeredImage sky;
  sky.width = 4;
  sky.height = 2;
  sky.layers = {{"", {"R", "G", "B"}, std::vector<float>(24, 0.625f)}};
  sky.layers[0].pixels[5] = 1234.5f;
  ASSERT_TRUE(image::write_exr(folder_ / "sky.exr", sky));
  auto document = *render::new_document("cornell");
  document = *render::with_environment(document, (folder_ / "sky.exr").string());
  for (const auto& [name, value] :
       {std::pair("environment.rotation", "0.5"), std::pair("environment.visible", "false"),
        std::pair("environment.backdrop", "true"), std::pair("environment.backdrop-brightness", "0.5"),
        std::pair("environment.tint.g", "0.25"), std::pair("scene.time", "0.75"),
        std::pair("camera.lens-radius", "0.125"), std::pair("camera.focus-distance", "3.5"),
        std::pair("camera.shutter", "0.0625")})
    document = *render::with_text(document, name, value);
  const scene::Scene before = render::scene_to_save(document), after = saved(before);
  EXPECT_EQ(difference(before, after), "");
  EXPECT_EQ(after.cameras[0].lens_radius, 0.125f);
  EXPECT_EQ(after.cameras[0].focus_distance, 3.5f);
  EXPECT_EQ(after.cameras[0].shutter, 0.0625f);
  EXPECT_EQ(after.time, 0.75f);
  EXPECT_EQ(after.environment.rotation, 0.5f);
  EXPECT_FALSE(after.environment.visible);
  EXPECT_TRUE(after.environment.backdrop);
  EXPECT_EQ(after.environment.backdrop_brightness, 0.5f);
  ASSERT_TRUE(after.environment.map);
  EXPECT_EQ(after.environment.map->floats[5], 1234.5f);
  EXPECT_EQ(description(before)["extensions"]["ETENDUE_transport"]["environment"]["file"], "sky.exr");
  fs::remove(folder_ / "sky.exr");
  const auto lost = scene::load_gltf(folder_ / "saved.glb");
  ASSERT_TRUE(lost) << "a missing environment map is a warning";
  EXPECT_TRUE(warns(*lost, "extensions.ETENDUE_transport.environment.file: ")) << all(lost->warnings);
}

TEST_F(Saving, DefaultValuesNeedNoExtension) {
  // The environment that new_document adds to a scene without light is not saved.
  Gltf gltf;
  gltf.triangle();
  const auto document = render::new_document(write("dark.glb", gltf.glb()).string());
  ASSERT_TRUE(document);
  EXPECT_FALSE(document->scene->environment.black());
  const json plain = description(render::scene_to_save(*document));
  EXPECT_FALSE(plain.contains("extensionsUsed")) << plain.dump();
  EXPECT_FALSE(plain.contains("cameras")) << "the framing camera is not saved";
}

TEST_F(Saving, AMovedCameraComesFirst) {
  auto document = *render::with_text(*render::new_document("cornell"), "camera.eye.x", "0.5");
  const scene::Scene after = saved(render::scene_to_save(document));
  const auto cameras = scene::placed_cameras(after);
  ASSERT_EQ(cameras.size(), 2U);
  EXPECT_EQ(cameras[0].name, "view");
  EXPECT_EQ(cameras[0].to_world, document.camera.to_world);
  // Moving it again does not add another camera.
  document = *render::new_document((folder_ / "saved.glb").string());
  document = *render::with_text(document, "camera.eye.x", "0.75");
  EXPECT_EQ(scene::placed_cameras(saved(render::scene_to_save(document), "twice.glb")).size(), 2U);
}

TEST_F(Saving, CamerasWithAndWithoutPlanesAndAspect) {
  scene::Scene scene = scene::find_builtin("cornell")->make();
  for (const Projection projection : {Projection::perspective, Projection::orthographic})
    for (const float aspect : {0.0f, 1.777f})
      for (const float far : {kInfinity, 123.0f}) {
        Camera& camera = scene.cameras[0];
        camera.projection = projection;
        camera.aspect = aspect;
        camera.far_clip = far;
        camera.yfov = projection == Projection::perspective ? 0.7f : 0.8f;
        camera.ymag = projection == Projection::orthographic ? 2.3f : 1.0f;
        camera.near_clip = far < kInfinity ? 0.1f : 0;
        EXPECT_EQ(saved(scene).cameras[0], camera);
      }
}

TEST_F(Saving, VariantsAndHiddenNodes) {
  scene::Scene scene = scene::find_builtin("cornell")->make();
  scene.variants = {"one", "two"};
  scene.meshes[0].primitives[0].choices = {scene.meshes[0].primitives[0].material, 1, 0};
  scene.nodes[2].visible = false;
  scene::select_variant(scene, 0);
  EXPECT_EQ(difference(scene, saved(scene)), "");
  scene::keep_only_variant(scene, 1);
  const scene::Scene after = saved(scene);
  EXPECT_TRUE(after.variants.empty());
  EXPECT_EQ(after.meshes[0].primitives[0].material, 0);
}

TEST_F(Saving, SharedMeshesStayShared) {
  scene::Scene scene = scene::find_builtin("cornell")->make();
  scene.meshes[1].primitives[0].mesh = scene.meshes[0].primitives[0].mesh;
  const json root = description(scene);
  EXPECT_EQ(root["meshes"][0]["primitives"][0]["attributes"], root["meshes"][1]["primitives"][0]["attributes"]);
}

TEST_F(Saving, FloatImagesAreClampedWithAWarning) {
  scene::Scene scene = with_material(rich_material());
  auto picture = std::make_shared<image::Image>();
  picture->width = 2;
  picture->height = 1;
  picture->channels = 3;
  picture->type = image::PixelType::float32;
  picture->floats = {0, 0.5f, 1, 2, -1, 0.25f};
  scene.textures[0].image = picture;
  std::vector<std::string> warnings;
  ASSERT_TRUE(scene::save_gltf(scene, folder_ / "floats.glb", &warnings));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0], "textures[0]: the floating-point image was clamped to [0, 1] and stored with 16 bits");
  const auto again = scene::load_gltf(folder_ / "floats.glb");
  EXPECT_EQ(again->textures[0].image->bytes, (std::vector<uint8_t>{0, 188, 255, 255, 0, 137})) << "as sRGB";
}

TEST_F(Saving, ErrorsAreReported) {
  const scene::Scene scene = scene::find_builtin("cornell")->make();
  const auto nowhere = scene::save_gltf(scene, folder_ / "no/such/folder.glb");
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().fault, Fault::output);
  const auto wrong = scene::save_gltf(scene, folder_ / "scene.obj");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().fault, Fault::usage);
}

TEST_F(Saving, ExtensionValuesOutOfRange) {
  Gltf gltf;
  gltf.triangle();
  gltf.root["extensionsUsed"] = {"ETENDUE_transport"};
  gltf.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  gltf.root["cameras"][0]["extensions"]["ETENDUE_transport"] = {{"lensRadius", -1}, {"shutter", "long"}};
  gltf.root["extensions"]["ETENDUE_transport"] = {
      {"time", -2}, {"environment", {{"tint", {1, -1, 0}}, {"rotation", {1}}, {"file", 7}}}};
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.time, 0);
  EXPECT_EQ(scene.cameras[0].lens_radius, 0);
  EXPECT_EQ(scene.environment.tint, Rgb(1));
  for (const char* text :
       {"cameras[0].extensions.ETENDUE_transport.lensRadius: has to be a number from 0 to 1e+09; it is ignored",
        "cameras[0].extensions.ETENDUE_transport.shutter, extensions.ETENDUE_transport.time: has to be a number of at "
        "least 0",
        "extensions.ETENDUE_transport.environment.tint:", "extensions.ETENDUE_transport.environment.rotation:"})
    EXPECT_TRUE(warns(scene, text)) << text << "\n" << all(scene.warnings);
  gltf.root["extensions"]["ETENDUE_transport"] = {{"variant", 3}};
  EXPECT_EQ(error_of(gltf),
            "extensions.ETENDUE_transport: refers to variants[3], which does not exist; the file has 0");
}

TEST_F(Saving, EveryAssetOfTheData) {
  const std::string data = data_folder();
  if (data.empty()) GTEST_SKIP() << "ETENDUE_TEST_DATA is not a folder";
  int seen = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(data) / "gltf")) {
    if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb") continue;
    const auto before = scene::load_gltf(entry.path());
    if (!before) continue;
    EXPECT_EQ(difference(*before, saved(*before)), "") << entry.path();
    ++seen;
  }
  EXPECT_GT(seen, 120);
}

TEST_F(Saving, ImagesAreBitIdentical) {
  std::vector<std::string> scenes{"cornell"};
  if (const std::string data = data_folder(); !data.empty())
    for (const char* file : {"BoxTextured.glb", "RiggedSimple.glb", "LightsPunctualLamp/glTF/LightsPunctualLamp.gltf"})
      if (fs::exists(fs::path(data) / "gltf" / file)) scenes.push_back((fs::path(data) / "gltf" / file).string());
  for (const auto& name : scenes) {
    const auto picture = [](render::Document document) {
      document.width = 48;
      document.height = 32;
      return rendered(document, 4);
    };
    const auto before = render::new_document(name);
    ASSERT_TRUE(before) << before.error().message;
    ASSERT_TRUE(scene::save_gltf(render::scene_to_save(*before), folder_ / "picture.gltf"));
    const auto after = render::new_document((folder_ / "picture.gltf").string());
    ASSERT_TRUE(after) << after.error().message;
    EXPECT_TRUE(same_bits(picture(*before), picture(*after))) << name;
  }
}

// All reflection models with all presets and both limits of each parameter.
TEST_F(Saving, BsdfModels) {
  scene::Scene before = scene::find_builtin("cornell")->make();
  const auto add = [&](std::shared_ptr<const BsdfModel> model) {
    Material m;
    m.name = "model " + std::to_string(before.materials.size());
    m.model.model = std::move(model);
    before.materials.push_back(m);
  };
  for (const BsdfModelInfo& info : bsdf_model_infos()) {
    const auto usual = make_bsdf_model(info.description.name);
    add(usual);
    for (const ModelPreset& preset : info.presets) add(with_preset(usual, preset.name));
    for (const ParameterInfo& p : info.parameters) {
      if (p.type == ParameterType::number) {
        add(usual->with(p.name, p.min));
        add(usual->with(p.name, p.max));
      }
      if (p.type == ParameterType::integer) add(usual->with(p.name, static_cast<int64_t>(p.min)));
    }
  }
  EXPECT_EQ(difference(before, saved(before)), "");
}

TEST_F(Saving, UnknownReflectionModels) {
  scene::Scene before = scene::find_builtin("cornell")->make();
  before.materials[0].model.model = make_bsdf_model("phong");
  json file = description(before);
  auto& extension = file["materials"][0]["extensions"]["ETENDUE_transport"];
  extension["parameters"]["exponent"] = 1e9;
  extension["parameters"]["shininess"] = 3;
  std::ofstream(folder_ / "described.gltf") << file;
  auto opened = scene::load_gltf(folder_ / "described.gltf");
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_TRUE(opened->materials[0].model == before.materials[0].model);
  EXPECT_EQ(opened->warnings.size(), 2u);
  extension["model"] = "fong";
  std::ofstream(folder_ / "described.gltf") << file;
  opened = scene::load_gltf(folder_ / "described.gltf");
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_FALSE(opened->materials[0].model);
  ASSERT_EQ(opened->warnings.size(), 1u);
  EXPECT_NE(opened->warnings[0].find("fong"), std::string::npos);
}

TEST_F(Saving, UnknownLayering) {
  scene::Scene before = scene::find_builtin("cornell")->make();
  before.materials[0].layering = Layering::energy_conserving;
  json file = description(before);
  auto& extension = file["materials"][0]["extensions"]["ETENDUE_transport"];
  EXPECT_EQ(extension, json({{"layering", "energy-conserving"}}));
  extension["layering"] = "onion";
  std::ofstream(folder_ / "described.gltf") << file;
  const auto opened = scene::load_gltf(folder_ / "described.gltf");
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(opened->materials[0].layering, Layering::gltf);
  EXPECT_TRUE(warns(*opened, "layering: 'onion'")) << all(opened->warnings);
}

// A value that is not the default.
Value other_value(const ParameterInfo& p) {
  switch (p.type) {
    case ParameterType::toggle:
      return !std::get<bool>(p.default_value);
    case ParameterType::integer:
      return int64_t{9};
    case ParameterType::number:
      return double{static_cast<float>(p.min + 0.1 * (p.max - p.min))};
    default:
      return p.options.back();
  }
}

// Spectra are stored by name; the path of a file is relative to the scene.
TEST_F(Saving, SpectraOfEmitters) {
  std::ofstream(folder_ / "bulb.csv") << "400,1\n700,3\n";
  scene::Scene before = scene::find_builtin("cornell")->make();
  for (const std::string& name : {std::string("a"), std::string("3000K"), (folder_ / "bulb.csv").string()}) {
    Light light = make_light("spot");
    light.spectrum = *find_emission_spectrum(name);
    scene::add(before, light, {});
  }
  before.environment.tint = Rgb(1);
  before.environment.spectrum = *find_emission_spectrum("d65");
  const scene::Scene after = saved(before);
  EXPECT_EQ(difference(before, after), "");
  EXPECT_TRUE(after.lights.back().spectrum);
  const json lights = description(before)["extensions"]["KHR_lights_punctual"]["lights"];
  EXPECT_EQ(lights.back()["extensions"]["ETENDUE_transport"]["spectrum"], "bulb.csv");

  json file = json::parse(std::ifstream(folder_ / "described.gltf"));
  file["extensions"]["KHR_lights_punctual"]["lights"].back()["extensions"]["ETENDUE_transport"]["spectrum"] = "no.csv";
  std::ofstream(folder_ / "lost.gltf") << file;
  const auto lost = scene::load_gltf(folder_ / "lost.gltf");
  ASSERT_TRUE(lost);
  EXPECT_FALSE(lost->lights.back().spectrum);
  EXPECT_TRUE(warns(*lost, "ETENDUE_transport.spectrum: ")) << all(lost->warnings);
}

TEST_F(Saving, SpectraOfMedia) {
  std::ofstream(folder_ / "dye.csv") << "400,1\n700,3\n";
  scene::Scene before = scene::find_builtin("cornell")->make();
  before.atmosphere.medium.set_spectrum(Coefficient::absorption,
                                        *find_coefficient_spectrum(Coefficient::absorption, "pure-water"));
  before.materials[0].medium.set_spectrum(
      Coefficient::scattering, *find_coefficient_spectrum(Coefficient::scattering, (folder_ / "dye.csv").string()));
  const scene::Scene after = saved(before);
  EXPECT_EQ(difference(before, after), "");
  EXPECT_TRUE(after.atmosphere.medium.absorption_spectrum);
  EXPECT_TRUE(after.materials[0].medium.scattering_spectrum);

  json file = description(before);
  EXPECT_EQ(file["materials"][0]["extensions"]["ETENDUE_transport"]["medium"]["scatteringSpectrum"], "dye.csv");
  file["materials"][0]["extensions"]["ETENDUE_transport"]["medium"]["scatteringSpectrum"] = "no.csv";
  std::ofstream(folder_ / "lost.gltf") << file;
  const auto lost = scene::load_gltf(folder_ / "lost.gltf");
  ASSERT_TRUE(lost);
  EXPECT_FALSE(lost->materials[0].medium.scattering_spectrum);
  EXPECT_TRUE(warns(*lost, "scatteringSpectrum: ")) << all(lost->warnings);
}

// ETENDUE_transport keeps what KHR_lights_punctual cannot hold; other readers find point lights of the same power.
TEST_F(Saving, LightsOfEveryType) {
  scene::Scene before = scene::find_builtin("cornell")->make();
  for (const LightTypeInfo& type : light_type_infos()) {
    Light light = make_light(type.description.name);
    light.name = type.description.label;
    light.color = {1, 0.5f, 0.25f};
    scene::add(before, light, {});
    for (const ParameterInfo& p : type.parameters) light.set(p.name, other_value(p));
    scene::add(before, light, {});
  }
  EXPECT_EQ(difference(before, saved(before)), "");
  const json file = description(before);
  for (const auto& light : file["extensions"]["KHR_lights_punctual"]["lights"])
    EXPECT_TRUE(light["type"] == "point" || light["type"] == "spot" || light["type"] == "directional");
}

// The path of a photometric file is stored relative to the scene, and the light emits the same after loading.
TEST_F(Saving, PhotometricFiles) {
  std::ofstream(folder_ / "lamp.ies")
      << "IESNA:LM-63-2002\nTILT=INCLUDE\n1\n2\n0 90\n1 0.5\n1 -1 2 3 1 1 2 0 0 0\n1 1 9\n"
         "0 45 90\n0\n10 7 1\n";
  scene::Scene before = scene::find_builtin("cornell")->make();
  Light light = make_light("photometric");
  light.set("profile", (folder_ / "lamp.ies").string());
  scene::add(before, light, {});
  const scene::Scene after = saved(before);
  EXPECT_EQ(difference(before, after), "");
  EXPECT_EQ(before.lights.back().flux(), after.lights.back().flux());
  EXPECT_GT(after.lights.back().flux().g, 30);
  const json lights = description(before)["extensions"]["KHR_lights_punctual"]["lights"];
  EXPECT_NE(lights.dump().find("\"lamp.ies\""), std::string::npos) << lights.dump();
}

TEST_F(Saving, SkiesOfBothModels) {
  for (const SkyModel model : {SkyModel::preetham, SkyModel::hosek_wilkie}) {
    scene::Scene before = scene::find_builtin("cornell")->make();
    before.environment = make_sky({.model = model,
                                   .sun_position = SunPosition::time,
                                   .sun_elevation = 0.3f,
                                   .sun_azimuth = -1,
                                   .latitude = -0.6f,
                                   .day = 20,
                                   .hour = 16.5f,
                                   .turbidity = least_turbidity(model),
                                   .ground_albedo = 0.7f,
                                   .sun_disk = false});
    EXPECT_EQ(difference(before, saved(before)), "");
  }
}

}  // namespace
}  // namespace etendue::test
