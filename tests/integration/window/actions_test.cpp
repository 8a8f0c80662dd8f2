// Every action of the program in a real window: by its entry in a menu, and by the palette if it has no entry.
#include <algorithm>
#include <fstream>

#include "actions.h"
#include "file_drag.h"

namespace etendue::actions_test {
namespace {

class ActionsOfMenu : public Actions, public ::testing::WithParamInterface<const char*> {
 protected:
  void run_by_menu(const json& action) {
    const std::string name = action["name"], submenu = lower_case(action["submenu"].get<std::string>());
    user_->click("menu." + lower_case(action["menu"].get<std::string>()));
    if (!submenu.empty()) user_->click("submenu." + submenu);
    user_->click("entry." + name);
  }
};

TEST_P(ActionsOfMenu, EveryEntry) {
  int chosen = 0;
  for (const json& action : all()) {
    const std::string name = action["name"];
    if (action["menu"] != GetParam() || left_out().contains(name)) continue;
    prepare(name);
    if (HasFatalFailure()) return;
    if (!becomes_enabled(name)) {
      ADD_FAILURE() << name << " is disabled";
      continue;
    }
    run_by_menu(action);
    ++chosen;
    ASSERT_TRUE(user_->is_running()) << "after " << name;
    close_popups();
  }
  EXPECT_GT(chosen, 0);
}

INSTANTIATE_TEST_SUITE_P(Menus, ActionsOfMenu,
                         ::testing::Values("File", "Edit", "View", "Compare", "Integrator", "Render", "Help"),
                         [](const auto& name) { return std::string(name.param); });

// Each menu of an action is one of those above.
TEST(ActionsOfMenus, AllMenusAreTested) {
  const std::set<std::string> tested{"", "File", "Edit", "View", "Compare", "Integrator", "Render", "Help"};
  for (const json& action : Actions::all())
    EXPECT_TRUE(tested.contains(action["menu"].get<std::string>())) << action["name"] << ": " << action["menu"];
}

TEST_F(Actions, WithoutMenuByPalette) {
  int chosen = 0;
  for (const json& action : all()) {
    const std::string name = action["name"];
    if (action["menu"] != "" || left_out().contains(name)) continue;
    prepare(name);
    if (HasFatalFailure()) return;
    if (!becomes_enabled(name)) {
      ADD_FAILURE() << name << " is disabled";
      continue;
    }
    run_by_palette(name);
    ++chosen;
    ASSERT_TRUE(user_->is_running()) << "after " << name;
    close_popups();
  }
  EXPECT_GT(chosen, 0);
}

// A glTF file whose objects take seconds to read.
fs::path large_scene(const fs::path& folder) {
  constexpr int kNodes = 600'000;
  const fs::path file = folder / "large.gltf";
  std::ofstream out(file);
  out << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{})";
  for (int i = 1; i < kNodes; ++i) out << R"(,{"translation":[)" << i << R"(,0,0]})";
  out << "]}";
  return file;
}

TEST_F(Actions, OpeningIsCancelled) {
  if (!test::can_drag_files()) GTEST_SKIP() << "libx11-dev is not installed";
  user_->drop({large_scene(folder_)});
  ASSERT_TRUE(becomes_enabled("file.cancel")) << "the file is being read";
  user_->click("file.cancel");
  EXPECT_TRUE(user_->wait_until([](const json& report) { return !is_enabled(report, "file.cancel"); }));
  EXPECT_EQ(user_->report()["scene"], "cornell");
  EXPECT_EQ(user_->report()["errors"], json::array());
}

}  // namespace
}  // namespace etendue::actions_test
