// Names in scripts: former names of items and actions still work.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "viewer/script/name_aliases.h"
#include "viewer/viewer.h"

namespace etendue::viewer {
namespace {

TEST(ScriptNames, FormerNamesLeadToPresentOnes) {
  std::set<std::string> present;
  for (const auto& entry : nlohmann::json::parse(widgets_json())) present.insert(entry["name"].get<std::string>());
  for (const char* former :
       {"sheet.convergence", "sheet.health", "sheet.paths", "sheet.techniques", "sheet.sampling", "sheet.surface",
        "layout.drawer", "status.health", "view.health-map", "view.sheet.paths", "compare.go-on", "surface.keep",
        "surface.drop", "surface.ball", "surface.ball-kept", "surface.lobe-kept", "surface.badge.NAME"})
    EXPECT_TRUE(present.contains(current_name(former))) << former << " -> " << current_name(former);
}

TEST(ScriptNames, PresentNamesAreUnchanged) {
  EXPECT_EQ(current_name("compare.start"), "compare.start");
  EXPECT_EQ(current_name("palette.compare.start"), "palette.compare.start");
}

}  // namespace
}  // namespace etendue::viewer
