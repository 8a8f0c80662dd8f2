// Edits of materials and textures: states, undo, material files, impossible edits.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "render/material_settings.h"
#include "render/scene_saving.h"
#include "scene/gltf/load_gltf.h"
#include "scene/gltf/save_gltf.h"
#include "support/scenes.h"

namespace etendue {
namespace {

using render::Document;
using scene::EditKind;
using scene::StructuralEdit;
namespace fs = std::filesystem;

Document cornell() {
  Document d = *render::new_document("cornell");
  d.width = d.height = 24;
  return d;
}

Document edited(const Document& d, const StructuralEdit& edit) {
  auto changed = render::with_structural_edit(d, edit);
  EXPECT_TRUE(changed) << changed.error().message;
  return changed ? *changed : d;
}

Document with(const Document& d, const std::string& name, const char* text) {
  auto changed = render::with_text(d, name, text);
  EXPECT_TRUE(changed) << changed.error().message;
  return changed ? *changed : d;
}

void expect_same_scene(const scene::Scene& a, const scene::Scene& b) {
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.roots, b.roots);
  EXPECT_EQ(a.meshes.size(), b.meshes.size());
  for (size_t i = 0; i < std::min(a.meshes.size(), b.meshes.size()); ++i)
    for (size_t p = 0; p < a.meshes[i].primitives.size(); ++p)
      EXPECT_EQ(a.meshes[i].primitives[p].material, b.meshes[i].primitives[p].material);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (size_t i = 0; i < a.materials.size(); ++i) EXPECT_EQ(a.materials[i], b.materials[i]) << "material " << i;
  EXPECT_EQ(a.removed_materials, b.removed_materials);
  ASSERT_EQ(a.textures.size(), b.textures.size());
  for (size_t i = 0; i < a.textures.size(); ++i) {
    EXPECT_EQ(a.textures[i].name, b.textures[i].name);
    ASSERT_EQ(a.textures[i].image != nullptr, b.textures[i].image != nullptr);
    if (a.textures[i].image) {
      EXPECT_EQ(a.textures[i].image->bytes, b.textures[i].image->bytes);
    }
  }
  EXPECT_EQ(a.lights, b.lights);
  EXPECT_EQ(a.cameras, b.cameras);
}

bool have_same_bits(const film::Film& a, const film::Film& b) {
  return a.pixels().size() == b.pixels().size() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

Document reopened(const Document& d) {
  auto opened = render::document_from_state(render::state_json(d, 0), "state");
  EXPECT_TRUE(opened) << opened.error().message;
  return opened ? *opened : d;
}

void expect_same_when_reopened(const Document& d) {
  const Document opened = reopened(d);
  expect_same_scene(*d.scene, *opened.scene);
  EXPECT_TRUE(have_same_bits(test::rendered(d, 1, 1), test::rendered(opened, 1, 1)));
}

class MaterialEdits : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("etendue-material-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // A picture of 4 x 2 pixels in different colours.
  std::string picture(const std::string& name) const {
    std::vector<uint8_t> rgb;
    for (int i = 0; i < 24; ++i) rgb.push_back(static_cast<uint8_t>(i * 10 + name.size()));
    EXPECT_TRUE(image::write_png(path(name), 4, 2, rgb));
    return path(name);
  }

  fs::path folder_;
};

TEST_F(MaterialEdits, SettingsOfAMaterialAreRestored) {
  // An edit of the index removes a glass.
  Document d = with(cornell(), "material.0.glass", "n-bk7");
  d = with(d, "material.1.model", "oren-nayar");
  expect_same_when_reopened(d);
  EXPECT_EQ(reopened(d).scene->materials[0].glass, d.scene->materials[0].glass);
}

// The default distance is infinite, which the end of the range of the parameter stands for.
TEST_F(MaterialEdits, InfiniteAttenuationDistanceIsRestored) {
  const Document d = cornell();
  const auto distance = [](const Document& document) { return document.scene->materials[0].attenuation_distance; };
  ASSERT_EQ(distance(d), kInfinity);
  const Document finite = with(d, "material.0.attenuation-distance", "2");
  EXPECT_EQ(distance(finite), 2);
  const auto settings = render::material_settings(d.scene->materials[0], d.scene->textures);
  const auto pasted = render::with_material_settings(finite, 0, settings);
  ASSERT_TRUE(pasted) << pasted.error().message;
  EXPECT_EQ(distance(*pasted), kInfinity);
}

TEST_F(MaterialEdits, EveryPresetIsRestored) {
  for (const BsdfModelInfo& model : bsdf_model_infos())
    for (const ModelPreset& preset : model.presets) {
      Document d = with(cornell(), "material.0.model", model.description.name);
      d = with(d, std::string("material.0.") + model.description.name + ".preset", preset.name.c_str());
      EXPECT_EQ(reopened(d).scene->materials[0], d.scene->materials[0]) << model.description.name << " " << preset.name;
    }
}

TEST_F(MaterialEdits, AddedAndAssignedMaterialsAreRestored) {
  Document d = cornell();
  const int count = static_cast<int>(d.scene->materials.size());
  d = edited(d, {.kind = EditKind::add_material, .name = "new"});
  d = with(d, "material." + std::to_string(count) + ".base-color.r", "0.1");
  d = edited(d, {.kind = EditKind::add_material, .name = "copy", .material = 0});
  d = edited(d, {.kind = EditKind::assign_material, .node = 0, .material = count});
  d = edited(d, {.kind = EditKind::rename_material, .name = "renamed", .material = 1});
  EXPECT_EQ(d.scene->materials[static_cast<size_t>(count)].name, "new");
  EXPECT_EQ(d.scene->materials[1].name, "renamed");
  EXPECT_EQ(scene::user_of_material(*d.scene, count), 0);
  expect_same_when_reopened(d);
}

TEST_F(MaterialEdits, AssignmentCopiesASharedMesh) {
  Document d = edited(cornell(), {.kind = EditKind::add_shape, .type = "box", .name = "box"});
  const int box = static_cast<int>(d.scene->nodes.size()) - 1;
  d = edited(d, {.kind = EditKind::duplicate, .node = box, .name = "copy"});
  const int original = d.scene->meshes[static_cast<size_t>(d.scene->nodes.back().mesh)].primitives[0].material;
  d = edited(d, {.kind = EditKind::assign_material, .node = box + 1, .material = 0});
  const auto material_of = [&](int node) {
    const auto& n = d.scene->nodes[static_cast<size_t>(node)];
    return d.scene->meshes[static_cast<size_t>(n.mesh)].primitives[0].material;
  };
  EXPECT_EQ(material_of(box), original);
  EXPECT_EQ(material_of(box + 1), 0);
  expect_same_when_reopened(d);
}

TEST_F(MaterialEdits, MaterialInUseCannotBeRemoved) {
  Document d = cornell();
  const int used = d.scene->meshes[static_cast<size_t>(d.scene->nodes[0].mesh)].primitives[0].material;
  const auto failed = render::with_structural_edit(d, {.kind = EditKind::remove_material, .material = used});
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.error().message.find("is used by"), std::string::npos);
  const int added = static_cast<int>(d.scene->materials.size());
  d = edited(d, {.kind = EditKind::add_material, .name = "unused"});
  d = edited(d, {.kind = EditKind::remove_material, .material = added});
  EXPECT_FALSE(scene::has_material(*d.scene, added));
  EXPECT_FALSE(render::with_structural_edit(d, {.kind = EditKind::assign_material, .node = 0, .material = added}));
  EXPECT_FALSE(render::with_structural_edit(d, {.kind = EditKind::remove_material, .material = added}));
  expect_same_when_reopened(d);
  EXPECT_EQ(render::scene_to_save(d).materials.size(), d.scene->materials.size() - 1);
}

TEST_F(MaterialEdits, TexturesAreRestoredAndExported) {
  Document d = edited(cornell(), {.kind = EditKind::add_shape, .type = "sphere", .name = "ball"});
  const int material = static_cast<int>(d.scene->materials.size()) - 1;
  const std::string slot = "material." + std::to_string(material) + ".texture.base-color";
  const int first = static_cast<int>(d.scene->textures.size());
  d = edited(d, {.kind = EditKind::add_texture, .file = picture("unused.png")});
  d = edited(d, {.kind = EditKind::add_texture, .file = picture("used.png")});
  d = with(d, slot, std::to_string(first + 1).c_str());
  d = with(d, slot + ".offset.x", "0.25");
  d = with(d, slot + ".rotation", "1.5");
  d = with(d, slot + ".scale.y", "3");
  expect_same_when_reopened(d);
  const std::string file = path("saved.glb");
  ASSERT_TRUE(scene::save_gltf(render::scene_to_save(d), file));
  const auto saved = scene::load_gltf(file);
  ASSERT_TRUE(saved) << saved.error().message;
  ASSERT_EQ(saved->textures.size(), static_cast<size_t>(first) + 1);
  const TextureUse& use = saved->materials[static_cast<size_t>(material)].base_color_texture;
  const TextureUse& original = d.scene->materials[static_cast<size_t>(material)].base_color_texture;
  EXPECT_EQ(use.texture, first);
  EXPECT_EQ(use.offset, original.offset);
  EXPECT_EQ(use.rotation, original.rotation);
  EXPECT_EQ(use.scale, original.scale);
  const auto& pixels = saved->textures[static_cast<size_t>(first)].image;
  ASSERT_TRUE(pixels);
  EXPECT_EQ(pixels->bytes, d.scene->textures[static_cast<size_t>(first) + 1].image->bytes);
}

TEST_F(MaterialEdits, FilesThatAreNotPicturesAreErrors) {
  std::ofstream(path("text.png")) << "no picture";
  const Document d = cornell();
  for (const std::string& file : {path("missing.png"), path("text.png"), folder_.string(), std::string()}) {
    const auto failed = render::with_structural_edit(d, {.kind = EditKind::add_texture, .file = file});
    ASSERT_FALSE(failed) << file;
    EXPECT_FALSE(failed.error().message.empty());
  }
}

TEST_F(MaterialEdits, SessionWithoutItsTextureOpensWithAWarning) {
  Document d = edited(cornell(), {.kind = EditKind::add_texture, .file = picture("lost.png")});
  d = with(d, "material.0.texture.base-color", std::to_string(d.scene->textures.size() - 1).c_str());
  fs::remove(path("lost.png"));
  const Document opened = reopened(d);
  ASSERT_EQ(opened.scene->textures.size(), d.scene->textures.size());
  EXPECT_FALSE(opened.scene->textures.back().image);
  EXPECT_EQ(opened.scene->warnings.size(), d.scene->warnings.size() + 1);
  // The name of the file is kept, so that the texture is back with its file.
  picture("lost.png");
  EXPECT_TRUE(reopened(opened).scene->textures.back().image);
}

TEST_F(MaterialEdits, MaterialFilesKeepParametersAndTextures) {
  Document d = with(cornell(), "material.0.roughness", "0.125");
  d = edited(d, {.kind = EditKind::add_texture, .file = picture("pattern.png")});
  d = with(d, "material.0.texture.base-color", std::to_string(d.scene->textures.size() - 1).c_str());
  d = with(d, "material.0.texture.base-color.scale.x", "4");
  d = with(d, "material.0.glass", "n-bk7");
  ASSERT_TRUE(render::write_material_file(path("kept.material"), *d.scene, 0));
  // Into another scene, whose material has other parameters.
  Document other = with(*render::new_document("cornell-spheres"), "material.1.model", "oren-nayar");
  auto loaded = render::with_material_file(other, 1, path("kept.material"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  Material expected = d.scene->materials[0], actual = loaded->scene->materials[1];
  ASSERT_GE(actual.base_color_texture.texture, 0);
  EXPECT_EQ(loaded->scene->textures.back().image->bytes, d.scene->textures.back().image->bytes);
  EXPECT_EQ(actual.name, other.scene->materials[1].name);
  expected.name = actual.name;
  expected.base_color_texture.texture = actual.base_color_texture.texture;
  // The file holds the finite end of the range for an infinite length.
  expected.attenuation_distance = actual.attenuation_distance;
  EXPECT_EQ(actual, expected);
}

TEST_F(MaterialEdits, DamagedMaterialFilesAreErrors) {
  const Document d = cornell();
  for (const char* text : {"", "{}", "[1]", R"({"program":"etendue"})",
                           R"({"program":"etendue","name":3,"settings":{},"textures":{}})",
                           R"({"program":"etendue","name":"a","settings":{"roughness":"x"},"textures":{}})",
                           R"({"program":"etendue","name":"a","settings":{"roughness":7},"textures":{}})",
                           R"({"program":"etendue","name":"a","settings":{"speed":1},"textures":{}})",
                           R"({"program":"etendue","name":"a","settings":{"roughness":[]},"textures":{}})",
                           R"({"program":"etendue","name":"a","settings":{},"textures":{"normal":"none.png"}})"}) {
    std::ofstream(path("damaged.material")) << text;
    EXPECT_FALSE(render::with_material_file(d, 0, path("damaged.material"))) << text;
  }
}

TEST_F(MaterialEdits, ParentKeepsTheWorldTransformAndCyclesAreErrors) {
  Document d = edited(cornell(), {.kind = EditKind::add_shape, .type = "box", .name = "a"});
  d = edited(d, {.kind = EditKind::add_shape, .type = "box", .name = "b"});
  const int a = static_cast<int>(d.scene->nodes.size()) - 2, b = a + 1;
  d = with(d, "node." + std::to_string(a) + ".translation.x", "2");
  // Relative to a, which is at x = 2, b is at x = -2.
  d = edited(d, {.kind = EditKind::set_parent, .node = b, .transform = {.translation = {-2, 0, 0}}, .parent = a});
  EXPECT_EQ(scene::world_matrices(*d.scene)[static_cast<size_t>(b)], Mat4(1));
  expect_same_when_reopened(d);
  EXPECT_FALSE(render::with_structural_edit(d, {.kind = EditKind::set_parent, .node = a, .parent = b}));
  EXPECT_FALSE(render::with_structural_edit(d, {.kind = EditKind::set_parent, .node = a, .parent = a}));
  EXPECT_FALSE(render::with_structural_edit(d, {.kind = EditKind::set_parent, .node = a, .parent = 10000}));
  StructuralEdit sheared{.kind = EditKind::set_parent, .node = b};
  sheared.transform.matrix = Mat4(1);
  (*sheared.transform.matrix)[1][0] = 0.5f;
  d = edited(d, sheared);
  EXPECT_EQ(d.scene->nodes[static_cast<size_t>(b)].parent, -1);
  expect_same_when_reopened(d);
}

}  // namespace
}  // namespace etendue
