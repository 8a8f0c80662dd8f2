// Numbers in the reports of the advisor.
#include "advisor/report_numbers.h"

#include <gtest/gtest.h>

namespace etendue::test {
namespace {

using Texts = std::vector<std::string>;

TEST(ReportNumbers, PartsAddUpToTheWhole) {
  EXPECT_EQ(advisor::percents(std::vector{0.538, 0.236, 0.226}), (Texts{"54 %", "24 %", "22 %"}));
  EXPECT_EQ(advisor::percents(std::vector{1.0}), (Texts{"100 %"}));
  EXPECT_EQ(advisor::percents(std::vector{1 / 3.0, 1 / 3.0, 1 / 3.0}), (Texts{"34 %", "33 %", "33 %"}));
  EXPECT_EQ(advisor::percents(std::vector<double>{}), Texts());
}

// Small shares keep their digits; with them, the sum is not larger than the whole.
TEST(ReportNumbers, SmallSharesKeepTheirDigits) {
  EXPECT_EQ(advisor::percents(std::vector{0.6, 0.396, 0.0035, 0.0005}), (Texts{"60 %", "39 %", "0.35 %", "0.05 %"}));
}

}  // namespace
}  // namespace etendue::test
