// A fixture with the viewer in a window of 1280 x 720 pixels that shows the Cornell box. Skipped without Xvfb or xdotool.
#pragma once
#include <gtest/gtest.h>

#include <memory>

#include "window_user.h"

namespace etendue {

using json = nlohmann::json;
namespace fs = std::filesystem;

class Window : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::WindowUser::is_possible()) GTEST_SKIP() << "Xvfb or xdotool is not installed";
    folder_ = fs::temp_directory_path() /
              (std::string("etendue-window-") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    user_ = std::make_unique<test::WindowUser>(ETENDUE_BINARY, folder_, scene_);
    user_->resize(1280, 720);
  }
  void TearDown() override {
    const bool has_crashed = user_ && !has_ended_ && !user_->is_running();
    EXPECT_FALSE(has_crashed);
    user_.reset();
    if (!HasFailure()) fs::remove_all(folder_);
  }

  // Selects the short box of the Cornell box, whose material appears in the Material panel.
  std::string select_box() {
    constexpr int kX = 500, kY = 550;  // in a window of 1280 x 720
    user_->click_at(kX, kY);
    EXPECT_TRUE(user_->wait_until([](const json& report) { return report["selection"]["material"] >= 0; }));
    return "material." + std::to_string(user_->report()["selection"]["material"].get<int>());
  }

  json parameter(const std::string& name) { return user_->report()["parameters"][name]; }
  bool becomes(const std::string& name, const json& value) {
    return user_->wait_until([&](const json& report) { return report["parameters"][name] == value; });
  }

  bool differs(const std::string& name, const json& value) {
    return user_->wait_until([&](const json& report) { return report["parameters"][name] != value; });
  }

  fs::path folder_;
  std::string scene_ = "cornell";
  std::unique_ptr<test::WindowUser> user_;
  bool has_ended_ = false;  // the test has closed the viewer
};

}  // namespace etendue
