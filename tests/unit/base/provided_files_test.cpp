#include "base/provided_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "base/file.h"

namespace etendue {
namespace {

TEST(ProvidedFiles, AreReadByTheirNames) {
  const std::string path = "/no/such/folder/etendue-provided";
  EXPECT_FALSE(read_file(path));
  EXPECT_FALSE(is_file(path));
  provide_files({{path, {std::byte{1}, std::byte{2}}}});
  ASSERT_TRUE(read_file(path));
  EXPECT_EQ(*read_file(path), (std::vector<std::byte>{std::byte{1}, std::byte{2}}));
  EXPECT_TRUE(is_file(path));
  EXPECT_FALSE(read_file(path + "2"));
}

TEST(ProvidedFiles, NamesOfReadFilesAreRecordedOnce) {
  const auto path = std::filesystem::temp_directory_path() / ("etendue-read-" + std::to_string(::getpid()));
  ASSERT_TRUE(write_file(path, "text", 4));
  ASSERT_TRUE(read_file(path));
  EXPECT_EQ(std::ranges::count(files_read(), path.string()), 0);
  record_files_read();
  ASSERT_TRUE(read_file(path));
  ASSERT_TRUE(read_file(path));
  EXPECT_FALSE(read_file(path.string() + "-missing"));
  EXPECT_EQ(std::ranges::count(files_read(), path.string()), 1);
  EXPECT_EQ(std::ranges::count(files_read(), path.string() + "-missing"), 0);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace etendue
