// File structure: JSON, GLB chunks, URIs, versions, extensions.
#include "unit/scene/gltf_builder.h"

namespace etendue::test {
namespace {

class Files : public GltfTest {
 protected:
  // A triangle whose buffer has this uri.
  static json described(const std::string& uri, size_t size = 36) {
    Gltf gltf;
    gltf.triangle();
    gltf.root["buffers"] = {{{"byteLength", size}, {"uri", uri}}};
    return gltf.root;
  }
  static std::string triangle_bytes() {
    Gltf gltf;
    gltf.triangle();
    return {gltf.bytes().begin(), gltf.bytes().end()};
  }
};

constexpr const char* kTriangle64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

TEST_F(Files, DataUri) {
  for (const char* type : {"application/octet-stream", "application/gltf-buffer", ""}) {
    const auto scene =
        scene::load_gltf(write("test.gltf", described("data:" + std::string(type) + ";base64," + kTriangle64).dump()));
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(mesh_of(*scene)->positions[1], Vec3(1, 0, 0));
  }
  EXPECT_EQ(error_of(described("data:application/octet-stream;base64,AA*A").dump()),
            "meshes[0].primitives[0].attributes.POSITION: buffers[0] has a malformed data URI; it has to be base64");
}

TEST_F(Files, ExternalFilesWithSpacesPercentsAndUnicode) {
  const std::pair<const char*, const char*> names[] = {
      {"two words.bin", "two%20words.bin"},       {"two words.bin", "two words.bin"}, {"ünï♻.bin", "ünï♻.bin"},
      {"ünï♻.bin", "%C3%BCn%C3%AF%E2%99%BB.bin"}, {"100%.bin", "100%.bin"},           {"a%20b.bin", "a%20b.bin"}};
  for (const auto& [name, uri] : names) {
    const auto bin = write(name, triangle_bytes());
    const auto scene = scene::load_gltf(write("täst ❤.gltf", described(uri).dump()));
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(mesh_of(*scene)->positions[2], Vec3(0, 1, 0));
    EXPECT_EQ(all(scene->warnings), "");
    std::filesystem::remove(bin);
  }
}

TEST_F(Files, MissingBuffersAreReported) {
  EXPECT_EQ(error_of(described("gone.bin").dump()),
            "meshes[0].primitives[0].attributes.POSITION: buffers[0] cannot be read from 'gone.bin': there is no "
            "such file");
  EXPECT_EQ(
      error_of(described("https://example.com/a.bin").dump()),
      "meshes[0].primitives[0].attributes.POSITION: buffers[0] has the uri 'https://example.com/a.bin', which is not a "
      "local file");
  json no_uri = described("x");
  no_uri["buffers"][0].erase("uri");
  EXPECT_EQ(
      error_of(no_uri.dump()),
      "meshes[0].primitives[0].attributes.POSITION: buffers[0] has no uri, and the file has no binary chunk for it");
}

TEST_F(Files, BuffersMayBeLongerButNotShorterThanNeeded) {
  write("long.bin", triangle_bytes() + "more");
  EXPECT_EQ(error_of(described("long.bin").dump()), "");
  write("short.bin", triangle_bytes().substr(0, 30));
  EXPECT_EQ(error_of(described("short.bin").dump()),
            "meshes[0].primitives[0].attributes.POSITION: bufferView 0 ends at byte 36, but buffer 0 has 30");
}

TEST_F(Files, FilesThatAreNotGltf) {
  const auto message = [](const std::filesystem::path& path) {
    const auto scene = scene::load_gltf(path);
    return scene ? "" : scene.error().message;
  };
  EXPECT_EQ(message(folder_ / "none.gltf"), (folder_ / "none.gltf").string() + ": there is no such file");
  EXPECT_EQ(message(folder_), folder_.string() + ": this is a folder; give a file");
  EXPECT_EQ(error_of(""), "the file is empty; it has to be a .gltf or .glb file");
  EXPECT_EQ(error_of("hello"), "not glTF: the file has to begin with '{' (JSON) or 'glTF' (binary)");
  EXPECT_TRUE(error_of("{\"asset\": }").starts_with("not valid JSON: parse error at line 1, column 11"));
  EXPECT_TRUE(error_of("{\n\"asset\":\n }").starts_with("not valid JSON: parse error at line 3"));
  EXPECT_EQ(error_of("{}"), "not glTF: asset.version is missing");
}

TEST_F(Files, DeepNestingIsRejected) {
  const std::string deep =
      "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(100000, '[') + std::string(100000, ']') + "}";
  EXPECT_EQ(error_of(deep), "the JSON is nested more than 64 levels deep");
}

TEST_F(Files, Versions) {
  const auto with_asset = [&](const char* asset) { return error_of(std::string("{\"asset\":") + asset + "}"); };
  EXPECT_EQ(with_asset("{\"version\":\"2.0\"}"), "");
  EXPECT_EQ(with_asset("{\"version\":\"2.1\"}"), "")
      << "later minor versions are compatible unless minVersion excludes 2.0";
  EXPECT_EQ(with_asset("{\"version\":\"1.0\"}"), "glTF version 1.0 (asset.version) is not supported, only 2.0 is");
  EXPECT_EQ(with_asset("{\"version\":\"2.1\",\"minVersion\":\"2.1\"}"),
            "requires glTF 2.1 (asset.minVersion); only 2.0 is supported");
  EXPECT_EQ(with_asset("{\"version\":\"2.1\",\"minVersion\":\"2.0\"}"), "");
  EXPECT_EQ(with_asset("{\"version\":2.0}"), "glTF version 2.0 (asset.version) is not supported, only 2.0 is");
}

TEST_F(Files, GlbHeader) {
  Gltf gltf;
  gltf.triangle();
  const std::string good = gltf.glb();
  const auto patched = [&](size_t offset, uint32_t value) {
    return std::string(good).replace(offset, 4, Gltf::word(value));
  };
  EXPECT_EQ(error_of(good), "");
  EXPECT_EQ(error_of(good.substr(0, 8)), "truncated: a GLB header has 12 bytes, but the file has 8");
  EXPECT_EQ(error_of(patched(4, 1)), "GLB version 1 is not supported, only version 2 is");
  EXPECT_EQ(error_of(good.substr(0, good.size() - 10)), "truncated: the GLB header declares " +
                                                            std::to_string(good.size()) + " bytes, but the file has " +
                                                            std::to_string(good.size() - 10));
  EXPECT_EQ(error_of(patched(8, 12)), "the GLB header declares 12 bytes; a header and one chunk need at least 20");
  EXPECT_EQ(error_of(patched(12, 0xffffffffU)),
            "chunk 0: declares 4294967295 bytes, but only " + std::to_string(good.size() - 20) + " remain in the file");
  EXPECT_EQ(error_of(patched(16, 0x004e4942)), "chunk 0: is not JSON; the first chunk of a GLB has to be JSON");
}

TEST_F(Files, GlbWithUnusualChunks) {
  Gltf gltf;
  gltf.triangle();
  const auto trailing = scene::load_gltf(write("test.glb", gltf.glb() + "tail"));
  ASSERT_TRUE(trailing);
  EXPECT_TRUE(warns(*trailing, "4 bytes after the end of the GLB are ignored"));
  // Chunks of unknown types are ignored at any position.
  std::string file = gltf.glb() + Gltf::word(4) + "XTRA" + "abcd";
  file.replace(8, 4, Gltf::word(file.size()));
  EXPECT_EQ(error_of(file), "");
}

TEST_F(Files, ByteOrderMarkIsIgnored) {
  const auto scene = scene::load_gltf(write("bom.gltf", "\xef\xbb\xbf{\"asset\":{\"version\":\"2.0\"}}"));
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(warns(*scene, "byte order mark"));
}

TEST_F(Files, Extensions) {
  Gltf gltf;
  gltf.triangle();
  gltf.root["extensionsUsed"] = {"KHR_animation_pointer", "KHR_materials_ior", "EXT_other"};
  EXPECT_EQ(opened(gltf).unsupported, (std::vector<std::string>{"KHR_animation_pointer", "EXT_other"}));
  gltf.root["extensionsRequired"] = {"KHR_materials_ior"};
  EXPECT_EQ(error_of(gltf), "");
  gltf.root["extensionsRequired"] = {"KHR_materials_ior", "KHR_animation_pointer"};
  EXPECT_EQ(error_of(gltf), "requires the extension KHR_animation_pointer, which is not supported");
}

TEST_F(Files, SceneSelection) {
  Gltf gltf;
  gltf.triangle();
  gltf.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"children", {2}}}, {{"mesh", 0}}};
  gltf.root["scenes"] = {{{"nodes", {0}}}, {{"name", "second"}, {"nodes", {1}}}};
  gltf.root["scene"] = 1;
  EXPECT_EQ(opened(gltf).roots, std::vector<int>{1});
  EXPECT_EQ(opened(gltf).name, "second");
  EXPECT_EQ(opened(gltf).scene_names, (std::vector<std::string>{"scene 0", "second"}));
  scene::LoadOptions options;
  options.scene = 0;
  EXPECT_EQ(load(gltf, options)->roots, std::vector<int>{0});
  options.scene = 5;
  EXPECT_EQ(stripped(load(gltf, options)), "scene 5 does not exist; the file has 2");
  gltf.root.erase("scene");
  EXPECT_EQ(opened(gltf).roots, std::vector<int>{0});
  gltf.root.erase("scenes");
  EXPECT_EQ(opened(gltf).roots, (std::vector<int>{0, 1})) << "without scenes, all nodes without a parent are roots";
}

TEST_F(Files, ProgressAndCancellation) {
  Gltf gltf;
  gltf.triangle();
  std::vector<std::string> phases;
  scene::LoadOptions options;
  options.progress = [&](const char* phase, float done) {
    EXPECT_TRUE(done >= 0 && done <= 1);
    phases.emplace_back(phase);
    return true;
  };
  EXPECT_TRUE(load(gltf, options));
  EXPECT_GE(phases.size(), 2U);
  for (size_t stop = 0; stop < phases.size(); ++stop) {
    size_t calls = 0;
    options.progress = [&](const char*, float) { return calls++ < stop; };
    const auto scene = load(gltf, options);
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().fault, Fault::interrupted);
  }
}

}  // namespace
}  // namespace etendue::test
