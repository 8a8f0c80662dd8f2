// New documents: additions to a scene without light or camera.
#include "render/document.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "film/film.h"
#include "image/image.h"
#include "light/environments/builtin_environment.h"
#include "light/sampling/environment_map.h"
#include "render/scene_saving.h"
#include "render/session.h"
#include "scene/builtin/scene_builder.h"
#include "scene/builtin/shapes.h"
#include "scene/gltf/save_gltf.h"

namespace etendue::render {
namespace {

// A file with one material and no geometry.
Result<Document> opened(const std::string& material) {
  const auto file = std::filesystem::temp_directory_path() / ("etendue-lit-" + std::to_string(::getpid()) + ".gltf");
  std::ofstream(file)
      << R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_emissive_strength"],"scenes":[{}],)"
      << R"("materials":[)" << material << "]}";
  auto document = new_document(file.string());
  std::filesystem::remove(file);
  return document;
}

TEST(NewDocument, AWeakEmitterIsNoLightSource) {
  for (const char* material : {"{}", R"({"emissiveFactor":[1,1,1]})"}) {
    const auto document = opened(material);
    ASSERT_TRUE(document) << document.error().message;
    EXPECT_FALSE(document->scene->environment.black()) << material;
    ASSERT_FALSE(document->scene->warnings.empty());
    EXPECT_NE(document->scene->warnings.back().find("studio environment"), std::string::npos);
  }
}

TEST(NewDocument, AStrongEmitterIsALightSource) {
  const auto document =
      opened(R"({"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":5}}})");
  ASSERT_TRUE(document) << document.error().message;
  EXPECT_TRUE(document->scene->environment.black());
  EXPECT_TRUE(new_document("cornell")->scene->environment.black());
}

// A file with a triangle and no light. Removed at the end of the test.
class UnlitScene : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto saved = scene::save_gltf(
        [] {
          scene::Scene s;
          scene::add(s, scene::quad(1), scene::diffuse(Rgb(0.5f)));
          return s;
        }(),
        file_);
    ASSERT_TRUE(saved) << saved.error().message;
    auto document = new_document(file_.string());
    ASSERT_TRUE(document) << document.error().message;
    document_ = *document;
  }
  void TearDown() override { std::filesystem::remove(file_); }

  std::string preset(const Document& d) const { return std::get<std::string>(*get(d, "environment.preset")); }

  const std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("etendue-unlit-" + std::to_string(::getpid()) + ".glb");
  Document document_;
};

TEST_F(UnlitScene, IsLitByTheStudioAndToneMapped) {
  EXPECT_EQ(preset(document_), "studio");
  EXPECT_TRUE(document_.lit_by_default);
  EXPECT_EQ(document_.display.curve, image::ToneCurve::neutral);
  EXPECT_TRUE(scene_to_save(document_).environment.black());
}

// The camera sees a backdrop, which is brighter above.
TEST_F(UnlitScene, IsShownInFrontOfABackdrop) {
  EXPECT_FALSE(document_.scene->environment.visible);
  EXPECT_TRUE(document_.scene->environment.backdrop);
  for (const char* name : {"studio", "overcast", "uniform", "sky"}) {
    const auto chosen = *with_text(document_, "environment.preset", name);
    const EnvironmentMap map(chosen.scene->environment);
    EXPECT_TRUE(map.shows_backdrop()) << name;
    EXPECT_NEAR(map.seen_radiance({0, 1, 0}).g / map.seen_radiance({0, -1, 0}).g, 3, 1e-4f) << name;
  }
  const auto shown = *with_text(document_, "environment.visible", "true");
  EXPECT_EQ(shown.scene->environment, [] {
    Environment studio = make_environment(*find_builtin_environment("studio"));
    studio.backdrop = true;
    return studio;
  }());
  const auto parameters = section_parameters(shown, "environment");
  const auto backdrop = std::ranges::find_if(
      parameters, [](const DocumentParameter& p) { return p.info.name == "environment.backdrop"; });
  ASSERT_NE(backdrop, parameters.end());
  EXPECT_FALSE(backdrop->inactive_reason.empty());
}

