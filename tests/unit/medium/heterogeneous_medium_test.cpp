// Delta, ratio and residual ratio tracking through heterogeneous media against closed forms.
//
// Means are compared within 4.5 standard errors, which are bounded: one false alarm in 150,000 comparisons of normal
// means.
#include "medium/heterogeneous_medium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "medium/free_flight.h"

namespace etendue {
namespace {

// A mean and its standard error.
struct Statistic {
  double sum = 0, squares = 0;
  int count = 0;

  void add(double x) { sum += x, squares += x * x, ++count; }
  double mean() const { return sum / count; }
  double error() const { return std::sqrt(std::max(squares / count - mean() * mean(), 0.0) / (count - 1)); }
};

void expect_mean(const Statistic& s, double expected, double largest_error, const std::string& what) {
  EXPECT_NEAR(s.mean(), expected, 4.5 * s.error() + 2e-5 * std::abs(expected) + 1e-12) << what;
  EXPECT_LE(s.error(), largest_error) << what;
}

HeterogeneousMedium slab(const MediumDescription& m, const std::shared_ptr<const DensityField>& density) {
  return {m, Rgb(0), *density->grid(), Mat4(1)};
}

MediumDescription coefficients(const Rgb& scattering, const Rgb& absorption) {
  MediumDescription m;
  m.scattering = scattering;
  m.absorption = absorption;
  return m;
}

// Upwards through the unit cube. The length of the direction is 2, so that parameters and metres differ.
const RaySpan kUp{{0.3f, -1, 0.6f}, {0, 2, 0}, 0, 5};

std::shared_ptr<const DensityField> linear(double bottom, double top) {
  return *make_density("linear", {{"bottom", bottom}, {"top", top}});
}

constexpr TransmittanceEstimator kEstimators[] = {TransmittanceEstimator::delta, TransmittanceEstimator::ratio,
                                                  TransmittanceEstimator::residual_ratio,
                                                  TransmittanceEstimator::regular};

struct Slab {
  const char* name;
  std::shared_ptr<const DensityField> density;
  double integral;  // of the density
};

std::vector<Slab> slabs() {
  return {{"constant", *make_density("constant", {{"value", 0.7}}), 0.7},
          {"linear", linear(2, 0.5), 1.25},
          {"linear from 0", linear(0, 3), 1.5},
          {"exponential", *make_density("exponential", {{"scale-height", 0.25}}), 0.25 * (1 - std::exp(-4))}};
}

TEST(Transmittance, EqualsClosedForms) {
  for (const Slab& s : slabs())
    for (const Rgb& extinction : {Rgb(1), Rgb(0, 0.4f, 3), Rgb(0.1f)}) {
      const HeterogeneousMedium medium = slab(coefficients(0.5f * extinction, 0.5f * extinction), s.density);
      for (const TransmittanceEstimator estimator : kEstimators) {
        RandomStream random(7);
        Statistic channels[3];
        for (int i = 0; i < 20000; ++i) {
          const Rgb t = estimated_transmittance(medium, kUp, estimator, random);
          for (int c = 0; c < 3; ++c) channels[c].add(static_cast<double>(t[c]));
        }
        for (int c = 0; c < 3; ++c)
          expect_mean(channels[c], std::exp(-static_cast<double>(extinction[c]) * s.integral), 0.008,
                      std::string(s.name) + ", estimator " + std::to_string(static_cast<int>(estimator)) +
                          ", channel " + std::to_string(c));
      }
    }
}

// Ratio tracking has less variance than delta tracking; regular tracking has none.
TEST(Transmittance, VarianceOfTheEstimators) {
  const HeterogeneousMedium medium = slab(coefficients(Rgb(2), Rgb(0)), linear(0.5, 1.5));
  double variance[4];
  for (const TransmittanceEstimator estimator : kEstimators) {
    RandomStream random(11);
    Statistic s;
    for (int i = 0; i < 20000; ++i)
      s.add(static_cast<double>(estimated_transmittance(medium, kUp, estimator, random).g));
    variance[static_cast<size_t>(estimator)] = s.error() * s.error() * s.count;
  }
  EXPECT_LT(variance[1], variance[0]);
  EXPECT_LT(variance[2], 0.1 * variance[1]);
  EXPECT_LT(variance[3], 1e-12);
}

TEST(Transmittance, OfOpticalDepth100IsFinite) {
  const HeterogeneousMedium medium = slab(coefficients(Rgb(100, 1e6f, 0), Rgb(0)), linear(0, 2));
  for (const TransmittanceEstimator estimator : kEstimators) {
    RandomStream random(5);
    for (int i = 0; i < 100; ++i) {
      const Rgb t = estimated_transmittance(medium, kUp, estimator, random);
      EXPECT_TRUE(is_finite(t));
      EXPECT_LT(t.r, 1e-3f);
    }
  }
}

// Collisions, distances and passages of a free flight through a slab, in each channel.
struct Flights {
  Statistic passed[3], collided[3], moment[3];
};

Flights flights(const HeterogeneousMedium& medium, const Rgb& throughput, int count) {
  Flights f;
  RandomStream random(3);
  for (int i = 0; i < count; ++i) {
    FreeFlight flight(throughput, random.next());
    const auto at = flight.pass(medium, kUp, random);
    const Rgb weight = flight.weight();
    for (int c = 0; c < 3; ++c) {
      const auto value = static_cast<double>(throughput[c] * weight[c]);
      f.passed[c].add(at ? 0 : value);
      f.collided[c].add(at ? value : 0);
      f.moment[c].add(at ? value * static_cast<double>(2 * *at - 1) : 0);
    }
  }
  return f;
}

// The integral over the height of sigma_s density(y) exp(-sigma_t depth(y)) y^power.
double collided(double scattering, double extinction, double bottom, double top, int power) {
  constexpr int kSlices = 20000;
  double sum = 0;
  for (int i = 0; i < kSlices; ++i) {
    const double y = (i + 0.5) / kSlices, density = bottom + (top - bottom) * y,
                 depth = bottom * y + 0.5 * (top - bottom) * y * y;
    sum += scattering * density * std::exp(-extinction * depth) * std::pow(y, power) / kSlices;
  }
  return sum;
}

TEST(DeltaTracking, EqualsClosedFormsInEachChannel) {
  const Rgb scattering(0.2f, 1, 3), absorption(0.5f, 0.1f, 0);
  for (const auto& [bottom, top] : {std::pair(2.0, 0.5), std::pair(0.0, 3.0)}) {
    const HeterogeneousMedium medium = slab(coefficients(scattering, absorption), linear(bottom, top));
    for (const Rgb& throughput : {Rgb(1), Rgb(1, 0.2f, 0.05f), Rgb(0, 2, 1)}) {
      const Flights f = flights(medium, throughput, 100000);
      for (int c = 0; c < 3; ++c) {
        const auto t = static_cast<double>(throughput[c]), s = static_cast<double>(scattering[c]),
                   k = s + static_cast<double>(absorption[c]);
        const std::string what = "channel " + std::to_string(c);
        expect_mean(f.passed[c], t * std::exp(-k * 0.5 * (bottom + top)), 0.01, what + ", passed");
        expect_mean(f.collided[c], t * collided(s, k, bottom, top, 0), 0.01, what + ", collided");
        expect_mean(f.moment[c], t * collided(s, k, bottom, top, 1), 0.01, what + ", moment");
      }
    }
  }
}

// With the same first random number, distance and weight are those of the homogeneous medium.
TEST(DeltaTracking, InAConstantGridEqualsTheHomogeneousMedium) {
  const MediumDescription m = coefficients({0.2f, 1, 3}, {0.5f, 0.1f, 0});
  const HeterogeneousMedium medium = slab(m, make_density("constant"));
  const HomogeneousMedium homogeneous(m);
  for (int i = 0; i < 1000; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / 1000;
    RandomStream random(static_cast<uint32_t>(i));
    FreeFlight a({1, 0.5f, 0.2f}, u), b({1, 0.5f, 0.2f}, u);
    const auto at = a.pass(medium, kUp, random);
    const auto distance = b.pass(homogeneous, 1);
    ASSERT_EQ(bool{at}, bool{distance});
    EXPECT_NEAR(at ? 2 * *at - 1 : 0, distance.value_or(0), 1e-5f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.weight()[c], b.weight()[c], 1e-4f * b.weight()[c]);
  }
}

TEST(DeltaTracking, WeightsAreBounded) {
  const HeterogeneousMedium medium = slab(coefficients({0.01f, 1, 50}, Rgb(0)), linear(0, 3));
  RandomStream random(9);
  for (int i = 0; i < 10000; ++i) {
    FreeFlight flight(Rgb(1), random.next());
    flight.pass(medium, kUp, random);
    EXPECT_TRUE(is_finite(flight.weight()));
    EXPECT_LE(max_component(flight.weight()), 3.001f);
  }
}

// A slab that absorbs and emits: L = L_e (1 - exp(-sigma_a depth)), whatever the density.
TEST(Emission, OfASlabEqualsItsClosedForm) {
  for (const Slab& s : slabs()) {
    MediumDescription m = coefficients(Rgb(0), {0.5f, 2, 0});
    m.emission = {3, 1, 5};
    const HeterogeneousMedium medium = slab(m, s.density);
    RandomStream random(13);
    Statistic channels[3];
    for (int i = 0; i < 50000; ++i) {
      Rgb emitted(0);
      transmittance_and_emission(medium, kUp, random, emitted);
      for (int c = 0; c < 3; ++c) channels[c].add(static_cast<double>(emitted[c]));
    }
    for (int c = 0; c < 3; ++c)
      expect_mean(channels[c],
                  static_cast<double>(m.emission[c]) * -std::expm1(-static_cast<double>(m.absorption[c]) * s.integral),
                  0.02, std::string(s.name) + ", channel " + std::to_string(c));
  }
}

// The same with scattering: light emitted before the first collision.
TEST(Emission, DuringAFreeFlight) {
  MediumDescription m = coefficients({1, 0.2f, 2}, {0.5f, 2, 0.1f});
  m.emission = {3, 1, 5};
  for (const Slab& s : slabs()) {
    const HeterogeneousMedium medium = slab(m, s.density);
    RandomStream random(17);
    Statistic channels[3];
    for (int i = 0; i < 50000; ++i) {
      FreeFlight flight(Rgb(1), random.next());
      flight.pass(medium, kUp, random);
      for (int c = 0; c < 3; ++c) channels[c].add(static_cast<double>(flight.emitted()[c]));
    }
    for (int c = 0; c < 3; ++c) {
      const auto a = static_cast<double>(m.absorption[c]), k = a + static_cast<double>(m.scattering[c]);
      expect_mean(channels[c], static_cast<double>(m.emission[c]) * a / k * -std::expm1(-k * s.integral), 0.02,
                  std::string(s.name) + ", channel " + std::to_string(c));
    }
  }
}

TEST(Emission, OfABlackBody) {
  MediumDescription m = coefficients(Rgb(0), Rgb(1));
  m.emission = Rgb(2);
  m.temperature = 3000;
  const HeterogeneousMedium medium = slab(m, make_density("constant"));
  const Rgb hottest = medium.emitted(Vec3(0.5f), 1);
  EXPECT_NEAR(luminance(hottest), 2, 1e-4f);
  EXPECT_GT(hottest.r, hottest.g);
  EXPECT_GT(hottest.g, hottest.b);
  EXPECT_NEAR(luminance(HomogeneousMedium(m).emission), 2, 1e-4f);
}

// The survival of a flight depends on neither the random numbers nor the direction, and is that of a homogeneous medium
// in a grid of constant density.
TEST(HeterogeneousMedium, SurvivalIsAFunctionOfTheSpan) {
  const MediumDescription m = coefficients({3, 1, 0.2f}, {0, 1, 0.5f});
  const HeterogeneousMedium cloud = slab(m, make_density("cloud")),
                            constant = slab(m, *make_density("constant", {{"value", 1.0}}));
  RandomStream random(5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 a(random.next(), random.next(), random.next()), b(random.next(), random.next(), random.next());
    FreeFlight flight(Rgb(1, 0.3f, 0.5f), random.next());
    const auto at = flight.pass(cloud, {a, b - a, 0, 1}, random);
    FreeFlight back = FreeFlight::without_collision(Rgb(1));
    back.pass(cloud, {a + (b - a) * at.value_or(1), a - b, 0, at.value_or(1)}, random);
    EXPECT_NEAR(flight.survival(), back.survival(), 1e-4f * back.survival() + 1e-6f);

    FreeFlight in_grid = FreeFlight::without_collision(Rgb(1)), homogeneous = FreeFlight::without_collision(Rgb(1));
    in_grid.pass(constant, {a, b - a, 0, 1}, random);
    homogeneous.pass(HomogeneousMedium(m), glm::distance(a, b));
    EXPECT_NEAR(in_grid.survival(), homogeneous.survival(), 1e-4f * homogeneous.survival());
  }
}

// The weight of a flight that is known to have no collision is that of the exact optical depth, by the balance
// heuristic.
TEST(HeterogeneousMedium, FlightsWithoutCollisionsAreExact) {
  const HeterogeneousMedium m = slab(coefficients({3, 1, 0.2f}, {0, 1, 0.5f}), linear(1, 3));
  const Rgb throughput(1, 0.25f, 0.75f);
  RandomStream random(6);
  FreeFlight flight = FreeFlight::without_collision(throughput);
  flight.pass(m, kUp, random);
  Rgb transmittance;
  float probability = 0;
  for (int c = 0; c < 3; ++c) {
    transmittance[c] = std::exp(-2 * m.extinction[c]);
    probability += throughput[c] / 2 * transmittance[c];
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(flight.weight()[c], transmittance[c] / probability, 1e-4f);
}

}  // namespace
}  // namespace etendue
