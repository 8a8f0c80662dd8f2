// MediumStack, the set of solids that contain a point, and MediumInterface.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "scene/medium_stack.h"

namespace etendue::scene {
namespace {

TEST(MediumStack, MediumIsTheSmallestNumber) {
  MediumStack stack;
  EXPECT_TRUE(stack.empty());
  EXPECT_EQ(stack.top(), kNoSolid);
  stack.insert(7);
  stack.insert(3);
  stack.insert(5);
  EXPECT_EQ(stack.top(), 3U);
  stack.erase(3);
  EXPECT_EQ(stack.top(), 5U);
  stack.erase(7);
  EXPECT_EQ(stack.top(), 5U);
  stack.erase(5);
  EXPECT_TRUE(stack.empty());
}

TEST(MediumStack, DoesNotDependOnTheOrder) {
  std::vector<uint32_t> order{4, 8, 15, 16, 23};
  MediumStack first;
  for (const uint32_t solid : order) first.insert(solid);
  while (std::next_permutation(order.begin(), order.end())) {
    MediumStack other;
    for (const uint32_t solid : order) other.insert(solid);
    EXPECT_EQ(first, other);
  }
}

// Meshes may be open: a path can enter or leave a solid twice.
TEST(MediumStack, IgnoresRepeatedInsertionAndErasure) {
  MediumStack stack, once;
  stack.insert(2);
  stack.insert(2);
  stack.erase(9);
  once.insert(2);
  EXPECT_EQ(stack, once);
  stack.erase(2);
  stack.erase(2);
  EXPECT_TRUE(stack.empty());
}

TEST(MediumStack, DropsTheLowestPriorityWhenItIsFull) {
  MediumStack stack;
  for (uint32_t solid = 0; solid < MediumStack::kCapacity; ++solid) stack.insert(2 * solid + 1);
  stack.insert(1000);
  EXPECT_FALSE(stack.contains(1000));
  stack.insert(0);
  EXPECT_EQ(stack.top(), 0U);
  EXPECT_EQ(stack.solids().size(), MediumStack::kCapacity);
  EXPECT_FALSE(stack.contains(2 * MediumStack::kCapacity - 1));
  EXPECT_TRUE(stack.contains(2 * MediumStack::kCapacity - 3));
}

TEST(MediumInterface, HasTheSolidsOfBothSides) {
  MediumStack stack;
  stack.insert(9);
  stack.insert(4);
  MediumInterface interface;
  interface.clear(stack);
  interface.add_boundary(4, true);
  interface.add_boundary(2, false);
  EXPECT_EQ(interface.top(true), 2U);
  EXPECT_EQ(interface.top(false), 4U);
  MediumStack front, back;
  front.insert(2);
  front.insert(9);
  back.insert(4);
  back.insert(9);
  EXPECT_EQ(interface.side(true), front);
  EXPECT_EQ(interface.side(false), back);
  interface.flip();
  EXPECT_EQ(interface.side(true), back);
  EXPECT_EQ(interface.top(false), 2U);
}

}  // namespace
}  // namespace etendue::scene
