#include "base/mapped_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/provided_files.h"

namespace etendue {
namespace {

namespace fs = std::filesystem;

class MappedFiles : public testing::Test {
 protected:
  void TearDown() override { fs::remove(path_); }

  void write(size_t size, char value = 'x') { std::ofstream(path_) << std::string(size, value); }
  static size_t count(const MappedFile& file, char value) {
    return static_cast<size_t>(std::ranges::count(file.bytes(), static_cast<std::byte>(value)));
  }

  const fs::path path_ = fs::temp_directory_path() / ("etendue-mapped-" + std::to_string(getpid()));
};

TEST_F(MappedFiles, HaveTheBytesOfTheFile) {
  write(100'000);
  const auto file = MappedFile::open(path_);
  ASSERT_TRUE(file);
  EXPECT_EQ(file->bytes().size(), 100'000U);
  EXPECT_EQ(count(*file, 'x'), 100'000U);
  EXPECT_FALSE(file->is_damaged());
}

TEST_F(MappedFiles, EmptyFileHasNoBytes) {
  write(0);
  const auto file = MappedFile::open(path_);
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->bytes().empty());
}

TEST_F(MappedFiles, MissingFilesAndFoldersAreErrors) {
  const auto missing = MappedFile::open(path_), folder = MappedFile::open(fs::temp_directory_path());
  ASSERT_FALSE(missing || folder);
  EXPECT_NE(missing.error().message.find("there is no such file"), std::string::npos);
  EXPECT_NE(folder.error().message.find("this is a folder"), std::string::npos);
}

// Another program shortens the file. Accesses beyond its new end would end the process.
TEST_F(MappedFiles, BytesThatDisappearReadAsZero) {
  write(1'000'000);
  const auto file = MappedFile::open(path_);
  ASSERT_TRUE(file);
  fs::resize_file(path_, 5000);
  const size_t left = count(*file, 'x');
  EXPECT_EQ(left, 5000U);
  EXPECT_EQ(count(*file, '\0'), 995'000U);
  write(1'000'000);
  EXPECT_TRUE(file->is_damaged()) << "also if the file has its size again";
}

// The rest of a page reads as zero without a signal.
TEST_F(MappedFiles, FewMissingBytesAreNoticed) {
  write(5000);
  const auto file = MappedFile::open(path_);
  ASSERT_TRUE(file);
  fs::resize_file(path_, 4990);
  EXPECT_EQ(count(*file, 'x'), 4990U);
  EXPECT_TRUE(file->is_damaged());
}

TEST_F(MappedFiles, ManyFilesCanBeOpen) {
  write(5000);
  std::vector<MappedFile> files;
  for (int i = 0; i < 400; ++i) {
    auto file = MappedFile::open(path_);
    ASSERT_TRUE(file) << i;
    files.push_back(std::move(*file));
  }
  for (const MappedFile& file : files) ASSERT_EQ(count(file, 'x'), 5000U);
  files.clear();
  const auto file = MappedFile::open(path_);
  fs::resize_file(path_, 0);
  EXPECT_EQ(count(*file, '\0'), 5000U);
  EXPECT_TRUE(file->is_damaged()) << "closed files leave room for others";
}

}  // namespace
}  // namespace etendue
