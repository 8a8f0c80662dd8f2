// Runs the tests of a program in a temporary folder of its own, so that programs which run at the same time never write
// the same file.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace etendue::test {
namespace {

// A folder that is the temporary folder of this process and of those it starts, until it ends.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(std::filesystem::temp_directory_path() / ("etendue-tests-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);  // of a killed process with the same number
    std::filesystem::create_directories(path_);
    for (const char* name : {"TMPDIR", "TEST_TMPDIR"}) ::setenv(name, path_.c_str(), 1);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

 private:
  std::filesystem::path path_;
};

}  // namespace
}  // namespace etendue::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const etendue::test::TemporaryFolder folder;
  return RUN_ALL_TESTS();
}
