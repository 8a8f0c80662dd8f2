// Names of path classes are expressions that partition the paths.
#include "transport/path_expression/path_classes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "transport/path_expression/path_expression.h"

namespace etendue::transport {
namespace {

std::vector<Event> events(const std::string& word) {
  std::vector<Event> list;
  for (const char c : word) list.push_back(static_cast<Event>(kLetters.find(c)));
  return list;
}

std::string name_of(const std::string& scattering, Naming naming, size_t detail) {
  return PathClass::of(events(scattering), naming, detail).name();
}

std::vector<std::string> words_up_to(size_t longest) {
  std::vector<std::string> words{""};
  for (size_t i = 0; i < words.size(); ++i)
    for (const char c : {'D', 'G', 'S'})
      if (words[i].size() < longest) words.push_back(words[i] + c);
  return words;
}

TEST(PathClass, Names) {
  EXPECT_EQ(name_of("", Naming::words, 3), "EL");
  EXPECT_EQ(name_of("DSS", Naming::words, 3), "EDSSL");
  EXPECT_EQ(name_of("DSSG", Naming::words, 3), "EDSS.+L");
  EXPECT_EQ(name_of("D", Naming::words, 0), "E.+L");
  EXPECT_EQ(name_of("DSS", Naming::runs, 3), "ED+S+L");
  EXPECT_EQ(name_of("SSSD", Naming::runs, 1), "ES+(D|G).*L");
  EXPECT_EQ(name_of("G", Naming::runs, 0), "E.+L");
}

TEST(PathClass, EveryPathMatchesOnlyTheNameOfItsClass) {
  const auto words = words_up_to(6);
  for (const Naming naming : {Naming::words, Naming::runs})
    for (const size_t detail : {0U, 1U, 2U, 3U, 4U}) {
      std::map<std::string, PathExpression> classes;
      for (const auto& word : words) {
        const std::string name = name_of(word, naming, detail);
        auto e = PathExpression::parse_paths(name);
        ASSERT_TRUE(e) << name << e.error().message;
        classes.emplace(name, *e);
      }
      for (const auto& word : words) {
        const std::string own = name_of(word, naming, detail);
        for (const auto& [name, expression] : classes)
          ASSERT_EQ(expression.matches("E" + word + "L"), name == own) << word << ' ' << name;
      }
    }
}

TEST(PathClass, PartsPartitionTheClass) {
  const auto words = words_up_to(5);
  for (const Naming naming : {Naming::words, Naming::runs})
    for (const auto& word : words)
      for (const size_t detail : {0U, 1U, 2U}) {
        const auto whole = PathClass::of(events(word), naming, detail);
        const auto parts = whole.parts();
        const auto finer = PathClass::of(events(word), naming, detail + 1);
        if (parts.empty())
          EXPECT_EQ(finer, whole) << word;
        else
          EXPECT_EQ(std::ranges::count(parts, finer), 1) << word << ' ' << whole.name();
        for (const auto& part : parts) {
          const auto all = PathExpression::parse_paths(whole.name()), some = PathExpression::parse_paths(part.name());
          EXPECT_TRUE(Automaton::difference(some->automaton(), all->automaton())->empty()) << part.name();
        }
      }
}

}  // namespace
}  // namespace etendue::transport
