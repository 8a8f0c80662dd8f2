// Focal length and f-number.
#include "camera/lens_units.h"

#include <gtest/gtest.h>

namespace etendue {
namespace {

TEST(LensUnits, KnownLenses) {
  // Vertical angles of view of full-frame lenses, from tables of their makers: 50 mm 27.0, 24 mm 53.1, 200 mm 6.87 degrees.
  const double degree = M_PI / 180;
  EXPECT_NEAR(angle_of_view(50, kFullFrameHeight) / degree, 27.0, 0.05);
  EXPECT_NEAR(angle_of_view(24, kFullFrameHeight) / degree, 53.1, 0.05);
  EXPECT_NEAR(angle_of_view(200, kFullFrameHeight) / degree, 6.87, 0.005);
  EXPECT_DOUBLE_EQ(angle_of_view(12, 24), M_PI / 2);
  EXPECT_DOUBLE_EQ(lens_radius(50, 2), 12.5);  // the aperture of a 50 mm f/2 lens is 25 mm wide
}

TEST(LensUnits, ConversionsAreInverse) {
  for (const double height : {4.8, 15.6, 24.0, 33.0})
    for (const double f : {1.0, 8.0, 35.0, 85.0, 1200.0}) {
      EXPECT_NEAR(focal_length(angle_of_view(f, height), height), f, 1e-12 * f);
      for (const double n : {0.7, 1.4, 8.0, 64.0}) EXPECT_NEAR(f_number(f, lens_radius(f, n)), n, 1e-12 * n);
    }
}

TEST(LensUnits, PinholesHaveTheFNumberZero) {
  EXPECT_EQ(f_number(50, 0), 0);
  EXPECT_EQ(lens_radius(50, 0), 0);
}

}  // namespace
}  // namespace etendue
