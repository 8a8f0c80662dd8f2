// OpenVDB files, and NanoVDB files with compression and quantised values: values, and damaged files.
#include <gtest/gtest.h>

#include <cmath>

#include "base/hash.h"
#include "medium/grid_file.h"
#include "medium/grid_plugin.h"
#include "support/nanovdb_file.h"
#ifdef ETENDUE_OPENVDB
#include "unit/medium/vdb_writer.h"
#endif

namespace etendue {
namespace {

using test::NanovdbCompression;
using test::NanovdbGrid;
using test::NanovdbValues;

float slope(int x, int y, int z) {
  return 0.5f * static_cast<float>(x) + static_cast<float>(y) + 2 * static_cast<float>(z);
}

const NanovdbGrid kSlope{"density", {9, 12, 5}, slope};

void expect_slope(const Result<GridValues>& values, float tolerance, const std::string& what) {
  ASSERT_TRUE(values) << what << ": " << values.error().message;
  ASSERT_EQ(values->nodes, (GridSize{9, 12, 5})) << what;
  size_t i = 0;
  for (int z = 1; z <= 5; ++z)
    for (int y = 1; y <= 12; ++y)
      for (int x = 1; x <= 9; ++x) ASSERT_NEAR(values->density[i++], slope(x, y, z), tolerance) << what;
}

// Any result is accepted, but no crash, and no invalid values.
void expect_error_or_valid(const std::vector<std::byte>& bytes, const char* name) {
  const auto read = parse_grid_file(bytes, name);
  if (!read) {
    EXPECT_EQ(read.error().message.find(name), 0U) << read.error().message;
    return;
  }
  for (const float v : read->density) ASSERT_TRUE(v >= 0 && std::isfinite(v));
}

void damage(const std::vector<std::byte>& bytes, const char* name, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) {
    auto damaged = bytes;
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t h = mix_bits(i * 3 + k + 1);
      damaged[(i % 2 == 0 ? h % 1200 : h) % damaged.size()] = static_cast<std::byte>(h >> 24);
    }
    expect_error_or_valid(damaged, name);
  }
}

void truncate(const std::vector<std::byte>& bytes, const char* name, size_t step) {
  for (size_t size = 0; size + 64 < bytes.size(); size += size < 1000 ? 1 + step / 16 : step) {
    const auto read = parse_grid_file({bytes.data(), size}, name);
    ASSERT_FALSE(read) << name << ", " << size << " of " << bytes.size() << " bytes";
    EXPECT_EQ(read.error().message.find(name), 0U) << read.error().message;
  }
}

TEST(NanovdbStorage, QuantisedValues) {
  if (!test::kHasNanovdb) GTEST_SKIP() << "built without NanoVDB";
  // The values of a leaf span a range of up to 27.
  const std::pair<NanovdbValues, float> cases[] = {{NanovdbValues::fp4, 27.0f / 15},
                                                   {NanovdbValues::fp8, 27.0f / 255},
                                                   {NanovdbValues::fp16, 27.0f / 65535},
                                                   {NanovdbValues::fpn, 0.5f}};
  for (const auto& [values, tolerance] : cases)
    expect_slope(parse_grid_file(test::nanovdb_bytes({kSlope}, values), "smoke.nvdb"), tolerance,
                 std::to_string(static_cast<int>(values)));
}

TEST(NanovdbStorage, Compression) {
  if (!test::kHasNanovdb) GTEST_SKIP() << "built without NanoVDB";
  for (const NanovdbCompression compression : {NanovdbCompression::zip, NanovdbCompression::blosc}) {
    const auto bytes =
        test::nanovdb_bytes({kSlope, {"temperature", {9, 12, 5}, slope}}, NanovdbValues::floats, compression);
    if (bytes.empty()) continue;
    EXPECT_LT(bytes.size(), test::nanovdb_bytes({kSlope, kSlope}).size() / 2);
    expect_slope(parse_grid_file(bytes, "smoke.nvdb"), 0, std::to_string(static_cast<int>(compression)));
    truncate(bytes, "smoke.nvdb", 97);
    damage(bytes, "smoke.nvdb", 300);
  }
}

TEST(NanovdbStorage, DamagedQuantisedFiles) {
  if (!test::kHasNanovdb) GTEST_SKIP() << "built without NanoVDB";
  for (const NanovdbValues values : {NanovdbValues::fp8, NanovdbValues::fpn}) {
    const auto bytes = test::nanovdb_bytes({kSlope}, values);
    truncate(bytes, "smoke.nvdb", 997);
    damage(bytes, "smoke.nvdb", 200);
  }
}

