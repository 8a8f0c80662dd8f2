// Edits that add, duplicate, remove and rename objects: undo, states and files.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "render/scene_saving.h"
#include "render/session.h"
#include "scene/gltf/save_gltf.h"
#include "support/random_editor.h"
#include "support/scenes.h"

namespace etendue {
namespace {

using render::Document;
using scene::EditKind;
using scene::StructuralEdit;

bool have_same_bits(const film::Film& a, const film::Film& b) {
  return a.pixels().size() == b.pixels().size() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

// The Cornell box, opened by its name so that a state can refer to it.
Document cornell_by_name() {
  Document d = *render::new_document("cornell");
  d.width = d.height = 24;
  return d;
}

// Random edits of a document: of the structure, of parameters of the objects, undo and redo.
class RandomObjectEditor : public test::RandomEditor {
 public:
  using RandomEditor::RandomEditor;

  void edit() {
    switch (below(12)) {
      case 0:
        return undo();
      case 1:
        return redo();
      case 2:
        return apply(adding(EditKind::add_light));
      case 3:
        return apply(adding(EditKind::add_shape));
      case 4:
        return apply(adding(EditKind::add_camera));
      case 5:
        return apply(of_node(EditKind::duplicate));
      case 6:
      case 7:
        return apply(of_node(EditKind::remove));
      case 8:
        return apply(of_node(EditKind::rename));
      default:
        return change_parameter();
    }
  }

 private:
  StructuralEdit of_node(EditKind kind) {
    StructuralEdit edit;
    edit.kind = kind;
    edit.node = static_cast<int>(below(document().scene->nodes.size()));
    edit.name = "renamed " + std::to_string(below(1000));
    return edit;
  }

  void change_parameter() {
    const std::string node = "node." + std::to_string(below(document().scene->nodes.size()));
    const bool hides = below(4) == 0;
    auto changed = hides ? render::with(document(), node + ".visible", Value(below(2) == 0))
                         : render::with(document(), node + ".translation.x", Value(double{between(-0.5f, 0.5f)}));
    if (changed) step(std::move(*changed));
  }
};

void expect_same_scene(const scene::Scene& a, const scene::Scene& b) {
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.roots, b.roots);
  EXPECT_EQ(a.lights, b.lights);
  EXPECT_EQ(a.cameras, b.cameras);
  EXPECT_EQ(a.materials.size(), b.materials.size());
  EXPECT_EQ(a.meshes.size(), b.meshes.size());
}

// The document, its state opened again, and its glTF file show the same image, bit for bit.
void expect_same_image_when_reopened(const Document& d) {
  const auto reopened = render::document_from_state(render::state_json(d, 0), "state");
  ASSERT_TRUE(reopened) << reopened.error().message;
  expect_same_scene(*d.scene, *reopened->scene);
  const film::Film image = test::rendered(d, 1, 1);
  EXPECT_TRUE(have_same_bits(image, test::rendered(*reopened, 1, 1)));

  const auto folder = std::filesystem::temp_directory_path() / "etendue-structural-edits";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "saved.glb").string();
  ASSERT_TRUE(scene::save_gltf(render::scene_to_save(d), file));
  auto saved = render::new_document(file);
  ASSERT_TRUE(saved) << saved.error().message;
  saved->camera = d.camera;
  saved->width = d.width;
  saved->height = d.height;
  saved->limits = d.limits;
  auto scene = std::make_shared<scene::Scene>(*saved->scene);
  scene->environment = d.scene->environment;
  saved->scene = std::move(scene);
  EXPECT_TRUE(have_same_bits(image, test::rendered(*saved, 1, 1)));
  std::filesystem::remove_all(folder);
}

TEST(StructuralEdits, ThousandRandomEditsSurviveReopening) {
  RandomObjectEditor editor(cornell_by_name(), 5);
  for (int i = 1; i <= 1000; ++i) {
    editor.edit();
    if (i % 200 == 0) expect_same_image_when_reopened(editor.document());
    if (testing::Test::HasFailure()) FAIL() << "after edit " << i;
  }
}

TEST(StructuralEdits, UndoOfAllEditsRestoresTheScene) {
  const Document opened = cornell_by_name();
  RandomObjectEditor editor(opened, 9);
  for (int i = 0; i < 300; ++i) editor.edit();
  while (editor.undo_depth() > 0) editor.undo();
  EXPECT_EQ(editor.document().scene, opened.scene);
  EXPECT_TRUE(editor.document().structure.empty());
}

TEST(StructuralEdits, IndicesOfOtherObjectsStay) {
  const Document d = cornell_by_name();
  const auto removed = render::with_structural_edit(d, {.kind = EditKind::remove, .node = 0});
  ASSERT_TRUE(removed);
  ASSERT_EQ(removed->scene->nodes.size(), d.scene->nodes.size());
  for (size_t i = 1; i < d.scene->nodes.size(); ++i) EXPECT_EQ(removed->scene->nodes[i], d.scene->nodes[i]);
  EXPECT_FALSE(scene::reached(*removed->scene)[0]);
  EXPECT_EQ(render::scene_to_save(*removed).nodes.size(), d.scene->nodes.size() - 1);
}

TEST(StructuralEdits, ImpossibleEditsAreErrors) {
  const Document d = cornell_by_name();
  const int nodes = static_cast<int>(d.scene->nodes.size());
  EXPECT_FALSE(render::with_structural_edit(d, {.kind = EditKind::remove, .node = nodes}));
  EXPECT_FALSE(render::with_structural_edit(d, {.kind = EditKind::remove, .node = -1}));
  EXPECT_FALSE(render::with_structural_edit(d, {.kind = EditKind::add_light, .type = "lamp"}));
  EXPECT_FALSE(render::with_structural_edit(d, {.kind = EditKind::add_shape, .type = "teapot"}));
  EXPECT_FALSE(
      render::with_structural_edit(d, {.kind = EditKind::rename, .node = 0, .name = std::string(100000, 'x')}));
  const auto removed = render::with_structural_edit(d, {.kind = EditKind::remove, .node = 0});
  ASSERT_TRUE(removed);
  EXPECT_FALSE(render::with_structural_edit(*removed, {.kind = EditKind::duplicate, .node = 0}));
}

TEST(StructuralEdits, DamagedStatesAreErrors) {
  auto d = render::with_structural_edit(cornell_by_name(), {.kind = EditKind::add_shape, .type = "box", .name = "box"});
  ASSERT_TRUE(d);
  const auto state = nlohmann::json::parse(render::state_json(*d, 0));
  ASSERT_TRUE(render::document_from_state(state.dump(), "state"));
  const auto fails = [&](const char* member, const nlohmann::json& value) {
    auto damaged = state;
    damaged["structure"][0][member] = value;
    return !render::document_from_state(damaged.dump(), "state");
  };
  EXPECT_TRUE(fails("edit", "explode"));
  EXPECT_TRUE(fails("edit", 3));
  EXPECT_TRUE(fails("type", "teapot"));
  EXPECT_TRUE(fails("translation", {1, 2}));
  EXPECT_TRUE(fails("translation", {1, 2, 1e30}));
  EXPECT_TRUE(fails("rotation", {0, 0, 0, 0}));
  EXPECT_TRUE(fails("scale", "large"));
  auto damaged = state;
  damaged["structure"] = "none";
  EXPECT_FALSE(render::document_from_state(damaged.dump(), "state"));
  damaged["structure"] = {{{"edit", "remove"}, {"node", 1000000}}};
  EXPECT_FALSE(render::document_from_state(damaged.dump(), "state"));
}

}  // namespace
}  // namespace etendue
