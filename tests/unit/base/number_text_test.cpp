// Numbers as text: rounding at the borders between formats and units.
#include "base/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace etendue {
namespace {

TEST(NumberText, TextOfAnyLength) {
  const std::string word(1000, 'x');
  EXPECT_EQ(format_text("%s and %d", word.c_str(), 7), word + " and 7");
  EXPECT_EQ(format_text("%s", ""), "");
}

TEST(NumberText, SignificantDigits) {
  EXPECT_EQ(format_number(0.012345), "0.0123");
  EXPECT_EQ(format_number(250), "250");
  EXPECT_EQ(format_number(2.0 / 3, 1), "0.7");
  EXPECT_EQ(format_number(12'345'678, 2), "1.2e+07");
}

TEST(NumberText, Counts) {
  EXPECT_EQ(format_count(0, "light", "lights"), "0 lights");
  EXPECT_EQ(format_count(1, "light", "lights"), "1 light");
  EXPECT_EQ(format_count(2, "light", "lights"), "2 lights");
}

TEST(NumberText, Percentages) {
  EXPECT_EQ(format_percent(0.0042), "0.42 %");
  EXPECT_EQ(format_percent(0.031), "3.1 %");
  EXPECT_EQ(format_percent(0.0994), "9.9 %");
  EXPECT_EQ(format_percent(0.0996), "10 %");
  EXPECT_EQ(format_percent(1), "100 %");
}

TEST(NumberText, Durations) {
  EXPECT_EQ(format_duration(0), "0 s");
  EXPECT_EQ(format_duration(0.012), "12 ms");
  EXPECT_EQ(format_duration(0.82), "0.82 s");
  EXPECT_EQ(format_duration(9.97), "10 s");
  EXPECT_EQ(format_duration(59.4), "59 s");
  EXPECT_EQ(format_duration(59.6), "1 min");
  EXPECT_EQ(format_duration(80), "1 min 20 s");
  EXPECT_EQ(format_duration(3599.7), "1 h");
  EXPECT_EQ(format_duration(2 * 3600 + 5 * 60 + 10), "2 h 5 min");
  EXPECT_EQ(format_duration(76 * 3600), "3 d 4 h");
  EXPECT_EQ(format_duration(std::numeric_limits<double>::infinity()), "unknown");
  EXPECT_EQ(format_duration(std::nan("")), "unknown");
}

TEST(NumberText, ByteSizes) {
  EXPECT_EQ(format_bytes(512), "512 B");
  EXPECT_EQ(format_bytes(1536), "1.5 KiB");
  EXPECT_EQ(format_bytes(312ULL << 20), "312 MiB");
  EXPECT_EQ(format_bytes((1ULL << 30) - 1), "1.0 GiB");
  EXPECT_EQ(format_bytes(5ULL << 42), "20 TiB");
}

TEST(NumberText, Rates) {
  EXPECT_EQ(format_rate(0, "rays"), "0.00 rays/s");
  EXPECT_EQ(format_rate(42, "rays"), "42.0 rays/s");
  EXPECT_EQ(format_rate(1.9e6, "samples"), "1.90 Msamples/s");
  EXPECT_EQ(format_rate(999'700, "samples"), "1.00 Msamples/s");
}

}  // namespace
}  // namespace etendue
