// The tail index khat of samples with known index, with error rates; moments against the samples; merging.
#include "film/tail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <span>
#include <vector>

namespace etendue::film {
namespace {

// Strictly between zero and one.
struct Uniform {
  std::mt19937_64 engine;
  double operator()() { return (static_cast<double>(engine() >> 12) + 0.5) * 0x1p-52; }
};

using Draw = std::function<double(Uniform&)>;

Draw pareto(double alpha) {
  return [alpha](Uniform& u) { return std::pow(u(), -1 / alpha); };
}
// The absolute value of Student's t with two degrees of freedom in closed form, and of the Cauchy distribution.
double student2(Uniform& u) {
  const double p = 2 * u() - 1;
  return std::abs(p) * std::sqrt(2 / (1 - p * p));
}
double cauchy(Uniform& u) { return std::abs(std::tan(3.14159265358979 * (u() - 0.5))); }
double exponential(Uniform& u) { return -std::log(u()); }
double uniform(Uniform& u) { return u(); }

// The tail of the samples relative to the expectation.
Tail report_of(std::span<const double> x, double expected = 0, size_t capacity = 8192) {
  std::vector<float> deviations;
  for (const double v : x) deviations.push_back(static_cast<float>(v - expected));
  TailAccumulator tail(capacity);
  tail.add(deviations, std::accumulate(x.begin(), x.end(), 0.0));
  return tail.report();
}

std::vector<double> drawn(const Draw& draw, Uniform& random, int samples) {
  std::vector<double> x(static_cast<size_t>(samples));
  for (double& v : x) v = draw(random);
  return x;
}

constexpr int kRuns = 200;

struct Runs {
  double mean = 0, deviation = 0;
  int heavy = 0;
};

Runs run(const Draw& draw, int samples) {
  Runs runs;
  double squares = 0;
  for (int r = 0; r < kRuns; ++r) {
    Uniform random{std::mt19937_64(static_cast<uint64_t>(r) + 1)};
    const Tail t = report_of(drawn(draw, random, samples));
    runs.mean += *t.khat / kRuns;
    squares += *t.khat * *t.khat / kRuns;
    runs.heavy += t.heavy();
  }
  runs.deviation = std::sqrt(squares - runs.mean * runs.mean);
  return runs;
}

// At 20,000 samples the tail has 425 samples; the standard error of the index is about (1 + k) / sqrt(425).
TEST(Tail, InfiniteVarianceIsDetected) {
  // Missed in at most 1 % of the runs.
  EXPECT_GE(run(pareto(1), 20'000).heavy, 198);
  EXPECT_GE(run(cauchy, 20'000).heavy, 198);
  EXPECT_EQ(run(pareto(0.7), 20'000).heavy, kRuns);
  // k = 0.8, near the limit: missed in at most 10 % of the runs, at 100,000 samples.
  EXPECT_GE(run(pareto(1.25), 100'000).heavy, 180);
}

TEST(Tail, FiniteVarianceIsNotFlagged) {
  EXPECT_EQ(run(uniform, 20'000).heavy, 0);
  EXPECT_EQ(run(exponential, 20'000).heavy, 0);
  EXPECT_EQ(run(pareto(4), 20'000).heavy, 0);
  EXPECT_LE(run(pareto(2.5), 20'000).heavy, 1);
  // At k = 1/2 the variance diverges logarithmically. It must not be flagged either: at most 2 % false alarms.
  EXPECT_LE(run(student2, 20'000).heavy, 4);
}

TEST(Tail, IndexMatchesTheDistribution) {
  struct Case {
    const char* name;
    Draw draw;
    double k;
    double bias = 0.01;  // of the fit; it grows below -1/2, outside the range of its theory [Zhang and Stephens 2009]
  };
  for (const Case& c : {Case{"Pareto 1", pareto(1), 1},
                        {"Pareto 2", pareto(2), 0.5},
                        {"Pareto 4", pareto(4), 0.25},
                        {"Cauchy", cauchy, 1},
                        {"Student 2", student2, 0.5},
                        {"exponential", exponential, 0},
                        {"uniform", uniform, -1, 0.04}}) {
    const Runs runs = run(c.draw, 20'000);
    // The prior moves k by (1/2 - k) 10/435. The standard error of the mean is a fourteenth of the standard deviation
    // of a run.
    const double expected = c.k + (0.5 - c.k) * 10 / 435;
    EXPECT_NEAR(runs.mean, expected, 4 * runs.deviation / std::sqrt(kRuns) + c.bias) << c.name;
    EXPECT_NEAR(runs.deviation, (1 + std::max(c.k, -0.5)) / std::sqrt(425), 0.03) << c.name;
  }
}

TEST(Tail, VarianceOfTheVarianceFollowsFromTheFourthMoment) {
  struct Case {
    Draw draw;
    double mean, kurtosis;
  };
  for (const Case& c : {Case{exponential, 1, 9}, {uniform, 0.5, 1.8}}) {
    Uniform random{std::mt19937_64(3)};
    constexpr int kSamples = 400'000;
    const Tail t = report_of(drawn(c.draw, random, kSamples), c.mean);
    EXPECT_NEAR(t.vov * kSamples, c.kurtosis - 1, 0.1 * c.kurtosis);
  }
}

// For squares without a mean, the sum of p^2 over their shares p has the expectation 1 - alpha / 2 [Pitman and Yor
// 1997]. Its standard deviation is known to a twentieth from 200 runs. Two per cent is four times the error of the
// mean.
TEST(Tail, VarianceOfTheVarianceStaysForInfiniteVariance) {
  for (const double alpha : {0.7, 1.0, 1.4}) {
    for (const int samples : {2000, 50'000}) {
      double mean = 0, squares = 0;
      for (int r = 0; r < kRuns; ++r) {
        Uniform random{std::mt19937_64(static_cast<uint64_t>(r) + 1)};
        const double vov = report_of(drawn(pareto(alpha), random, samples)).vov;
        mean += vov / kRuns;
        squares += vov * vov / kRuns;
      }
      const double error = std::sqrt((squares - mean * mean) / kRuns);
      // The smallest squares do not follow a power law; their contribution is of order n^(1 - 2 / alpha).
      EXPECT_NEAR(mean, 1 - alpha / 2, 4 * error + 2 * std::pow(samples, 1 - 2 / alpha)) << alpha << " " << samples;
    }
  }
}

TEST(Tail, MomentsAndSharesEqualThoseOfTheSamples) {
  Uniform random{std::mt19937_64(9)};
  std::vector<double> x = drawn(pareto(1.5), random, 30'000);
  const auto n = static_cast<double>(x.size());
  const double total = std::accumulate(x.begin(), x.end(), 0.0), mean = total / n;
  const Tail t = report_of(x, mean);
  double second = 0, fourth = 0;
  for (const double v : x) {
    second += std::pow(v - mean, 2);
    fourth += std::pow(v - mean, 4);
  }
  EXPECT_NEAR(t.vov, fourth / (second * second) - 1 / n, 1e-6);
  std::sort(x.begin(), x.end(), std::greater<>());
  EXPECT_NEAR(t.brightest_share, (x[0] + x[1] + x[2] - 3 * mean) / total, 1e-6);
  EXPECT_FALSE(t.brightest_share_is_lower_bound);
}

// With less memory the threshold is higher: the tail is shorter but complete.
TEST(Tail, LessMemoryOnlyShortensTheTail) {
  Runs runs;
  for (int r = 0; r < kRuns; ++r) {
    Uniform random{std::mt19937_64(static_cast<uint64_t>(r) + 1)};
    const std::vector<double> x = drawn(pareto(1), random, 20'000);
    const Tail much = report_of(x), little = report_of(x, 0, 256);
    EXPECT_EQ(little.vov, much.vov);
    EXPECT_EQ(little.brightest_share, much.brightest_share);
    EXPECT_GT(little.khat_error, much.khat_error);
    runs.mean += *little.khat / kRuns;
    runs.heavy += little.heavy();
  }
  // Tails of 192 samples; the prior has the weight of ten samples at k = 1/2.
  EXPECT_NEAR(runs.mean, 1, 0.05);
  EXPECT_GE(runs.heavy, 190);
}

TEST(Tail, MergedBlocksKeepTheTailOfTheWhole) {
  Uniform random{std::mt19937_64(21)};
  std::vector<float> x(20'000);
  for (float& v : x) v = random() < 0.5 ? -1 : static_cast<float>(pareto(1.3)(random));
  TailAccumulator whole(2048);
  whole.add(x, 1);
  const Tail expected = whole.report();
  for (const size_t blocks : {2U, 5U, 64U}) {
    std::vector<TailAccumulator> parts(blocks, TailAccumulator(2048));
    for (size_t i = x.size(); i-- > 0;) parts[i * 7 % blocks].add(std::span(x).subspan(i, 1), 1.0 / x.size());
    TailAccumulator merged(2048);
    for (size_t i = blocks; i-- > 0;) merged.merge(parts[i]);
    const Tail t = merged.report();
    EXPECT_EQ(t.samples, expected.samples);
    EXPECT_EQ(*t.khat, *expected.khat);
    EXPECT_NEAR(t.vov, expected.vov, 1e-12);
    EXPECT_NEAR(t.brightest_share, expected.brightest_share, 1e-9);
  }
}

TEST(Tail, IsScaleInvariant) {
  Uniform random{std::mt19937_64(2)};
  const std::vector<double> x = drawn(pareto(2), random, 5000);
  std::vector<double> dim = x, bright = x;
  for (double& v : dim) v *= 0x1p-20;
  for (double& v : bright) v *= 0x1p20;
  const Tail a = report_of(dim), b = report_of(bright);
  EXPECT_NEAR(*a.khat, *b.khat, 1e-9);
  EXPECT_NEAR(a.vov, b.vov, 1e-9);
  EXPECT_NEAR(a.brightest_share, b.brightest_share, 1e-9);
}

TEST(Tail, DegenerateCases) {
  std::vector<double> few;
  EXPECT_FALSE(report_of(few).khat);
  EXPECT_EQ(report_of(few).brightest_share, 0);
  for (int i = 0; i < 24; ++i) few.push_back(i);
  EXPECT_FALSE(report_of(few).khat);
  few.push_back(24);
  EXPECT_TRUE(report_of(few).khat);

  // Black, constant, and two-valued samples have no tail.
  for (const double high : {0.0, 3.0}) {
    std::vector<double> flat, two;
    for (int i = 0; i < 10'000; ++i) {
      flat.push_back(high);
      two.push_back(i % 2 ? high : 1.0);
    }
    for (const Tail& t : {report_of(flat), report_of(two), report_of(flat, 0, 64), report_of(two, 0, 64)}) {
      ASSERT_TRUE(t.khat);
      EXPECT_FALSE(t.heavy());
      EXPECT_LE(*t.khat, 0);
      EXPECT_TRUE(std::isfinite(t.vov) && std::isfinite(t.brightest_share));
    }
  }
  // A black image with a few bright pixels.
  std::vector<double> dots;
  for (int i = 0; i < 100'000; ++i) dots.push_back(i % 10'000 == 0 ? 1000 + i : 0);
  const Tail t = report_of(dots);
  ASSERT_TRUE(t.khat);
  EXPECT_NEAR(t.brightest_share, 1, 1e-12);
  EXPECT_GT(t.vov, 0.05);

  // Three bright pixels are too few for an estimate, so there is none.
  std::vector<double> three;
  for (int i = 0; i < 100'000; ++i) three.push_back(i % 40'000 == 0 ? 1000 + i : 0);
  EXPECT_FALSE(report_of(three).khat);
  EXPECT_FALSE(report_of(three).heavy());
  EXPECT_EQ(report_of(three).p_value(), 1);

  const std::vector<double> alike(200'000, 1.0);
  EXPECT_TRUE(report_of(alike, 0, 16).brightest_share_is_lower_bound);
  EXPECT_FALSE(report_of(alike, 1, 16).brightest_share_is_lower_bound);
}

}  // namespace
}  // namespace etendue::film
