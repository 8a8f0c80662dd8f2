// The light meter and the light presets.
#include <cmath>

#include "scripted.h"

namespace etendue::light_meter_test {
namespace {

json steps_of(std::initializer_list<json> steps) { return json::array_t(steps); }

class LightMeterPanel : public Viewer {};

TEST_F(LightMeterPanel, MeasuresAtTheClickedPoint) {
  const auto steps =
      joined(small(1), steps_of({file_step("state", path("before.json")),
                                 click("meter.pick"),
                                 {{"do", "drag"}, {"from", {280, 330}}, {"to", {280, 330}}, {"button", "left"}},
                                 wait_for("meter"),
                                 file_step("state", path("a.json")),
                                 file_step("screenshot", path("a.png")),
                                 set("meter.efficacy", "maximal"),
                                 click("tab.material"),
                                 set("material.0.base-color.r", 0.1),
                                 click("tab.light"),
                                 wait_for("meter"),
                                 file_step("state", path("b.json"))}));
  ASSERT_EQ(run(steps), 0);
  const auto a = state("a.json")["meter"], b = state("b.json")["meter"];
  ASSERT_TRUE(a["whole"].get<bool>() && b["whole"].get<bool>());
  EXPECT_GT(a["irradiance"]["value"][0].get<double>(), 0);
  // The walls reflect less red, so less arrives. The measurement restarts by itself.
  EXPECT_LT(b["irradiance"]["value"][0].get<double>(), a["irradiance"]["value"][0].get<double>());
  EXPECT_EQ(state("a.json")["undo_depth"], state("before.json")["undo_depth"])
      << "measuring must not edit the document";
}

// A sensor on the floor receives its area times the illuminance there, approximately, because that varies.
TEST_F(LightMeterPanel, SensorReceivesFlux) {
  const auto steps =
      joined(small(1), steps_of({click("meter.pick"),
                                 {{"do", "drag"}, {"from", {280, 330}}, {"to", {280, 330}}, {"button", "left"}},
                                 wait_for("meter"),
                                 file_step("state", path("none.json")),
                                 set("meter.sensor", 0.05),
                                 wait_for("meter"),
                                 file_step("state", path("sensor.json")),
                                 file_step("screenshot", path("sensor.png"))}));
  ASSERT_EQ(run(steps), 0);
  EXPECT_FALSE(state("none.json")["meter"].contains("received_flux"));
  const auto meter = state("sensor.json")["meter"];
  ASSERT_TRUE(meter["whole"].get<bool>());
  const double illuminance = meter["irradiance"]["value"][1].get<double>();
  const double flux = meter["received_flux"]["value"][1].get<double>();
  EXPECT_NEAR(flux / (0.05 * 0.05 * illuminance), 1, 0.25);
}

// A preset is one step of undo.
TEST_F(LightMeterPanel, PresetSetsIntensityAndColour) {
  const auto steps =
      joined(small(1), steps_of({click("tab.light"), click("light.choose.0"), file_step("state", path("before.json")),
                                 set("light.preset", "bulb-60"), file_step("state", path("bulb.json")), key("ctrl+z"),
                                 file_step("state", path("after.json"))}));
  ASSERT_EQ(run(steps, "spot-indirect"), 0);
  const auto bulb = state("bulb.json")["parameters"];
  const auto number = [&](const char* name) { return bulb[std::string("light.0.") + name].get<double>(); };
  // Full intensity within the inner cone; a third of it between the cones, because the falloff is t^2.
  const double inner = std::cos(number("inner-cone")), outer = std::cos(number("outer-cone"));
  const double cones = 1 - inner + (inner - outer) / 3;
  const double y = 0.212671 * number("color.r") + 0.71516 * number("color.g") + 0.072169 * number("color.b");
  EXPECT_NEAR(y * number("intensity") * 2 * 3.14159265 * cones, 710, 0.5);
  EXPECT_EQ(state("bulb.json")["undo_depth"].get<int>(), state("before.json")["undo_depth"].get<int>() + 1);
  EXPECT_EQ(state("after.json")["parameters"]["light.0.intensity"],
            state("before.json")["parameters"]["light.0.intensity"]);
}

// The stored intensity is in candela; the field shows and takes it in the selected unit.
TEST_F(LightMeterPanel, IntensityIsEditedInTheSelectedUnit) {
  const auto steps =
      joined(small(1), steps_of({click("tab.light"), click("light.choose.0"), set("light.0.intensity", 30),
                                 file_step("state", path("candela.json")), set("light.unit", "radiometric"),
                                 set("meter.efficacy", "maximal"), file_step("screenshot", path("watts.png")),
                                 set("light.0.intensity", 2), file_step("state", path("watts.json"))}));
  ASSERT_EQ(run(steps, "spot-indirect"), 0);
  EXPECT_EQ(state("candela.json")["parameters"]["light.0.intensity"], 30);
  EXPECT_NEAR(state("watts.json")["parameters"]["light.0.intensity"].get<double>(), 2 * 683, 1e-3);
}

TEST_F(LightMeterPanel, TemperatureSetsTheColour) {
  const auto steps = joined(
      small(1),
      steps_of({click("tab.light"), click("light.choose.0"), file_step("state", path("before.json")),
                set("light.temperature", 2856), file_step("state", path("warm.json")),
                file_step("screenshot", path("warm.png")), key("ctrl+z"), file_step("state", path("after.json"))}));
  ASSERT_EQ(run(steps, "spot-indirect"), 0);
  const auto warm = state("warm.json")["parameters"], before = state("before.json")["parameters"],
             after = state("after.json")["parameters"];
  // CIE illuminant A.
  EXPECT_NEAR(warm["light.0.color.r"].get<double>(), 1, 1e-6);
  EXPECT_NEAR(warm["light.0.color.g"].get<double>(), 0.448, 2e-3);
  EXPECT_NEAR(warm["light.0.color.b"].get<double>(), 0.126, 2e-3);
  EXPECT_EQ(state("warm.json")["undo_depth"].get<int>(), state("before.json")["undo_depth"].get<int>() + 1);
  for (const char* name : {"light.0.color.r", "light.0.color.g", "light.0.color.b"})
    EXPECT_EQ(after[name], before[name]) << name;
}

TEST_F(LightMeterPanel, WaitFailsWithoutAMeasurement) {
  EXPECT_EQ(run(joined(small(1), steps_of({wait_for("meter")}))), 1);
}

}  // namespace
}  // namespace etendue::light_meter_test
