// The registry of integrators: groups, keys, parameters, and incompatibilities with documents.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "integrator/bdpt/techniques.h"
#include "integrator/integrator.h"
#include "render/incompatibility.h"
#include "scene/compiled_scene.h"
#include "support/scenes.h"

namespace etendue::registry_test {
namespace {

TEST(Registry, GroupsAreContiguousAndInOrder) {
  const auto& infos = integrator::integrator_infos();
  EXPECT_TRUE(std::ranges::is_sorted(infos, {}, &integrator::IntegratorInfo::group));
}

TEST(Registry, KeysAreUnique) {
  std::set<char> keys;
  for (const auto& info : integrator::integrator_infos()) {
    if (!info.shortcut) continue;
    EXPECT_TRUE(info.shortcut >= '1' && info.shortcut <= '9') << info.name;
    EXPECT_TRUE(keys.insert(info.shortcut).second) << info.name;
  }
  EXPECT_TRUE(keys.contains('1'));
}

TEST(Registry, TechniquesAreParametersOfTheIntegrator) {
  size_t methods = 0;
  for (const auto& info : integrator::integrator_infos()) {
    if (info.techniques.empty()) continue;
    ++methods;
    for (const auto& knob : {info.techniques.without, info.techniques.only}) {
      const auto* p = find_parameter(info.parameters, knob);
      ASSERT_TRUE(p && p->validate_text) << info.name << ' ' << knob;
      EXPECT_TRUE(p->validate_text("0,3 1,*")) << info.name;
      EXPECT_FALSE(p->validate_text("0;3")) << info.name;
    }
    const auto* weighted = find_parameter(info.parameters, info.techniques.weighted);
    ASSERT_TRUE(weighted) << info.name;
    EXPECT_EQ(weighted->type, ParameterType::toggle);
  }
  EXPECT_GT(methods, 0u);
}

std::string incompatibility_of(const render::Document& d) {
  return render::incompatibility(d, *scene::compile(d.scene, d.camera, nullptr));
}

render::Document floor_under_point_light() {
  scene::Scene scene;
  test::add(scene, test::quad(10), test::diffuse(Rgb(0.5f)));
  test::add_point_light(scene, {0, 2, 0}, 10);
  return test::document(scene, look_at({1, 1, 0}, {0, 0, 0}, {0, 1, 0}, 1), 16, 16);
}

// An incompatible document renders black, and every sample reports the incompatibility.
TEST(Incompatibility, IsReportedWhereAnIntegratorFindsNothing) {
  auto parallel = test::cornell(16);
  parallel = *render::with_text(parallel, "camera.projection", "orthographic");
  for (const auto& place : {test::cornell(16), parallel, floor_under_point_light()}) {
    size_t clear = 0;
    for (const auto& info : integrator::integrator_infos()) {
      auto d = place;
      d.method.integrator = info.name;
      const double mean = test::mean_of(test::rendered(d, 4)).value;
      const std::string incompatibility = incompatibility_of(d);
      EXPECT_EQ(mean > 0, incompatibility.empty()) << info.name << ' ' << incompatibility;
      clear += incompatibility.empty();
    }
    EXPECT_GT(clear, 0u);
  }
}

TEST(Incompatibility, MessageStatesTheRemedy) {
  auto d = test::cornell(16);
  d.method.integrator = "light-pure";
  EXPECT_NE(incompatibility_of(d).find("camera.lens-radius"), std::string::npos) << incompatibility_of(d);
  d = *render::with_text(d, "camera.lens-radius", "0.1");
  EXPECT_EQ(incompatibility_of(d), "");
  d.method.paths = "EDL";
  d.method.integrator = "raycast";
  EXPECT_EQ(incompatibility_of(d), "");
  d.method.paths = "EDDL";
  EXPECT_NE(incompatibility_of(d).find("film.paths"), std::string::npos);
}

TEST(Incompatibility, AdaptiveSamplingNeedsIndependentPixels) {
  for (const auto& info : integrator::integrator_infos())
    EXPECT_EQ(render::adaptive_incompatibility(info.name).empty(),
              info.accumulation == integrator::Accumulation::per_pixel)
        << info.name;
}

}  // namespace
}  // namespace etendue::registry_test
