// Scripts with unusable steps: an input error that names the step.
#include <fstream>

#include "integration/cli/cli.h"

namespace etendue::test::script_test {
namespace {

class Script : public Cli {
 protected:
  void expect_script_error(const std::string& text, const std::string& part) const {
    std::ofstream(folder_ / "s.json") << text;
    expect_error("view cornell --offscreen --script s.json", 3, part);
  }
};

TEST_F(Script, SampleCountsAreIntegers) {
  for (const char* value : {"-1", "-1e30", "1.5", "4294967296", "\"x\"", "{}"}) {
    expect_script_error(R"([{"do": "wait", "spp": )" + std::string(value) + "}]", "step 1: 'spp' has to be a number");
    expect_script_error(R"([{"do": "wait", "compared": )" + std::string(value) + "}]", "step 1: 'compared' has to be");
  }
}

TEST_F(Script, NumbersOfRandomActionsAreIntegers) {
  expect_script_error(R"([{"do": "random", "actions": 1e30}])", "step 1: 'actions' has to be an integer");
  expect_script_error(R"([{"do": "random", "actions": 1, "seed": -1}])", "step 1: 'seed' has to be an integer");
}

TEST_F(Script, NestingIsLimited) {
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  expect_script_error(R"([{"do": "set", "name": "x", "value": )" + deep + "}]", "more than 16 levels");
}

TEST_F(Script, ValuesOfOtherTypesAreErrors) {
  for (const char* step : {"5", "[]", R"({"do": 1})", R"({"do": "click", "item": {}})",
                           R"({"do": "drag", "from": [1], "to": 3})", R"({"do": "key", "key": "w", "down": "x"})",
                           R"({"do": "click", "item": "a", "double": 3})", R"({"do": "open", "file": null})"})
    expect_script_error("[" + std::string(step) + "]", "step 1: ");
}

}  // namespace
}  // namespace etendue::test::script_test
