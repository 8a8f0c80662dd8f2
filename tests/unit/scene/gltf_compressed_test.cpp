// Compressed geometry is decoded to the original, and damaged data are rejected with one line.
#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <random>

#include "support/scenes.h"
#include "unit/scene/gltf_builder.h"

namespace etendue::test {
namespace {

// A grid with a height field.
struct Grid {
  static constexpr uint32_t kSide = 24;
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> uvs;
  std::vector<uint32_t> indices;

  Grid() {
    for (uint32_t y = 0; y <= kSide; ++y)
      for (uint32_t x = 0; x <= kSide; ++x) {
        const Vec2 uv = Vec2(x, y) / float{kSide};
        positions.emplace_back(uv, 0.1f * std::sin(9 * uv.x) * std::cos(7 * uv.y));
        normals.push_back(glm::normalize(
            Vec3(-0.9f * std::cos(9 * uv.x) * std::cos(7 * uv.y), 0.7f * std::sin(9 * uv.x) * std::sin(7 * uv.y), 1)));
        uvs.push_back(uv);
      }
    for (uint32_t y = 0; y < kSide; ++y)
      for (uint32_t x = 0; x < kSide; ++x) {
        const uint32_t a = y * (kSide + 1) + x, b = a + 1, c = a + kSide + 1, d = c + 1;
        indices.insert(indices.end(), {a, b, d, a, d, c});
      }
  }
};

// The largest distance between corresponding corners of a triangle of one mesh and the nearest triangle of the other.
float distance(const Mesh& a, const Mesh& b) {
  float worst = 0;
  const auto corner = [](const Mesh& m, const Triangle& t, size_t k) { return m.positions[t[k % 3]]; };
  for (const Triangle& s : a.triangles) {
    float best = kInfinity;
    for (const Triangle& t : b.triangles)
      for (size_t turn = 0; turn < 3; ++turn) {
        float d = 0;
        for (size_t k = 0; k < 3; ++k) d = std::max(d, glm::length(corner(a, s, k) - corner(b, t, k + turn)));
        best = std::min(best, d);
      }
    worst = std::max(worst, best);
  }
  return worst;
}

class Draco : public GltfTest {
 protected:
  static std::string encoded(int method) {
    const Grid grid;
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(grid.indices.size() / 3));
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int normal = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    for (uint32_t f = 0; f < grid.indices.size() / 3; ++f) {
      const uint32_t* t = &grid.indices[size_t{f} * 3];
      const draco::FaceIndex face(f);
      const auto set = [&](int attribute, const auto& v) {
        builder.SetAttributeValuesForFace(attribute, face, &v[t[0]], &v[t[1]], &v[t[2]]);
      };
      set(position, grid.positions);
      set(normal, grid.normals);
      set(uv, grid.uvs);
    }
    const auto mesh = builder.Finalize();
    draco::ExpertEncoder encoder(*mesh);
    encoder.SetEncodingMethod(method);
    encoder.SetAttributeQuantization(position, 14);
    encoder.SetAttributeQuantization(normal, 10);
    encoder.SetAttributeQuantization(uv, 12);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
    return {buffer.data(), buffer.size()};
  }

  static Gltf file(const std::string& bytes) {
    Gltf gltf;
    const size_t vertices = (Grid::kSide + 1) * (Grid::kSide + 1);
    const int position = gltf.accessor(-1, kFloat, "VEC3", vertices);
    const int normal = gltf.accessor(-1, kFloat, "VEC3", vertices), uv = gltf.accessor(-1, kFloat, "VEC2", vertices);
    const int indices = gltf.accessor(-1, kUShort, "SCALAR", size_t{Grid::kSide} * Grid::kSide * 6);
    json& primitive = gltf.primitive({{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}}, indices);
    primitive["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", gltf.view(bytes.data(), bytes.size())},
        {"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}}};
    gltf.root["extensionsUsed"] = gltf.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return gltf;
  }
};

TEST_F(Draco, BothMethodsRestoreTheMesh) {
  const Grid grid;
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    Gltf gltf = file(encoded(method));
    const auto scene = opened(gltf);
    EXPECT_EQ(all(scene.warnings) + all(scene.unsupported), "");
    const auto mesh = mesh_of(scene);
    ASSERT_EQ(mesh->triangles.size(), grid.indices.size() / 3);
    ASSERT_EQ(mesh->positions.size(), grid.positions.size());
    Mesh original;
    original.positions = grid.positions;
    for (size_t i = 0; i < grid.indices.size(); i += 3)
      original.triangles.push_back({grid.indices[i], grid.indices[i + 1], grid.indices[i + 2]});
    EXPECT_LT(distance(original, *mesh), 1e-4f);
    EXPECT_LT(distance(*mesh, original), 1e-4f);
    for (size_t v = 0; v < mesh->positions.size(); ++v) {
      EXPECT_LT(glm::length(mesh->uvs[0][v] - Vec2(mesh->positions[v])), 1e-3f) << "uv is the position in the grid";
      const auto x = static_cast<size_t>(std::lround(mesh->uvs[0][v].x * Grid::kSide)),
                 y = static_cast<size_t>(std::lround(mesh->uvs[0][v].y * Grid::kSide));
      EXPECT_LT(glm::length(mesh->normals[v] - grid.normals[y * (Grid::kSide + 1) + x]), 1e-2f);
    }
  }
}

TEST_F(Draco, AnUncompressedCopyIsPreferred) {
  Gltf gltf;
  json& primitive = gltf.square();
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", gltf.view("broken", 6)},
                                                           {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}};
  EXPECT_EQ(mesh_of(opened(gltf))->positions.size(), 4U);
}

