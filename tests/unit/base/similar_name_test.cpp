// Names that a typing error may have changed.
#include "base/similar_name.h"

#include <gtest/gtest.h>

namespace etendue {
namespace {

const std::vector<std::string> kNames{"path", "path-pure", "light"};

TEST(SimilarName, EditDistanceCountsLetters) {
  EXPECT_EQ(edit_distance("path", "path"), 0U);
  EXPECT_EQ(edit_distance("pth", "path"), 1U);
  EXPECT_EQ(edit_distance("", "path"), 4U);
  EXPECT_EQ(edit_distance("light", "night"), 1U);
}

TEST(SimilarName, AProbableNameHasAtMostTwoErrors) {
  EXPECT_EQ(probable_name("pathh", kNames), "path");
  EXPECT_EQ(probable_name("lght", kNames), "light");
  EXPECT_EQ(probable_name("lixxx", kNames), "");
  EXPECT_EQ(probable_name("xy", kNames), "") << "half of the letters have to be right";
  EXPECT_EQ(probable_name("path", {}), "");
}

TEST(SimilarName, AsksForTheProbableName) {
  EXPECT_EQ(did_you_mean("pathh", kNames), "; did you mean 'path'?");
  EXPECT_EQ(did_you_mean("sobol", kNames), "");
}

}  // namespace
}  // namespace etendue
