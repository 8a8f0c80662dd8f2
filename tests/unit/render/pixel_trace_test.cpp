// A traced sample is bit-identical to that of the film, and its record is consistent in itself.
#include "render/pixel_trace.h"

#include <gtest/gtest.h>

#include "integrator/integrator.h"
#include "support/independent_estimates.h"
#include "support/integrator_scenes.h"
#include "support/media_scenes.h"
#include "support/moving_scenes.h"
#include "support/scenes.h"

namespace etendue {
namespace {

using integrator::Accumulation;
using render::Document;
using render::PixelTrace;
using transport::PathEnd;
using transport::RecordedLight;
using transport::RecordedVertex;

// One pixel in a block of its own, one at the edge of a block, some between.
constexpr Vec2i kPixels[] = {{0, 0}, {31, 15}, {32, 16}, {20, 11}, {7, 23}, {39, 3}};
constexpr Vec2i kSize(40, 24);

std::shared_ptr<const scene::CompiledScene> compiled_scene(const Document& d) {
  return scene::compile(d.scene, d.camera, nullptr);
}

std::vector<std::string> per_pixel_integrators() {
  std::vector<std::string> names;
  for (const auto& info : integrator::integrator_infos())
    if (info.accumulation == Accumulation::per_pixel) names.push_back(info.name);
  return names;
}

PixelTrace traced(const Document& d, const std::shared_ptr<const scene::CompiledScene>& scene, Vec2i pixel,
                  uint32_t sample) {
  auto trace = render::trace_pixel(d, scene, pixel, sample);
  EXPECT_TRUE(trace) << trace.error().message;
  return *trace;
}

// Traces samples 0 and 1 of all pixels with every integrator. Returns the number of vertices.
size_t expect_samples_of_the_film(Document d) {
  d.width = kSize.x;
  d.height = kSize.y;
  const auto scene = compiled_scene(d);
  size_t vertices = 0;
  for (const std::string& name : per_pixel_integrators()) {
    d.method.integrator = name;
    const film::Film film = test::rendered(d, 2);
    for (const Vec2i& pixel : kPixels)
      for (uint32_t sample = 0; sample < 2; ++sample) {
        const PixelTrace trace = traced(d, scene, pixel, sample);
        const Rgb expected = film.half_buffer_mean(pixel.x, pixel.y, sample);
        EXPECT_EQ(trace.radiance, expected) << name << " " << pixel.x << "," << pixel.y << " sample " << sample;
        EXPECT_EQ(trace.record.radiance, expected) << name << " " << pixel.x << "," << pixel.y << " sample " << sample;
        vertices += trace.record.vertices.size();
      }
  }
  return vertices;
}

// One scene for each transport model: diffuse, standard lobes, media, all lobes.
TEST(PixelTrace, EqualsTheFilmBitForBit) {
  EXPECT_GT(expect_samples_of_the_film(test::cornell(24)), 100u);
  EXPECT_GT(expect_samples_of_the_film(test::glossy_scene()), 100u);
  EXPECT_GT(expect_samples_of_the_film(test::ice_in_water_in_glass(true)), 100u);
  EXPECT_GT(expect_samples_of_the_film(test::bsdf_model_scene()), 100u);
}

TEST(PixelTrace, EqualsTheFilmWithMotionAndALens) {
  EXPECT_GT(expect_samples_of_the_film(test::motion_and_lens_scene()), 100u);
}

TEST(PixelTrace, EqualsTheFilmWithSelectedPaths) {
  for (Document d : {test::cornell(24), test::glossy_scene(), test::ice_in_water_in_glass(true)}) {
    d.method.paths = "E(D|G|S)(D|G)L";
    EXPECT_GT(expect_samples_of_the_film(d), 30u);
  }
}

TEST(PixelTrace, EqualsTheFilmWithBranchesAtThreeVertices) {
  Document d = test::with_integrator(test::cornell(24), "distribution");
  d = test::with(test::with(test::with(d, "branches-1", "5"), "branches-2", "3"), "branches-3", "2");
  d.width = kSize.x;
  d.height = kSize.y;
  const film::Film film = test::rendered(d, 2);
  const auto scene = compiled_scene(d);
  size_t vertices = 0;
  for (const Vec2i& pixel : kPixels) {
    const PixelTrace trace = traced(d, scene, pixel, 0);
    EXPECT_EQ(trace.record.radiance, film.half_buffer_mean(pixel.x, pixel.y, 0));
    vertices += trace.record.vertices.size();
  }
  EXPECT_GT(vertices, 40u);
}

// What each vertex of a path says agrees with the vertex before it, and its light samples with the estimator
//   throughput f |cos| L_e w / p
TEST(PixelTrace, VerticesAreConsistent) {
  Document d = test::glossy_scene();
  d.width = kSize.x;
  d.height = kSize.y;
  const auto scene = compiled_scene(d);
  int continued = 0, unattenuated = 0, samples = 0, weighted = 0;
  for (const Vec2i& pixel : kPixels)
    for (uint32_t sample = 0; sample < 32; ++sample) {
      const PixelTrace trace = traced(d, scene, pixel, sample);
      for (const RecordedVertex& v : trace.record.vertices) {
        if (v.parent >= 0) {
          const RecordedVertex& parent = trace.record.vertices[static_cast<size_t>(v.parent)];
          const auto& s = parent.scattering_samples[static_cast<size_t>(v.scattering)];
          EXPECT_EQ(s.end, PathEnd::none);
          for (int c = 0; c < 3; ++c) EXPECT_LE(v.throughput[c], s.throughput[c]);
          unattenuated += v.throughput == s.throughput;
          EXPECT_EQ(v.length, parent.length + 1);
          EXPECT_NEAR(glm::dot(s.sample.wi, -v.wo), 1, 1e-5f);
          EXPECT_EQ(v.origin, parent.point.position);
          ++continued;
        } else {
          EXPECT_EQ(v.length, 1);
        }
        for (const RecordedLight& light : v.lights) {
          const Rgb expected = v.throughput * light.f_cos * light.radiance * (light.mis_weight / light.sample.pdf);
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(light.unoccluded[c], expected[c], 1e-4f * std::abs(expected[c]) + 1e-9f);
          EXPECT_EQ(light.contribution, light.occluded ? Rgb(0) : light.unoccluded);
          EXPECT_GT(light.mis_weight, 0);
          EXPECT_LE(light.mis_weight, 1 + 1e-5f);
          weighted += light.mis_weight < 0.999f;
          ++samples;
        }
      }
    }
  EXPECT_GT(continued, 100);
  EXPECT_GT(unattenuated, continued / 2);
  EXPECT_GT(samples, 50);
  EXPECT_GT(weighted, 10);
}

TEST(PixelTrace, RouletteIsRecorded) {
  Document d = test::cornell(24);
  const auto scene = compiled_scene(d);
  int survived = 0, ended = 0;
  for (uint32_t sample = 0; sample < 64; ++sample)
    for (const RecordedVertex& v : traced(d, scene, {12, 12}, sample).record.vertices)
      for (const auto& s : v.scattering_samples) {
        if (!s.roulette) continue;
        EXPECT_GE(v.length, 4);
        EXPECT_EQ(s.end == PathEnd::roulette, !(s.roulette->random < s.roulette->survival));
        (s.end == PathEnd::roulette ? ended : survived)++;
      }
  EXPECT_GT(survived, 10);
  EXPECT_GT(ended, 10);
}

TEST(PixelTrace, OtherIntegratorsSayWhyTheyHaveNoTrace) {
  Document d = test::cornell(16);
  const auto scene = compiled_scene(d);
  for (const auto& info : integrator::integrator_infos()) {
    d.method.integrator = info.name;
    const auto trace = render::trace_pixel(d, scene, {3, 3}, 0);
    EXPECT_EQ(bool{trace}, info.accumulation == Accumulation::per_pixel) << info.name;
    if (!trace) {
      EXPECT_NE(trace.error().message.find(info.name), std::string::npos) << trace.error().message;
    }
  }
}

TEST(PixelTrace, PixelsOutsideTheImageAreAnError) {
  const Document d = test::cornell(16);
  const auto scene = compiled_scene(d);
  for (const Vec2i& pixel : {Vec2i(-1, 0), Vec2i(16, 0), Vec2i(0, 16)}) {
    const auto trace = render::trace_pixel(d, scene, pixel, 0);
    ASSERT_FALSE(trace);
    EXPECT_NE(trace.error().message.find("16x16"), std::string::npos);
  }
}

}  // namespace
}  // namespace etendue
