// Warnings that depend on the scene and on the integrator.
#include "render/scene_warnings.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace etendue::render {
namespace {

Document room_with_portal(const char* integrator, Vec2 size) {
  Document d = *new_document("cornell");
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  scene->nodes[0].portal = size;
  d.scene = scene;
  d.method.integrator = integrator;
  return d;
}

bool warns_about_portals(const Document& d) {
  return std::ranges::any_of(current_warnings(d), [](const std::string& warning) {
    return warning.find("ignores environment portals") != std::string::npos;
  });
}

TEST(SceneWarnings, IntegratorsThatIgnorePortals) {
  for (const char* integrator : {"bdpt", "pssmlt", "mlt", "light", "light-pure", "path-pure"})
    EXPECT_TRUE(warns_about_portals(room_with_portal(integrator, {1, 1}))) << integrator;
  for (const char* integrator : {"path", "distribution", "photonmap"})
    EXPECT_FALSE(warns_about_portals(room_with_portal(integrator, {1, 1}))) << integrator;
  EXPECT_FALSE(warns_about_portals(room_with_portal("bdpt", {1, 0})));
}

}  // namespace
}  // namespace etendue::render
