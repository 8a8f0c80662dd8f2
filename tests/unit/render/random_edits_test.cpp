// A thousand random edits of a scene, with undo and redo of all of them: the document equals a fresh load of its state.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "material/texture_slots.h"
#include "render/document_parameters.h"
#include "render/material_settings.h"
#include "render/scene_saving.h"
#include "scene/gltf/save_gltf.h"
#include "scene/keyframes.h"
#include "scene/pose.h"
#include "scene/rotation.h"
#include "support/random_editor.h"
#include "support/scenes.h"

namespace etendue {
namespace {

using render::Document;
using scene::EditKind;
using scene::StructuralEdit;
namespace fs = std::filesystem;

// ETENDUE_RANDOM_EDITS sets the number of edits of longer runs.
int number_of_edits() {
  const char* text = std::getenv("ETENDUE_RANDOM_EDITS");
  return text ? std::max(1, std::atoi(text)) : 1000;
}

class RandomSceneEditor : public test::RandomEditor {
 public:
  RandomSceneEditor(Document document, std::vector<std::string> pictures, uint32_t seed)
      : RandomEditor(std::move(document), seed), pictures_(std::move(pictures)) {}

  void edit() {
    constexpr size_t kKinds = 18;
    switch (below(kKinds)) {
      case 0:
        return undo();
      case 1:
        return redo();
      case 2:
        return apply(adding(EditKind::add_light));
      case 3:
        return apply(adding(EditKind::add_shape));
      case 4:
        return apply(of_node(EditKind::duplicate));
      case 5:
      case 6:
        return apply(of_node(EditKind::remove));
      case 7:
        return apply(of_node(below(2) == 0 ? EditKind::rename : EditKind::assign_material));
      case 8:
        return set_parent();
      case 9:
        return apply(of_material(EditKind::add_material));
      case 10:
        return apply(of_material(below(2) == 0 ? EditKind::rename_material : EditKind::remove_material));
      case 11:
        return paste_material();
      case 12:
        return apply({.kind = EditKind::add_texture, .file = pictures_[below(pictures_.size())]});
      case 13:
        return change_texture();
      case 14:
        return set_keyframe();
      case 15:
        return remove_keyframe();
      case 16:
        return change_parameter_of("material." + std::to_string(below(document().scene->materials.size())));
      default:
        return change_parameter_of("node." + std::to_string(below(document().scene->nodes.size())));
    }
  }

 private:
  int any_node() { return static_cast<int>(below(document().scene->nodes.size())); }
  int any_material() { return static_cast<int>(below(document().scene->materials.size())); }

  StructuralEdit of_node(EditKind kind) {
    StructuralEdit edit;
    edit.kind = kind;
    edit.node = any_node();
    edit.name = "node " + std::to_string(below(1000));
    edit.material = any_material();
    return edit;
  }

  StructuralEdit of_material(EditKind kind) {
    StructuralEdit edit;
    edit.kind = kind;
    edit.name = "material " + std::to_string(below(1000));
    edit.material = below(4) == 0 ? -1 : any_material();
    return edit;
  }

  static constexpr int kKeyframeTimes = 4;

  StructuralEdit keyframe(EditKind kind) {
    StructuralEdit edit;
    edit.kind = kind;
    edit.node = any_node();
    edit.animation = scene::animation_for_keyframes(*document().scene, edit.node);
    edit.time = 0.5f * static_cast<float>(below(kKeyframeTimes));
    return edit;
  }

  // A place near the present one.
  void set_keyframe() {
    StructuralEdit edit = keyframe(EditKind::set_keyframe);
    const auto posed = scene::decompose(scene::posed_transform(*document().scene, edit.node));
    if (!posed) return;
    edit.transform = *posed;
    edit.transform.translation += Vec3(between(-0.1f, 0.1f), between(-0.1f, 0.1f), between(-0.1f, 0.1f));
    apply(edit);
  }

  void remove_keyframe() { apply(keyframe(EditKind::remove_keyframe)); }

  // Keeps the world transform, as a matrix if the parents shear it.
  void set_parent() {
    StructuralEdit edit;
    edit.kind = EditKind::set_parent;
    edit.node = any_node();
    edit.parent = below(3) == 0 ? -1 : any_node();
    const auto world = scene::world_matrices(*document().scene);
    const Mat4 parent = edit.parent < 0 ? Mat4(1) : world[static_cast<size_t>(edit.parent)];
    if (scene::is_singular(parent)) return;
    const Mat4 local = glm::inverse(parent) * world[static_cast<size_t>(edit.node)];
    if (const auto parts = scene::decompose({.matrix = local}))
      edit.transform = *parts;
    else
      edit.transform.matrix = local;
    apply(edit);
  }

  void paste_material() {
    const auto& materials = document().scene->materials;
    const auto settings = render::material_settings(materials[below(materials.size())], document().scene->textures);
    auto changed = render::with_material_settings(document(), below(materials.size()), settings);
    ASSERT_TRUE(changed) << changed.error().message;
    step(std::move(*changed));
  }