TEST_F(Draco, PrimitivesThatDifferOnlyInMaterialShareTheMesh) {
  Gltf gltf = file(encoded(draco::MESH_EDGEBREAKER_ENCODING));
  json& primitives = gltf.root["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  gltf.root["materials"] = json::array({json::object()});
  primitives[1]["material"] = 0;
  const auto scene = opened(gltf);
  EXPECT_EQ(mesh_of(scene, 0), mesh_of(scene, 1));
}

TEST_F(Draco, WrongAccessorCountsAreCorrected) {
  Gltf gltf = file(encoded(draco::MESH_EDGEBREAKER_ENCODING));
  gltf.root["accessors"][0]["count"] = 7;
  const auto scene = opened(gltf);
  EXPECT_EQ(mesh_of(scene)->positions.size(), size_t{(Grid::kSide + 1) * (Grid::kSide + 1)});
  EXPECT_TRUE(warns(scene, "attributes.POSITION: the accessor declares 7 elements, but the decoded mesh has 625"))
      << all(scene.warnings);
}

constexpr const char* kDracoWhere = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";

TEST_F(Draco, DefectsAreReported) {
  const std::string bytes = encoded(draco::MESH_EDGEBREAKER_ENCODING);
  const auto error = [&](const std::string& data) {
    Gltf gltf = file(data);
    return error_of(gltf);
  };
  const std::string where = kDracoWhere;
  EXPECT_EQ(error("no such thing"), where + ": the data are not Draco data");
  EXPECT_TRUE(error(bytes.substr(0, bytes.size() / 2)).starts_with(where + ": the Draco data are damaged: "));
  std::string old = bytes, cloud = bytes, method = bytes;
  old[5] = 1;
  cloud[7] = 0;
  method[8] = 9;
  EXPECT_EQ(error(old), where + ": the Draco data have version 1.2; glTF allows only 2.2");
  EXPECT_EQ(error(cloud), where + ": the Draco data are not a mesh");
  EXPECT_EQ(error(method), where + ": the Draco data use an unknown encoding method");
  Gltf id = file(bytes);
  id.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["NORMAL"] = 9;
  EXPECT_EQ(error_of(id), where + ".attributes.NORMAL: the Draco data have no attribute 9");
  Gltf view = file(bytes);
  view.root["bufferViews"][0]["byteLength"] = 1 << 20;
  EXPECT_TRUE(error_of(view).starts_with(where + ": ends at byte 1048576, but buffers[0] has ")) << error_of(view);
}

// Counts that would need gigabytes are rejected before memory is allocated.
TEST_F(Draco, HugeCountsAreRejected) {
  const std::string varint = "\xff\xff\xff\xff\x0f";
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    std::string bytes = encoded(method);
    // After the header of eleven bytes: the traversal type (Edgebreaker only) and two counts.
    bytes.replace(method == draco::MESH_EDGEBREAKER_ENCODING ? 12 : 11, 4, varint + varint);
    Gltf gltf = file(bytes);
    const std::string error = error_of(gltf);
    EXPECT_TRUE(error.starts_with(std::string(kDracoWhere) + ": the Draco header declares more data than ")) << error;
  }
}

