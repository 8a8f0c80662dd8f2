// The reference manual in docs/manual is what the program generates.
#include <set>

#include "integration/cli/cli.h"

namespace etendue::test::manual_test {
namespace {

class Manual : public Cli {};

std::set<std::string> pages_in(const fs::path& folder) {
  std::set<std::string> pages;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".md" || entry.path().extension() == ".1")
      pages.insert(entry.path().lexically_relative(folder).generic_string());
  return pages;
}

TEST_F(Manual, CommittedPagesAreTheGeneratedOnes) {
  const fs::path generated = folder_ / "manual", committed = fs::path(ETENDUE_SOURCE_DIR) / "docs/manual";
  const Outcome r = run("manual " + generated.string() + " --source " + ETENDUE_SOURCE_DIR);
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(pages_in(generated), pages_in(committed)) << "run tools/update_manual.sh";
  for (const std::string& page : pages_in(generated))
    EXPECT_EQ(slurp(generated / page), slurp(committed / page)) << page << " differs: run tools/update_manual.sh";
}

TEST_F(Manual, FoldersWithoutSourcesAreErrors) {
  expect_error("manual pages --source " + folder_.string(), 3, "is not a checkout");
}

}  // namespace
}  // namespace etendue::test::manual_test
