// A full disk: files that link to /dev/full. Nothing is lost, and the user is told.
#include <unistd.h>

#include <ctime>

#include "scripted.h"

namespace etendue::full_disk_test {
namespace {

class FullDisk : public Viewer {
 protected:
  void SetUp() override {
    Viewer::SetUp();
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  }

  void link_to_full_disk(const fs::path& file) { fs::create_symlink("/dev/full", file); }

  // The linked file stays as it is, and no temporary file is left.
  void expect_untouched(const std::string& file) {
    EXPECT_TRUE(fs::is_symlink(path(file)));
    size_t others = 0;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      others += name != file && name != "script.json" && name != "s.json";
    }
    EXPECT_EQ(others, 0U);
  }

  // Saves under the name of a full disk, with the dialog that the shortcut opens.
  void expect_error_of_dialog(const std::string& shortcut, const std::string& file) {
    link_to_full_disk(path(file));
    // The second click replaces the existing file.
    ASSERT_EQ(run(json::array({{{"do", "wait"}, {"spp", 1}},
                               key(shortcut),
                               set("files.name", path(file)),
                               click("files.accept"),
                               click("files.accept"),
                               {{"do", "wait"}, {"seconds", 2}},
                               file_step("state", path("s.json"))}),
                  "cornell"),
              0);
    const json errors = state("s.json")["errors"];
    ASSERT_EQ(errors.size(), 1U) << errors;
    EXPECT_NE(errors[0].get<std::string>().find(file), std::string::npos) << errors;
    expect_untouched(file);
  }

  // Saves the image; the script ends with the error.
  void expect_error_of_image(const std::string& file) {
    link_to_full_disk(path(file));
    testing::internal::CaptureStderr();
    EXPECT_NE(run(joined(small(), json::array({file_step("image", path(file))})), "cornell"), 0);
    const std::string errors = testing::internal::GetCapturedStderr();
    EXPECT_NE(errors.find(path(file) + ":"), std::string::npos) << errors;
    expect_untouched(file);
  }
};

TEST_F(FullDisk, SavingASessionIsAnError) { expect_error_of_dialog("ctrl+shift+s", "a.etendue"); }
TEST_F(FullDisk, ExportingASceneIsAnError) { expect_error_of_dialog("ctrl+shift+e", "a.glb"); }
TEST_F(FullDisk, SavingASnapshotIsAnError) { expect_error_of_image("a.exr"); }
TEST_F(FullDisk, ExportingAnImageIsAnError) { expect_error_of_image("a.png"); }

// Edits go on, and a message says that they cannot be recovered.
TEST_F(FullDisk, TheJournalSaysThatItCannotBeWritten) {
  const fs::path recovery = folder_ / "settings" / "recovery";
  fs::create_directories(recovery);
  // The name of a journal is made from time and process.
  const std::time_t now = std::time(nullptr);
  for (std::time_t t = now; t < now + 30; ++t)
    link_to_full_disk(recovery / (std::to_string(t) + "-" + std::to_string(::getpid()) + ".etendue"));
  const json steps = json::array({{{"do", "wait"}, {"spp", 1}},
                                  set("material.0.roughness", 0.25),
                                  {{"do", "wait"}, {"seconds", 1.5}},
                                  file_step("state", path("s.json"))});
  std::ofstream(path("kept.json")) << steps.dump();
  viewer::ViewOptions options;
  options.scene = "cornell";
  options.offscreen = true;
  options.script = path("kept.json");
  options.settings = path("settings");
  ASSERT_EQ(viewer::run_viewer(options), 0);
  const json s = state("s.json");
  EXPECT_EQ(s["parameters"]["material.0.roughness"], 0.25);
  EXPECT_EQ(s["edited"], true);
  const std::string messages = s["log"].dump();
  EXPECT_NE(messages.find("cannot be recovered after a crash"), std::string::npos) << messages;
}

}  // namespace
}  // namespace etendue::full_disk_test
