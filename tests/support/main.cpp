// Runs the tests of a program in a temporary folder of its own, so that programs which run at the same time never write
// the same file.
//
//   --sanitizer-reports-only   failed expectations are printed, but the exit code is that of a success. Reports of a
//                              sanitizer end the program with an exit code of their own.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>

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
  const bool reports_only = argc > 1 && std::string_view(argv[1]) == "--sanitizer-reports-only";
  const int result = RUN_ALL_TESTS();
  return reports_only ? 0 : result;
}