  void change_texture() {
    const auto slots = texture_slots();
    const std::string name = "material." + std::to_string(any_material()) + ".texture." + slots[below(slots.size())].name;
    const auto count = static_cast<int64_t>(document().scene->textures.size());
    const auto texture = static_cast<int64_t>(below(static_cast<size_t>(count) + 1)) - 1;
    auto changed = render::with(document(), name, Value(texture));
    if (changed && texture >= 0) changed = render::with(*changed, name + ".scale.x", Value(double{between(0.1f, 4)}));
    if (changed && texture >= 0) changed = render::with(*changed, name + ".rotation", Value(double{between(-3, 3)}));
    if (changed) step(std::move(*changed));
  }

  // One parameter of the section, of any type.
  void change_parameter_of(const std::string& section) {
    const auto parameters = render::section_parameters(document(), section);
    const auto& info = parameters[below(parameters.size())].info;
    if (info.validate_text) return;
    Value value;
    switch (info.type) {
      case ParameterType::toggle:
        value = below(2) == 0;
        break;
      case ParameterType::integer:
        value = static_cast<int64_t>(info.min) +
                static_cast<int64_t>(below(static_cast<size_t>(info.max - info.min) + 1));
        break;
      case ParameterType::number:
        value = double{between(static_cast<float>(std::max(info.min, -1.0)), static_cast<float>(std::min(info.max, 1.0)))};
        break;
      case ParameterType::choice:
        value = info.options[below(info.options.size())];
        break;
    }
    if (auto changed = render::with(document(), info.name, value)) step(std::move(*changed));
  }

  std::vector<std::string> pictures_;
};

class RandomEdits : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / "etendue-random-edits";
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    for (const char* name : {"a.png", "b.png"}) {
      std::vector<uint8_t> rgb;
      for (int i = 0; i < 48; ++i) rgb.push_back(static_cast<uint8_t>(i * 5 + name[0]));
      ASSERT_TRUE(image::write_png(folder_ / name, 4, 4, rgb));
      pictures_.push_back((folder_ / name).string());
    }
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
  std::vector<std::string> pictures_;
};

bool have_same_bits(const film::Film& a, const film::Film& b) {
  return a.pixels().size() == b.pixels().size() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

// The parameters in which two materials differ.
std::string differences(const scene::Scene& a, const scene::Scene& b, size_t material) {
  std::string text;
  const auto x = render::material_settings(a.materials[material], a.textures);
  const auto y = render::material_settings(b.materials[material], b.textures);
  for (size_t i = 0; i < std::min(x.size(), y.size()); ++i)
    if (x[i].name != y[i].name || x[i].value != y[i].value)
      text += " " + x[i].name + "=" + to_string(x[i].value) + "/" + y[i].name + "=" + to_string(y[i].value);
  return text;
}

void expect_same_scene(const scene::Scene& a, const scene::Scene& b) {
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.roots, b.roots);
  EXPECT_EQ(a.lights, b.lights);
  EXPECT_EQ(a.removed_materials, b.removed_materials);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (size_t i = 0; i < a.materials.size(); ++i)
    EXPECT_TRUE(a.materials[i] == b.materials[i]) << "material " << i << differences(a, b, i);
  ASSERT_EQ(a.textures.size(), b.textures.size());
  for (size_t i = 0; i < a.textures.size(); ++i) EXPECT_EQ(a.textures[i].image->bytes, b.textures[i].image->bytes);
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (size_t i = 0; i < a.meshes.size(); ++i)
    for (size_t p = 0; p < a.meshes[i].primitives.size(); ++p)
      EXPECT_EQ(a.meshes[i].primitives[p].material, b.meshes[i].primitives[p].material);
}

void expect_same_as_fresh_load(const Document& d, bool renders) {
  const auto opened = render::document_from_state(render::state_json(d, 0), "state");
  ASSERT_TRUE(opened) << opened.error().message;
  expect_same_scene(*d.scene, *opened->scene);
  if (renders) {
    EXPECT_TRUE(have_same_bits(test::rendered(d, 1, 1), test::rendered(*opened, 1, 1)));
  }
}

TEST_F(RandomEdits, EqualAFreshLoadWithUndoAndRedoOfAll) {
  Document original = *render::new_document("cornell");
  original.width = original.height = 16;
  RandomSceneEditor editor(original, pictures_, 20);
  const int count = number_of_edits();
  for (int i = 1; i <= count; ++i) {
    editor.edit();
    if (i % 50 == 0) expect_same_as_fresh_load(editor.document(), i % 250 == 0);
    ASSERT_FALSE(HasFailure()) << "after edit " << i;
  }
  // At most an eighth are undo and redo, and about a third of the others are impossible or change nothing.
  EXPECT_GT(editor.done(), static_cast<size_t>(count) / 3);
  const Document last = editor.document();
  const size_t depth = editor.undo_depth();
  while (editor.undo_depth() > 0) editor.undo();
  EXPECT_EQ(editor.document().scene, original.scene);
  EXPECT_TRUE(editor.document().structure.empty());
  while (editor.undo_depth() < depth) editor.redo();
  EXPECT_EQ(editor.document().scene, last.scene);
  expect_same_as_fresh_load(editor.document(), true);
  EXPECT_TRUE(scene::save_gltf(render::scene_to_save(editor.document()), (folder_ / "saved.glb").string()));
  const auto saved = render::new_document((folder_ / "saved.glb").string());
  EXPECT_TRUE(saved) << saved.error().message;
}

}  // namespace
}  // namespace etendue
