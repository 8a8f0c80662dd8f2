// Animations, morph targets and skins.
#include <glm/gtc/matrix_transform.hpp>

#include "unit/scene/gltf_builder.h"

namespace etendue::test {
namespace {

class Animations : public GltfTest {
 protected:
  // Node 0 with one animated property.
  static Gltf animated(const char* path, const char* interpolation, int components, const std::vector<float>& times,
                       const std::vector<float>& values) {
    static constexpr const char* kTypes[] = {"", "SCALAR", "", "VEC3", "VEC4"};
    Gltf gltf;
    gltf.triangle();
    const int input = gltf.floats(times);
    const int output =
        gltf.accessor(gltf.view(values), kFloat, kTypes[components], values.size() / static_cast<size_t>(components));
    gltf.root["animations"] = {
        {{"name", "move"},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}},
         {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}}};
    return gltf;
  }
  static Vec3 place(scene::Scene scene, float time) {
    scene.time = time;
    return Vec3(scene::world_matrices(scene)[0][3]);
  }
  static Mat4 matrix(scene::Scene scene, float time) {
    scene.time = time;
    return scene::world_matrices(scene)[0];
  }
};

TEST_F(Animations, Linear) {
  Gltf gltf = animated("translation", "LINEAR", 3, {1, 2, 4}, {0, 0, 0, 10, 0, 0, 10, 20, 0});
  const auto scene = opened(gltf);
  ASSERT_EQ(scene.animations.size(), 1U);
  EXPECT_EQ(scene.animations[0]->name, "move");
  EXPECT_EQ(scene.animations[0]->duration, 4);
  EXPECT_EQ(place(scene, 0), Vec3(0)) << "constant before the first keyframe";
  EXPECT_EQ(place(scene, 1.25f), Vec3(2.5f, 0, 0));
  EXPECT_EQ(place(scene, 2), Vec3(10, 0, 0));
  EXPECT_EQ(place(scene, 3), Vec3(10, 10, 0));
  EXPECT_EQ(place(scene, 99), Vec3(10, 20, 0));
}

TEST_F(Animations, Step) {
  Gltf gltf = animated("translation", "STEP", 3, {0, 1}, {1, 0, 0, 2, 0, 0});
  const auto scene = opened(gltf);
  EXPECT_EQ(place(scene, 0.999f), Vec3(1, 0, 0));
  EXPECT_EQ(place(scene, 1), Vec3(2, 0, 0));
}

TEST_F(Animations, CubicSpline) {
  // In-tangent, value, out-tangent; from 0 to 1 within two seconds, with derivative 3 at the first keyframe and -1 at
  // the second.
  Gltf gltf =
      animated("translation", "CUBICSPLINE", 3, {0, 2}, {0, 0, 0, 0, 0, 0, 3, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0});
  const auto scene = opened(gltf);
  for (const float t : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    const float t2 = t * t, t3 = t2 * t;
    const float expected = 2 * (t3 - 2 * t2 + t) * 3 + (-2 * t3 + 3 * t2) * 1 + 2 * (t3 - t2) * -1;
    EXPECT_NEAR(place(scene, 2 * t).x, expected, 1e-6f);
  }
  // The derivative at the first key is the out-tangent.
  EXPECT_NEAR(place(scene, 1e-3f).x / 1e-3f, 3, 1e-2f);
}

TEST_F(Animations, RotationsUseTheShorterArc) {
  const float h = std::sqrt(0.5f);
  for (const float sign : {1.0f, -1.0f}) {  // a quaternion and its negative are the same rotation
    Gltf gltf = animated("rotation", "LINEAR", 4, {0, 1}, {0, 0, 0, 1, 0, 0, sign * h, sign * h});
    const auto scene = opened(gltf);
    for (const float t : {0.0f, 0.2f, 0.5f, 1.0f}) {
      const Mat4 expected = glm::rotate(Mat4(1), t * kPi / 2, Vec3(0, 0, 1));
      for (int c = 0; c < 4; ++c) EXPECT_LT(glm::distance(matrix(scene, t)[c], expected[c]), 1e-5f);
    }
  }
}

