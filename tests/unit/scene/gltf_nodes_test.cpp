// Nodes, cameras and lights.
#include <glm/gtc/matrix_transform.hpp>

#include "scene/pose.h"
#include "unit/scene/gltf_builder.h"

namespace etendue::test {
namespace {

class Nodes : public GltfTest {
 protected:
  static void expect_near(const Mat4& a, const Mat4& b) {
    for (int c = 0; c < 4; ++c) EXPECT_LT(glm::distance(a[c], b[c]), 1e-5f) << "column " << c;
  }
};

TEST_F(Nodes, TransformsAreRelativeToTheParent) {
  Gltf gltf;
  gltf.triangle();
  // A rotation by 90 degrees about z, then the translation and scale of the parent.
  const double h = std::sqrt(0.5);
  gltf.root["nodes"] = {{{"children", {1}}, {"translation", {1, 2, 3}}, {"scale", {2, -1, 1}}},
                        {{"mesh", 0}, {"rotation", {0, 0, h, h}}, {"translation", {5, 0, 0}}}};
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.nodes[1].parent, 0);
  EXPECT_EQ(all(scene.warnings), "");
  const auto world = scene::world_matrices(scene);
  const Mat4 parent = glm::scale(glm::translate(Mat4(1), Vec3(1, 2, 3)), Vec3(2, -1, 1));
  expect_near(world[0], parent);
  expect_near(world[1], parent * glm::rotate(glm::translate(Mat4(1), Vec3(5, 0, 0)), kPi / 2, Vec3(0, 0, 1)));
}

TEST_F(Nodes, MatricesAreColumnMajor) {
  Gltf gltf;
  gltf.triangle();
  gltf.root["nodes"] = {{{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 7, 8, 9, 1}}}};
  const auto scene = opened(gltf);
  expect_near(scene::world_matrices(scene)[0], glm::scale(glm::translate(Mat4(1), Vec3(7, 8, 9)), Vec3(1, 2, 3)));
}

TEST_F(Nodes, RotationsAreNormalised) {
  Gltf gltf;
  gltf.triangle();
  gltf.root["nodes"] = {{{"mesh", 0}, {"rotation", {0, 0, 0, 2}}}, {{"mesh", 0}, {"rotation", {0, 0, 0, 0}}}};
  gltf.root["scenes"][0]["nodes"] = {0, 1};
  const auto scene = opened(gltf);
  for (const auto& m : scene::world_matrices(scene)) expect_near(m, Mat4(1));
  EXPECT_TRUE(warns(scene, "nodes[0].rotation: is not a unit quaternion; it was normalised"));
  EXPECT_TRUE(warns(scene, "nodes[1].rotation: is not a quaternion"));
}

TEST_F(Nodes, SingularTransformsAreNotRendered) {
  Gltf gltf;
  gltf.triangle();
  gltf.root["nodes"] = {{{"mesh", 0}, {"scale", {1, 0, 1}}}, {{"mesh", 0}, {"scale", {1e-4, 1e-4, 1e-4}}}};
  gltf.root["scenes"][0]["nodes"] = {0, 1};
  const auto scene = opened(gltf);
  EXPECT_TRUE(warns(scene, "nodes[0]: the transform is singular, as with a scale of 0; the mesh is not rendered"));
  EXPECT_EQ(scene.warnings.size(), 1U);
  const auto world = scene::world_matrices(scene);
  const auto& primitive = scene.meshes[0].primitives[0];
  EXPECT_TRUE(scene::posed_mesh(scene, 0, primitive, world).mesh->triangles.empty());
  EXPECT_EQ(scene::posed_mesh(scene, 1, primitive, world).mesh, primitive.mesh) << "a small scale is not singular";
  EXPECT_EQ(scene::world_bounds(scene).max, Vec3(1e-4f, 1e-4f, 0));
}

TEST_F(Nodes, LongChainsOfNodes) {
  Gltf gltf;
  gltf.triangle();
  constexpr int kLength = 50000;
  gltf.root["nodes"] = json::array();
  for (int i = 0; i < kLength; ++i) gltf.root["nodes"].push_back({{"children", {i + 1}}, {"translation", {1, 0, 0}}});
  gltf.root["nodes"].push_back({{"mesh", 0}});
  const auto scene = opened(gltf);
  EXPECT_EQ(scene::world_bounds(scene).min.x, kLength);
}

TEST_F(Nodes, RootsAreShownOnce) {
  Gltf gltf;
  gltf.triangle();
  gltf.root["nodes"] = {{{"children", {1}}, {"translation", {1, 0, 0}}}, {{"mesh", 0}}};
  gltf.root["scenes"][0]["nodes"] = {0, 1, 0};
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.roots, std::vector<int>{0});
  EXPECT_TRUE(warns(scene, "nodes[1] is not a root")) << all(scene.warnings);
  EXPECT_TRUE(warns(scene, "nodes[0] is listed twice; it is shown once"));
}

