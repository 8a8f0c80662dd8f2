// Every registered light type: its description, its parameters, and its flux in closed form.
#include <gtest/gtest.h>

#include <cctype>
#include <numbers>
#include <set>

#include "light/area_light.h"
#include "light/light.h"
#include "light/types/spot_light.h"

namespace etendue::light_types_test {
namespace {

constexpr double kPiD = std::numbers::pi;

double flux_of(const Light& light) { return static_cast<double>(light.flux().g); }
double radiance_of(const Light& light) { return static_cast<double>(light.model->area_light(light.color)->radiance.g); }

// A value of the parameter that is not its default.
Value other_value(const ParameterInfo& p) {
  switch (p.type) {
    case ParameterType::toggle:
      return !std::get<bool>(p.default_value);
    case ParameterType::integer:
      return int64_t{7};
    case ParameterType::number:
      return double{static_cast<float>(p.min + 0.3 * (p.max - p.min))};
    default:
      return p.options.back();
  }
}

TEST(LightTypes, DescribeThemselves) {
  std::set<std::string> names;
  for (const LightTypeInfo& info : light_type_infos()) {
    const LightTypeDescription& d = info.description;
    EXPECT_TRUE(names.insert(d.name).second) << d.name;
    ASSERT_NE(find_light_type(d.name), nullptr);
    EXPECT_EQ(find_light_type(d.name)->description.label, d.label);
    for (const char* text : {d.name, d.label, d.summary, d.formula, d.sampling, d.source})
      EXPECT_GT(std::string_view(text).size(), 2U) << d.name;
    for (const char c : std::string_view(d.name)) EXPECT_TRUE(std::islower(c) || c == '-') << d.name;
    ASSERT_NE(d.quantity, nullptr) << d.name;
    const ParameterInfo* intensity = find_parameter(info.parameters, "intensity");
    ASSERT_NE(intensity, nullptr) << d.name;
    EXPECT_EQ(intensity->unit, d.quantity->unit) << d.name;
    for (const ParameterInfo& p : info.parameters) EXPECT_FALSE(p.doc.empty()) << d.name << ": " << p.name;
  }
  EXPECT_EQ(find_light_type("lantern"), nullptr);
}

// Every parameter can be set by its text, changes the light, and can be restored.
TEST(LightTypes, KeepTheirParameters) {
  for (const LightTypeInfo& info : light_type_infos()) {
    const Light usual = make_light(info.description.name);
    for (const ParameterInfo& p : usual.parameters()) {
      SCOPED_TRACE(std::string(info.description.name) + ": " + p.name);
      EXPECT_EQ(usual.parameter(p.name), p.default_value);
      const auto value = parse_value(p, to_string(other_value(p)));
      ASSERT_TRUE(value) << value.error().message;
      Light changed = usual;
      ASSERT_TRUE(changed.set(p.name, *value));
      // Numbers are stored in single precision.
      const auto* number = std::get_if<double>(&*value);
      const Value stored = number ? Value(double{static_cast<float>(*number)}) : *value;
      EXPECT_EQ(changed.parameter(p.name), stored);
      EXPECT_FALSE(changed == usual);
      for (const ParameterInfo& other : changed.parameters()) {
        if (other.name != p.name) {
          EXPECT_EQ(other.default_value, *usual.parameter(other.name)) << other.name;
        }
      }
      ASSERT_TRUE(changed.set(p.name, p.default_value));
      EXPECT_TRUE(changed == usual);
    }
    Light light = usual;
    EXPECT_FALSE(light.set("wattage", 60.0));
    EXPECT_EQ(light.parameter("wattage"), std::nullopt);
    EXPECT_TRUE(light == usual);
  }
}

TEST(LightTypes, AreEqualOnlyToThemselves) {
  for (const LightTypeInfo& a : light_type_infos())
    for (const LightTypeInfo& b : light_type_infos())
      EXPECT_EQ(make_light(a.description.name) == make_light(b.description.name), &a == &b);
}

TEST(LightTypes, UnitOfAnAreaLightFollowsItsQuantity) {
  Light light = make_light("disk");
  light.set("quantity", std::string("power"));
  const auto parameters = light.parameters();
  EXPECT_EQ(find_parameter(parameters, "intensity")->unit, "lm");
}

// ---- Flux in closed form, for intensity 3 and the colour (1, 0.5, 0.25).

Light coloured(Light light) {
  light.set("intensity", 3.0);
  light.color = {1, 0.5f, 0.25f};
  return light;
}

TEST(LightFlux, PointLight) { EXPECT_NEAR(flux_of(coloured(make_light("point"))), 0.5 * 3 * 4 * kPiD, 1e-5); }

// The integral of the profile over the cosine.
TEST(LightFlux, SpotLight) {
  for (const char* profile : {"squared", "smoothstep", "quartic", "cosine"})
    for (const double outer : {0.02, 0.3, 1.0, 1.5}) {
      const double inner = 0.4 * outer;
      const double exponent = 5;
      const Light spot = coloured(make_light(
          "spot", {{"profile", profile}, {"inner-cone", inner}, {"outer-cone", outer}, {"exponent", exponent}}));
      const auto falloff = [&](double cosine) {
        if (cosine < std::cos(outer)) return 0.0;
        if (std::string(profile) == "cosine") return std::pow(cosine, exponent);
        const double t = std::min((cosine - std::cos(outer)) / (std::cos(inner) - std::cos(outer)), 1.0);
        if (std::string(profile) == "smoothstep") return t * t * (3 - 2 * t);
        return std::string(profile) == "quartic" ? t * t * t * t : t * t;
      };
      constexpr int kSteps = 200'000;
      double integral = 0;
      const double begin = std::cos(outer), step = (1 - begin) / kSteps;
      for (int i = 0; i < kSteps; ++i) integral += falloff(begin + (i + 0.5) * step) * step;
      const double expected = 0.5 * 3 * 2 * kPiD * integral;
      EXPECT_NEAR(flux_of(spot), expected, 2e-3 * expected) << profile << ' ' << outer;
    }
}

// The emitted intensity has this flux: the mean over directions that are uniform in the cone, and the value on the axis.
TEST(LightFlux, NarrowSpotLightsEmitIt) {
  for (const SpotProfile profile : {SpotProfile::squared, SpotProfile::smoothstep, SpotProfile::quartic})
    for (const double outer : {0.01, 0.02, 0.05}) {
      SpotLight spot;
      spot.profile.value = profile;
      spot.inner_cone.value = 0;
      spot.outer_cone.value = static_cast<float>(outer);
      const auto emitter = spot.emitter(Rgb(1));
      constexpr int kSteps = 10'000;
      double integral = 0;
      for (int i = 0; i < kSteps; ++i) {
        const auto cosine = static_cast<float>(1 - (1 - std::cos(outer)) * (i + 0.5) / kSteps);
        integral += double{emitter.falloff(cosine)} * 2 * kPiD * (1 - std::cos(outer)) / kSteps;
      }
      // Cosines of small angles have few digits in single precision.
      EXPECT_NEAR(double{emitter.solid_angle()}, integral, 0.02 * integral) << outer;
      EXPECT_NEAR(emitter.falloff(1), 1, 1e-6) << outer;
    }
}

TEST(LightFlux, InfiniteLightsHaveNoFlux) {
  for (const LightTypeInfo& info : light_type_infos()) {
    const LightClass light_class = info.description.light_class;
    if (light_class == LightClass::delta_direction || light_class == LightClass::ambient) {
      EXPECT_EQ(make_light(info.description.name).flux(), Rgb(0)) << info.description.name;
    }
  }
}

// 2 pi A s L0 / (k + 2), the integral of L0 cos^k times the cosine over the area A of s sides and over the hemisphere.
TEST(LightFlux, AreaLights) {
  const std::pair<const char*, double> kAreas[] = {{"quad", 0.7 * 0.4},
                                                   {"disk", kPiD * 0.3 * 0.3},
                                                   {"sphere", 4 * kPiD * 0.3 * 0.3},
                                                   {"cylinder", 2 * kPiD * 0.3 * 0.9}};
  for (const auto& [type, area] : kAreas)
    for (const double k : {0.0, 2.5})
      for (const bool two_sided : {false, true}) {
        Light light = coloured(make_light(type, {{"focus", k}}));
        for (const auto& [size, value] :
             {std::pair("width", 0.7), std::pair("height", 0.4), std::pair("radius", 0.3), std::pair("length", 0.9)})
          light.set(size, value);
        const int sides = light.set("two-sided", two_sided) && two_sided ? 2 : 1;
        const double expected = 0.5 * 3 * 2 * kPiD / (k + 2) * area * sides;
        EXPECT_NEAR(flux_of(light), expected, 1e-5 * expected) << type << ' ' << k;
        EXPECT_NEAR(radiance_of(light), 1.5, 1e-6);

        // The same light specified by its power.
        light.set("quantity", std::string("power"));
        EXPECT_NEAR(flux_of(light), 1.5, 1e-5);
        light.set("intensity", 2 * expected);
        EXPECT_NEAR(radiance_of(light), 1.5, 1e-5);
      }
}

TEST(LightFlux, AreaLightsWithoutAreaAreBlack) {
  EXPECT_EQ(flux_of(make_light("disk", {{"radius", 0.0}, {"quantity", "power"}})), 0);
}

}  // namespace
}  // namespace etendue::light_types_test