// The header claims a terabyte.
TEST(NanovdbStorage, AbsurdSizesAreRefused) {
  if (!test::kHasNanovdb) GTEST_SKIP() << "built without NanoVDB";
  auto bytes = test::nanovdb_bytes({kSlope}, NanovdbValues::floats, NanovdbCompression::zip);
  bytes[16 + 5] = std::byte{1};  // the sixth byte of MetaData::gridSize
  const auto read = parse_grid_file(bytes, "smoke.nvdb");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("claims more bytes"), std::string::npos) << read.error().message;
}

TEST(GridPlugin, IsReportedMissing) {
  const auto plugin = load_grid_plugin({::testing::TempDir() + "no_such_folder"});
  ASSERT_FALSE(plugin);
  EXPECT_NE(plugin.error().message.find("install the packages libopenvdb-dev"), std::string::npos);
}

#ifdef ETENDUE_OPENVDB

using test::vdb_bytes;
using test::VdbCompression;

TEST(Openvdb, ValuesOfVoxels) {
  for (const VdbCompression compression : {VdbCompression::none, VdbCompression::zip, VdbCompression::blosc})
    for (const bool half : {false, true})
      expect_slope(parse_grid_file(vdb_bytes({kSlope}, compression, half), "smoke.vdb"), half ? 0.02f : 0,
                   std::to_string(static_cast<int>(compression)));
}

TEST(Openvdb, GridsAreChosenByName) {
  const auto bytes =
      vdb_bytes({{"heat", {4, 4, 4}, [](int, int, int) { return 7.0f; }},
                 {"temperature", {4, 4, 4}, [](int x, int, int) { return 500.0f * static_cast<float>(x); }},
                 {"density", {4, 4, 4}, [](int, int, int) { return 2.0f; }}});
  const auto values = parse_grid_file(bytes, "smoke.vdb");
  ASSERT_TRUE(values) << values.error().message;
  EXPECT_EQ(values->density.front(), 2);
  ASSERT_EQ(values->temperature.size(), values->density.size());
  EXPECT_EQ(values->temperature[0], 0.25f);
  EXPECT_EQ(values->temperature[3], 1);
}

TEST(Openvdb, InvalidVoxelsBecomeZero) {
  const auto values = parse_grid_file(vdb_bytes({{"density",
                                                  {4, 4, 4},
                                                  [](int x, int y, int) {
                                                    return x == 1 ? NAN : x == 2 ? -1.0f : y == 1 ? INFINITY : 1.0f;
                                                  }}}),
                                      "smoke.vdb");
  ASSERT_TRUE(values) << values.error().message;
  for (size_t i = 0; i < values->density.size(); ++i)
    EXPECT_EQ(values->density[i], i % 4 >= 2 && i / 4 % 4 > 0 ? 1 : 0);
}

TEST(Openvdb, TruncatedFiles) {
  for (const VdbCompression compression : {VdbCompression::none, VdbCompression::zip, VdbCompression::blosc}) {
    const auto bytes = vdb_bytes({kSlope}, compression);
    truncate(bytes, "smoke.vdb", 97);
  }
}

TEST(Openvdb, FilesThatAreNoDensityAreRefused) {
  const auto message = [](const std::vector<std::byte>& bytes) {
    const auto read = parse_grid_file(bytes, "smoke.vdb");
    return read ? std::string() : read.error().message;
  };
  EXPECT_NE(message(vdb_bytes({kSlope}, VdbCompression::none, false, true)).find("is a level set"), std::string::npos);
  EXPECT_NE(message(test::huge_vdb_bytes()).find("more than 256 million voxels"), std::string::npos);
  EXPECT_NE(message(vdb_bytes({})).find("has no grid"), std::string::npos);
  EXPECT_NE(message(std::vector<std::byte>(100, std::byte{'x'})).find("is not an OpenVDB file"), std::string::npos);
  EXPECT_NE(message({}).find("is not an OpenVDB file"), std::string::npos);
  auto old = vdb_bytes({kSlope});
  old[8] = std::byte{200};  // the version of the format
  EXPECT_NE(message(old).find("version 200 of the format"), std::string::npos) << message(old);
}

#endif

}  // namespace
}  // namespace etendue
