// The tail index on samples whose index is known, with error rates; moments against the samples themselves; merging.
#include "measure/tail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

namespace etendue::measure {
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
// The absolute value of Student's t with two degrees of freedom in closed form, and of Cauchy's distribution.
double student2(Uniform& u) {
  const double p = 2 * u() - 1;
  return std::abs(p) * std::sqrt(2 / (1 - p * p));
}
double cauchy(Uniform& u) { return std::abs(std::tan(3.14159265358979 * (u() - 0.5))); }
double exponential(Uniform& u) { return -std::log(u()); }
double uniform(Uniform& u) { return u(); }

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
    TailAccumulator tail(1024);
    for (int i = 0; i < samples; ++i) tail.add(draw(random));
    const Tail t = tail.report();
    runs.mean += *t.khat / kRuns, squares += *t.khat * *t.khat / kRuns;
    runs.heavy += t.heavy();
  }
  runs.deviation = std::sqrt(squares - runs.mean * runs.mean);
  return runs;
}

// At 20,000 samples 425 are the tail; the index is known to about (1 + k) / sqrt(425).
TEST(Tail, InfiniteVarianceIsFlagged) {
  // Missed in 1 % of the runs at most.
  EXPECT_GE(run(pareto(1), 20'000).heavy, 198);
  EXPECT_GE(run(cauchy, 20'000).heavy, 198);
  EXPECT_EQ(run(pareto(0.7), 20'000).heavy, kRuns);
  // k = 0.8, near the limit: in 10 % at most, at 100,000 samples.
  EXPECT_GE(run(pareto(1.25), 100'000).heavy, 180);
}

TEST(Tail, WhatHasAVarianceIsNot) {
  EXPECT_EQ(run(uniform, 20'000).heavy, 0);
  EXPECT_EQ(run(exponential, 20'000).heavy, 0);
  EXPECT_EQ(run(pareto(4), 20'000).heavy, 0);
  EXPECT_LE(run(pareto(2.5), 20'000).heavy, 1);
  // At 1/2, where the variance is infinite by a logarithm only, nothing is said either: 2 % of false alarms at most.
  EXPECT_LE(run(student2, 20'000).heavy, 4);
}

TEST(Tail, TheIndexIsThatOfTheDistribution) {
  struct Case {
    const char* name;
    Draw draw;
    double k;
    double bias = 0.01;  // of the fit; it grows below -1/2, where its theory ends (Zhang & Stephens)
  };
  for (const Case& c : {Case{"Pareto 1", pareto(1), 1},
                        {"Pareto 2", pareto(2), 0.5},
                        {"Pareto 4", pareto(4), 0.25},
                        {"Cauchy", cauchy, 1},
                        {"Student 2", student2, 0.5},
                        {"exponential", exponential, 0},
                        {"uniform", uniform, -1, 0.04}}) {
    const Runs runs = run(c.draw, 20'000);
    // The prior moves k by (1/2 - k) 10/435; the mean of the runs is known to a fourteenth of their deviation.
    const double expected = c.k + (0.5 - c.k) * 10 / 435;
    EXPECT_NEAR(runs.mean, expected, 4 * runs.deviation / std::sqrt(kRuns) + c.bias) << c.name;
    EXPECT_NEAR(runs.deviation, (1 + std::max(c.k, -0.5)) / std::sqrt(425), 0.03) << c.name;
  }
}

TEST(Tail, TheVarianceOfTheVarianceFollowsFromTheFourthMoment) {
  struct Case {
    Draw draw;
    double kurtosis;
  };
  for (const Case& c : {Case{exponential, 9}, {uniform, 1.8}}) {
    Uniform random{std::mt19937_64(3)};
    TailAccumulator tail;
    constexpr int kSamples = 400'000;
    for (int i = 0; i < kSamples; ++i) tail.add(c.draw(random));
    EXPECT_NEAR(tail.report().vov * kSamples, c.kurtosis - 1, 0.1 * c.kurtosis);
  }
  Uniform random{std::mt19937_64(4)};
  TailAccumulator wild;
  for (int i = 0; i < 400'000; ++i) wild.add(cauchy(random));
  EXPECT_GT(wild.report().vov, 0.1);
}

TEST(Tail, MomentsAndSharesAreThoseOfTheSamples) {
  Uniform random{std::mt19937_64(9)};
  std::vector<double> x(30'000);
  for (double& v : x) v = pareto(1.5)(random);
  TailAccumulator tail;
  for (const double v : x) tail.add(v);
  const Tail t = tail.report();
  const auto n = static_cast<double>(x.size());
  const double total = std::accumulate(x.begin(), x.end(), 0.0), mean = total / n;
  double second = 0, fourth = 0;
  for (const double v : x) second += std::pow(v - mean, 2), fourth += std::pow(v - mean, 4);
  EXPECT_NEAR(t.vov, fourth / (second * second) - 1 / n, 1e-9);
  std::sort(x.begin(), x.end(), std::greater<>());
  EXPECT_NEAR(t.brightest, (x[0] + x[1] + x[2]) / total, 1e-12);
  EXPECT_FALSE(t.brightest_is_bound);
}

TEST(Tail, MergedInAnyOrderToTheSameBits) {
  Uniform random{std::mt19937_64(21)};
  std::vector<double> x(20'000);
  for (double& v : x) v = random() < 0.5 ? 0 : pareto(1.3)(random);
  TailAccumulator whole(500);
  for (const double v : x) whole.add(v);
  const Tail expected = whole.report();
  for (const size_t blocks : {2U, 5U, 64U}) {
    std::vector<TailAccumulator> parts(blocks, TailAccumulator(500));
    for (size_t i = x.size(); i-- > 0;) parts[i * 7 % blocks].add(x[i]);
    TailAccumulator merged(500);
    for (size_t i = blocks; i-- > 0;) merged.merge(parts[i]);
    const Tail t = merged.report();
    EXPECT_EQ(t.samples, expected.samples);
    EXPECT_EQ(std::bit_cast<uint64_t>(*t.khat), std::bit_cast<uint64_t>(*expected.khat));
    EXPECT_EQ(std::bit_cast<uint64_t>(t.vov), std::bit_cast<uint64_t>(expected.vov));
    EXPECT_EQ(std::bit_cast<uint64_t>(t.brightest), std::bit_cast<uint64_t>(expected.brightest));
  }
}

TEST(Tail, TheUnitDoesNotMatter) {
  Uniform random{std::mt19937_64(2)};
  TailAccumulator dim, bright;
  for (int i = 0; i < 5000; ++i) {
    const double v = pareto(2)(random);
    dim.add(v * 1e-6), bright.add(v * 1e6);
  }
  EXPECT_NEAR(*dim.report().khat, *bright.report().khat, 1e-9);
  EXPECT_NEAR(dim.report().vov, bright.report().vov, 1e-9);
  EXPECT_NEAR(dim.report().brightest, bright.report().brightest, 1e-9);
}

TEST(Tail, EdgesAreSaid) {
  TailAccumulator few;
  EXPECT_FALSE(few.report().khat);
  EXPECT_EQ(few.report().brightest, 0);
  for (int i = 0; i < 24; ++i) few.add(i);
  EXPECT_FALSE(few.report().khat);
  few.add(24);
  EXPECT_TRUE(few.report().khat);

  // Black, constant, and two values: no tail.
  for (const double high : {0.0, 3.0}) {
    TailAccumulator flat, two;
    for (int i = 0; i < 10'000; ++i) flat.add(high), two.add(i % 2 ? high : 1.0);
    for (const Tail& t : {flat.report(), two.report()}) {
      ASSERT_TRUE(t.khat);
      EXPECT_FALSE(t.heavy());
      EXPECT_LE(*t.khat, 0);
      EXPECT_TRUE(std::isfinite(t.vov) && std::isfinite(t.brightest));
    }
  }
  // A black picture with a few bright dots.
  TailAccumulator dots;
  for (int i = 0; i < 100'000; ++i) dots.add(i % 10'000 == 0 ? 1000 + i : 0);
  const Tail t = dots.report();
  ASSERT_TRUE(t.khat);
  EXPECT_NEAR(t.brightest, 1, 1e-12);
  EXPECT_GT(t.vov, 0.05);

  // Three of them are too few to say anything, and nothing is said.
  TailAccumulator three;
  for (int i = 0; i < 100'000; ++i) three.add(i % 40'000 == 0 ? 1000 + i : 0);
  EXPECT_FALSE(three.report().khat);
  EXPECT_FALSE(three.report().heavy());

  TailAccumulator small(10);
  for (int i = 0; i < 200'000; ++i) small.add(1);
  EXPECT_TRUE(small.report().brightest_is_bound);
}

}  // namespace
}  // namespace etendue::measure
