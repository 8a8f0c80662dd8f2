// The environment: turned by a drag over the image, and its strength in EV.
#include <cmath>
#include <numeric>

#include "scripted.h"

namespace etendue::environment_test {
namespace {

json turn(double dx) {
  return {{"do", "drag"}, {"from", {300, 200}}, {"to", {300 + dx, 200}}, {"button", "right"}, {"holding", "shift"}};
}

class EnvironmentDrag : public Viewer {
 protected:
  // "new" is lit by an environment.
  double rotation(const char* name) const { return state(name)["parameters"]["environment.rotation"]; }
};

TEST_F(EnvironmentDrag, TurnsInOneStepOfUndo) {
  ASSERT_EQ(run(joined(small(),
                       json::array({file_step("state", path("a.json")), turn(100), file_step("state", path("b.json")),
                                    turn(-100), file_step("state", path("c.json")), key("ctrl+z"), key("ctrl+z"),
                                    file_step("state", path("d.json"))})),
                "new"),
            0);
  const double a = rotation("a.json"), b = rotation("b.json");
  const double width = state("a.json")["image"][2];
  EXPECT_NEAR(b - a, 2 * M_PI * 100 / width, 1e-3);
  EXPECT_NEAR(rotation("c.json"), a, 1e-5);
  EXPECT_EQ(rotation("d.json"), a);
  EXPECT_EQ(state("b.json")["undo_depth"], state("a.json")["undo_depth"].get<int>() + 1);
  EXPECT_EQ(state("b.json")["parameters"]["camera.yfov"], state("a.json")["parameters"]["camera.yfov"]);
}

// The sun moves with the pointer.
TEST_F(EnvironmentDrag, FollowsThePointer) {
  constexpr int kAngles = 12;
  const auto image = [&](const std::string& name) {
    return json::array({{{"do", "wait"}, {"spp", 4}}, file_step("image", path(name))});
  };
  const auto at_angle = [](int i) { return json::array({set("environment.rotation", 2 * M_PI * i / kAngles)}); };
  const json start = joined(small(), json::array({click("environment.sunset"), set("environment.visible", true),
                                                  set("camera.yfov", 1.6), set("film.width", 192)}));
  // The column of the brightest pixel, if it is much brighter than the others.
  const auto column = [&](const std::string& name) {
    const auto read = saved_image(name);
    const auto& pixels = read.find("")->pixels;
    const auto brightest = std::ranges::max_element(pixels);
    const double mean = std::accumulate(pixels.begin(), pixels.end(), 0.0) / static_cast<double>(pixels.size());
    const bool is_sun = static_cast<double>(*brightest) > 5 * mean;
    return is_sun ? static_cast<int>((brightest - pixels.begin()) / 3) % read.width : -1;
  };
  json steps = start;
  for (int i = 0; i < kAngles; ++i) steps = joined(joined(steps, at_angle(i)), image("r" + std::to_string(i) + ".exr"));
  ASSERT_EQ(run(steps, "new"), 0);
  int angle = -1;
  for (int i = 0; i < kAngles; ++i)
    if (const int x = column("r" + std::to_string(i) + ".exr"); x > 40 && x < 130) angle = i;
  ASSERT_GE(angle, 0) << "the sun is never in view";
  ASSERT_EQ(run(joined(joined(joined(start, at_angle(angle)), json::array({turn(30)})), image("turned.exr")), "new"),
            0);
  EXPECT_GT(column("turned.exr"), column("r" + std::to_string(angle) + ".exr") + 5);
}

TEST_F(EnvironmentDrag, ChangesNothingWithoutAnEnvironment) {
  ASSERT_EQ(run(joined(small(), json::array({file_step("state", path("a.json")), turn(100),
                                             file_step("state", path("b.json"))})),
                "cornell"),
            0);
  EXPECT_EQ(state("a.json")["parameters"], state("b.json")["parameters"]);
  EXPECT_EQ(state("a.json")["undo_depth"], state("b.json")["undo_depth"]);
}

TEST_F(EnvironmentDrag, StrengthScalesTheLuminance) {
  ASSERT_EQ(run(joined(small(), json::array({set("environment.tint.r", 1), set("environment.tint.g", 0.5),
                                             set("environment.tint.b", 0.25), set("environment.strength", 2),
                                             file_step("state", path("s.json"))})),
                "new"),
            0);
  const json p = state("s.json")["parameters"];
  EXPECT_NEAR(p["environment.tint.r"].get<double>(), 4, 1e-5);
  EXPECT_NEAR(p["environment.tint.g"].get<double>(), 2, 1e-5);
  EXPECT_NEAR(p["environment.tint.b"].get<double>(), 1, 1e-5);
}

// The parameters of lights, not those of the integrator "light".
TEST_F(Viewer, ParametersOfLightsAreFoundInTheLightPanel) {
  ASSERT_EQ(run(joined(small(), json::array({click("view.tab.scene"), click("add.light.spot"), set("light.0.range", 5),
                                             file_step("state", path("s.json")), set("render.integrator", "light"),
                                             click("view.tab.scene"), set("light.max-depth", 3),
                                             file_step("state", path("t.json"))})),
                "new", 1280, 720),
            0);
  EXPECT_EQ(state("s.json")["tab"], "tab.light");
  EXPECT_EQ(state("s.json")["parameters"]["light.0.range"], 5);
  EXPECT_EQ(state("t.json")["tab"], "tab.render");
}

}  // namespace
}  // namespace etendue::environment_test
