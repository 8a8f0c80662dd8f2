// Sessions: saving and opening, questions about unsaved edits, and recovery after the viewer was killed.
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "scripted.h"

namespace etendue::session_test {
namespace {

class Session : public Viewer {
 protected:
  std::string settings() const { return path("settings"); }

  viewer::ViewOptions options_for(const json& steps, const std::string& script) const {
    std::ofstream(path(script)) << steps.dump();
    viewer::ViewOptions options;
    options.offscreen = true;
    options.script = path(script);
    options.settings = settings();
    options.width = 640;
    options.height = 480;
    return options;
  }

  int run_with_settings(const json& steps) { return viewer::run_viewer(options_for(steps, "kept.json")); }

  std::vector<fs::path> journals() const {
    std::vector<fs::path> files;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(settings() + "/recovery", code))
      if (entry.path().extension() == ".etendue") files.push_back(entry.path());
    return files;
  }

  // Runs the viewer in a process of its own, and kills it when its journal contains a text.
  void kill_after_edit(const json& steps, const std::string& text) {
    const auto options = options_for(steps, "killed.json");
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      execl(ETENDUE_BINARY, ETENDUE_BINARY, "view", "--offscreen", "--script", options.script.c_str(), "--settings",
            options.settings.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    bool is_written = false;
    for (int i = 0; i < 600 && !is_written; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      for (const auto& file : journals()) {
        std::ifstream in(file);
        is_written = std::string(std::istreambuf_iterator<char>(in), {}).find(text) != std::string::npos;
      }
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_TRUE(is_written) << "the journal does not contain " << text;
  }
};

json wait_seconds(double seconds) { return {{"do", "wait"}, {"seconds", seconds}}; }

TEST_F(Session, ASavedSessionRestoresAllParameters) {
  const std::string file = path("box.etendue");
  ASSERT_EQ(run(json::array({set("material.0.model", "mirror"), set("material.0.mirror.reflectance", 0.5),
                             set("render.integrator", "bdpt"), set("camera.exposure", 1), click("session.save"),
                             set("files.name", file), click("files.accept"), wait_seconds(0.5),
                             file_step("state", path("a.json"))})),
            0);
  ASSERT_TRUE(fs::exists(file));
  ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}}, file_step("state", path("b.json"))}), file), 0);
  EXPECT_EQ(state("a.json")["parameters"], state("b.json")["parameters"]);
  EXPECT_EQ(state("a.json")["edited"], false);
  EXPECT_EQ(state("b.json")["session"], file);
}

TEST_F(Session, OnlyEditsOfTheSceneAreUnsavedEdits) {
  ASSERT_EQ(run(json::array({set("render.integrator", "bdpt"), set("camera.exposure", 1),
                             file_step("state", path("method.json")), set("material.0.roughness", 0.25),
                             file_step("state", path("scene.json")), key("ctrl+z"),
                             file_step("state", path("undone.json"))})),
            0);
  EXPECT_EQ(state("method.json")["edited"], false);
  EXPECT_EQ(state("scene.json")["edited"], true);
  EXPECT_EQ(state("undone.json")["edited"], false);
}

TEST_F(Session, OpeningAnotherSceneAsksAboutUnsavedEdits) {
  ASSERT_EQ(run(json::array({set("material.0.roughness", 0.25), click("file.glossy-plates"), wait_seconds(1),
                             click("unsaved.cancel"), file_step("state", path("cancelled.json")),
                             click("file.glossy-plates"), wait_seconds(1), click("unsaved.discard"), wait_seconds(1),
                             file_step("state", path("discarded.json"))})),
            0);
  EXPECT_EQ(state("cancelled.json")["scene"], "cornell");
  EXPECT_EQ(state("cancelled.json")["parameters"]["material.0.roughness"], 0.25);
  EXPECT_EQ(state("discarded.json")["scene"], "glossy-plates");
}

TEST_F(Session, SavingFromTheQuestionContinuesWithWhatWasAsked) {
  const std::string file = path("edited.etendue");
  ASSERT_EQ(run(json::array({set("material.0.roughness", 0.25), click("app.quit"), wait_seconds(0.3),
                             click("unsaved.save"), set("files.name", file), click("files.accept"), wait_seconds(20)})),
            0);
  ASSERT_TRUE(fs::exists(file));
  ASSERT_EQ(run(json::array({file_step("state", path("a.json"))}), file), 0);
  EXPECT_EQ(state("a.json")["parameters"]["material.0.roughness"], 0.25);
}

TEST_F(Session, KilledViewerOffersItsEditsAtTheNextStart) {
  kill_after_edit(
      json::array({set("material.0.model", "mirror"), set("material.0.mirror.reflectance", 0.375), wait_seconds(100)}),
      "0.375");
  ASSERT_EQ(journals().size(), 1u);
  ASSERT_EQ(run_with_settings(json::array({click("recovery.later")})), 0);
  ASSERT_EQ(journals().size(), 1u) << "the edits are offered again";
  ASSERT_EQ(run_with_settings(
                json::array({click("recovery.recover"), wait_seconds(1), file_step("state", path("recovered.json"))})),
            0);
  EXPECT_EQ(state("recovered.json")["parameters"]["material.0.mirror.reflectance"], 0.375);
  EXPECT_EQ(state("recovered.json")["edited"], true);
  EXPECT_TRUE(journals().empty());
}

TEST_F(Session, JournalThatCannotBeReadIsKept) {
  fs::create_directories(settings() + "/recovery");
  std::ofstream(settings() + "/recovery/1.etendue")
      << R"({"program": "etendue", "version": 2, "scene": "no-such-file.glb", "settings": {}})";
  run_with_settings(json::array({click("recovery.recover"), wait_seconds(0.5)}));
  EXPECT_EQ(journals().size(), 1u);
}

TEST_F(Session, RecentFilesAreWrittenWhenAFileIsOpened) {
  kill_after_edit(json::array({click("file.glossy-plates"), wait_seconds(1), set("material.0.roughness", 0.3125),
                               wait_seconds(100)}),
                  "0.3125");
  std::ifstream in(settings() + "/viewer.json");
  EXPECT_NE(json::parse(in)["recent"].dump().find("glossy-plates"), std::string::npos);
}

}  // namespace
}  // namespace etendue::session_test
