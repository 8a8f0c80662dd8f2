// Focal length and f-number in the Camera panel.
#include <cmath>

#include "scripted.h"

namespace etendue::lens_test {
namespace {

TEST_F(Viewer, FocalLengthAndFNumberEditTheCamera) {
  ASSERT_EQ(run(json::array({click("view.tab.camera"),
                             {{"do", "wait"}, {"spp", 1}},
                             set("lens.focal-length", 50),
                             set("lens.f-number", 2),
                             file_step("state", path("fifty.json")),
                             set("lens.focal-length", 100),
                             file_step("state", path("hundred.json")),
                             set("lens.sensor-height", 12),
                             file_step("state", path("sensor.json")),
                             set("lens.focal-length", 6),
                             file_step("state", path("wide.json")),
                             key("ctrl+z"),
                             file_step("state", path("undone.json"))}),
                "", 900, 900),
            0);
  const auto camera = [&](const char* report, const char* name) {
    return state(report)["parameters"][std::string("camera.") + name].get<double>();
  };
  EXPECT_NEAR(camera("fifty.json", "yfov"), 2 * std::atan(12.0 / 50), 1e-6);
  EXPECT_NEAR(camera("fifty.json", "lens-radius"), 0.0125, 1e-7);
  // The f-number stays.
  EXPECT_NEAR(camera("hundred.json", "yfov"), 2 * std::atan(12.0 / 100), 1e-6);
  EXPECT_NEAR(camera("hundred.json", "lens-radius"), 0.025, 1e-7);
  EXPECT_EQ(state("sensor.json")["parameters"], state("hundred.json")["parameters"]);
  EXPECT_NEAR(camera("wide.json", "yfov"), M_PI / 2, 1e-6);
  EXPECT_EQ(state("undone.json")["parameters"], state("hundred.json")["parameters"]);
}

}  // namespace
}  // namespace etendue::lens_test