class Meshopt : public GltfTest {
 protected:
  // A buffer view with the compressed bytes `in`, which decode to `count` elements of `stride` bytes.
  static int view(Gltf& gltf, const std::string& in, size_t count, size_t stride, const char* mode,
                  const char* filter = nullptr) {
    gltf.view(in.data(), in.size());
    json& compressed = gltf.root["bufferViews"].back();
    json extension = {{"buffer", 0},          {"byteOffset", compressed["byteOffset"]},
                      {"count", count},       {"byteLength", in.size()},
                      {"byteStride", stride}, {"mode", mode}};
    if (filter) extension["filter"] = filter;
    compressed = {{"buffer", 1}, {"byteLength", count * stride}};
    if (std::string(mode) == "ATTRIBUTES") compressed["byteStride"] = stride;
    compressed["extensions"]["EXT_meshopt_compression"] = extension;
    return static_cast<int>(gltf.root["bufferViews"].size()) - 1;
  }

  template <class V>
  static std::string vertices(const std::vector<V>& values) {
    std::string bytes(meshopt_encodeVertexBufferBound(values.size(), sizeof(V)), '\0');
    bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), values.data(),
                                            values.size(), sizeof(V)));
    return bytes;
  }
  static std::string triangles(const std::vector<uint32_t>& indices, size_t count) {
    std::string bytes(meshopt_encodeIndexBufferBound(indices.size(), count), '\0');
    bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), indices.data(),
                                           indices.size()));
    return bytes;
  }
  static std::string sequence(const std::vector<uint32_t>& indices, size_t count) {
    std::string bytes(meshopt_encodeIndexSequenceBound(indices.size(), count), '\0');
    bytes.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(),
                                             indices.data(), indices.size()));
    return bytes;
  }

  std::string glb(Gltf& gltf) const {
    gltf.root["extensionsUsed"] = {"EXT_meshopt_compression"};
    const auto& bytes = gltf.bytes();
    gltf.root["buffers"] = {
        {{"byteLength", bytes.size()}},
        {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    return Gltf::glb_of(gltf.root.dump(), std::string(bytes.begin(), bytes.end()));
  }

  // The grid with every mode and filter.
  Gltf file(const char* index_mode = "TRIANGLES") const {
    const Grid grid;
    const size_t n = grid.positions.size();
    std::vector<Vec4> wide;
    for (const Vec3& normal : grid.normals) wide.emplace_back(normal, 0);
    std::vector<std::array<int8_t, 4>> octahedral(n);
    meshopt_encodeFilterOct(octahedral.data(), n, 4, 8, &wide[0].x);
    std::vector<Vec3> exponential(n);
    meshopt_encodeFilterExp(exponential.data(), n, 12, 16, &grid.positions[0].x);
    Gltf gltf;
    const int position =
        gltf.accessor(view(gltf, vertices(exponential), n, 12, "ATTRIBUTES", "EXPONENTIAL"), kFloat, "VEC3", n);
    const int normal =
        gltf.accessor(view(gltf, vertices(octahedral), n, 4, "ATTRIBUTES", "OCTAHEDRAL"), kByte, "VEC3", n, true);
    const int uv = gltf.accessor(view(gltf, vertices(grid.uvs), n, 8, "ATTRIBUTES"), kFloat, "VEC2", n);
    const size_t corners = grid.indices.size();
    const std::string indices =
        std::string(index_mode) == "TRIANGLES" ? triangles(grid.indices, n) : sequence(grid.indices, n);
    gltf.primitive({{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}},
                   gltf.accessor(view(gltf, indices, corners, 2, index_mode), kUShort, "SCALAR", corners));
    return gltf;
  }
};

TEST_F(Meshopt, EveryModeRestoresTheMesh) {
  const Grid grid;
  for (const char* mode : {"TRIANGLES", "INDICES"}) {
    Gltf gltf = file(mode);
    const auto scene = scene::load_gltf(write("grid.glb", glb(gltf)));
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(all(scene->unsupported), "");
    for (const auto& warning : scene->warnings)
      EXPECT_NE(warning.find("KHR_mesh_quantization"), std::string::npos) << warning;
    const auto mesh = mesh_of(*scene);
    ASSERT_EQ(mesh->positions.size(), grid.positions.size());
    EXPECT_EQ(mesh->uvs[0], grid.uvs) << "attributes without a filter are exact";
    for (size_t v = 0; v < mesh->positions.size(); ++v) {
      EXPECT_LT(glm::length(mesh->positions[v] - grid.positions[v]), 1e-4f);
      EXPECT_LT(glm::length(glm::normalize(mesh->normals[v]) - grid.normals[v]), 0.03f);
    }
    Mesh original;
    original.positions = grid.positions;
    for (size_t i = 0; i < grid.indices.size(); i += 3)
      original.triangles.push_back({grid.indices[i], grid.indices[i + 1], grid.indices[i + 2]});
    EXPECT_LT(distance(original, *mesh), 1e-4f);
  }
}

TEST_F(Meshopt, QuaternionsOfAnimations) {
  const std::vector<Vec4> turns{{0, 0, 0, 1}, glm::normalize(Vec4(1, 2, 3, 4)), glm::normalize(Vec4(-1, 0.5f, 0, 1))};
  std::vector<std::array<int16_t, 4>> packed(turns.size());
  meshopt_encodeFilterQuat(packed.data(), turns.size(), 8, 16, &turns[0].x);
  Gltf gltf;
  gltf.triangle();
  const int keys = gltf.accessor(view(gltf, vertices(packed), turns.size(), 8, "ATTRIBUTES", "QUATERNION"), kShort,
                                 "VEC4", turns.size(), true);
  gltf.root["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}},
                              {"samplers", {{{"input", gltf.floats({0, 1, 2})}, {"output", keys}}}}}};
  const auto scene = scene::load_gltf(write("turns.glb", glb(gltf)));
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->animations.size(), 1U);
  const auto& values = scene->animations[0]->channels.at(0).values;
  for (size_t k = 0; k < turns.size(); ++k) {
    const Vec4 q(values[4 * k], values[4 * k + 1], values[4 * k + 2], values[4 * k + 3]);
    EXPECT_NEAR(std::abs(glm::dot(q, turns[k])), 1, 1e-4f) << k;
  }
}

