// The grid of vertices that camera subpaths are merged with, against brute force.
#include "integrator/bdpt/merge_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace etendue::integrator {
namespace {

// Vertices in a box of this size around a centre; every third one has another orientation.
std::vector<MergeVertex> scattered(size_t count, const Vec3& center, float size) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> offset(-size / 2, size / 2);
  std::vector<MergeVertex> vertices(count);
  for (size_t i = 0; i < count; ++i) {
    vertices[i].position = center + Vec3(offset(engine), offset(engine), offset(engine));
    vertices[i].normal = i % 3 == 0 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    vertices[i].length = static_cast<uint16_t>(i);
  }
  return vertices;
}

MergeMap built(std::vector<MergeVertex> vertices, float radius, size_t tasks) {
  MergeMap map;
  map.begin(radius, 100);
  std::vector<MergeMap::Lists> lists(tasks);
  const size_t share = (vertices.size() + tasks - 1) / tasks;
  for (size_t t = 0; t < tasks; ++t) {
    const size_t first = std::min(t * share, vertices.size()), end = std::min(first + share, vertices.size());
    map.divide(std::span(vertices).subspan(first, end - first), lists[t]);
  }
  for (int piece = 0; piece < MergeMap::kPieces; ++piece) map.build_piece(piece, lists);
  return map;
}

TEST(MergeMap, FindsAllVerticesWithinTheRadiusOnce) {
  for (const Vec3& center : {Vec3(0), Vec3(-1000, 500, 20)})
    for (const float radius : {0.01f, 0.1f, 3.0f}) {
      const auto vertices = scattered(2000, center, 1);
      const MergeMap map = built(vertices, radius, 5);
      EXPECT_EQ(map.size(), vertices.size());
      for (size_t q = 0; q < vertices.size(); q += 10) {
        const Vec3& position = vertices[q].position;
        std::multiset<int> expected, found;
        for (const MergeVertex& v : vertices)
          if (length_squared(v.position - position) <= radius * radius && v.normal.y > 0) expected.insert(v.length);
        map.for_each_near(position, Vec3(0, -1, 0), [&](const MergeVertex& v) { found.insert(v.length); });
        ASSERT_EQ(found, expected) << radius << ", vertex " << q;
      }
    }
}

TEST(MergeMap, CanBeEmpty) {
  const MergeMap map = built({}, 0.1f, 3);
  int found = 0;
  map.for_each_near(Vec3(0), Vec3(0, 1, 0), [&](const MergeVertex&) { ++found; });
  EXPECT_EQ(found, 0);
  EXPECT_EQ(map.size(), 0U);
}

TEST(MergeMap, AcceptsPositionsFarAway) {
  std::vector<MergeVertex> vertices(2);
  vertices[0].position = Vec3(1e30f, -1e30f, 0);
  vertices[0].normal = vertices[1].normal = Vec3(0, 1, 0);
  const MergeMap map = built(vertices, 1e-6f, 1);
  int found = 0;
  map.for_each_near(vertices[0].position, Vec3(0, 1, 0), [&](const MergeVertex&) { ++found; });
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace etendue::integrator
