// Path expressions against a matcher that follows the definition, error messages, and properties of the automaton.
#include "transport/path_expression/path_expression.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <random>
#include <set>

namespace etendue::transport {
namespace {

// An expression as a tree, with its text and the set of positions where a match that starts at `from` can end.
struct ExpressionTree {
  char kind;  // a letter or '.', or one of & | * + ? [
  std::vector<ExpressionTree> parts;

  std::string text() const {
    switch (kind) {
      case '&':
        return parts[0].grouped() + parts[1].grouped();
      case '|':
        return parts[0].grouped() + "|" + parts[1].grouped();
      case '*':
      case '+':
      case '?':
        return parts[0].grouped() + kind;
      case '[':
        return "[" + parts[0].text() + "]";
      default:
        return std::string(1, kind);
    }
  }
  std::string grouped() const { return parts.empty() || kind == '[' ? text() : "(" + text() + ")"; }

  std::set<size_t> ends(const std::string& word, size_t from) const {
    switch (kind) {
      case '&': {
        std::set<size_t> all;
        for (const size_t middle : parts[0].ends(word, from)) all.merge(parts[1].ends(word, middle));
        return all;
      }
      case '|': {
        auto all = parts[0].ends(word, from);
        all.merge(parts[1].ends(word, from));
        return all;
      }
      case '?':
      case '[': {
        auto all = parts[0].ends(word, from);
        all.insert(from);
        return all;
      }
      case '*':
        return repeated(word, {from});
      case '+':
        return repeated(word, parts[0].ends(word, from));
      case '.':
        return from < word.size() && std::string("DGSV").find(word[from]) != std::string::npos
                   ? std::set<size_t>{from + 1}
                   : std::set<size_t>{};
      default:
        return from < word.size() && word[from] == kind ? std::set<size_t>{from + 1} : std::set<size_t>{};
    }
  }
  std::set<size_t> repeated(const std::string& word, std::set<size_t> all) const {
    for (size_t known = 0; known != all.size();) {
      known = all.size();
      for (const size_t middle : std::set<size_t>(all)) all.merge(parts[0].ends(word, middle));
    }
    return all;
  }
  bool matches(const std::string& word) const { return ends(word, 0).contains(word.size()); }
};

ExpressionTree random_tree(std::mt19937& random, int depth) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  if (depth == 0 || below(5) == 0) return {"ELDGSV." [below(7)], {}};
  const char kind = "&&&||*+?["[below(9)];
  std::vector<ExpressionTree> parts{random_tree(random, depth - 1)};
  if (kind == '&' || kind == '|') parts.push_back(random_tree(random, depth - 1));
  return {kind, parts};
}

void for_all_words(size_t longest, const std::function<void(const std::string&)>& visit) {
  std::string word;
  const std::function<void()> extend = [&] {
    visit(word);
    if (word.size() == longest) return;
    for (const char c : kLetters) {
      word.push_back(c);
      extend();
      word.pop_back();
    }
  };
  extend();
}

Automaton automaton(const std::string& text) {
  const auto e = PathExpression::parse(text);
  EXPECT_TRUE(e) << text << ": " << e.error().message;
  return e ? e->automaton() : Automaton();
}

// The tree of E(...)L, so that many random words are paths.
ExpressionTree as_path(ExpressionTree inner) { return {'&', {{'E', {}}, {'&', {std::move(inner), {'L', {}}}}}}; }

TEST(PathExpression, RandomExpressionsMatchTheirDefinition) {
  std::mt19937 random(7);
  for (int i = 0; i < 12; ++i) {
    ExpressionTree tree = random_tree(random, 4);
    if (i % 2) tree = as_path(tree);
    const Automaton a = automaton(tree.text());
    for_all_words(7, [&](const std::string& word) {
      ASSERT_EQ(a.accepts(word), tree.matches(word)) << tree.text() << " on '" << word << "'";
    });
  }
  for (int i = 0; i < 400; ++i) {
    ExpressionTree tree = random_tree(random, 5);
    if (i % 2) tree = as_path(tree);
    const auto e = PathExpression::parse(tree.text());
    if (!e) {
      ASSERT_NE(e.error().message.find("states"), std::string::npos) << tree.text() << e.error().message;
      continue;
    }
    for_all_words(4, [&](const std::string& word) {
      ASSERT_EQ(e->matches(word), tree.matches(word)) << tree.text() << " on '" << word << "'";
    });
  }
}

TEST(PathExpression, NamedClassesOfTheThesis) {
  const auto matches = [](const char* text, const char* word) { return automaton(text).accepts(word); };
  EXPECT_TRUE(matches("EL", "EL"));
  EXPECT_FALSE(matches("EL", "EDL"));
  EXPECT_TRUE(matches("E[D|G]L", "EL"));
  EXPECT_TRUE(matches("E[D|G]L", "EGL"));
  EXPECT_FALSE(matches("E[D|G]L", "EDGL"));
  EXPECT_TRUE(matches("ES*[D|G]L", "ESSSL"));
  EXPECT_TRUE(matches("ES*[D|G]L", "ESDL"));
  EXPECT_FALSE(matches("ES*[D|G]L", "EDSL"));
  EXPECT_TRUE(matches("EDS+L", "EDSSL"));
  EXPECT_FALSE(matches("EDS+L", "EDL"));
}

TEST(PathExpression, EqualLanguagesHaveEqualAutomata) {
  EXPECT_EQ(automaton("E(D|G|S|V)*L"), automaton("E.*L"));
  EXPECT_EQ(automaton("E[D|G]L"), automaton("E(D|G)?L"));
  EXPECT_EQ(automaton("E(D*|G*)*L"), automaton("E(D|G)*L"));
  EXPECT_EQ(automaton("E D+ L"), automaton("EDD*L"));
  EXPECT_EQ(automaton("E(DG|DS)L"), automaton("ED(G|S)L"));
  EXPECT_EQ(automaton("E(D?)+L"), automaton("ED*L"));
  EXPECT_EQ(automaton("ED**L"), automaton("E[D+]L"));
  EXPECT_FALSE(automaton("ED*L") == automaton("ED+L"));
  // States: rejected, after E, after E.*, and accepted.
  EXPECT_EQ(automaton("E.*L").size(), 4u);
}

TEST(PathExpression, RejectingStateIsEnteredAsEarlyAsPossible) {
  std::mt19937 random(11);
  for (int i = 0; i < 40; ++i) {
    const Automaton a = automaton(random_tree(random, 4).text());
    // In a minimal automaton with n states, an accepting state is within n letters of every state that is not
    // rejecting.
    for (size_t s = 1; s < a.size(); ++s) {
      std::set<Automaton::State> reached{static_cast<Automaton::State>(s)};
      for (size_t length = 0; length < a.size(); ++length)
        for (const auto state : std::set<Automaton::State>(reached))
          for (int e = 0; e < kEvents; ++e) reached.insert(a.next(state, static_cast<Event>(e)));
      EXPECT_TRUE(std::any_of(reached.begin(), reached.end(), [&](auto state) { return a.accepts(state); }));
    }
    for (int e = 0; e < kEvents; ++e) EXPECT_EQ(a.next(Automaton::kDead, static_cast<Event>(e)), Automaton::kDead);
    EXPECT_FALSE(a.accepts(Automaton::kDead));
  }
  const Automaton direct = automaton("E(D|G)L");
  const auto after = [&](const char* word) {
    auto state = direct.start();
    for (const char* c = word; *c; ++c) state = direct.next(state, static_cast<Event>(kLetters.find(*c)));
    return state;
  };
  EXPECT_NE(after("ED"), Automaton::kDead);
  EXPECT_EQ(after("ES"), Automaton::kDead);
  EXPECT_EQ(after("EDD"), Automaton::kDead);
}

TEST(PathExpression, WordsThatAreNotPathsAreExcluded) {
  const auto e = PathExpression::parse_paths("(E|D)(D|L)*");
  ASSERT_TRUE(e);
  EXPECT_EQ(e->automaton(), automaton("ED*L"));
  for (const char* text : {"D*L", "ED", "ELL", "EE*DE"}) {
    const auto none = PathExpression::parse_paths(text);
    ASSERT_FALSE(none) << text;
    EXPECT_NE(none.error().message.find("E.*L"), std::string::npos) << none.error().message;
    EXPECT_EQ(none.error().fault, Fault::usage);
  }
}

TEST(PathExpression, IntersectionsAndEmptiness) {
  const auto common = Automaton::intersection(automaton("E[D|G]L"), automaton("ED*L"));
  ASSERT_TRUE(common);
  EXPECT_EQ(*common, automaton("E[D]L"));
  EXPECT_TRUE(Automaton::intersection(automaton("EDL"), automaton("EGL"))->empty());
}

TEST(PathExpression, ErrorsStateDefectPositionAndRemedy) {
  struct Case {
    const char *text, *column, *part;
  };
  for (const Case& c : {Case{"", "column 1", "empty"},
                        {"   ", "column 4", "missing"},
                        {"E(DL", "column 2", "never closed; add ')'"},
                        {"E[DL", "column 2", "add ']'"},
                        {"E(D]L", "column 4", "give ')'"},
                        {"ED)L", "column 3", "has no opening bracket"},
                        {")", "column 1", "has no opening bracket"},
                        {"E()L", "column 3", "nothing between"},
                        {"E(D|)L", "column 5", "one side of '|' is empty"},
                        {"E(D| )L", "column 6", "one side of '|' is empty"},
                        {" )", "column 2", "has no opening bracket"},
                        {"E(|D)L", "column 3", "one side of '|' is empty"},
                        {"ED|", "column 4", "missing"},
                        {"*DL", "column 1", "nothing to repeat"},
                        {"E(+D)L", "column 3", "nothing to repeat"},
                        {"edl", "column 1", "capital: E"},
                        {"CDL", "column 1", "the camera is E"},
                        {"EvL", "column 2", "capital: V"},
                        {"ED_GL", "column 3", "D_G"},
                        {"ERL", "column 2", "D, G or S"},
                        {"ED{2}L", "column 3", "write repetitions out"},
                        {"E#L", "column 2", "'#' is not a letter"},
                        {"E\xc3\xa9L", "column 2", "is not a letter"}}) {
    const auto e = PathExpression::parse(c.text);
    ASSERT_FALSE(e) << c.text;
    EXPECT_NE(e.error().message.find(c.column), std::string::npos) << c.text << ": " << e.error().message;
    EXPECT_NE(e.error().message.find(c.part), std::string::npos) << c.text << ": " << e.error().message;
    EXPECT_EQ(e.error().fault, Fault::usage);
  }
}

TEST(PathExpression, TooLargeExpressionsAreRejected) {
  const auto expect_refused = [](const std::string& text, const char* part) {
    const auto e = PathExpression::parse(text);
    ASSERT_FALSE(e) << text;
    EXPECT_NE(e.error().message.find(part), std::string::npos) << e.error().message;
  };
  expect_refused(std::string(300, 'D'), "characters");
  expect_refused(std::string(100, 'D'), "states");
  expect_refused(std::string(100, '(') + "D" + std::string(100, ')'), "brackets");
  // The tenth letter from the end: the minimal automaton has 2^10 states.
  expect_refused("E.*D.........L", "states");
  expect_refused("E.*D....................L", "states");
  EXPECT_TRUE(PathExpression::parse("E.*D...L"));
  EXPECT_TRUE(PathExpression::parse(std::string(60, 'D')));
}

TEST(Automaton, DifferenceRemovesWords) {
  const auto all = PathExpression::all().automaton();
  const auto whitted = PathExpression::parse_paths("ES*[D|G]L")->automaton();
  const auto rest = *Automaton::difference(all, whitted);
  for (const char* word : {"EL", "ESL", "EDL", "ESSGL"}) EXPECT_FALSE(rest.accepts(std::string_view(word))) << word;
  for (const char* word : {"EDDL", "EDSL", "ESDSL"}) EXPECT_TRUE(rest.accepts(std::string_view(word))) << word;
  EXPECT_TRUE(Automaton::difference(whitted, all)->empty());
}

// Round trip through the expression of an automaton, including complements.
TEST(PathExpression, ExpressionOfAnAutomatonIsEquivalent) {
  const auto all = PathExpression::all().automaton();
  for (const char* text : {"EL", "E.*L", "E(D|G).+L", "ES*[D|G]L", "EDS+L", "E.*(D|G)S+L", "E[D|G]L", "ED+S+(D|G).*L",
                           "E[.[.[.[.]]]]L", "E(DS|SD)*L", "E.*DG.*L"}) {
    const auto whole = PathExpression::parse_paths(text)->automaton();
    const auto rest = *Automaton::difference(all, whole);
    for (const Automaton& automaton : {whole, rest}) {
      if (automaton.empty()) continue;
      const std::string again = expression_of(automaton);
      const auto parsed = PathExpression::parse_paths(again);
      ASSERT_TRUE(parsed) << text << ' ' << again << ' ' << parsed.error().message;
      EXPECT_EQ(parsed->automaton(), automaton) << text << ' ' << again;
      RecordProperty(text, again);
    }
  }
  EXPECT_EQ(expression_of(PathExpression::parse_paths("E[D|G]L")->automaton()), "E[D|G]L");
}

}  // namespace
}  // namespace etendue::transport
