// The nesting depth of JSON texts.
#include "base/json_nesting.h"

#include <gtest/gtest.h>

#include <string>

namespace etendue {
namespace {

TEST(JsonNesting, CountsOpenArraysAndObjects) {
  EXPECT_EQ(json_nesting(""), 0);
  EXPECT_EQ(json_nesting("1"), 0);
  EXPECT_EQ(json_nesting("[]"), 1);
  EXPECT_EQ(json_nesting(R"({"a": [1, {"b": 2}], "c": [3]})"), 3);
  EXPECT_EQ(json_nesting(R"([[], [], [[]]])"), 3);
}

TEST(JsonNesting, IgnoresBracketsInStrings) {
  EXPECT_EQ(json_nesting(R"(["[[[", "\"[[", "\\", []])"), 2);
  EXPECT_EQ(json_nesting(R"({"[{[": 1})"), 1);
}

TEST(JsonNesting, TakesInvalidTexts) {
  EXPECT_EQ(json_nesting(std::string(1000, '[')), 1000);
  EXPECT_EQ(json_nesting("]]]["), 0);
  EXPECT_EQ(json_nesting("[\"\\"), 1);
}

}  // namespace
}  // namespace etendue
