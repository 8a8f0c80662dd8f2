// Directions towards emitting media: samples have the stated density, which integrates to 1.
//
// Chi-square tests with a false-alarm rate of 1e-4 each.
#include "medium/medium_emitters.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/chi_square.h"

namespace etendue {
namespace {

HeterogeneousMedium flame(const Mat4& box_to_world) {
  MediumDescription m;
  m.absorption = Rgb(3);
  m.emission = Rgb(2);
  m.temperature = 2000;
  return {m, Rgb(0), *make_density("flame")->grid(), glm::inverse(box_to_world)};
}

// A sheared and turned box, two metres high.
Mat4 slanted_box() {
  Mat4 m(1);
  m[0] = Vec4(1, 0.2f, 0, 0);
  m[1] = Vec4(0.3f, 2, 0.1f, 0);
  m[2] = Vec4(0, -0.4f, 0.8f, 0);
  m[3] = Vec4(1, -1, 3, 1);
  return m;
}

MediumEmitters emitters() {
  HomogeneousMedium gas;
  gas.emission = {1, 0.5f, 0.2f};
  const std::vector<EmitterBox> boxes{emitter_box(flame(slanted_box())),
                                      emitter_box(gas, Vec3(-2, 0, 1), Vec3(-1, 0.5f, 2))};
  return MediumEmitters(boxes);
}

// Receivers far from the media, near them, and inside.
const Vec3 kReceivers[] = {{0, -20, 5}, {-2.2f, 0.1f, 1.4f}, {1.6f, 0.2f, 3.4f}, {-1.5f, 0.2f, 1.5f}};

TEST(MediumEmitters, SamplesHaveTheirDensity) {
  const MediumEmitters media = emitters();
  for (const Vec3& from : kReceivers) {
    RandomStream random(7);
    const auto result = test::chi_square_on_sphere(
        [&](Vec3& w) {
          const float choice = random.next();
          const Vec3 position(random.next(), random.next(), random.next());
          const auto s = media.sample(from, choice, position);
          if (!(s.pdf > 0)) return false;
          EXPECT_NEAR(s.pdf, media.pdf(from, s.direction), 1e-4f * s.pdf);
          w = s.direction;
          return true;
        },
        [&](const Vec3& w) { return static_cast<double>(media.pdf(from, w)); }, 40'000);
    EXPECT_GT(result.p_value, 1e-4) << from.x << ' ' << from.y << ' ' << from.z;
    EXPECT_GT(result.degrees, 10);
  }
}

// Cells are chosen by their power: a receiver in a far corner sees the hot base of the flame more often than its top.
TEST(MediumEmitters, PowerIsThatOfTheCells) {
  const EmitterBox box = emitter_box(flame(Mat4(1)));
  double sum = 0, reference = 0;
  for (const float p : box.power) sum += static_cast<double>(p);
  const HeterogeneousMedium m = flame(Mat4(1));
  constexpr int kSteps = 80;
  for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
    const Vec3 p = (Vec3(i % kSteps, i / kSteps % kSteps, i / kSteps / kSteps) + 0.5f) / static_cast<float>(kSteps);
    reference += static_cast<double>(average(m.emitted(p, m.grid->density(p)))) / (kSteps * kSteps * kSteps);
  }
  EXPECT_NEAR(sum, reference, 0.01 * reference);
}

TEST(MediumEmitters, WithoutEmissionThereAreNone) {
  HomogeneousMedium dark;
  const EmitterBox boxes[] = {emitter_box(dark, Vec3(0), Vec3(1))};
  EXPECT_TRUE(MediumEmitters(boxes).empty());
  HomogeneousMedium gas;
  gas.emission = Rgb(1);
  const EmitterBox flat[] = {emitter_box(gas, Vec3(0), Vec3(1, 0, 1))};
  EXPECT_TRUE(MediumEmitters(flat).empty());
  EXPECT_EQ(MediumEmitters().pdf(Vec3(0), Vec3(0, 0, 1)), 0);
}

// The mean of one over the density of points in the boxes is their volume. 4.5 standard errors.
TEST(MediumEmitters, PointsHaveTheirDensity) {
  HomogeneousMedium gas;
  gas.emission = Rgb(2);
  // Two boxes of 1 and 0.25 m^3, which overlap in 0.125 m^3.
  const MediumEmitters media(
      std::vector<EmitterBox>{emitter_box(gas, Vec3(0), Vec3(1)), emitter_box(gas, {0.5f, 0.5f, 0.5f}, {1.5f, 1, 1})});
  EXPECT_NEAR(media.power(), 4 * kPi * 2 * 1.25f, 1e-4f);
  RandomStream random(9);
  double sum = 0, squares = 0;
  constexpr int kPoints = 20'000;
  for (int i = 0; i < kPoints; ++i) {
    const auto p = media.sample_point(random.next(), {random.next(), random.next(), random.next()});
    ASSERT_GT(p.pdf, 0);
    const double value = 1 / static_cast<double>(p.pdf);
    sum += value, squares += value * value;
  }
  const double mean = sum / kPoints, error = std::sqrt((squares / kPoints - mean * mean) / kPoints);
  EXPECT_NEAR(mean, 1.125, 4.5 * error);
  EXPECT_LT(error, 0.01);

  const MediumEmitters cells = emitters();
  for (int i = 0; i < 2000; ++i)
    EXPECT_GT(cells.sample_point(random.next(), {random.next(), random.next(), random.next()}).pdf, 0);
}

}  // namespace
}  // namespace etendue