TEST_F(Meshopt, DefectsAreReported) {
  const auto error = [&](const char* member, const json& value, int view = 0) {
    Gltf gltf = file();
    gltf.root["bufferViews"][view]["extensions"]["EXT_meshopt_compression"][member] = value;
    return stripped(scene::load_gltf(write("wrong.glb", glb(gltf))));
  };
  const std::string first = "bufferViews[0].extensions.EXT_meshopt_compression: ",
                    last = "bufferViews[3].extensions.EXT_meshopt_compression: ";
  EXPECT_EQ(error("buffer", 7), first + "refers to buffers[7], which does not exist; the file has 2");
  EXPECT_EQ(error("buffer", 1), first + "buffers[1] is a placeholder for compressed data");
  EXPECT_TRUE(error("byteOffset", 1 << 30).starts_with(first + "ends at byte "));
  EXPECT_EQ(error("count", -1), first + "count has to be an integer between 0 and 9007199254740992");
  EXPECT_EQ(error("count", "many"), first + "count has to be an integer between 0 and 9007199254740992");
  EXPECT_EQ(error("byteStride", 13), first + "byteStride 13 is not allowed in this mode");
  EXPECT_EQ(error("byteStride", 260), first + "byteStride 260 is not allowed in this mode");
  EXPECT_EQ(error("mode", "POINTS"), first + "mode has to be one of ATTRIBUTES, TRIANGLES, INDICES");
  EXPECT_EQ(error("filter", 4), first + "filter has to be one of NONE, OCTAHEDRAL, QUATERNION, EXPONENTIAL");
  EXPECT_EQ(error("filter", "OCTAHEDRAL"), first + "byteStride 12 is not allowed in this mode");
  EXPECT_EQ(error("count", 100, 3), last + "count 100 has to be a multiple of 3 in mode TRIANGLES");
  EXPECT_EQ(error("filter", "EXPONENTIAL", 3), last + "has a filter, which only mode ATTRIBUTES allows");
  EXPECT_TRUE(error("count", 700).starts_with(first + "the ")) << error("count", 700);
  EXPECT_TRUE(error("count", uint64_t{1} << 50).starts_with(first)) << "without allocating memory for it";
  EXPECT_TRUE(error("count", 40'000'000).starts_with(first + "needs more than ")) << error("count", 40'000'000);
}

