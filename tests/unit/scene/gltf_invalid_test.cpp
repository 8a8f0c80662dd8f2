// Invalid files are rejected with one line that names the place, the defect and what would be right.
#include <sys/resource.h>

#include "unit/scene/gltf_builder.h"

namespace etendue::test {
namespace {

// A valid file with two triangles, a skin, an animation and a material; tests change single values of it.
Gltf valid_file() {
  Gltf gltf;
  gltf.root["materials"] = {{{"name", "m"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  gltf.root["textures"] = {{{"source", 0}, {"sampler", 0}}};
  gltf.root["samplers"] = {{{"magFilter", 9728}}};
  gltf.root["images"] = {{{"uri", "none.png"}}};
  json& square = gltf.square();  // accessors 0 to 3
  square["material"] = 0;
  square["attributes"]["JOINTS_0"] =
      gltf.accessor(gltf.view(std::vector<std::array<uint8_t, 4>>(4)), kUByte, "VEC4", 4);
  square["attributes"]["WEIGHTS_0"] = gltf.vec4(std::vector<Vec4>(4, Vec4(1, 0, 0, 0)));
  square["targets"] = {{{"POSITION", gltf.vec3(std::vector<Vec3>(4))}}};
  gltf.root["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"children", {2}}}, {{"camera", 0}}};
  gltf.root["scenes"] = {{{"nodes", {0, 1}}}};
  gltf.root["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", gltf.mat4({Mat4(1), Mat4(1)})}}};
  gltf.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  gltf.root["animations"] = {
      {{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}},
       {"samplers", {{{"input", gltf.floats({0, 1})}, {"output", gltf.vec3({{0, 0, 0}, {1, 0, 0}})}}}}}};
  return gltf;
}

struct Damage {
  const char* name;
  const char* pointer;  // JSON pointer of the value to replace
  const char* value;    // JSON; empty removes it
  const char* message;  // beginning of the message after the file name
};

std::ostream& operator<<(std::ostream& out, const Damage& damage) { return out << damage.name; }

const Damage kDamages[] = {
    {"ViewBeyondBuffer", "/bufferViews/0/byteLength", "100000",
     "meshes[0].primitives[0].attributes.POSITION: bufferView 0 ends at byte 100000, but buffer 0 has "},
    {"ViewOffsetOverflows", "/bufferViews/0/byteOffset", "18446744073709551600",
     "bufferViews[0].byteOffset: 18446744073709551600 has to be"},
    {"ViewOfNoBuffer", "/bufferViews/0/buffer", "7",
     "meshes[0].primitives[0].attributes.POSITION: bufferView 0 refers to buffer 7, which does not exist; the file has "
     "1"},
    {"ViewNegative", "/bufferViews/0/byteLength", "-5",
     "bufferViews[0].byteLength: -5 has to be an integer between 0 and"},
    {"StrideOdd", "/bufferViews/0/byteStride", "13",
     "bufferViews[0].byteStride: 13 has to be a multiple of 4 and at most 252"},
    {"StrideTooSmall", "/bufferViews/0/byteStride", "8",
     "meshes[0].primitives[0].attributes.POSITION: accessor 0 has elements of 12 bytes, but the byteStride of "
     "bufferView 0 is 8"},
    {"AccessorBeyondView", "/accessors/0/count", "5",
     "meshes[0].primitives[0].attributes.POSITION: accessor 0 ends at byte 60, but bufferView 0 has 48; at most 4 "
     "elements fit"},
    {"AccessorOffset", "/accessors/0/byteOffset", "4",
     "meshes[0].primitives[0].attributes.POSITION: accessor 0 ends at byte 52, but bufferView 0 has 48; at most 3 "
     "elements fit"},
    {"AccessorCountAbsurd", "/accessors/0/count", "9007199254740992",
     "meshes[0].primitives[0].attributes.POSITION: accessor 0 ends at byte"},
    {"AccessorCountNegative", "/accessors/0/count", "-1", "accessors[0].count: -1 has to be an integer"},
    {"AccessorCountMissing", "/accessors/0/count", "", "accessors[0]: has no count, which is required"},
    {"AccessorOfNoView", "/accessors/0/bufferView", "99",
     "meshes[0].primitives[0].attributes.POSITION: bufferView 99 does not exist; the file has "},
    {"AccessorType", "/accessors/0/type", "\"VEC2\"",
     "meshes[0].primitives[0].attributes.POSITION: accessor 0 is VEC2 of floats; VEC3 of floats is required"},
    {"AccessorTypeUnknown", "/accessors/0/type", "\"VEC5\"", "the structure cannot be read: Unsupported `type`"},
    {"AccessorComponents", "/accessors/0/componentType", "5125",
     "meshes[0].primitives[0].attributes.POSITION: accessor 0 is VEC3 of unsigned ints; VEC3 of floats is required"},
    {"AccessorComponentsUnknown", "/accessors/0/componentType", "5124",
     "meshes[0].primitives[0].attributes.POSITION: accessor 0 has component type 5124, which does not exist in glTF"},
    {"IndicesAreSigned", "/accessors/3/componentType", "5122",
     "meshes[0].primitives[0].indices: accessor 3 is SCALAR of shorts; SCALAR of unsigned integers is required"},
    {"IndicesOfNoAccessor", "/meshes/0/primitives/0/indices", "77",
     "meshes[0].primitives[0].indices: refers to accessors[77], which does not exist; the file has "},
    {"IndicesAreText", "/meshes/0/primitives/0/indices", "\"x\"",
     "meshes[0].primitives[0].indices: \"x\" has to be an integer between 0 and 2147483647"},
    {"IndicesBeyondIntegers", "/meshes/0/primitives/0/indices", "1e30",
     "meshes[0].primitives[0].indices: 1e+30 has to be an integer between 0 and 2147483647"},
    {"IndicesOfNoView", "/accessors/3/bufferView", "99",
     "meshes[0].primitives[0].indices: accessor 3 refers to bufferView 99, which does not exist"},
    {"IndicesWithoutView", "/accessors/3/bufferView", "",
     "meshes[0].primitives[0].indices: accessor 3 has no bufferView"},
    {"CountsDiffer", "/accessors/1/count", "3",
     "meshes[0].primitives[0].attributes.NORMAL: accessor 1 has 3 elements, but POSITION has 4"},
    {"AttributeOfNoAccessor", "/meshes/0/primitives/0/attributes/POSITION", "77",
     "meshes[0].primitives[0].attributes.POSITION: accessor 77 does not exist; the file has "},
    {"AttributeNoNumber", "/meshes/0/primitives/0/attributes/POSITION", "\"x\"",
     "meshes[0].primitives[0].attributes.POSITION: \"x\" has to be"},
    {"AttributesMissing", "/meshes/0/primitives/0/attributes", "",
     "meshes[0].primitives[0]: has no attributes, which is required"},
    {"PrimitivesNoArray", "/meshes/0/primitives", "3", "meshes[0].primitives: has to be an array"},
    {"ModeUnknown", "/meshes/0/primitives/0/mode", "7",
     "meshes[0].primitives[0].mode: 7 is not a mode; it has to be between 0 and 6"},
    {"MaterialUnknown", "/meshes/0/primitives/0/material", "1",
     "meshes[0].primitives[0].material: refers to materials[1], which does not exist; the file has 1"},
    {"TargetCount", "/accessors/6/count", "3",
     "meshes[0].primitives[0].targets[0].POSITION: accessor 6 has 3 elements, but POSITION has 4"},
    {"NodeOfNoMesh", "/nodes/0/mesh", "9", "nodes[0].mesh: refers to meshes[9], which does not exist; the file has 1"},
    {"NodeOfNoCamera", "/nodes/2/camera", "1",
     "nodes[2].camera: refers to cameras[1], which does not exist; the file has 1"},
    {"NodeOfNoSkin", "/nodes/0/skin", "1", "nodes[0].skin: refers to skins[1], which does not exist; the file has 1"},
    {"NodeOfNoChild", "/nodes/1/children", "[5]",
     "nodes[1].children: refers to nodes[5], which does not exist; the file has 3"},
    {"NodeCycle", "/nodes/2/children", "[1]", "nodes[1]: is its own ancestor; nodes have to form trees"},
    {"NodeIsItsOwnChild", "/nodes/0/children", "[0]", "nodes[0]: is its own ancestor; nodes have to form trees"},
    {"NodeTwoParents", "/nodes/0/children", "[2]",
     "nodes[1].children: nodes[2] is already a child of nodes[0]; a node has at most one parent"},
    {"NodeMatrixShort", "/nodes/1/matrix", "[1,0,0]", "nodes[1].matrix: has 3 numbers; it has to have 16"},
    {"NodeTranslationHuge", "/nodes/1/translation", "[1e39,0,0]",
     "nodes[1].translation: 1e+39 has to be a number within the range of single precision"},
    {"NodeScaleTwo", "/nodes/1/scale", "[1,1]", "nodes[1].scale: has 2 numbers; it has to have 3"},
    {"NodeNoObject", "/nodes/1", "5", "nodes[1]: has to be an object"},
    {"NodesNoArray", "/nodes", "{}", "nodes: has to be an array of objects"},
    {"SceneOfNoNode", "/scenes/0/nodes", "[4]",
     "scenes[0].nodes[0]: refers to nodes[4], which does not exist; the file has 3"},
    {"DefaultSceneUnknown", "/scene", "3", "scene: refers to scenes[3], which does not exist; the file has 1"},
    {"SkinOfNoJoint", "/skins/0/joints", "[1,17]",
     "skins[0].joints[1]: refers to nodes[17], which does not exist; the file has 3"},
    {"SkinFewMatrices", "/skins/0/joints", "[1,2,1]",
     "skins[0].inverseBindMatrices: accessor 7 has 2 matrices for 3 joints"},
    {"SkinNoMatrices", "/skins/0/inverseBindMatrices", "0",
     "skins[0].inverseBindMatrices: accessor 0 is VEC3 of floats; MAT4 of floats is required"},
    {"SkinNoJoints", "/skins/0/joints", "", "skins[0]: has no joints, which is required"},
    {"ChannelOfNoSampler", "/animations/0/channels/0/sampler", "4",
     "animations[0].channels[0].sampler: refers to samplers[4], which does not exist; the file has 1"},
    {"ChannelOfNoNode", "/animations/0/channels/0/target/node", "8",
     "animations[0].channels[0].target.node: refers to nodes[8], which does not exist; the file has 3"},
    {"SamplerOfNoInput", "/animations/0/samplers/0/input", "80",
     "animations[0].samplers[0].input: accessor 80 does not exist; the file has "},
    {"SamplerOutputKind", "/animations/0/channels/0/target/path", "\"rotation\"",
     "animations[0].samplers[0].output: accessor 9 is VEC3 of floats; VEC4 of floats or normalized integers is "
     "required"},
    {"TextureOfNoImage", "/textures/0/source", "3",
     "textures[0].source: refers to images[3], which does not exist; the file has 1"},
    {"TextureOfNoSampler", "/textures/0/sampler", "3",
     "textures[0].sampler: refers to samplers[3], which does not exist; the file has 1"},
    {"MaterialOfNoTexture", "/materials/0/pbrMetallicRoughness/baseColorTexture/index", "5",
     "materials[0].pbrMetallicRoughness.baseColorTexture.index: refers to textures[5], which does not exist; the file "
     "has 1"},
    {"MaterialFactorText", "/materials/0/pbrMetallicRoughness/metallicFactor", "\"shiny\"",
     "materials[0].pbrMetallicRoughness.metallicFactor: \"shiny\" has to be a number"},
    {"MaterialColourShort", "/materials/0/pbrMetallicRoughness/baseColorFactor", "[1,1]",
     "materials[0].pbrMetallicRoughness.baseColorFactor: has 2 numbers; it has to have 4"},
    {"CameraNoType", "/cameras/0/type", "", "cameras[0]: has no type, which is required"},
    {"CameraTypeUnknown", "/cameras/0/type", "\"fisheye\"",
     "cameras[0].type: \"fisheye\" has to be \"perspective\" or \"orthographic\""},
    {"CameraNoLens", "/cameras/0/perspective", "", "cameras[0]: has no perspective, which is required"},
    {"BufferNoLength", "/buffers/0/byteLength", "\"many\"", "buffers[0].byteLength: \"many\" has to be an integer"},
    {"ExtensionsRequiredNoArray", "/extensionsRequired", "\"KHR_x\"",
     "extensionsRequired: has to be an array of strings"},
};

class InvalidFiles : public GltfTest, public testing::WithParamInterface<Damage> {};

TEST_P(InvalidFiles, IsRejectedWithAMessage) {
  Gltf gltf = valid_file();
  (void)gltf.glb();  // fills in the buffer's length
  json root = gltf.root;
  const json::json_pointer place(GetParam().pointer);
  if (*GetParam().value)
    root[place] = json::parse(GetParam().value);
  else
    root[place.parent_pointer()].erase(place.back());
  const std::string file = Gltf::glb_of(root.dump(), {gltf.bytes().begin(), gltf.bytes().end()});
  const std::string message = error_of(file);
  EXPECT_EQ(message.substr(0, std::string(GetParam().message).size()), GetParam().message) << message;
}

INSTANTIATE_TEST_SUITE_P(Damage, InvalidFiles, testing::ValuesIn(kDamages),
                         [](const auto& test) { return std::string(test.param.name); });

class InvalidValues : public GltfTest {};

TEST_F(InvalidValues, UndamagedFileLoads) {
  Gltf gltf = valid_file();
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.warnings.size(), 1U) << all(scene.warnings);
  EXPECT_TRUE(warns(scene, "images[0] 'none.png': there is no such file; constant factors are used instead"));
}

TEST_F(InvalidValues, IndicesOutOfRange) {
  Gltf gltf;
  json& over = gltf.triangle();
  over["indices"] = gltf.indices({0, 1, 3});
  EXPECT_EQ(error_of(gltf),
            "meshes[0].primitives[0].indices: element 2 of accessor 1 is 3, but the primitive has 3 vertices");
  Gltf restart;
  json& last = restart.triangle();
  last["indices"] = restart.indices({0, 1, 65535});
  EXPECT_EQ(error_of(restart),
            "meshes[0].primitives[0].indices: element 2 of accessor 1 is 65535, the primitive restart value, which "
            "glTF forbids, but the primitive has 3 vertices");
}

// 2^32 is 0 if it is cut to 32 bits.
TEST_F(InvalidValues, AnIndexBeyond32BitsRefersToNoAccessor) {
  Gltf gltf;
  json& primitive = gltf.triangle();
  primitive["indices"] = gltf.indices({0, 1, 2});
  primitive["indices"] = uint64_t{1} << 32;
  EXPECT_NE(error_of(gltf).find("4294967296 has to be an integer"), std::string::npos) << error_of(gltf);
}

TEST_F(InvalidValues, SparseIndicesOutOfRange) {
  Gltf gltf;
  const int position = gltf.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const int index = gltf.view(std::vector<uint8_t>{3}), value = gltf.view(std::vector<Vec3>{{1, 0, 0}});
  json sparse = {{"count", 1},
                 {"indices", {{"bufferView", index}, {"componentType", kUByte}}},
                 {"values", {{"bufferView", value}}}};
  gltf.primitive({{"POSITION", position}});
  gltf.root["accessors"][position]["sparse"] = sparse;
  EXPECT_EQ(error_of(gltf),
            "meshes[0].primitives[0].attributes.POSITION: has the sparse index 3, but the accessor has 3 elements");
  sparse["count"] = 4;
  gltf.root["accessors"][position]["sparse"] = sparse;
  EXPECT_EQ(error_of(gltf),
            "meshes[0].primitives[0].attributes.POSITION: accessor 0 has 4 sparse values for 3 elements");
  sparse["count"] = 2;
  gltf.root["accessors"][position]["sparse"] = sparse;
  EXPECT_EQ(error_of(gltf),
            "meshes[0].primitives[0].attributes.POSITION: accessor 0 (sparse indices) ends at byte 2, but bufferView 1 "
            "has 1; at most 1 elements fit");
  sparse["count"] = 1;
  sparse["indices"]["componentType"] = kFloat;
  gltf.root["accessors"][position]["sparse"] = sparse;
  EXPECT_EQ(
      error_of(gltf),
      "meshes[0].primitives[0].attributes.POSITION: accessor 0 has sparse indices that are not unsigned integers");
}

// A small file with large counts is rejected without allocating memory for them.
TEST_F(InvalidValues, LargeCountsCostNoMemory) {
  const auto peak = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const long before = peak();
  Gltf gltf;
  gltf.primitive({{"POSITION", gltf.accessor(-1, kFloat, "VEC3", size_t{1} << 32)}});
  gltf.root["buffers"] = json::array();
  const std::string message = error_of(gltf);
  EXPECT_TRUE(message.starts_with("meshes[0].primitives[0]: needs more than 256 MiB")) << message;
  Gltf many;
  const int zeros = many.accessor(-1, kFloat, "VEC3", size_t{1} << 20);
  for (int i = 0; i < 100; ++i) many.primitive({{"POSITION", zeros}, {"NORMAL", zeros}})["extras"] = i;
  for (int i = 0; i < 100; ++i) many.root["meshes"][0]["primitives"][i]["mode"] = 4 + i % 3;
  EXPECT_EQ(error_of(many), "") << "equal primitives share one mesh";
  for (int i = 0; i < 100; ++i)
    many.root["meshes"][0]["primitives"][i]["targets"] = json::array({{{"POSITION", zeros}}, {{"NORMAL", zeros}}});
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < i; ++k) many.root["meshes"][0]["primitives"][i]["targets"].push_back({{"POSITION", zeros}});
  EXPECT_TRUE(error_of(many).ends_with("the count of an accessor must be wrong")) << error_of(many);
  EXPECT_LT(peak() - before, 1 << 20) << "KiB";
}

TEST_F(InvalidValues, DefectsOfUnusedObjectsAreWarnings) {
  Gltf gltf;
  gltf.triangle();
  gltf.accessor(0, kFloat, "VEC3", 1000);
  const auto scene = opened(gltf);
  EXPECT_TRUE(warns(
      scene,
      "accessors[1]: accessor 1 ends at byte 12000, but bufferView 0 has 36; at most 3 elements fit; nothing uses it"))
      << all(scene.warnings);
}

TEST_F(InvalidValues, RepeatedWarningsAreShortened) {
  Gltf gltf;
  const int position = gltf.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  for (int i = 0; i < 1000; ++i)
    gltf.primitive({{"POSITION", position}, {"_I" + std::to_string(i), position}})["mode"] = 0;
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.warnings.size(), 1U) << all(scene.warnings);
  EXPECT_TRUE(warns(scene, "meshes[0].primitives[2], meshes[0].primitives[3] and 996 more: points are not rendered"))
      << all(scene.warnings);
}

