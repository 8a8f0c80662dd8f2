// The window campaign and the random user rely on the asserts of Dear ImGui. They are active in Debian's library, although
// this project is compiled without asserts.
#include <gtest/gtest.h>
#include <imgui.h>

namespace etendue::imgui_asserts_test {
namespace {

TEST(ImguiAssertsDeathTest, AViolationAborts) {
  EXPECT_EXIT(
      {
        ImGui::SetCurrentContext(nullptr);
        ImGui::NewFrame();
      },
      ::testing::KilledBySignal(SIGABRT), "imgui.cpp.*Assertion");
}

}  // namespace
}  // namespace etendue::imgui_asserts_test
