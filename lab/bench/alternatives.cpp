#include "bench/alternatives.h"

namespace etendue::bench {
namespace {

Error unmatched(const std::string& text) {
  return usage_error("'" + text + "': a brace has no counterpart; give alternatives as {a,b}");
}

// The parts of a text between commas.
std::vector<std::string> alternatives_of(const std::string& text) {
  std::vector<std::string> list(1);
  for (const char c : text) {
    if (c == ',')
      list.emplace_back();
    else
      list.back() += c;
  }
  return list;
}

}  // namespace

Result<std::vector<std::string>> expand_alternatives(const std::string& text) {
  std::vector<std::string> texts{""};
  size_t begin = 0;
  while (true) {
    const size_t open = text.find_first_of("{}", begin);
    const std::string literal = text.substr(begin, open == std::string::npos ? open : open - begin);
    for (std::string& t : texts) t += literal;
    if (open == std::string::npos) return texts;
    const size_t close = text.find_first_of("{}", open + 1);
    if (text[open] == '}' || close == std::string::npos || text[close] == '{') return unmatched(text);
    const std::vector<std::string> alternatives = alternatives_of(text.substr(open + 1, close - open - 1));
    if (texts.size() * alternatives.size() > kMostAlternatives)
      return usage_error("'" + text + "' stands for more than " + std::to_string(kMostAlternatives) +
                         " methods; give fewer alternatives");
    std::vector<std::string> longer;
    for (const std::string& t : texts)
      for (const std::string& alternative : alternatives) longer.push_back(t + alternative);
    texts = std::move(longer);
    begin = close + 1;
  }
}

}  // namespace etendue::bench
