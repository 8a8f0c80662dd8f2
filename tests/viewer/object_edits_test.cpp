// Edits that add, duplicate, delete, rename and hide objects.
#include <cstdlib>

#include "render/session_file.h"
#include "scene/gltf/load_gltf.h"
#include "scripted.h"

namespace etendue::object_edits_test {
namespace {

json wait(int samples) { return {{"do", "wait"}, {"spp", samples}}; }

bool same_image(const image::LayeredImage& a, const image::LayeredImage& b) {
  const auto *x = a.find(""), *y = b.find("");
  return x && y && a.width == b.width && a.height == b.height && x->pixels == y->pixels;
}

class ObjectEdits : public Viewer {
 protected:
  // Performs the steps on the Cornell box, saves a snapshot, and opens it again.
  void expect_same_after_reopening(const json& steps) {
    const auto saves = [&](const std::string& name) {
      return json::array({wait(4), file_step("image", path(name + ".exr")), file_step("state", path(name + ".json"))});
    };
    ASSERT_EQ(run(joined(joined(small(), steps), saves("live"))), 0);
    ASSERT_EQ(run(saves("snapshot"), path("live.exr")), 0);
    EXPECT_TRUE(same_image(saved_image("live.exr"), saved_image("snapshot.exr")));
    EXPECT_EQ(state("live.json")["parameters"], state("snapshot.json")["parameters"]);
  }
};

// The rows that are drawn after the copy was made belong to the scene before it.
TEST_F(ObjectEdits, ContextMenuOfTheTreeDuplicates) {
  json steps = json::array({click("tab.scene")});
  const json wait{{"do", "wait"}, {"seconds", 0.3}};
  for (const char* item : {"scene.node.1", "scene.node.0"})
    steps = joined(
        steps,
        json::array(
            {{{"do", "click"}, {"item", item}, {"button", "right"}}, wait, click("entry.object.duplicate"), wait}));
  steps.push_back(file_step("state", path("copies.json")));
  ASSERT_EQ(run(steps, "many-lights"), 0);
  const json report = state("copies.json");
  const int copy = report["selection"]["node"];
  EXPECT_TRUE(report["items"].contains("scene.node." + std::to_string(copy))) << copy;
  EXPECT_FALSE(report["items"].contains("scene.node." + std::to_string(copy + 1)));
}

TEST_F(ObjectEdits, AddedObjectsAreRestored) {
  expect_same_after_reopening(json::array({click("add.sphere"), click("add.light.point"), click("add.light.spot"),
                                           click("add.camera"), click("add.disk"), click("object.duplicate")}));
}

TEST_F(ObjectEdits, EditsOfAddedObjectsAreRestored) {
  expect_same_after_reopening(
      json::array({click("add.box"), click("add.sphere"), click("object.delete"), click("add.light.point"),
                   click("object.hide"), click("object.hide"), click("object.duplicate"), click("light.solo")}));
}

TEST_F(ObjectEdits, UndoAndRedoOfEachEdit) {
  const auto depth = [&](const char* name) { return state(name)["undo_depth"].get<int>(); };
  const std::vector<json> edits{click("add.sphere"),        click("object.duplicate"), click("object.hide"),
                                click("object.delete"),     click("add.light.point"),  click("light.solo"),
                                set("object.name", "lamp"), click("add.camera"),       click("add.light.directional")};
  json steps = small();
  for (size_t i = 0; i < edits.size(); ++i) {
    const std::string n = std::to_string(i);
    steps.push_back(edits[i]);
    steps.push_back(file_step("state", path("done" + n + ".json")));
  }
  for (size_t i = edits.size(); i-- > 0;) {
    steps.push_back(file_step("state", path("undo" + std::to_string(i) + ".json")));
    steps.push_back(key("ctrl+z"));
  }
  for (size_t i = 0; i < edits.size(); ++i) {
    steps.push_back(key("ctrl+shift+z"));
    steps.push_back(file_step("state", path("redo" + std::to_string(i) + ".json")));
  }
  ASSERT_EQ(run(steps), 0);
  for (size_t i = 0; i < edits.size(); ++i) {
    const std::string n = std::to_string(i) + ".json";
    EXPECT_EQ(state("done" + n)["parameters"], state("undo" + n)["parameters"]) << i;
    EXPECT_EQ(state("done" + n)["parameters"], state("redo" + n)["parameters"]) << i;
    EXPECT_EQ(depth(("done" + n).c_str()), depth(("redo" + n).c_str()));
  }
}

TEST_F(ObjectEdits, DeletedCameraKeepsTheView) {
  ASSERT_EQ(run(json::array({wait(1), click("add.camera"), file_step("state", path("a.json")), click("object.delete"),
                             file_step("state", path("b.json"))})),
            0);
  EXPECT_EQ(state("a.json")["parameters"]["camera.eye.x"], state("b.json")["parameters"]["camera.eye.x"]);
  EXPECT_EQ(state("b.json")["selection"]["node"], -1);
}

TEST_F(ObjectEdits, SaveWritesTheObjectsOfASession) {
  auto d = render::with_structural_edit(*render::new_document("cornell"),
                                        {.kind = scene::EditKind::add_shape, .type = "box", .name = "added box"});
  ASSERT_TRUE(d);
  d = render::with_structural_edit(*d, {.kind = scene::EditKind::remove, .node = 0});
  ASSERT_TRUE(d);
  ASSERT_TRUE(render::write_session_file(path("edited.etendue"), *d));
  const std::string command =
      std::string(ETENDUE_BINARY) + " save " + path("edited.etendue") + " -o " + path("edited.glb");
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto saved = scene::load_gltf(path("edited.glb"));
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_EQ(saved->nodes.size(), d->scene->nodes.size() - 1);
  EXPECT_EQ(saved->nodes.back().name, "added box");
}

}  // namespace
}  // namespace etendue::object_edits_test
