// Edits of materials and textures in the Material panel, and the library of material files.
#include <cstdlib>

#include "render/material_settings.h"
#include "scripted.h"

namespace etendue::material_edits_test {
namespace {

json wait(int samples) { return {{"do", "wait"}, {"spp", samples}}; }

class MaterialEditing : public Viewer {
 protected:
  void SetUp() override {
    Viewer::SetUp();
    setenv("XDG_DATA_HOME", folder_.c_str(), 1);
    std::vector<uint8_t> rgb;
    for (int i = 0; i < 3 * 64; ++i) rgb.push_back(static_cast<uint8_t>(i));
    ASSERT_TRUE(image::write_png(path("picture.png"), 8, 8, rgb));
    std::ofstream(path("text.png")) << "no picture";
  }
  void TearDown() override {
    unsetenv("XDG_DATA_HOME");
    Viewer::TearDown();
  }

  // Selects the material of the short box.
  static json with_material(const json& steps) {
    return Viewer::joined(Viewer::joined(small(), json::array({click("view.tab.material"), click("material.choose"),
                                                               click("material.choose.0")})),
                          steps);
  }
  json loads_texture(const char* slot, const char* file) const {
    return json::array({click("material.texture.add"), click(std::string("material.texture.add.") + slot),
                        set("files.name", path(file)), click("files.accept")});
  }
  json state_after(const char* name) const { return file_step("state", path(name)); }