TEST_F(Animations, RotationsInNormalisedIntegers) {
  Gltf gltf;
  gltf.triangle();
  const int input = gltf.floats({0, 1});
  const std::vector<std::array<int16_t, 4>> turns{{0, 0, 0, 32767}, {0, 0, 23170, 23170}};
  const int output = gltf.accessor(gltf.view(turns), kShort, "VEC4", 2, true);
  gltf.root["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}},
                              {"samplers", {{{"input", input}, {"output", output}}}}}};
  EXPECT_LT(glm::distance(matrix(opened(gltf), 1)[0], Vec4(0, 1, 0, 0)), 1e-4f);
}

TEST_F(Animations, ScaleKeepsTranslationAndRotation) {
  Gltf gltf = animated("scale", "LINEAR", 3, {0, 1}, {1, 1, 1, 3, 3, 3});
  gltf.root["nodes"][0]["translation"] = {1, 2, 3};
  const Mat4 m = matrix(opened(gltf), 0.5f);
  EXPECT_EQ(m[0], Vec4(2, 0, 0, 0));
  EXPECT_EQ(m[3], Vec4(1, 2, 3, 1));
}

TEST_F(Animations, InvalidChannelsAreIgnored) {
  const auto refused = [&](Gltf gltf, const char* text) {
    const auto scene = opened(gltf);
    EXPECT_TRUE(scene.animations[0]->channels.empty());
    EXPECT_TRUE(warns(scene, text)) << all(scene.warnings);
  };
  refused(animated("translation", "LINEAR", 3, {0, 1, 1}, std::vector<float>(9)),
          "animations[0].channels[0]: the times do not increase strictly (keyframe 2)");
  refused(animated("translation", "LINEAR", 3, {0, 1}, std::vector<float>(9)),
          "has 9 values, but its 2 keyframes need 6");
  refused(animated("translation", "CUBICSPLINE", 3, {0, 1}, std::vector<float>(6)),
          "has 6 values, but its 2 keyframes need 18");
  refused(animated("translation", "BEZIER", 3, {0, 1}, std::vector<float>(6)),
          "the interpolation has to be LINEAR, STEP or CUBICSPLINE");
  refused(animated("translation", "LINEAR", 3, {0, 1}, {0, 0, 0, 0, kInfinity, 0}),
          "has values that are not finite or beyond 1e9");
  refused(animated("weights", "LINEAR", 1, {0, 1}, {0, 1}), "the target node has no morph targets");
  refused(animated("colour", "LINEAR", 3, {0, 1}, std::vector<float>(6)), "cannot animate 'colour'");
  Gltf gltf = animated("translation", "LINEAR", 3, {0, 1}, std::vector<float>(6));
  gltf.root["nodes"][0]["matrix"] = std::vector<int>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  refused(std::move(gltf), "the target node has a matrix; animated nodes need translation, rotation and scale");
}

TEST_F(Animations, AnimationsOfTheSameNodeDoNotPlayTogether) {
  Gltf gltf = animated("translation", "STEP", 3, {0}, {1, 0, 0});
  const int input = gltf.root["animations"][0]["samplers"][0]["input"];
  json second = gltf.root["animations"][0], third = second;
  second["samplers"][0]["output"] = gltf.vec3({{2, 2, 2}});
  third["samplers"][0] = {{"input", input}, {"output", gltf.vec3({{3, 3, 3}})}};
  third["channels"][0]["target"]["path"] = "scale";
  gltf.root["animations"].push_back(second);
  gltf.root["animations"].push_back(third);
  const auto scene = opened(gltf);
  EXPECT_EQ(matrix(scene, 0)[3], Vec4(1, 0, 0, 1));
  EXPECT_EQ(matrix(scene, 0)[0], Vec4(3, 0, 0, 0));
  EXPECT_TRUE(warns(scene, "1 animations move the same nodes as an earlier one; only the earlier one plays"));
}