TEST_F(Nodes, PerspectiveCameras) {
  Gltf gltf;
  gltf.triangle();
  gltf.root["cameras"] = {{{"name", "far"},
                           {"type", "perspective"},
                           {"perspective", {{"yfov", 0.5}, {"aspectRatio", 1.5}, {"znear", 0.1}, {"zfar", 100}}}},
                          {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.01}}}},
                          {{"type", "perspective"}, {"perspective", {{"yfov", -1}, {"znear", 5}, {"zfar", 1}}}}};
  gltf.root["nodes"] = {{{"camera", 0}, {"translation", {0, 0, 5}}, {"scale", {2, 2, 2}}},
                        {{"camera", 1}, {"name", "eye"}},
                        {{"camera", 2}}};
  gltf.root["scenes"][0]["nodes"] = {0, 1, 2};
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.cameras[0].yfov, 0.5f);
  EXPECT_EQ(scene.cameras[0].aspect, 1.5f);
  EXPECT_EQ(scene.cameras[0].near_clip, 0.1f);
  EXPECT_EQ(scene.cameras[0].far_clip, 100);
  EXPECT_EQ(scene.cameras[1].far_clip, kInfinity) << "without zfar the projection is infinite";
  EXPECT_EQ(scene.cameras[1].aspect, 0);
  EXPECT_EQ(scene.cameras[2].yfov, 0.8f);
  EXPECT_TRUE(warns(scene, "cameras[2].perspective.yfov: has to be between 0 and pi"));
  EXPECT_TRUE(warns(scene, "cameras[2]: zfar has to be greater than znear"));

  const auto placed = scene::placed_cameras(scene);
  ASSERT_EQ(placed.size(), 3U);
  EXPECT_EQ(placed[0].name, "far");
  expect_near(placed[0].to_world, glm::translate(Mat4(1), Vec3(0, 0, 5)));
  EXPECT_EQ(placed[1].name, "eye") << "a camera without a name has that of its node";
  EXPECT_EQ(scene::choose_camera(scene, "eye")->yfov, 1);
  EXPECT_EQ(scene::choose_camera(scene, "0")->yfov, 0.5f);
  EXPECT_EQ(scene::choose_camera(scene, "")->yfov, 0.5f);
  const auto unknown = scene::choose_camera(scene, "tripod");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().fault, Fault::usage);
  EXPECT_NE(unknown.error().message.find("eye"), std::string::npos);
}

TEST_F(Nodes, OrthographicCameras) {
  Gltf gltf;
  gltf.triangle();
  gltf.root["cameras"] = {
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 10}}}}};
  const auto camera = opened(gltf).cameras[0];
  EXPECT_EQ(camera.projection, Projection::orthographic);
  EXPECT_EQ(camera.ymag, 2);
  EXPECT_EQ(camera.aspect, 1.5f);
  EXPECT_EQ(camera.far_clip, 10);
}

TEST_F(Nodes, CamerasOutsideTheSceneAreNotListed) {
  Gltf gltf;
  gltf.triangle();
  gltf.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.01}}}}};
  gltf.root["nodes"].push_back({{"camera", 0}});
  const auto scene = opened(gltf);
  EXPECT_TRUE(scene::placed_cameras(scene).empty());
  const auto camera = scene::choose_camera(scene, "");
  ASSERT_TRUE(camera) << "a framing camera replaces missing cameras";
  EXPECT_EQ(camera->name, "framing");
}

TEST_F(Nodes, FramingShowsEverything) {
  for (const float size : {1e-4f, 1.0f, 1e6f}) {
    Bounds bounds;
    bounds.extend(Vec3(-size, 0, 2 * size));
    bounds.extend(Vec3(size, 3 * size, 4 * size));
    const Camera camera = scene::framing_camera(bounds);
    const Mat4 to_camera = glm::inverse(camera.to_world);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p(corner & 1 ? bounds.min.x : bounds.max.x, corner & 2 ? bounds.min.y : bounds.max.y,
                   corner & 4 ? bounds.min.z : bounds.max.z);
      const Vec3 seen(to_camera * Vec4(p, 1));
      EXPECT_LT(std::abs(seen.y), -seen.z * std::tan(camera.yfov / 2));
      EXPECT_LT(std::abs(seen.x), -seen.z * std::tan(camera.yfov / 2));
    }
  }
  EXPECT_TRUE(std::isfinite(scene::framing_camera(Bounds{}).to_world[3].x)) << "an empty scene has a framing camera";
  // A small object far from the origin: the direction of the camera would be lost by rounding.
  for (const float far : {1e3f, 1e6f, 1e9f}) {
    Bounds bounds;
    bounds.extend(Vec3(far, 0, -far));
    bounds.extend(Vec3(far, 1e-5f, -far));
    const Camera camera = scene::framing_camera(bounds);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(glm::length(Vec3(camera.to_world[c])), 1, 1e-5f) << far;
  }
}

