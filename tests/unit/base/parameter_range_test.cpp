// Ranges of numbers: limits are single-precision values, and texts are read in double precision.
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "base/parameter.h"

namespace etendue {
namespace {

ParameterInfo number(float min, float max) {
  ParameterInfo info;
  info.name = "x";
  info.min = static_cast<double>(min);
  info.max = static_cast<double>(max);
  return info;
}

TEST(ParameterRange, ContainsItsLimitsAsTheyAreWritten) {
  const ParameterInfo info = number(0.001f, 0.7f);  // the first is more than 0.001, the second less than 0.7
  const auto least = parse_value(info, "0.001"), most = parse_value(info, "0.7");
  ASSERT_TRUE(least && most);
  EXPECT_EQ(std::get<double>(*least), info.min);
  EXPECT_EQ(std::get<double>(*most), info.max);
  EXPECT_TRUE(parse_value(info, "0.25"));
}

TEST(ParameterRange, ContainsNothingElse) {
  const ParameterInfo info = number(0.001f, 0.7f);
  for (const std::string text : {"0.000999", "0.70001", "-0.001", "1e300", "-1e300", "1e39", "nan", "inf", "-inf", ""})
    EXPECT_FALSE(parse_value(info, text)) << text;
}

}  // namespace
}  // namespace etendue