class Morphs : public Animations {
 protected:
  static Gltf morphed() {
    Gltf gltf;
    const json attributes = {{"POSITION", gltf.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})},
                             {"NORMAL", gltf.vec3(std::vector<Vec3>(3, Vec3(0, 0, 1)))}};
    json& primitive = gltf.primitive(attributes);
    primitive["targets"] = {{{"POSITION", gltf.vec3(std::vector<Vec3>(3, Vec3(0, 0, 4)))}},
                            {{"POSITION", gltf.vec3({{0, 0, 0}, {2, 0, 0}, {0, 0, 0}})},
                             {"NORMAL", gltf.vec3(std::vector<Vec3>(3, Vec3(1, 0, 0)))}}};
    return gltf;
  }
  static std::shared_ptr<const Mesh> posed(const scene::Scene& scene) {
    return scene::posed_mesh(scene, 0, scene.meshes[0].primitives[0], scene::world_matrices(scene)).mesh;
  }
};

TEST_F(Morphs, WeightsOfMeshAndNode) {
  Gltf gltf = morphed();
  EXPECT_EQ(posed(opened(gltf))->positions[1], Vec3(1, 0, 0));
  gltf.root["meshes"][0]["weights"] = {0.5, 0.25};
  const auto mesh = posed(opened(gltf));
  EXPECT_EQ(mesh->positions[1], Vec3(1.5f, 0, 2));
  EXPECT_LT(glm::distance(mesh->normals[0], glm::normalize(Vec3(0.25f, 0, 1))), 1e-6f);
  gltf.root["nodes"][0]["weights"] = {1, 0};
  EXPECT_EQ(posed(opened(gltf))->positions[1], Vec3(1, 0, 4)) << "weights of the node take precedence";
  EXPECT_EQ(mesh_of(opened(gltf))->positions[1], Vec3(1, 0, 0)) << "the undeformed mesh is unchanged";
}

TEST_F(Morphs, WeightsAreAnimated) {
  Gltf gltf = morphed();
  const int input = gltf.floats({0, 1}), output = gltf.floats({0, 0, 1, 0.5f});
  gltf.root["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
                              {"samplers", {{{"input", input}, {"output", output}}}}}};
  auto scene = opened(gltf);
  scene.time = 0.5f;
  EXPECT_EQ(posed(scene)->positions[1], Vec3(1.5f, 0, 2));
  EXPECT_EQ(scene::world_bounds(scene).max, Vec3(1.5f, 1, 2));
}

TEST_F(Morphs, DegenerateTrianglesAreKept) {
  Gltf gltf;
  json& primitive = gltf.primitive({{"POSITION", gltf.vec3(std::vector<Vec3>(3, Vec3(0)))}});
  primitive["targets"] = {{{"POSITION", gltf.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}}};
  EXPECT_EQ(mesh_of(opened(gltf))->triangles.size(), 1U);
}

TEST_F(Morphs, ApplyToVerticesThatAreSplitForTangents) {
  Gltf gltf;
  json& square = gltf.square();
  square["attributes"].erase("NORMAL");
  square["material"] = 0;
  square["targets"] = {{{"POSITION", gltf.vec3({{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}})}}};
  gltf.root["meshes"][0]["weights"] = {1};
  gltf.root["materials"] = {{{"normalTexture", {{"index", 0}}}}};
  gltf.root["textures"] = json::array({json::object()});
  const auto mesh = posed(opened(gltf));
  ASSERT_EQ(mesh->positions.size(), 6U);
  for (const Vec3& p : mesh->positions) EXPECT_EQ(p.z, p.y == 0 ? p.x : 3 - p.x);
}