// A flat surface with the default material of glTF, a rough white metal, reflects the grey of the studio. In the middle
// of the image it differs from the backdrop beside it by at least 40 of 255 levels, from all sides of its upper half-space.
TEST_F(UnlitScene, AFlatSurfaceOfTheDefaultMaterialContrastsWithTheBackdrop) {
  scene::Scene s = *document_.scene;
  for (Material& material : s.materials) material = Material();
  document_.scene = std::make_shared<const scene::Scene>(std::move(s));
  document_.width = document_.height = 32;
  constexpr uint32_t kSamples = 64;
  for (const Vec3& eye : {Vec3(0, 2, 4), Vec3(0, 4, 1), Vec3(3, 1, 3), Vec3(-3, 1, 3)}) {
    document_.camera = look_at(eye, Vec3(0), {0, 1, 0}, 0.8f);
    const film::Film film = rendered(document_, kSamples, 1);
    const auto level = [&](int x, int y) {
      const auto& display = document_.display;
      return 255 * image::displayed(film.mean(x, y), display.exposure, display.curve).g;
    };
    EXPECT_GT(std::abs(level(16, 16) - level(1, 16)), 40) << eye.x << " " << eye.y;
  }
}

// The image of the backdrop alone.
TEST_F(UnlitScene, TheBackdropIsRendered) {
  auto d = *with_text(document_, "environment.preset", "uniform");
  d.camera = look_at({0, 5, 0}, {0, 10, 0}, {0, 0, 1}, 0.1f);
  d.width = d.height = 8;
  const film::Film film = rendered(d, 2, 1);
  EXPECT_NEAR(film.mean(4, 4).g, EnvironmentMap(d.scene->environment).seen_radiance({0, 1, 0}).g, 1e-3f);
}

// A map from a file is a background of its own.
TEST_F(UnlitScene, AnEnvironmentMapFromAFileIsShown) {
  const auto file = std::filesystem::temp_directory_path() / ("etendue-map-" + std::to_string(::getpid()) + ".hdr");
  ASSERT_TRUE(image::write_hdr(file, 4, 2, std::vector<float>(24, 0.5f)));
  auto d = *with_environment(document_, file.string());
  EXPECT_TRUE(d.scene->environment.visible);
  d = *with_text(d, "environment.visible", "false");
  const auto reopened = document_from_state(state_json(d, 1), "test");
  ASSERT_TRUE(reopened) << reopened.error().message;
  EXPECT_FALSE(reopened->scene->environment.visible) << "the state keeps what was chosen";
  const auto shown = document_from_state(state_json(*with_text(d, "environment.visible", "true"), 1), "test");
  EXPECT_TRUE(shown->scene->environment.visible);
  std::filesystem::remove(file);
}

TEST_F(UnlitScene, EnvironmentsAreSelectedByName) {
  const auto sunset = with_text(document_, "environment.preset", "sunset");
  ASSERT_TRUE(sunset);
  Environment expected = make_environment(*find_builtin_environment("sunset"));
  expected.visible = false;
  expected.backdrop = true;
  EXPECT_EQ(sunset->scene->environment, expected);
  const auto none = with_text(*sunset, "environment.preset", "none");
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->scene->environment.black());
  EXPECT_EQ(preset(*none), "none");
  EXPECT_FALSE(with_text(document_, "environment.preset", "cellar"));
}

TEST_F(UnlitScene, StateKeepsTheEnvironment) {
  auto edited = *with_text(document_, "environment.preset", "overcast");
  edited = *with_text(edited, "environment.tint.r", "0.5");
  const auto reopened = document_from_state(state_json(edited, 1), "test");
  ASSERT_TRUE(reopened) << reopened.error().message;
  EXPECT_EQ(reopened->scene->environment, edited.scene->environment);
  EXPECT_EQ(display_from_state(state_json(document_, 1)), document_.display);
}

// Images of version 1 show unlit scenes in uniform light without a tone curve, and do so when they are opened again.
TEST_F(UnlitScene, StateOfVersion1KeepsTheUniformEnvironment) {
  const std::string state = R"({"program":"etendue","version":1,"scene":")" + file_.string() +
                            R"(","camera":"","samples":4,"settings":{"camera.exposure":1.0}})";
  const auto reopened = document_from_state(state, "test");
  ASSERT_TRUE(reopened) << reopened.error().message;
  EXPECT_EQ(preset(*reopened), "uniform");
  EXPECT_TRUE(reopened->scene->environment.visible);
  EXPECT_EQ(reopened->display, (Display{.exposure = 1, .curve = image::ToneCurve::none}));
}

