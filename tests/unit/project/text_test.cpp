// Rules that the texts of the repository follow.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>

#include "unit/project/source_tree.h"

namespace etendue::test {
namespace {

std::vector<SourceFile> code_files() {
  std::vector<SourceFile> all;
  for (const char* folder : {"core", "lab", "app", "tests", "bench"}) {
    if (!std::filesystem::exists(source_root() / folder)) continue;
    for (SourceFile& file : source_files(folder, {".h", ".cpp"})) all.push_back(std::move(file));
  }
  return all;
}

std::vector<SourceFile> pages() {
  std::vector<SourceFile> all = source_files("docs", {".md"});
  for (SourceFile& file : source_files("third_party", {".md"})) all.push_back(std::move(file));
  for (const char* name : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md"}) {
    std::ifstream in(source_root() / name);
    SourceFile file{name, {}};
    for (std::string line; std::getline(in, line);) file.lines.push_back(line);
    all.push_back(std::move(file));
  }
  return all;
}

// Without identifiers: words joined by hyphens, dots or underscores, and code spans of Markdown.
std::string without_identifiers(const std::string& text) {
  static const std::regex pattern(R"re(`[^`]*`|\w+([-._/]\w+)+)re");
  return std::regex_replace(text, pattern, "");
}

// Comments and longer string literals of code, whole lines of pages.
std::string prose_of(const std::string& line, bool page) {
  if (page) return without_identifiers(line);
  static const std::regex pattern(R"re(//(.*)$|"((?:[^"\\]|\\.){12,})")re");
  std::string prose;
  for (std::sregex_iterator it(line.begin(), line.end(), pattern), end; it != end; ++it)
    prose += (*it)[1].str() + " " + (*it)[2].str() + " ";
  return without_identifiers(prose);
}

struct Term {
  std::regex pattern;
  std::string preferred;
};

// tests/unit/project/vocabulary.txt: a regular expression, a tab, and the preferred term, one pair per line.
std::vector<Term> vocabulary() {
  std::vector<Term> terms;
  std::ifstream in(source_root() / "tests/unit/project/vocabulary.txt");
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    const size_t tab = line.find('\t');
    EXPECT_NE(tab, std::string::npos) << "vocabulary.txt: no tab in '" << line << "'";
    if (tab == std::string::npos) continue;
    terms.push_back({std::regex("\\b(" + line.substr(0, tab) + ")\\b", std::regex::icase | std::regex::optimize),
                     line.substr(tab + 1)});
  }
  return terms;
}

void check_vocabulary(const std::vector<SourceFile>& files, bool page) {
  static const std::vector<Term> terms = vocabulary();
  for (const SourceFile& file : files)
    for (size_t i = 0; i < file.lines.size(); ++i) {
      const std::string prose = prose_of(file.lines[i], page);
      if (prose.empty()) continue;
      std::smatch match;
      for (const Term& term : terms)
        if (std::regex_search(prose, match, term.pattern))
          ADD_FAILURE() << file.path << ":" << i + 1 << ": '" << match[0] << "'; write '" << term.preferred << "'";
    }
}

TEST(Vocabulary, OfTheCodeIsThatOfTheField) { check_vocabulary(code_files(), false); }
TEST(Vocabulary, OfTheDocumentationIsThatOfTheField) { check_vocabulary(pages(), true); }

TEST(Files, HaveAtMost600Lines) {
  for (const SourceFile& file : code_files()) EXPECT_LE(file.lines.size(), 600u) << file.path;
}

// Two headers of one name would be confused in conversation and in include lists. Registries and stability cases, which
// have the names of their entries, are excepted.
TEST(Files, HeadersHaveDistinctNames) {
  std::map<std::string, std::string> seen;
  for (const SourceFile& file : code_files()) {
    if (!file.ends_with(".h") || file.ends_with("/registry.h") || file.path.starts_with("lab/stress/cases/")) continue;
    const std::string name = std::filesystem::path(file.path).filename().string();
    const auto [known, added] = seen.emplace(name, file.path);
    EXPECT_TRUE(added) << file.path << " and " << known->second;
  }
}

// Relative links and images of the documentation.
TEST(Documentation, LinksLeadToFiles) {
  const std::regex pattern(R"re(\]\(([^)#\s]+)(#[^)]*)?\))re");
  for (const SourceFile& file : pages()) {
    const auto folder = (source_root() / file.path).parent_path();
    bool fenced = false;
    for (const std::string& line : file.lines) {
      if (line.starts_with("```")) fenced = !fenced;
      if (fenced) continue;
      for (std::sregex_iterator it(line.begin(), line.end(), pattern), end; it != end; ++it) {
        const std::string target = (*it)[1].str();
        if (target.find("://") != std::string::npos || target.starts_with("mailto:")) continue;
        EXPECT_TRUE(std::filesystem::exists(folder / target)) << file.path << ": " << target;
      }
    }
  }
}

}  // namespace
}  // namespace etendue::test
