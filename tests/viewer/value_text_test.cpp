// Numbers and times as text.
#include "viewer/widgets/value_text.h"

#include <gtest/gtest.h>

namespace etendue::viewer {
namespace {

TEST(ValueText, DurationsAreClockTimes) {
  EXPECT_EQ(clock_text(48.9), "0:48");
  EXPECT_EQ(clock_text(3723), "1:02:03");
}

TEST(ValueText, TheTimeLeftIsARangeThatIsNotNegative) {
  EXPECT_EQ(remaining_time(48, 42, 54), "0:42 to 0:54 left");
  EXPECT_EQ(remaining_time(2332, -1167, 5831), "0:00 to 1:37:11 left");
}

TEST(ValueText, AShortRangeIsOneTime) { EXPECT_EQ(remaining_time(48.5, 48.1, 48.9), "0:48 left"); }

TEST(ValueText, LongTimesAreDays) {
  EXPECT_EQ(remaining_time(1e9, 1e6, 1e10), "days left");
  EXPECT_EQ(remaining_time(3600, 600, 1e7), "10:00 to days left");
}

}  // namespace
}  // namespace etendue::viewer
