// Several selected objects: edits of all of them in one step, parents and children.
#include "scripted.h"

namespace etendue::multiple_selection_test {
namespace {

json wait(int samples) { return {{"do", "wait"}, {"spp", samples}}; }

json extend(const std::string& item) { return {{"do", "click"}, {"item", item}, {"holding", "ctrl"}}; }

class MultipleSelection : public Viewer {
 protected:
  json state_after(const char* name) const { return file_step("state", path(name)); }
  json parameters(const char* name) const { return state(name)["parameters"]; }

  // Two boxes of the Cornell box, the second one active.
  static json with_two(const json& steps) {
    const json selection = json::array({click("view.tab.scene"), click("scene.node.5"), extend("scene.node.6")});
    return Viewer::joined(Viewer::joined(small(), selection), steps);
  }
  // How many values of parameters of all nodes differ.
  int differences(const json& a, const json& b, const std::string& ending) const {
    int count = 0;
    for (const auto& [name, value] : a.items())
      if (name.starts_with("node.") && name.ends_with(ending) && b.contains(name) && b[name] != value) ++count;
    return count;
  }
};

TEST_F(MultipleSelection, ControlAddsAndRemoves) {
  ASSERT_EQ(run(with_two(json::array({state_after("two.json"), extend("scene.node.5"), state_after("one.json"),
                                      extend("scene.node.6"), state_after("none.json")})),
                "", 1280, 720),
            0);
  EXPECT_EQ(state("two.json")["selection"]["node"], 6);
  EXPECT_EQ(state("two.json")["selection"]["others"], json::array({5}));
  EXPECT_EQ(state("one.json")["selection"]["node"], 6);
  EXPECT_EQ(state("one.json")["selection"]["others"], json::array());
  EXPECT_EQ(state("none.json")["selection"]["node"], -1);
}

TEST_F(MultipleSelection, ClicksInTheImageExtendTheSelection) {
  json steps = joined(small(), json::array({click("view.tab.scene")}));
  // Left and right wall of the image of 900 x 560 pixels; positions are those of the boxes and walls on screen.
  steps.push_back({{"do", "pick"}, {"at", {250, 250}}});
  steps.push_back(state_after("first.json"));
  steps.push_back({{"do", "pick"}, {"at", {400, 250}}, {"holding", "shift"}});
  steps.push_back(state_after("second.json"));
  ASSERT_EQ(run(steps), 0);
  const json first = state("first.json")["selection"], second = state("second.json")["selection"];
  EXPECT_EQ(first["others"], json::array());
  ASSERT_NE(first["node"], second["node"]);
  EXPECT_EQ(second["others"], json::array({first["node"]}));
}

TEST_F(MultipleSelection, EditsOfAllAreOneStep) {
  ASSERT_EQ(run(with_two(json::array({state_after("start.json"),
                                      click("object.hide"),
                                      state_after("hidden.json"),
                                      key("ctrl+z"),
                                      state_after("shown.json"),
                                      key("g"),
                                      {{"do", "drag"}, {"item", "gizmo.x"}, {"by", {30, 0}}},
                                      state_after("moved.json"),
                                      key("ctrl+z"),
                                      key("g"),
                                      click("object.duplicate"),
                                      state_after("copies.json"),
                                      key("ctrl+z"),
                                      state_after("end.json")})),
                "", 1280, 720),
            0);
  const int depth = state("start.json")["undo_depth"].get<int>();
  for (const char* name : {"hidden.json", "moved.json", "copies.json"})
    EXPECT_EQ(state(name)["undo_depth"].get<int>(), depth + 1) << name;
  EXPECT_EQ(differences(parameters("start.json"), parameters("hidden.json"), ".visible"), 2);
  EXPECT_EQ(parameters("start.json"), parameters("shown.json"));
  EXPECT_EQ(differences(parameters("start.json"), parameters("moved.json"), ".translation.x"), 2);
  EXPECT_EQ(state("copies.json")["selection"]["others"].size(), 1U);
  EXPECT_EQ(parameters("start.json"), parameters("end.json"));
}

TEST_F(MultipleSelection, DeletionOfAllIsOneStep) {
  ASSERT_EQ(run(with_two(json::array({state_after("start.json"), click("object.delete"), state_after("deleted.json"),
                                      key("ctrl+z"), state_after("undone.json"), key("ctrl+shift+z"), wait(4),
                                      file_step("image", path("live.exr"))})),
                "", 1280, 720),
            0);
  ASSERT_EQ(run(json::array({wait(4), file_step("image", path("again.exr"))}), path("live.exr")), 0);
  EXPECT_EQ(state("deleted.json")["undo_depth"].get<int>(), state("start.json")["undo_depth"].get<int>() + 1);
  EXPECT_EQ(state("deleted.json")["selection"]["node"], -1);
  EXPECT_EQ(parameters("start.json"), parameters("undone.json"));
  const auto a = saved_image("live.exr"), b = saved_image("again.exr");
  EXPECT_EQ(a.find("")->pixels, b.find("")->pixels);
}

TEST_F(MultipleSelection, ParentsMoveTheirChildren) {
  ASSERT_EQ(run(with_two(json::array({wait(4), file_step("image", path("before.exr")), key("ctrl+p"), wait(4),
                                      file_step("image", path("after.exr")), click("scene.node.6"),
                                      set("node.6.translation.x", 0.1), wait(4), file_step("image", path("live.exr")),
                                      state_after("moved.json"), click("scene.node.5"), click("object.unparent"),
                                      state_after("unparented.json")})),
                "", 1280, 720),
            0);
  // The transforms of the boxes are exact, so the picture is, too.
  EXPECT_EQ(saved_image("before.exr").find("")->pixels, saved_image("after.exr").find("")->pixels);
  ASSERT_EQ(run(json::array({wait(4), file_step("image", path("again.exr"))}), path("live.exr")), 0);
  EXPECT_EQ(saved_image("live.exr").find("")->pixels, saved_image("again.exr").find("")->pixels);
  EXPECT_NE(saved_image("before.exr").find("")->pixels, saved_image("live.exr").find("")->pixels);
  // Without the parent, the child has the movement of the parent itself.
  EXPECT_EQ(differences(parameters("moved.json"), parameters("unparented.json"), ".translation.x"), 1);
  EXPECT_NE(run(with_two(json::array({click("object.unparent")})), "", 1280, 720), 0) << "they have no parent";
}

// A row of the tree that is dropped on another one becomes its child.
TEST_F(MultipleSelection, RowsOfTheTreeAreDroppedOnTheirParent) {
  const json drop = {{"do", "drag"}, {"item", "scene.node.6"}, {"by", {0, -18}}};
  ASSERT_EQ(run(joined(small(), json::array({click("view.tab.scene"), wait(4), file_step("image", path("before.exr")),
                                             state_after("start.json"), drop, state_after("dropped.json"), wait(4),
                                             file_step("image", path("after.exr")), click("scene.node.6"),
                                             key("ctrl+shift+p"), state_after("unparented.json"), key("ctrl+z"),
                                             key("ctrl+z"), state_after("end.json")})),
                "", 1280, 720),
            0);
  const auto depth = [&](const char* name) { return state(name)["undo_depth"].get<int>(); };
  EXPECT_EQ(depth("dropped.json"), depth("start.json") + 1);
  EXPECT_EQ(depth("unparented.json"), depth("start.json") + 2) << "it has a parent";
  EXPECT_EQ(saved_image("before.exr").find("")->pixels, saved_image("after.exr").find("")->pixels);
  EXPECT_EQ(parameters("start.json"), parameters("end.json"));
}

}  // namespace
}  // namespace etendue::multiple_selection_test
