// Distances to collisions: transmittance, collision densities and weights for chromatic media.
#include "medium/free_flight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etendue {
namespace {

constexpr int kQuadraturePoints = 200000;  // of the random number; the estimates are quadratures without noise

HomogeneousMedium medium(const Rgb& scattering, const Rgb& absorption) {
  return HomogeneousMedium(MediumDescription{scattering, absorption, {}});
}

struct Estimate {
  double passed[3] = {}, collided[3] = {}, moment[3] = {};  // moment: collided times distance
};

Estimate estimate(const Rgb& throughput, const HomogeneousMedium& m, float length) {
  Estimate e;
  for (int i = 0; i < kQuadraturePoints; ++i) {
    FreeFlight flight(throughput, (static_cast<float>(i) + 0.5f) / kQuadraturePoints);
    const auto distance = flight.pass(m, length);
    const Rgb weight = flight.weight();
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(std::isfinite(weight[c]));
      const double value = static_cast<double>(throughput[c] * weight[c]) / kQuadraturePoints;
      (distance ? e.collided : e.passed)[c] += value;
      if (distance) e.moment[c] += value * static_cast<double>(*distance);
    }
  }
  return e;
}

TEST(FreeFlight, EstimatesTransmittanceAndCollisionsOfEachChannel) {
  const Rgb scattering(0.2f, 1, 3), absorption(0.5f, 0.1f, 0);
  const float length = 1.7f;
  for (const Rgb& throughput : {Rgb(1), Rgb(1, 0.2f, 0.05f), Rgb(0, 2, 1)}) {
    const Estimate e = estimate(throughput, medium(scattering, absorption), length);
    for (int c = 0; c < 3; ++c) {
      const double t = throughput[c], s = scattering[c], k = s + absorption[c], passed = std::exp(-k * length);
      EXPECT_NEAR(e.passed[c], t * passed, 2e-4 * t);
      EXPECT_NEAR(e.collided[c], t * s / k * (1 - passed), 2e-4 * t);
      const double mean = s / (k * k) * (1 - passed * (1 + k * length));
      EXPECT_NEAR(e.moment[c], t * mean, 3e-4 * t);
    }
  }
}

// The density of collisions is that of the samples, and the survival does not depend on the throughput.
TEST(FreeFlight, Densities) {
  const HomogeneousMedium m = medium({0.2f, 1, 3}, {0.5f, 0.1f, 0});
  const Rgb throughput(1, 0.2f, 0.05f);
  const float length = 0.8f;
  int collisions = 0;
  for (int i = 0; i < kQuadraturePoints; ++i) {
    FreeFlight flight(throughput, (static_cast<float>(i) + 0.5f) / kQuadraturePoints);
    if (flight.pass(m, length)) ++collisions;
  }
  double integral = 0;
  for (int i = 0; i < 1000; ++i)
    integral += static_cast<double>(FreeFlight(throughput, 0).collision_density(m, (i + 0.5f) * length / 1000)) *
                static_cast<double>(length) / 1000;
  EXPECT_NEAR(static_cast<double>(collisions) / kQuadraturePoints, integral, 1e-4);

  FreeFlight flight = FreeFlight::without_collision(throughput);
  EXPECT_FALSE(flight.pass(m, length));
  EXPECT_FLOAT_EQ(flight.survival(), average(m.transmittance(length)));
  FreeFlight collided(Rgb(0, 0, 1), 0.5f);
  const auto distance = collided.pass(m, length);
  ASSERT_TRUE(distance);
  EXPECT_FLOAT_EQ(collided.survival(), average(m.transmittance(*distance)));
}