// Flipped, truncated and random bytes give a message of one line or a mesh. Meshes from damaged data still pass the
// checks of the loader.
class CompressedDamage : public Draco {
 protected:
  void expect_survives(const std::function<std::string(const std::string&)>& glb_of, const std::string& good) {
    std::mt19937 random(7);
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
      std::string bytes = good;
      const int changes = 1 + static_cast<int>(random() % 3);
      for (int c = 0; c < changes; ++c) switch (random() % 3) {
          case 0:
            bytes[random() % bytes.size()] ^= static_cast<char>(1U << random() % 8);
            break;
          case 1:
            bytes[random() % bytes.size()] = static_cast<char>(random() % 2 ? 0xff : random());
            break;
          default:
            if (c == 0) bytes.resize(1 + random() % bytes.size());
            break;
        }
      refused += !stripped(scene::load_gltf(write("damaged.glb", glb_of(bytes)))).empty();
    }
    EXPECT_GT(refused, 40) << "the damage has to reach the decoder";
  }
};

TEST_F(CompressedDamage, DracoSequential) {
  expect_survives([](const std::string& bytes) { return file(bytes).glb(); }, encoded(draco::MESH_SEQUENTIAL_ENCODING));
}

TEST_F(CompressedDamage, DracoEdgebreaker) {
  expect_survives([](const std::string& bytes) { return file(bytes).glb(); },
                  encoded(draco::MESH_EDGEBREAKER_ENCODING));
}

class MeshoptDamage : public Meshopt {};

TEST_F(MeshoptDamage, BinaryChunk) {
  Gltf gltf = file();
  const std::string good = glb(gltf);
  const size_t first = good.find(std::string("BIN\0", 4)) + 4;
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    std::string bytes = good;
    for (unsigned c = 0; c <= random() % 3; ++c)
      bytes[first + random() % (bytes.size() - first)] ^= static_cast<char>(1U << random() % 8);
    refused += !stripped(scene::load_gltf(write("damaged.glb", bytes))).empty();
  }
  EXPECT_GT(refused, 40);
}

// Published files and the same models uncompressed.
class CompressedData : public testing::TestWithParam<std::array<const char*, 2>> {};

TEST_P(CompressedData, EqualsTheUncompressedFile) {
  const std::filesystem::path folder = data_folder();
  if (folder.empty()) GTEST_SKIP() << "ETENDUE_TEST_DATA names no folder";
  std::array<Mesh, 2> meshes;
  for (size_t i = 0; i < 2; ++i) {
    const auto scene = scene::load_gltf(folder / "gltf" / GetParam()[i]);
    ASSERT_TRUE(scene) << scene.error().message;
    meshes[i] = *scene->meshes.at(0).primitives.at(0).mesh;
    // gltfpack stores the scale in the node.
    const auto world = scene::world_matrices(*scene);
    for (size_t n = 0; n < scene->nodes.size(); ++n)
      if (scene->nodes[n].mesh == 0)
        for (Vec3& p : meshes[i].positions) p = Vec3(world[n] * Vec4(p, 1));
  }
  ASSERT_EQ(meshes[0].triangles.size(), meshes[1].triangles.size());
  const Bounds bounds = bounds_of(meshes[1], Mat4(1));
  const float steps =
      max_component(bounds.max - bounds.min) / 1024;  // quantisation to 10 bits, the coarsest that encoders use
  EXPECT_LT(distance(meshes[0], meshes[1]), 2 * steps);
  EXPECT_LT(distance(meshes[1], meshes[0]), 2 * steps);
}

INSTANTIATE_TEST_SUITE_P(All, CompressedData,
                         testing::Values(std::array{"Box/glTF-Draco/Box.gltf", "Box.glb"},
                                         std::array{"glTF-Transform/BoxDraco.gltf", "Box.glb"},
                                         std::array{"Duck/glTF-Draco/Duck.gltf", "Duck.glb"}));

TEST(MeshoptData, Box) {
  const std::filesystem::path folder = data_folder();
  if (folder.empty()) GTEST_SKIP() << "ETENDUE_TEST_DATA names no folder";
  const auto scene = scene::load_gltf(folder / "gltf/glTF-Transform/BoxMeshopt.glb");
  ASSERT_TRUE(scene) << scene.error().message;
  const Bounds bounds = scene::world_bounds(*scene);
  EXPECT_LT(glm::length(bounds.min + Vec3(0.5f)), 1e-3f);
  EXPECT_LT(glm::length(bounds.max - Vec3(0.5f)), 1e-3f);
  EXPECT_EQ(scene->meshes.at(0).primitives.at(0).mesh->triangles.size(), 12U);
}

}  // namespace
}  // namespace etendue::test