class Skins : public Morphs {
 protected:
  // A strip between two joints: node 1 at the origin and node 2 above it. The translation of node 0, which shows the
  // mesh, has no effect.
  static Gltf skinned(const std::vector<Vec4>& weights, std::array<uint8_t, 4> joints = {0, 1, 0, 0}) {
    Gltf gltf;
    const json attributes = {
        {"POSITION", gltf.vec3({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}})},
        {"NORMAL", gltf.vec3(std::vector<Vec3>(3, Vec3(0, 0, 1)))},
        {"JOINTS_0", gltf.accessor(gltf.view(std::vector<std::array<uint8_t, 4>>(3, joints)), kUByte, "VEC4", 3)},
        {"WEIGHTS_0", gltf.vec4(weights)}};
    gltf.primitive(attributes);
    gltf.root["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                          {{"children", {2}}},
                          {{"translation", {0, 1, 0}}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}};
    gltf.root["scenes"][0]["nodes"] = {0, 1};
    const int bind = gltf.mat4({Mat4(1), glm::translate(Mat4(1), Vec3(0, -1, 0))});
    gltf.root["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", bind}}};
    return gltf;
  }
};

TEST_F(Skins, VerticesFollowTheirJoints) {
  Gltf gltf = skinned({{1, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}});
  const auto scene = opened(gltf);
  EXPECT_EQ(all(scene.warnings), "");
  const auto result = scene::posed_mesh(scene, 0, scene.meshes[0].primitives[0], scene::world_matrices(scene));
  EXPECT_TRUE(result.in_world);
  // The second joint rotates by 90 degrees about z at (0, 1, 0): a point one unit above it moves one unit to its left.
  EXPECT_LT(glm::distance(result.mesh->positions[2], Vec3(-1, 1, 0)), 1e-5f);
  EXPECT_EQ(result.mesh->positions[1], Vec3(1, 0, 0)) << "the transform of the node has no effect";
  EXPECT_LT(glm::distance(result.mesh->normals[2], Vec3(0, 0, 1)), 1e-5f);
}

TEST_F(Skins, WeightsAreNormalised) {
  Gltf gltf = skinned({{2, 2, 0, 0}, {0, 0, 0, 0}, {0, -1, 0, 0}});
  const auto scene = opened(gltf);
  EXPECT_TRUE(
      warns(scene, "meshes[0].primitives[0]: the joint weights of 3 vertices do not sum to 1; they were normalised"))
      << all(scene.warnings);
  const auto& weights = scene.meshes[0].primitives[0].deformation->weights;
  EXPECT_EQ(weights[0], Vec4(0.5f, 0.5f, 0, 0));
  EXPECT_EQ(weights[1], Vec4(1, 0, 0, 0)) << "a vertex without weights belongs to its first joint";
}

TEST_F(Skins, MissingJointsAreIgnored) {
  Gltf gltf = skinned({{0.5f, 0.5f, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}}, {0, 9, 0, 0});
  const auto scene = opened(gltf);
  EXPECT_TRUE(warns(
      scene, "nodes[0]: the mesh references joints that are not in its skin, which has 2; these weights are ignored"))
      << all(scene.warnings);
  EXPECT_EQ(posed(scene)->positions[0], Vec3(0));
}

TEST_F(Skins, TwoSetsOfJoints) {
  Gltf gltf = skinned({{0.5f, 0, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 0}});
  json& attributes = gltf.root["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_1"] =
      gltf.accessor(gltf.view(std::vector<std::array<uint16_t, 4>>(3, {1, 0, 0, 0})), kUShort, "VEC4", 3);
  attributes["WEIGHTS_1"] = gltf.vec4({{0.5f, 0, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}});
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.meshes[0].primitives[0].deformation->joint_sets, 2U);
  EXPECT_LT(glm::distance(posed(scene)->positions[2], Vec3(-1, 1, 0)), 1e-5f);
}

TEST_F(Skins, JointsWithoutWeightsAreIgnored) {
  Gltf gltf = skinned({{1, 0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}});
  gltf.root["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
  const auto scene = opened(gltf);
  EXPECT_FALSE(scene.meshes[0].primitives[0].deformation);
  EXPECT_TRUE(warns(scene, "has JOINTS_0 without WEIGHTS_0; it is ignored")) << all(scene.warnings);
}

}  // namespace
}  // namespace etendue::test
