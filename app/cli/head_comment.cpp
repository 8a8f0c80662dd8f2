#include "head_comment.h"

#include <fstream>
#include <regex>
#include <sstream>
#include <vector>

namespace etendue::cli {
namespace {

std::string without_outer_spaces(const std::string& text) {
  const size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Prose with single spaces.
std::string collapsed(const std::string& text) { return std::regex_replace(text, std::regex(" {2,}"), " "); }

// Builds Markdown from the lines of a comment.
class CommentParser {
 public:
  void add(const std::string& line) {
    static const std::regex kLabel("^ {2,4}([A-Z][a-z]+(?: [a-z]+)?) {2,}(\\S.*)$");
    const size_t indent = line.find_first_not_of(' ');
    std::smatch match;
    if (indent == std::string::npos) {
      end_block();
    } else if (std::regex_match(line, match, kLabel)) {
      end_block();
      result_.labels.insert(match[1]);
      paragraph_ = "**" + match[1].str() + ".** ";
      append(match[2]);
      labelled_ = true;
    } else if (indent < 2 || labelled_) {
      end_formula();
      append(line);
    } else {
      end_paragraph();
      formula_ += "    " + line.substr(2) + "\n";
      result_.has_formula = true;
    }
  }

  HeadComment take() {
    end_block();
    return std::move(result_);
  }

 private:
  void append(const std::string& text) {
    if (!paragraph_.empty() && paragraph_.back() != ' ') paragraph_ += ' ';
    paragraph_ += markdown_prose(collapsed(without_outer_spaces(text)), "../../references.md");
  }
  void end_paragraph() {
    if (!paragraph_.empty()) result_.markdown += paragraph_ + "\n\n";
    paragraph_.clear();
    labelled_ = false;
  }
  void end_formula() {
    if (!formula_.empty()) result_.markdown += formula_ + "\n";
    formula_.clear();
  }
  void end_block() {
    end_paragraph();
    end_formula();
  }

  HeadComment result_;
  std::string paragraph_, formula_;
  bool labelled_ = false;
};

}  // namespace

std::string markdown_prose(const std::string& text, const std::string& references) {
  std::string escaped;
  for (const char c : text) {
    if (c == '<')
      escaped += "&lt;";
    else if (c == '*' || c == '_' || c == '|')
      escaped += std::string("\\") + c;
    else
      escaped += c;
  }
  static const std::regex kCitation("\\[([A-Z][^\\[\\]]*[0-9][^\\[\\]]*)\\]");
  return std::regex_replace(escaped, kCitation, "[[$1]](" + references + ")");
}

HeadComment parse_head_comment(const std::string& comment) {
  CommentParser parser;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) parser.add(line);
  return parser.take();
}

Result<SourceFiles> SourceFiles::open(const std::filesystem::path& root) {
  SourceFiles files;
  files.root_ = root;
  for (const char* folder : {"core", "lab"}) {
    std::error_code error;
    if (!std::filesystem::is_directory(root / folder, error))
      return input_error("'" + root.string() + "' is not a checkout of etendue: it has no folder '" + folder + "'");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
      if (entry.is_regular_file()) files.files_[entry.path().filename().string()] = entry.path();
  }
  return files;
}

std::string SourceFiles::text(const std::filesystem::path& file) const {
  const auto found = files_.find(file.filename().string());
  if (found == files_.end()) return "";
  std::ifstream stream(found->second);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string SourceFiles::relative_path(const std::filesystem::path& file) const {
  const auto found = files_.find(file.filename().string());
  return found == files_.end() ? "" : found->second.lexically_relative(root_).generic_string();
}

HeadComment SourceFiles::head_comment(const std::filesystem::path& file) const {
  std::istringstream lines(text(file));
  std::string comment;
  for (std::string line; std::getline(lines, line) && line.starts_with("//");)
    comment += line.substr(line.starts_with("// ") ? 3 : 2) + "\n";
  return parse_head_comment(comment);
}

}  // namespace etendue::cli