// Three flights through the same slab, with a channel that is kept: the throughput of a channel after three collisions
// has the mean (albedo (1 - transmittance))^3. 4.5 standard errors.
TEST(FreeFlight, KeptChannelsAreUnbiased) {
  const HomogeneousMedium m = medium({0.2f, 1, 3}, {0.5f, 0.1f, 0.2f});
  const float length = 1.3f;
  constexpr int kPaths = 300'000;
  double sum[3] = {}, squares[3] = {};
  RandomStream random(1);
  for (int i = 0; i < kPaths; ++i) {
    Rgb throughput(1), densities(1.0f / 3);
    for (int k = 0; k < 3 && !is_black(throughput); ++k) {
      FreeFlight flight(densities, i % 3, random.next());
      throughput = flight.pass(m, length) ? throughput * flight.weight() : Rgb(0);
      densities = flight.densities();
    }
    EXPECT_LE(max_component(throughput), 3.0001f);
    for (int c = 0; c < 3; ++c) {
      sum[c] += static_cast<double>(throughput[c]);
      squares[c] += static_cast<double>(throughput[c]) * static_cast<double>(throughput[c]);
    }
  }
  for (int c = 0; c < 3; ++c) {
    const auto k = static_cast<double>(m.extinction[c]);
    const double expected = std::pow(static_cast<double>(m.scattering[c]) / k * (1 - std::exp(-k * double{length})), 3);
    const double mean = sum[c] / kPaths, error = std::sqrt((squares[c] / kPaths - mean * mean) / kPaths);
    EXPECT_NEAR(mean, expected, 4.5 * error) << c;
    EXPECT_LT(error, 0.05 * expected) << c;
  }
}

// With equal albedos, the densities of a path are proportional to its throughput: both ways of choosing channels
// generate the same paths.
TEST(FreeFlight, DensitiesAreThroughputsForEqualAlbedos) {
  const HomogeneousMedium m = medium({0.4f, 1, 3}, {0.1f, 0.25f, 0.75f});
  RandomStream random(2);
  for (int i = 0; i < 100; ++i) {
    Rgb throughput(1), densities(1.0f / 3);
    for (int k = 0; k < 5; ++k) {
      FreeFlight flight(densities, i % 3, random.next());
      flight.pass(m, 2);
      throughput *= flight.weight();
      densities = flight.densities();
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(densities[c], throughput[c] / (throughput.r + throughput.g + throughput.b), 1e-4f);
    }
  }
}

// The balance heuristic bounds the weights: no channel is amplified by more than the inverse of its probability.
TEST(FreeFlight, WeightsAreBounded) {
  const HomogeneousMedium m = medium({0.01f, 1, 50}, Rgb(0));
  for (int i = 0; i < 1000; ++i) {
    FreeFlight flight(Rgb(1), (static_cast<float>(i) + 0.5f) / 1000);
    flight.pass(m, 3);
    EXPECT_LE(max_component(flight.weight()), 3.0001f);
  }
}

TEST(FreeFlight, SeveralMediaInSequence) {
  const HomogeneousMedium a = medium(Rgb(1, 2, 0.5f), Rgb(0)), b = medium(Rgb(0.3f, 0.1f, 4), Rgb(0.2f));
  double passed[3] = {};
  for (int i = 0; i < kQuadraturePoints; ++i) {
    FreeFlight flight(Rgb(1), (static_cast<float>(i) + 0.5f) / kQuadraturePoints);
    if (flight.pass(a, 0.4f)) continue;
    flight.attenuate(Rgb(0.5f));
    if (flight.pass(b, 0.7f)) continue;
    for (int c = 0; c < 3; ++c) passed[c] += static_cast<double>(flight.weight()[c]) / kQuadraturePoints;
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(
        passed[c],
        0.5 * std::exp(-static_cast<double>(a.extinction[c]) * 0.4 - static_cast<double>(b.extinction[c]) * 0.7), 2e-4);
}

TEST(FreeFlight, ExtremeOpticalDepthsAreFinite) {
  const HomogeneousMedium dense = medium(Rgb(100, 1e6f, 1e-6f), Rgb(0, 0, 1e-6f));
  for (const float length : {0.0f, 1e-6f, 1.0f, 1e6f, kInfinity})
    for (const float u : {0.0f, 0.3f, 0.5f, 0.7f, kOneMinusEpsilon}) {
      FreeFlight flight(Rgb(1, 1, 0), u);
      const auto distance = flight.pass(dense, length);
      EXPECT_TRUE(!distance || (*distance >= 0 && std::isfinite(*distance))) << length << " " << u;
      EXPECT_TRUE(is_finite(flight.weight())) << length << ' ' << u;
    }
}

TEST(FreeFlight, BlackThroughputIsHandled) {
  FreeFlight flight(Rgb(0), 0.5f);
  flight.pass(medium(Rgb(1), Rgb(0)), 2);
  EXPECT_TRUE(is_finite(flight.weight()));
}

}  // namespace
}  // namespace etendue