// Four missing textures are one message; of a hundred it names the first ones.
TEST_F(InvalidValues, MissingImagesAreOneWarning) {
  for (const int count : {1, 4, 100}) {
    Gltf gltf;
    gltf.triangle();
    std::string names;
    for (int i = 0; i < count; ++i) {
      const std::string name = "texture" + std::string(1, static_cast<char>('a' + i % 26)) + std::to_string(i) + ".png";
      gltf.root["images"].push_back({{"uri", name}});
      gltf.root["textures"].push_back({{"source", i}});
      if (i < 4) names += (i > 0 ? ", " : "") + ("images[" + std::to_string(i)) + "] '" + name + "'";
    }
    if (count > 4) names += " and 96 more";
    const auto scene = opened(gltf);
    EXPECT_EQ(scene.warnings.size(), 1U) << all(scene.warnings);
    EXPECT_TRUE(warns(scene, names + ": there is no such file; constant factors are used instead"))
        << all(scene.warnings);
  }
}

// A defect that is described with different numbers each time.
TEST_F(InvalidValues, KindsOfWarningsAreCounted) {
  Gltf gltf;
  gltf.triangle();
  for (int i = 0; i < 50; ++i) gltf.accessor(0, kFloat, "VEC3", 1000 + i);
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.warnings.size(), 5U) << all(scene.warnings);
  EXPECT_TRUE(warns(scene, "46 more of this kind: accessors[]: accessor  ends at byte")) << all(scene.warnings);
}

TEST_F(InvalidValues, IntegersWrittenAsFloats) {
  Gltf gltf;
  gltf.triangle();
  gltf.root["accessors"][0]["count"] = 3.0;
  gltf.root["nodes"][0]["mesh"] = 0.0;
  EXPECT_EQ(mesh_of(opened(gltf))->positions.size(), 3U);
  gltf.root["accessors"][0]["count"] = 2.5;
  EXPECT_EQ(error_of(gltf), "accessors[0].count: 2.5 has to be an integer between 0 and 9007199254740992");
}

}  // namespace
}  // namespace etendue::test