// In version 2 the studio was visible.
TEST_F(UnlitScene, StateOfVersion2ShowsTheEnvironment) {
  const std::string state = R"({"program":"etendue","version":2,"scene":")" + file_.string() +
                            R"(","camera":"","samples":4,"settings":{}})";
  const auto reopened = document_from_state(state, "test");
  ASSERT_TRUE(reopened) << reopened.error().message;
  EXPECT_EQ(reopened->scene->environment, make_environment(*find_builtin_environment("studio")));
}

// Values of unexpected types are errors or are ignored.
TEST(DocumentState, DamagedStatesAreErrors) {
  for (const char* text : {"", "[]", "5", R"({"program": 5})", R"({"program": "etendue", "scene": {}})",
                           R"({"program": "etendue", "scene": "cornell", "settings": [1]})",
                           R"({"program": "etendue", "scene": "cornell", "settings": {"film.width": {}}})"}) {
    const auto document = document_from_state(text, "a.exr");
    ASSERT_FALSE(document) << text;
    EXPECT_NE(document.error().message.find("a.exr: its settings are damaged"), std::string::npos) << text;
    EXPECT_EQ(display_from_state(text), Display{}) << text;
  }
}

TEST_F(UnlitScene, SavedSceneNamesItsEnvironment) {
  const auto sunset = *with_text(document_, "environment.preset", "sunset");
  ASSERT_TRUE(scene::save_gltf(scene_to_save(sunset), file_));
  const auto reopened = new_document(file_.string());
  ASSERT_TRUE(reopened) << reopened.error().message;
  EXPECT_FALSE(reopened->lit_by_default);
  EXPECT_EQ(preset(*reopened), "sunset");
}

// "auto" is a value of render.integrator, but the method of the document stays one of the registry.
TEST(AutomaticIntegrator, IsAFlagOfTheDocument) {
  const Document original = *new_document("cornell");
  auto d = with_text(original, "render.integrator", "auto");
  ASSERT_TRUE(d);
  EXPECT_TRUE(d->automatic.is_pending());
  EXPECT_EQ(d->method, original.method);
  EXPECT_EQ(*get(*d, "render.integrator"), Value(std::string("auto")));
  EXPECT_FALSE(with_text(*d, "render.integrator", "path")->automatic.enabled);
  // Until a choice was made, a state stores none.
  auto reopened = document_from_state(state_json(*d, 0), "test");
  ASSERT_TRUE(reopened);
  EXPECT_EQ(reopened->automatic, d->automatic);
  d->method.integrator = "bdpt";
  d->automatic.reason = "because";
  d->automatic.allow = AllowedIntegrators::consistent;
  d->automatic.error = render::MinimisedError::displayed;
  reopened = document_from_state(state_json(*d, 0), "test");
  ASSERT_TRUE(reopened) << reopened.error().message;
  EXPECT_EQ(reopened->automatic, d->automatic);
  EXPECT_EQ(reopened->method, d->method);
  // Another restriction makes a new choice necessary; the same one does not.
  EXPECT_FALSE(with_text(*d, "auto.allow", "consistent")->automatic.is_pending());
  EXPECT_TRUE(with_text(*d, "auto.allow", "anything")->automatic.is_pending());
  EXPECT_FALSE(with_text(*d, "render.integrator", "auto")->automatic.is_pending());
}

TEST(AutomaticIntegrator, ADamagedChoiceIsRefused) {
  const Document original = *new_document("cornell");
  const std::string state = state_json(*with_text(original, "render.integrator", "auto"), 0);
  const std::string head = state.substr(0, state.size() - 1);
  for (const char* automatic :
       {"3", "{}", R"({"reason": "r"})", R"({"reason": "r", "integrator": "auto"})",
        R"({"reason": "r", "integrator": "unknown"})", R"({"reason": 1, "integrator": "path"})"})
    EXPECT_FALSE(document_from_state(head + ",\"automatic\": " + automatic + "}", "test")) << automatic;
}

}  // namespace
}  // namespace etendue::render
