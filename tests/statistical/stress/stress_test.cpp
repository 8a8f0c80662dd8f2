// The stress cases: each behaves as theory predicts, violations are reported, and the matrix is written as JSON and
// HTML.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "stress/matrix.h"

namespace etendue::stress {
namespace {

class EveryCase : public testing::TestWithParam<size_t> {};

TEST_P(EveryCase, BehavesAsTheoryPredicts) {
  const CaseResult row = run(cases()[GetParam()], {});
  EXPECT_FALSE(row.results.empty());
  for (const TestResult& f : row.results)
    EXPECT_TRUE(f.ok) << row.stress_case->name << ": " << f.method << ": expected " << f.expectation << ", measured "
                      << f.measured;
}

INSTANTIATE_TEST_SUITE_P(Cases, EveryCase, testing::Range<size_t>(0, cases().size()), [](const auto& parameter) {
  std::string name = cases()[parameter.param].name;
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST(Cases, CoverEveryKindAndHaveUniqueNames) {
  std::set<std::string> names;
  std::set<Kind> kinds;
  for (const Case& c : cases()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    kinds.insert(c.kind);
    EXPECT_EQ(find_case(c.name), &c);
  }
  EXPECT_EQ(kinds.size(), 8U);
  EXPECT_EQ(find_case("no-such-case"), nullptr);
}

TEST(TestContext, DistinguishesMetAndViolatedExpectations) {
  TestContext lab({});
  lab.expect_near("a", "", 1.009, 1, 0.01);
  lab.expect_near("a", "", 1.011, 1, 0.01);
  lab.expect_mean("a", "", {1.04, 0.01, 0}, 1);
  lab.expect_mean("a", "", {1.05, 0.01, 0}, 1);
  lab.expect_between("a", "", 2, 1, 3);
  lab.expect_between("a", "", 3.1, 1, 3);
  lab.expect_between("a", "", std::nan(""), 1, 3);
  lab.expect_zero("a", "", 0);
  lab.expect_zero("a", "", 1e-30);
  std::vector<bool> ok;
  for (const TestResult& f : lab.take_results()) ok.push_back(f.ok);
  EXPECT_EQ(ok, (std::vector<bool>{true, false, true, false, true, false, false, true, false}));
}

TEST(Matrix, JsonHasEveryFindingAndThePageIsSelfContained) {
  static constexpr Case kCase{"a<b", Kind::bias, "one & two", [](TestContext& lab) {
                                lab.expect_zero("path", "", 0);
                                lab.expect_zero("path", "", std::numeric_limits<double>::infinity());
                              }};
  const std::vector<CaseResult> rows{run(kCase, {})};
  const auto json = nlohmann::json::parse(matrix_json(rows));
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["case"], "a<b");
  EXPECT_EQ(json[0]["kind"], "bias");
  EXPECT_TRUE(json[0]["ok"]);
  EXPECT_FALSE(json[1]["ok"]);
  EXPECT_TRUE(json[1]["measured"].is_null());
  const std::string page = matrix_html(rows);
  EXPECT_NE(page.find("a&lt;b"), std::string::npos);
  EXPECT_NE(page.find("one &amp; two"), std::string::npos);
  EXPECT_NE(page.find("1 not met"), std::string::npos);
  EXPECT_EQ(page.find("://"), std::string::npos) << "nothing is fetched";
}

}  // namespace
}  // namespace etendue::stress
