#include "base/shared_array.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>

namespace etendue {
namespace {

using Numbers = SharedArray<int>;
static_assert(std::random_access_iterator<Numbers::iterator> && std::random_access_iterator<Numbers::const_iterator>);

constexpr size_t kBlock = Numbers::kBlockSize;

Numbers first_numbers(size_t count) {
  Numbers numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

TEST(SharedArray, CopyKeepsItsElementsWhenTheOriginalChanges) {
  Numbers original = first_numbers(3 * kBlock + 5);
  const Numbers copy = original;
  original[kBlock + 1] = -1;
  EXPECT_EQ(copy[kBlock + 1], static_cast<int>(kBlock) + 1);
  EXPECT_EQ(original[kBlock + 1], -1);
  EXPECT_FALSE(copy == original);
  original[kBlock + 1] = copy[kBlock + 1];
  EXPECT_TRUE(copy == original) << "equal elements in a block of its own";
}

TEST(SharedArray, OnlyUnsharedBlocksAreCompared) {
  Numbers original = first_numbers(4 * kBlock);
  const Numbers copy = original;
  original[2 * kBlock + 7] = 0;
  std::vector<size_t> visited;
  const auto differs = [&](size_t i) { return visited.push_back(i), false; };
  EXPECT_TRUE(std::as_const(original).unshared_agree(copy, differs));
  ASSERT_EQ(visited.size(), kBlock);
  EXPECT_EQ(visited.front(), 2 * kBlock);
  EXPECT_EQ(visited.back(), 3 * kBlock - 1);
}

TEST(SharedArray, ElementsThatAResizeAddsAreValueInitialised) {
  Numbers numbers = first_numbers(kBlock + 10);
  const Numbers copy = numbers;
  numbers.resize(kBlock + 2);
  numbers.resize(kBlock + 10);
  EXPECT_EQ(std::as_const(numbers)[kBlock + 1], static_cast<int>(kBlock) + 1);
  for (size_t i = kBlock + 2; i < numbers.size(); ++i) EXPECT_EQ(std::as_const(numbers)[i], 0) << i;
  EXPECT_EQ(copy[kBlock + 5], static_cast<int>(kBlock) + 5);
  numbers.resize(0);
  EXPECT_TRUE(numbers.empty());
  EXPECT_EQ(numbers.push_back(4), 4);
  EXPECT_EQ(numbers.size(), 1U);
}

TEST(SharedArray, WorksWithAlgorithms) {
  Numbers numbers = first_numbers(2 * kBlock);
  std::ranges::reverse(numbers);
  EXPECT_EQ(numbers.back(), 0);
  std::ranges::sort(numbers);
  EXPECT_TRUE(numbers == first_numbers(2 * kBlock));
  EXPECT_EQ(std::ranges::find(numbers, 130) - numbers.begin(), 130);
}

TEST(SharedArray, ReferencesStayValidWhileTheArrayGrows) {
  SharedArray<std::string> names;
  std::string& first = names.emplace_back();
  for (size_t i = 0; i < 10 * kBlock; ++i) names.push_back("other");
  first = "first";
  EXPECT_EQ(names[0], "first");
}

}  // namespace
}  // namespace etendue
