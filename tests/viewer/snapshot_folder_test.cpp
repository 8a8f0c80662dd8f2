// Where snapshots are saved: in a folder of the user, never beside the opened file.
#include <cstdlib>

#include "base/user_folders.h"
#include "home_folder.h"
#include "viewer/state/settings.h"

namespace etendue::snapshot_folder_test {
namespace {

class SnapshotFolder : public HomeFolder {
 protected:
  void write_user_dirs(const std::string& line) {
    fs::create_directories(folder_ / ".config");
    std::ofstream(folder_ / ".config" / "user-dirs.dirs") << "# comment\nXDG_MUSIC_DIR=\"$HOME/Music\"\n"
                                                          << line << "\n";
  }
};

TEST_F(SnapshotFolder, PicturesOfTheUserAreFound) {
  EXPECT_EQ(pictures_folder(), "") << "a folder that does not exist";
  fs::create_directories(folder_ / "Pictures");
  EXPECT_EQ(pictures_folder(), folder_ / "Pictures");
  fs::create_directories(folder_ / "Bilder");
  write_user_dirs("XDG_PICTURES_DIR=\"$HOME/Bilder\"");
  EXPECT_EQ(pictures_folder(), folder_ / "Bilder");
  write_user_dirs("XDG_PICTURES_DIR=\"" + (folder_ / "Pictures").string() + "\"");
  EXPECT_EQ(pictures_folder(), folder_ / "Pictures");
  write_user_dirs("XDG_PICTURES_DIR=\"relative\"");
  EXPECT_EQ(pictures_folder(), "");
  ::unsetenv("HOME");
  EXPECT_EQ(pictures_folder(), "");
  EXPECT_EQ(viewer::default_snapshot_folder(), "");
}

TEST_F(SnapshotFolder, WithoutPicturesItIsTheStateFolder) {
  EXPECT_EQ(viewer::default_snapshot_folder(), folder_ / ".local/state/etendue/snapshots");
  ::setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
  EXPECT_EQ(viewer::default_snapshot_folder(), folder_ / "state/etendue/snapshots");
}

TEST_F(SnapshotFolder, F12SavesInThePicturesOfTheUser) {
  fs::create_directories(folder_ / "Pictures");
  fs::create_directories(folder_ / "assets");
  const std::string asset = path("assets/box.etendue");
  // The folder of the opened file is the one that the file dialog shows, but not that of snapshots.
  const json saved = json::array(
      {key("ctrl+shift+s"), set("files.name", asset), click("files.accept"), {{"do", "wait"}, {"seconds", 0.5}}});
  ASSERT_EQ(run(joined(joined(small(), saved), json::array({key("f12"), {{"do", "wait"}, {"seconds", 2}}}))), 0);
  size_t snapshots = 0, others = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "Pictures" / "etendue"))
    snapshots += entry.path().extension() == ".exr";
  for (const auto& entry : fs::directory_iterator(folder_ / "assets")) others += entry.path() != asset;
  EXPECT_EQ(snapshots, 1U);
  EXPECT_EQ(others, 0U);
}

}  // namespace
}  // namespace etendue::snapshot_folder_test