  void expect_same_after_reopening(const json& steps) {
    const auto saves = [&](const std::string& name) {
      return json::array({wait(4), file_step("image", path(name + ".exr")), file_step("state", path(name + ".json"))});
    };
    ASSERT_EQ(run(joined(with_material(steps), saves("live")), "", 1280, 720), 0);
    ASSERT_EQ(run(saves("snapshot"), path("live.exr")), 0);
    EXPECT_EQ(state("live.json")["parameters"], state("snapshot.json")["parameters"]);
    const auto a = saved_image("live.exr"), b = saved_image("snapshot.exr");
    ASSERT_TRUE(a.find("") && b.find(""));
    EXPECT_EQ(a.find("")->pixels, b.find("")->pixels);
  }
};

TEST_F(MaterialEditing, NewCopiedAndAssignedMaterialsAreRestored) {
  expect_same_after_reopening(json::array({click("material.copy"), click("material.add"), click("material.paste"),
                                           set("material.name", "painted"), click("material.duplicate"),
                                           click("view.tab.scene"), click("scene.node.2"), click("view.tab.material"),
                                           click("material.add"), click("material.assign")}));
}

TEST_F(MaterialEditing, PresetsOfAllModelsAreRestored) {
  expect_same_after_reopening(json::array({click("material.presets"), click("material.presets.3")}));
}

TEST_F(MaterialEditing, TexturesAreRestored) {
  json steps = loads_texture("base-color", "picture.png");
  steps.push_back(set("material.0.texture.base-color.scale.x", 3));
  steps.push_back(set("material.0.texture.base-color.rotation", 0.5));
  steps.push_back(set("textures.channel", "g"));
  expect_same_after_reopening(steps);
}

TEST_F(MaterialEditing, EveryEditIsOneStepOfUndo) {
  json steps = json::array({state_after("before.json"), click("material.add"), state_after("added.json"), key("ctrl+z"),
                            state_after("undone.json"), key("ctrl+shift+z"), state_after("redone.json"), key("ctrl+z"),
                            click("material.choose"), click("material.choose.0")});
  steps = joined(steps, loads_texture("base-color", "picture.png"));
  steps = joined(steps, json::array({state_after("textured.json"), click("material.texture.base-color.remove"),
                                     state_after("removed.json"), key("ctrl+z"), state_after("again.json"),
                                     key("ctrl+z"), state_after("end.json")}));
  ASSERT_EQ(run(with_material(steps), "", 1280, 720), 0);
  const auto parameters = [&](const char* name) { return state(name)["parameters"]; };
  EXPECT_EQ(state("added.json")["undo_depth"].get<int>(), state("before.json")["undo_depth"].get<int>() + 1);
  EXPECT_NE(parameters("before.json"), parameters("added.json"));
  EXPECT_EQ(parameters("before.json"), parameters("undone.json"));
  EXPECT_EQ(parameters("added.json"), parameters("redone.json"));
  EXPECT_NE(parameters("textured.json"), parameters("removed.json"));
  EXPECT_EQ(parameters("textured.json"), parameters("again.json"));
  EXPECT_EQ(parameters("before.json"), parameters("end.json"));
}

TEST_F(MaterialEditing, FilesThatAreNotPicturesChangeNothing) {
  json steps = json::array({state_after("before.json")});
  steps = joined(steps, loads_texture("normal", "text.png"));
  steps.push_back(state_after("after.json"));
  ASSERT_EQ(run(with_material(steps), "", 1280, 720), 0);
  EXPECT_EQ(state("before.json")["parameters"], state("after.json")["parameters"]);
  EXPECT_EQ(state("before.json")["undo_depth"], state("after.json")["undo_depth"]);
}

TEST_F(MaterialEditing, MaterialInUseIsNotDeleted) {
  ASSERT_EQ(
      run(with_material(json::array({state_after("before.json"), click("material.delete"), state_after("used.json"),
                                     click("material.add"), click("material.delete"), state_after("unused.json")})),
          "", 1280, 720),
      0);
  EXPECT_EQ(state("before.json")["undo_depth"], state("used.json")["undo_depth"]);
  EXPECT_EQ(state("unused.json")["selection"]["material"], -1);
}

TEST_F(MaterialEditing, LibraryKeepsMaterials) {
  ASSERT_EQ(run(with_material(json::array({set("material.0.roughness", 0.25), set("material.name", "kept"),
                                           click("material.save"), set("material.0.roughness", 0.5),
                                           click("material.library.0"), state_after("loaded.json")})),
                "", 1280, 720),
            0);
  const auto file = render::read_material_file((folder_ / "etendue/materials/kept.material").string());
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->name, "kept");
  EXPECT_EQ(state("loaded.json")["parameters"]["material.0.roughness"], 0.25);
}

// The context menu of a material file adds a material, with its texture, and selects it.
TEST_F(MaterialEditing, LibraryAddsAMaterial) {
  json steps = loads_texture("base-color", "picture.png");
  steps = joined(steps, json::array({set("material.name", "kept"),
                                     click("material.save"),
                                     state_after("saved.json"),
                                     {{"do", "click"}, {"item", "material.library.0"}, {"button", "right"}},
                                     click("material.library.0.add"),
                                     state_after("added.json"),
                                     key("ctrl+z"),
                                     state_after("undone.json")}));
  ASSERT_EQ(run(with_material(steps), "", 1280, 720), 0);
  const json saved = state("saved.json"), added = state("added.json");
  EXPECT_EQ(added["undo_depth"].get<int>(), saved["undo_depth"].get<int>() + 1);
  const int material = added["selection"]["material"].get<int>();
  EXPECT_GT(material, 0);
  const json parameters = added["parameters"];
  const std::string section = "material." + std::to_string(material);
  EXPECT_GE(parameters[section + ".texture.base-color"].get<int>(), 0);
  EXPECT_EQ(state("undone.json")["parameters"], saved["parameters"]);
}

// A full disk: the library has no material file, and the user is told.
TEST_F(MaterialEditing, AFullDiskForTheLibraryIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  const fs::path library = folder_ / "etendue" / "materials";
  fs::create_directories(library);
  fs::create_symlink("/dev/full", library / "kept-base-color.png");
  json steps = loads_texture("base-color", "picture.png");
  steps = joined(steps, json::array({set("material.name", "kept"), click("material.save"), state_after("s.json")}));
  ASSERT_EQ(run(with_material(steps), "", 1280, 720), 0);
  const json errors = state("s.json")["errors"];
  ASSERT_EQ(errors.size(), 1U) << errors;
  EXPECT_NE(errors[0].get<std::string>().find("kept-base-color.png"), std::string::npos) << errors;
  EXPECT_FALSE(fs::exists(library / "kept.material"));
}

}  // namespace
}  // namespace etendue::material_edits_test
