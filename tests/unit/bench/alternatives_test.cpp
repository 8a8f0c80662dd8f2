// Alternatives in braces.
#include "bench/alternatives.h"

#include <gtest/gtest.h>

namespace etendue::bench {
namespace {

using Texts = std::vector<std::string>;

Texts expanded(const std::string& text) {
  const auto texts = expand_alternatives(text);
  EXPECT_TRUE(texts) << text;
  return texts ? *texts : Texts();
}

TEST(Alternatives, StandForTheirProduct) {
  EXPECT_EQ(expanded("path"), Texts{"path"});
  EXPECT_EQ(expanded(""), Texts{""});
  EXPECT_EQ(expanded("{path,bdpt}:sampler={sobol,random}"),
            (Texts{"path:sampler=sobol", "path:sampler=random", "bdpt:sampler=sobol", "bdpt:sampler=random"}));
  EXPECT_EQ(expanded("a{1,2,3}"), (Texts{"a1", "a2", "a3"}));
  EXPECT_EQ(expanded("a{,b}"), (Texts{"a", "ab"}));
  EXPECT_EQ(expanded("a{b}c"), Texts{"abc"});
}

TEST(Alternatives, RefuseBracesWithoutCounterpart) {
  for (const char* text : {"{", "}", "a{b", "a}b", "{a,{b,c}}", "{a}}", "{a}{"})
    EXPECT_FALSE(expand_alternatives(text)) << text;
}

TEST(Alternatives, LimitTheirNumber) {
  std::string ten = "{0,1,2,3,4,5,6,7,8,9}";
  EXPECT_EQ(expanded(ten + ten).size(), 100U);
  EXPECT_FALSE(expand_alternatives(ten + ten + ten));
  std::string many = "x";
  for (int i = 0; i < 1000; ++i) many += ten;
  EXPECT_FALSE(expand_alternatives(many));
}

}  // namespace
}  // namespace etendue::bench