// The rays of Embree would overflow in the space of the mesh.
TEST(Transforms, ExtremeScalesAreSingular) {
  const auto scaled = [](const Vec3& scale) {
    return scene::is_singular(scene::Transform{.scale = scale}.to_matrix());
  };
  EXPECT_FALSE(scaled({1, 1, 1}));
  EXPECT_FALSE(scaled({1e-6f, 1e-6f, 1e-6f}));
  EXPECT_FALSE(scaled({-2, 2, 1e-5f}));
  EXPECT_TRUE(scaled({2, 2, 0}));
  EXPECT_TRUE(scaled({-2, 2, 1e-19f}));
  EXPECT_TRUE(scaled({1e-9f, 1e-9f, 1e-9f}));
}

TEST_F(Nodes, Lights) {
  Gltf gltf;
  gltf.triangle();
  gltf.root["extensionsUsed"] = {"KHR_lights_punctual"};
  gltf.root["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"color", {1, 0.5, 0}}, {"intensity", 20}, {"range", 4}, {"name", "bulb"}},
      {{"type", "directional"}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
      {{"type", "spot"}, {"spot", json::object()}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 1}, {"outerConeAngle", 0.5}}}}};
  gltf.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 2;
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.nodes[0].light, 2);
  EXPECT_EQ(scene.lights[0].name, "bulb");
  EXPECT_EQ(&scene.lights[0].info(), find_light_type("point"));
  EXPECT_EQ(scene.lights[0].color, Rgb(1, 0.5f, 0));
  EXPECT_EQ(scene.lights[0].intensity(), 20);
  const auto number = [&](size_t light, const char* parameter) {
    return std::get<double>(*scene.lights[light].parameter(parameter));
  };
  EXPECT_EQ(number(0, "range"), 4);
  EXPECT_EQ(&scene.lights[1].info(), find_light_type("directional"));
  EXPECT_EQ(scene.lights[1].intensity(), 1);
  EXPECT_EQ(number(2, "range"), 0);
  EXPECT_EQ(number(2, "inner-cone"), 0.25);
  EXPECT_EQ(number(2, "outer-cone"), 0.5);
  EXPECT_NEAR(number(3, "outer-cone"), double{kPi} / 4, 1e-6);
  EXPECT_LE(number(4, "inner-cone"), number(4, "outer-cone"));
  EXPECT_TRUE(warns(scene, "lights[4].spot: the cone angles"));
  gltf.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 9;
  EXPECT_EQ(error_of(gltf),
            "nodes[0].extensions.KHR_lights_punctual.light: refers to lights[9], which does not exist; the file has 5");
  gltf.root["extensions"]["KHR_lights_punctual"]["lights"][1].erase("type");
  EXPECT_EQ(error_of(gltf), "extensions.KHR_lights_punctual.lights[1]: has no type, which is required");
}

class Instances : public GltfTest {
 protected:
  static Gltf three() {
    Gltf gltf;
    gltf.triangle();
    json& attributes = gltf.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["TRANSLATION"] = gltf.vec3({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
    attributes["ROTATION"] = gltf.vec4({{0, 0, 0, 1}, {0, 0, 2, 0}, {0, 0, 0, 0}});
    attributes["SCALE"] = gltf.vec3({{1, 1, 1}, {1, 1, 1}, {2, 2, 2}});
    gltf.root["nodes"][0]["translation"] = {0, 10, 0};
    gltf.root["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    return gltf;
  }
};

TEST_F(Instances, AreChildrenOfTheirNode) {
  Gltf gltf = three();
  const auto scene = opened(gltf);
  EXPECT_EQ(all(scene.warnings) + all(scene.unsupported), "");
  ASSERT_EQ(scene.nodes.size(), 4U);
  EXPECT_EQ(scene.nodes[0].mesh, -1) << "the node itself has no mesh";
  EXPECT_EQ(scene.nodes[0].children, (std::vector<int>{1, 2, 3}));
  const auto world = scene::world_matrices(scene);
  for (size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(scene.nodes[i].mesh, 0);
    EXPECT_EQ(Vec3(world[i][3]), Vec3(i, 10, 0));
  }
  EXPECT_EQ(Vec3(world[2][0]), Vec3(-1, 0, 0)) << "rotation by 180 degrees about z";
  EXPECT_EQ(Vec3(world[3][0]), Vec3(2, 0, 0)) << "a quaternion of length 0 is no rotation";
}

TEST_F(Instances, AttributesHaveToAgree) {
  Gltf gltf = three();
  json& attributes = gltf.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes["SCALE"] = gltf.vec3({{1, 1, 1}});
  const std::string where = "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.SCALE: ";
  EXPECT_EQ(error_of(gltf), where + "has 1 elements, but other attributes have 3");
  attributes["SCALE"] = 99;
  EXPECT_EQ(error_of(gltf), where + "accessor 99 does not exist; the file has 5");
}

TEST_F(Instances, WithoutAMeshAreIgnored) {
  Gltf gltf = three();
  gltf.root["nodes"][0].erase("mesh");
  EXPECT_TRUE(warns(opened(gltf), "nodes[0].extensions.EXT_mesh_gpu_instancing: the node has to have a mesh"));
}

}  // namespace
}  // namespace etendue::test
