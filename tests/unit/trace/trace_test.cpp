// Traces as JSON, text and drawings.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "camera/segment_projection.h"
#include "support/independent_estimates.h"
#include "support/scenes.h"
#include "trace/trace_drawing.h"
#include "trace/trace_json.h"
#include "trace/trace_text.h"

namespace etendue {
namespace {

using nlohmann::json;
using Kind = trace::PathSegment::Kind;

render::PixelTrace traced(const render::Document& d, Vec2i pixel, uint32_t sample) {
  return *render::trace_pixel(d, scene::compile(d.scene, d.camera, nullptr), pixel, sample);
}

// The first sample of a pixel that has an occluded light sample.
render::PixelTrace with_occluded_light(const render::Document& d, Vec2i pixel) {
  for (uint32_t sample = 0; sample < 1000; ++sample) {
    auto trace = traced(d, pixel, sample);
    for (const auto& v : trace.record.vertices)
      for (const auto& light : v.lights)
        if (light.occluded) return trace;
  }
  ADD_FAILURE() << "no occluded light sample";
  return {};
}

TEST(Trace, JsonHasAllDigitsOfTheSum) {
  const auto d = test::cornell(32);
  const auto trace = traced(d, {10, 29}, 3);
  const json j = json::parse(trace::to_json(trace).dump());
  Rgb sum(0);
  const auto add = [&](const json& c) {
    for (int i = 0; i < 3; ++i) sum[i] += c[static_cast<size_t>(i)].get<float>();
  };
  // In this scene every light sample has a shadow ray, which is resolved before the next vertex is reached.
  for (const json& v : j["vertices"]) {
    if (v.contains("emission")) add(v["emission"]["contribution"]);
    for (const json& light : v["light_samples"])
      if (!light["occluded"].get<bool>()) add(light["contribution"]);
  }
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(j["film_sample"][i].get<float>(), trace.radiance[static_cast<int>(i)]);
    EXPECT_EQ(j["radiance"][i].get<float>(), sum[static_cast<int>(i)]);
  }
  EXPECT_GT(sum.g, 0);
}

TEST(Trace, EveryDensityHasItsMeasure) {
  const auto d = test::glossy_scene();
  std::vector<std::string> measures;
  const auto add = [&](const json& owner) {
    if (owner.contains("pdf")) measures.push_back(owner["pdf"]["measure"]);
  };
  for (uint32_t sample = 0; sample < 40; ++sample) {
    const json j = trace::to_json(traced(d, {7, 9}, sample));
    for (const json& v : j["vertices"]) {
      for (const json& light : v["light_samples"]) add(light);
      for (const json& s : v["bsdf_samples"]) add(s);
    }
  }
  EXPECT_GT(std::ranges::count(measures, "solid angle, 1/sr"), 20);
  EXPECT_GT(std::ranges::count(measures, "delta"), 5);
}

TEST(Trace, TextNamesSurfacesAndTheSum) {
  const auto d = test::cornell(32);
  const std::string text = trace::to_text(traced(d, {10, 29}, 0));
  EXPECT_NE(text.find("vertex 1: floor, white (diffuse)"), std::string::npos) << text;
  EXPECT_NE(text.find("light sample: light"), std::string::npos) << text;
  EXPECT_NE(text.find("equal to the sample of the film"), std::string::npos) << text;
}

TEST(Trace, OccludedShadowRaysAreDashed) {
  const auto d = test::cornell(32);
  const auto trace = with_occluded_light(d, {10, 29});
  const auto segments = trace::path_segments(trace.record, 1);
  EXPECT_GE(std::ranges::count(segments, Kind::occluded, &trace::PathSegment::kind), 1);
  const auto drawing = trace::path_drawing(trace, d.camera, {32, 32});
  int dashed = 0, solid = 0;
  for (const auto& shape : drawing.shapes)
    if (const auto* line = std::get_if<metrics::Polyline>(&shape)) (line->dashed ? dashed : solid)++;
  EXPECT_GE(dashed, 1);
  EXPECT_GE(solid, 1);
}

// The first vertex lies in the pixel.
TEST(Trace, VerticesAreDrawnWhereTheCameraSeesThem) {
  const auto d = test::cornell(32);
  for (const Vec2i pixel : {Vec2i(3, 5), Vec2i(10, 29), Vec2i(30, 16)}) {
    const auto trace = traced(d, pixel, 0);
    const Vec3& at = trace.record.vertices.at(0).point.position;
    const auto ends = project_segment(d.camera, Vec2i(32), at, at);
    ASSERT_TRUE(ends);
    EXPECT_NEAR((*ends)[0].x, trace.record.raster.x, 1e-3f);
    EXPECT_NEAR((*ends)[0].y, trace.record.raster.y, 1e-3f);
  }
}

TEST(Trace, SegmentsBehindTheCameraAreCut) {
  for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
    Camera camera = look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1);
    camera.projection = projection;
    EXPECT_FALSE(project_segment(camera, Vec2i(100), {0, 0, 1}, {1, 0, 2}));
    const auto ends = project_segment(camera, Vec2i(100), {0, 0, -1}, {0.5f, 0, 1});
    ASSERT_TRUE(ends);
    EXPECT_NEAR((*ends)[0].x, 50, 1e-3f);
    EXPECT_TRUE(std::isfinite((*ends)[1].x));
    EXPECT_GT((*ends)[1].x, 50);
  }
}

TEST(Trace, FigureHasThePictureBelowThePaths) {
  const auto d = test::cornell(32);
  const std::vector<std::byte> png(3, std::byte{65});
  const std::string svg = trace::path_figure(traced(d, {10, 29}, 0), d.camera, {32, 32}, png);
  const size_t picture = svg.find("data:image/png;base64,QUFB"), path = svg.find("<polyline");
  ASSERT_NE(picture, std::string::npos);
  ASSERT_NE(path, std::string::npos);
  EXPECT_LT(picture, path);
}

}  // namespace
}  // namespace etendue
