// Windows of 1024 x 600 and 800 x 600 pixels: the list of shortcuts, the tabs of the bottom panel, and the Convergence
// panel.
#include "scripted.h"

namespace etendue::small_window_test {
namespace {

// The corners of an item in a state report.
struct Rectangle {
  double left, top, right, bottom;

  Rectangle(const json& report, const std::string& item) {
    const auto numbers = report.at("items").at(item).get<std::vector<double>>();
    left = numbers[0];
    top = numbers[1];
    right = left + numbers[2];
    bottom = top + numbers[3];
  }
  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

class SmallWindow : public Viewer {
 protected:
  json report_after(const json& steps, int width, int height) {
    EXPECT_EQ(run(joined(steps, json::array({file_step("state", path("state.json"))})), "cornell", width, height), 0);
    return state("state.json");
  }
};

TEST_F(SmallWindow, ShortcutsNeedNoScrolling) {
  const json report = report_after(json::array({key("f1")}), 1024, 600);
  const Rectangle list(report, "help.list"), content(report, "help.content");
  EXPECT_GE(list.left, 0);
  EXPECT_LE(list.right, 1024);
  EXPECT_LE(list.bottom, 600);
  EXPECT_GE(content.left, list.left);
  EXPECT_LE(content.right, list.right);
  EXPECT_GE(content.top, list.top);
  EXPECT_LE(content.bottom, list.bottom);
  EXPECT_GT(content.height(), 300) << "the list is not empty";
}

TEST_F(SmallWindow, ShortcutsScrollOnlyVertically) {
  const json report = report_after(json::array({key("f1")}), 800, 600);
  const Rectangle list(report, "help.list"), content(report, "help.content"), close(report, "help.close");
  EXPECT_GE(list.left, 0);
  EXPECT_LE(list.right, 800);
  EXPECT_GE(content.left, list.left);
  EXPECT_LE(content.right, list.right);
  const json scrolled =
      report_after(json::array({key("f1"), {{"do", "scroll"}, {"at", {400, 400}}, {"by", -50}}}), 800, 600);
  EXPECT_LE(Rectangle(scrolled, "help.content").bottom, list.bottom) << "the end of the list can be reached";
  EXPECT_EQ(Rectangle(scrolled, "help.close").top, close.top) << "the title does not scroll";
}

TEST_F(SmallWindow, AllShortcutsAreInThePreferences) {
  const json report = report_after(json::array({key("f1"), click("help.all-shortcuts")}), 800, 600);
  EXPECT_FALSE(report["items"].contains("help.close"));
  EXPECT_TRUE(report["items"].contains("preferences.reset-shortcuts"));
}

// The pointer alone reaches every tab.
TEST_F(SmallWindow, HiddenTabsAreInAList) {
  for (const int width : {800, 1024}) {
    const json before = report_after(json::array({{{"do", "wait"}, {"spp", 1}}}), width, 600);
    ASSERT_TRUE(before["items"].contains("layout.more-tabs")) << width;
    EXPECT_TRUE(before["items"].contains("panel.convergence")) << width;
    EXPECT_FALSE(before["items"].contains("panel.messages")) << width;
    const Rectangle button(before, "layout.more-tabs"), column(before, "layout.column");
    EXPECT_LE(button.right, column.right) << width;
    for (const auto& [name, placement] : before["items"].items())
      if (name.starts_with("panel.")) {
        EXPECT_LE(Rectangle(before, name).right, button.left) << name << ", " << width;
      }
    const json open =
        report_after(json::array({click("layout.more-tabs"), click("more-tabs.panel.messages")}), width, 600);
    EXPECT_EQ(open["bottom_panel"], "panel.messages");
    EXPECT_TRUE(open["items"].contains("panel.messages")) << "the tab of the open panel is visible";
    EXPECT_LE(Rectangle(open, "panel.messages").right, Rectangle(open, "layout.more-tabs").left) << width;
  }
}

TEST_F(SmallWindow, EveryTabIsShownOrListed) {
  const json shown = report_after(json::array({click("layout.more-tabs")}), 800, 600)["items"];
  for (const auto& entry : json::parse(viewer::widgets_json())) {
    const auto action = entry["name"].get<std::string>();
    if (!action.starts_with("view.panel.")) continue;
    const std::string panel = action.substr(action.find('.') + 1);
    EXPECT_NE(shown.contains(panel), shown.contains("more-tabs." + panel)) << panel;
  }
}

TEST_F(SmallWindow, WideWindowsHaveNoListOfTabs) {
  const json report = report_after(json::array({{{"do", "wait"}, {"spp", 1}}}), 1280, 720);
  EXPECT_FALSE(report["items"].contains("layout.more-tabs"));
  EXPECT_TRUE(report["items"].contains("panel.messages"));
}

// The names of the methods take at most two lines, and the chart is as wide as the panel.
TEST_F(SmallWindow, MethodsOfTheConvergencePanelHaveNames) {
  const json compared = joined(
      small(), json::array({click("panel.convergence"), set("compare.rule", "samples"), set("compare.samples", 4),
                            set("compare.repeats", 2), click("compare.start"), wait_for("contest")}));
  const json report = report_after(compared, 800, 600);
  const Rectangle tabs(report, "layout.bottom-panel");
  ASSERT_TRUE(report["items"].contains("compare.method.0"));
  const Rectangle name(report, "compare.method.0"), remove(report, "compare.remove.0");
  constexpr double kLine = 13, kCharacter = 6;  // of the small font
  EXPECT_LE(name.height(), 2 * kLine + 2);
  EXPECT_GE(name.width(), 12 * kCharacter);
  EXPECT_LE(remove.right, tabs.right);
  const json chart = report_after(joined(compared, json::array({click("compare.chart")})), 800, 600);
  EXPECT_GT(Rectangle(chart, "compare.chart").width(), 0.9 * tabs.width());
}

}  // namespace
}  // namespace etendue::small_window_test
