// NanoVDB files: values, temperatures, repairs, and damaged files.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "base/hash.h"
#include "medium/density_field.h"
#include "medium/grid_file.h"
#include "support/nanovdb_file.h"

namespace etendue {
namespace {

using test::nanovdb_bytes;
using test::NanovdbGrid;

class Nanovdb : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::kHasNanovdb) GTEST_SKIP() << "built without NanoVDB";
  }
};

float plane(int x, int y, int z) {
  return 0.5f * static_cast<float>(x) + static_cast<float>(y) + 2 * static_cast<float>(z);
}

std::string error_of(std::vector<std::byte> bytes) {
  const auto read = parse_grid_file(bytes, "smoke.nvdb");
  return read ? "" : read.error().message;
}

TEST_F(Nanovdb, ValuesOfVoxels) {
  const auto bytes = nanovdb_bytes({{"density", {9, 12, 5}, plane}});
  const auto values = parse_grid_file(bytes, "smoke.nvdb");
  ASSERT_TRUE(values) << values.error().message;
  ASSERT_EQ(values->nodes, (GridSize{9, 12, 5}));
  EXPECT_TRUE(values->temperature.empty());
  // The builder numbers voxels from 1, so that all are active.
  size_t i = 0;
  for (int z = 1; z <= 5; ++z)
    for (int y = 1; y <= 12; ++y)
      for (int x = 1; x <= 9; ++x) EXPECT_EQ(values->density[i++], plane(x, y, z));
}

TEST_F(Nanovdb, GridsAreChosenByName) {
  const auto bytes =
      nanovdb_bytes({{"heat", {4, 4, 4}, [](int, int, int) { return 7.0f; }},
                     {"temperature", {4, 4, 4}, [](int x, int, int) { return 500.0f * static_cast<float>(x); }},
                     {"density", {4, 4, 4}, [](int, int, int) { return 2.0f; }}});
  const auto values = parse_grid_file(bytes, "smoke.nvdb");
  ASSERT_TRUE(values) << values.error().message;
  EXPECT_EQ(values->density.front(), 2);
  ASSERT_EQ(values->temperature.size(), values->density.size());
  EXPECT_EQ(values->temperature[0], 0.25f);
  EXPECT_EQ(values->temperature[3], 1);
}

TEST_F(Nanovdb, InvalidVoxelsBecomeZero) {
  const auto bytes = nanovdb_bytes({{"density", {4, 4, 4}, [](int x, int y, int) {
                                       return x == 1 ? NAN : x == 2 ? -1.0f : y == 1 ? INFINITY : 1.0f;
                                     }}});
  const auto values = parse_grid_file(bytes, "smoke.nvdb");
  ASSERT_TRUE(values) << values.error().message;
  for (size_t i = 0; i < values->density.size(); ++i)
    EXPECT_EQ(values->density[i], i % 4 >= 2 && i / 4 % 4 > 0 ? 1 : 0);
}

TEST_F(Nanovdb, TruncatedFiles) {
  const auto bytes = nanovdb_bytes({{"density", {9, 12, 5}, plane}});
  for (size_t size = 0; size < bytes.size(); size += size < 1000 ? 1 : 997)
    EXPECT_NE(error_of({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}), "") << size;
}

// Bytes of headers and of nodes replaced at random: an error or finite values, no crash.
TEST_F(Nanovdb, DamagedFiles) {
  const auto bytes = nanovdb_bytes({{"density", {9, 12, 5}, plane}});
  for (uint32_t i = 0; i < 600; ++i) {
    auto damaged = bytes;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t h = mix_bits(i * 3 + k + 1);
      const size_t at = i % 2 == 0 ? h % 1200 : h % damaged.size();
      damaged[at] = static_cast<std::byte>(h >> 24);
    }
    const auto read = parse_grid_file(damaged, "smoke.nvdb");
    if (!read) continue;
    for (const float v : read->density) ASSERT_TRUE(v >= 0 && std::isfinite(v));
  }
}

// The bounding box in the root node claims an astronomical number of voxels.
TEST_F(Nanovdb, HugeGridsAreRefused) {
  auto bytes = nanovdb_bytes({{"density", {9, 12, 5}, plane}});
  const int32_t from[] = {1, 1, 1, 9, 12, 5},
                to[] = {-2000000000, -2000000000, -2000000000, 2000000000, 2000000000, 2000000000};
  int found = 0;
  for (size_t at = 0; at + sizeof(from) <= bytes.size(); at += 4)
    if (std::memcmp(&bytes[at], from, sizeof(from)) == 0) std::memcpy(&bytes[at], to, sizeof(to)), ++found;
  EXPECT_GT(found, 0);
  EXPECT_NE(error_of(bytes).find("more than 256 million voxels"), std::string::npos) << error_of(bytes);
}

TEST_F(Nanovdb, OtherFilesAreRefused) {
  std::vector<std::byte> text(100, std::byte{'x'});
  EXPECT_NE(error_of(text).find("is not a NanoVDB file"), std::string::npos);
  EXPECT_NE(load_grid_file("/nonexistent/smoke.nvdb").error().message.find("cannot be read"), std::string::npos);
}

TEST_F(Nanovdb, AsADensity) {
  const std::string path = ::testing::TempDir() + "density_of_test.nvdb";
  const auto bytes = nanovdb_bytes({{"density", {9, 12, 5}, plane}});
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const auto density = make_density("file", {{"file", path}, {"scale", 0.5}});
  ASSERT_TRUE(density) << density.error().message;
  const auto& grid = (*density)->grid();
  ASSERT_TRUE(grid) << grid.error().message;
  EXPECT_NEAR((*grid)->density(Vec3(0.5f)), 0.5f * (0.5f * 5 + 6.5f + 2 * 3), 1e-4f);
  EXPECT_FALSE(make_density("file", {{"file", std::string("/nonexistent.nvdb")}}));
}

}  // namespace
}  // namespace etendue
