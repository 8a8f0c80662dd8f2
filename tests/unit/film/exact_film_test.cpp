// Films of parts add up to the film of all samples, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "film/film.h"
#include "film/tail.h"

namespace etendue::film {
namespace {

constexpr int kWidth = 70, kHeight = 3;  // three segments of rounding errors per row

// Radiances from 2^-149, the smallest float, to 2^100.
std::vector<Rgb> wide_samples(int count, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> mantissa(0.5f, 1), exponent(-148, 100);
  const auto value = [&] { return std::ldexp(mantissa(engine), static_cast<int>(exponent(engine))); };
  std::vector<Rgb> samples;
  for (int i = 0; i < count; ++i) samples.push_back({value(), value(), value()});
  return samples;
}

Film film_of(const std::vector<Rgb>& samples, const std::vector<size_t>& order) {
  Film film(kWidth, kHeight);
  for (const size_t i : order)
    for (int x = 0; x < kWidth; ++x)
      film.add(x, 1, static_cast<uint32_t>(i % 2), samples[i] * static_cast<float>(x + 1));
  return film;
}

void expect_equal(const Film& a, const Film& b) {
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      ASSERT_EQ(a.samples(x, y), b.samples(x, y));
      ASSERT_EQ(a.mean(x, y), b.mean(x, y));
      ASSERT_EQ(a.variance_of_mean(x, y), b.variance_of_mean(x, y));
      for (const uint32_t half : {0U, 1U}) ASSERT_EQ(a.sum(x, y, half), b.sum(x, y, half));
    }
}

TEST(ExactFilm, MeansDoNotDependOnTheOrderOfSamples) {
  const auto samples = wide_samples(200, 1);
  std::vector<size_t> order(samples.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const Film film = film_of(samples, order);
  std::mt19937 engine(2);
  std::ranges::shuffle(order, engine);
  const Film other = film_of(samples, order);
  expect_equal(film, other);
  // Sums that are rounded after each sample do depend on it.
  bool plain_sums_differ = false;
  for (size_t i = 0; i < film.pixels().size(); ++i)
    plain_sums_differ = plain_sums_differ || film.pixels()[i].sum != other.pixels()[i].sum;
  EXPECT_TRUE(plain_sums_differ);
}

TEST(ExactFilm, FewSamplesHaveNoRoundingErrors) {
  Film film(kWidth, kHeight);
  for (int i = 0; i < 64; ++i) film.add(3, 1, static_cast<uint32_t>(i % 2), Rgb(0.1f + static_cast<float>(i)));
  EXPECT_FALSE(film.rounding_errors().any_at(3, 1));
  film.add(3, 1, 0, Rgb(1e-30f));
  EXPECT_TRUE(film.rounding_errors().any_at(3, 1));
  EXPECT_FALSE(film.rounding_errors().any_at(3, 2));
}

TEST(ExactFilm, CopiesAndBytesKeepTheErrors) {
  const auto samples = wide_samples(100, 3);
  std::vector<size_t> order(samples.size());
  std::iota(order.begin(), order.end(), size_t{0});
  Film film = film_of(samples, order);
  const Film copy = film;
  expect_equal(film, copy);
  Film restored(kWidth, kHeight);
  std::ranges::copy(film.pixels(), restored.pixels().begin());
  ASSERT_TRUE(restored.rounding_errors().restore(film.rounding_errors().bytes()));
  expect_equal(film, restored);
  EXPECT_GT(film.memory(), Film(kWidth, kHeight).memory());
  film.clear_rows(0, kHeight);
  EXPECT_EQ(film.memory(), Film(kWidth, kHeight).memory());
  Film small(1, 1);
  EXPECT_FALSE(small.rounding_errors().restore(copy.rounding_errors().bytes()));
}

// A film whose first sample is number 5 names the samples of its half-buffers 6, 8 and 5, 7.
TEST(ExactFilm, InvalidSamplesHaveTheNumbersOfTheWholeRendering) {
  Film film(1, 1);
  film.set_first_sample(5);
  for (const uint32_t sample : {5U, 6U, 7U, 8U}) film.add(0, 0, sample % 2, Rgb(NAN));
  std::vector<uint32_t> numbers;
  for (const auto& s : film.invalid_samples().first) numbers.push_back(s.sample);
  EXPECT_EQ(numbers, (std::vector<uint32_t>{5, 6, 7, 8}));
}

// States of seven groups of deviations, merged in random order and grouping, against one accumulator of all deviations.
TEST(ExactFilm, TailStatesMergeInAnyOrder) {
  constexpr size_t kCapacity = 64;
  std::mt19937 engine(4);
  std::uniform_real_distribution<float> uniform(0.01f, 1);
  TailAccumulator all(kCapacity);
  std::vector<TailState> states;
  for (int group = 0; group < 7; ++group) {
    TailAccumulator part(kCapacity);
    std::vector<float> deviations;
    for (int i = 0; i < 20 * (group + 1); ++i) deviations.push_back(1 / uniform(engine) - 2);
    part.add(deviations, 1.5 * group);
    all.add(deviations, 1.5 * group);
    states.push_back(part.state());
  }
  const auto merged = [&](const std::vector<size_t>& order) {
    TailState first, second;
    for (size_t i = 0; i < order.size(); ++i) merge(i < 3 ? first : second, states[order[i]], kCapacity);
    merge(first, second, kCapacity);
    return first;
  };
  std::vector<size_t> order{0, 1, 2, 3, 4, 5, 6};
  const TailState reference = merged(order);
  EXPECT_EQ(reference.samples, all.samples());
  EXPECT_EQ(reference.largest, all.state().largest);
  EXPECT_EQ(reference.threshold, all.state().threshold);
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::ranges::shuffle(order, engine);
    EXPECT_EQ(merged(order), reference);
  }
  const std::vector<TailState> list{reference, states[0]};
  const auto bytes = bytes_of(list);
  EXPECT_EQ(tail_states_from(bytes), list);
  EXPECT_FALSE(tail_states_from(std::span(bytes).first(bytes.size() - 1)));
  const TailState continued = TailAccumulator(kCapacity, reference).state();
  EXPECT_EQ(continued.samples, reference.samples);
  EXPECT_EQ(continued.largest, reference.largest);
  EXPECT_EQ(continued.threshold, reference.threshold);
  EXPECT_EQ(continued.fourths.at(0), reference.fourths.at(0));
}

}  // namespace
}  // namespace etendue::film
