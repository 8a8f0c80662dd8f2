// The comments at the top of source files, as Markdown. The manual consists of them and of the registries.
#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "base/result.h"

namespace etendue::cli {

struct HeadComment {
  std::string markdown;
  std::set<std::string> labels;  // of its labelled paragraphs: "Properties", "Sampling"
  bool has_formula = false;
};

// Converts the text of a comment. Its form:
//   a paragraph per block of lines; text that is set off by several spaces at the end of a line is a citation;
//   lines that are indented by two or more spaces are formulas, unless they start with a label and two spaces
//   ("  Properties   Reciprocal."); lines that are indented further continue the paragraph of the label.
HeadComment parse_head_comment(const std::string& comment);

// The source files of a checkout, found by their names without folders.
class SourceFiles {
 public:
  // An input error if `root` is not the root of a checkout.
  static Result<SourceFiles> open(const std::filesystem::path& root);

  // `file` may have any folder. Empty if there is no such file or it has no comment at the top.
  HeadComment head_comment(const std::filesystem::path& file) const;
  std::string text(const std::filesystem::path& file) const;
  // Whether a file exists, by its path relative to the root.
  bool has_file(const std::string& path) const { return std::filesystem::exists(root_ / path); }
  // The path relative to the root; empty if there is no such file.
  std::string relative_path(const std::filesystem::path& file) const;

 private:
  std::filesystem::path root_;
  std::map<std::string, std::filesystem::path> files_;
};

// Escapes characters that Markdown interprets, and links citations like [Lang, eq. 9.26] to docs/references.md.
// `references` is the link's target.
std::string markdown_prose(const std::string& text, const std::string& references);

}  // namespace etendue::cli
