#include "transport/path_expression/path_expression.h"

#include <optional>

namespace etendue::transport {
namespace {

using Part = Pattern::Part;

// The message for a character of another notation, or of a feature that is not available.
std::string about_letter(char c, char before) {
  if (c == '_' && (before == 'D' || before == 'S'))
    return std::string(1, before) + "_G (division by roughness) is not available yet; use D, G, S";
  switch (c) {
    case 'C':
      return "'C' is not a letter of path expressions; the camera is E";
    case 'R':
    case 'T':
      return std::string("'") + c +
             "' is not a letter of path expressions; reflection and transmission are both D, G or S";
    case '{':
    case '}':
      return std::string("'") + c + "' is not an operator; write repetitions out, or use * and +";
    case '^':
      return "'^' is not an operator; repetitions need none: DS*";
    case 'e':
    case 'l':
    case 'd':
    case 'g':
    case 's':
    case 'v':
      return std::string("'") + c +
             "' is not a letter of path expressions; letters are capital: " + static_cast<char>(c - 'a' + 'A');
    default:
      break;
  }
  const bool printable = c > ' ' && c < 127;
  return (printable ? std::string("'") + c + "'" : std::string("this character")) +
         " is not a letter of path expressions; use E, D, G, S, V, L and | * + ? . ( ) [ ]";
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Result<Automaton> run() {
    if (text_.size() > PathExpression::kMaxLength)
      return usage_error("path expression: it has more than " + std::to_string(PathExpression::kMaxLength) +
                         " characters; give a shorter one");
    const auto whole = alternatives();
    if (whole && !at_end()) fail(at_, closing_without_opening());
    if (problem_) return *problem_;
    auto automaton = Automaton::of(pattern_, *whole);
    if (!automaton)
      return usage_error("path expression '" + std::string(text_) + "': it needs more than " +
                         std::to_string(Automaton::kMostStates) + " states; give a simpler one");
    return *automaton;
  }

 private:
  // Skips spaces.
  bool at_end() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    return at_ == text_.size();
  }
  // The previous character that is not a space.
  char previous() const {
    const size_t last = text_.substr(0, at_).find_last_not_of(' ');
    return last == std::string_view::npos ? '\0' : text_[last];
  }
  char peek() { return at_end() ? '\0' : text_[at_]; }

  // Records the first problem. Columns count from 1.
  std::nullopt_t fail(size_t at, const std::string& what) {
    if (!problem_)
      problem_ =
          usage_error("path expression '" + std::string(text_) + "', column " + std::to_string(at + 1) + ": " + what);
    return std::nullopt;
  }

  std::string closing_without_opening() const {
    return std::string("'") + text_[at_] + "' has no opening bracket; remove it or add one";
  }

  std::optional<Part> alternatives() {
    auto whole = sequence();
    while (whole && peek() == '|') {
      ++at_;
      const auto other = sequence();
      if (!other) return {};
      whole = pattern_.either(*whole, *other);
    }
    return whole;
  }

  std::optional<Part> sequence() {
    if (at_end() || peek() == '|' || peek() == ')' || peek() == ']') return nothing_here();
    std::optional<Part> whole;
    while (!at_end() && peek() != '|' && peek() != ')' && peek() != ']') {
      const auto next = repeated();
      if (!next) return {};
      whole = whole ? pattern_.sequence(*whole, *next) : *next;
    }
    return whole;
  }

  std::nullopt_t nothing_here() {
    const char c = peek();
    if (c == '\0' && at_ == 0) return fail(0, "it is empty; E.*L is every path");
    if (c == '\0') return fail(at_, "something is missing at the end; give a letter or a bracket");
    if (c == '|' || previous() == '|') return fail(at_, "one side of '|' is empty; [A|B] also stands for nothing");
    if (open_ == 0) return fail(at_, closing_without_opening());
    return fail(at_, "there is nothing between the brackets; give a letter");
  }

  std::optional<Part> repeated() {
    auto part = single();
    for (char c = peek(); part && (c == '*' || c == '+' || c == '?'); c = peek()) {
      ++at_;
      if (c != '?') part = pattern_.at_least_once(*part);
      if (c != '+') part = pattern_.optional(*part);
    }
    return part;
  }

  std::optional<Part> single() {
    const size_t column = at_;
    const char c = text_[at_++];
    if (c == '(' || c == '[') return bracketed(column, c);
    if (c == '.') return pattern_.one_of(kScattering);
    if (c == '*' || c == '+' || c == '?')
      return fail(column, std::string("'") + c + "' has nothing to repeat; give a letter or a bracket before it");
    const size_t event = kLetters.find(c);
    if (event == std::string_view::npos) return fail(column, about_letter(c, column > 0 ? text_[column - 1] : ' '));
    return pattern_.one_of(letters_of(static_cast<Event>(event)));
  }

  std::optional<Part> bracketed(size_t column, char opening) {
    const char closing = opening == '(' ? ')' : ']';
    if (++open_ > PathExpression::kMaxNesting)
      return fail(column, "more than " + std::to_string(PathExpression::kMaxNesting) +
                              " nested brackets; give a simpler expression");
    const auto inner = alternatives();
    if (!inner) return {};
    if (at_end()) return fail(column, std::string("'") + opening + "' is never closed; add '" + closing + "'");
    if (peek() != closing)
      return fail(at_, std::string("'") + peek() + "' does not close the '" + opening + "' of column " +
                           std::to_string(column + 1) + "; give '" + closing + "'");
    ++at_;
    --open_;
    return opening == '[' ? pattern_.optional(*inner) : *inner;
  }

  std::string_view text_;
  size_t at_ = 0;
  int open_ = 0;
  Pattern pattern_;
  std::optional<Error> problem_;
};

}  // namespace

Result<PathExpression> PathExpression::parse(std::string_view text) {
  auto automaton = Parser(text).run();
  if (!automaton) return automaton.error();
  return PathExpression(text, std::move(*automaton));
}

Result<PathExpression> PathExpression::parse_paths(std::string_view text) {
  auto any = parse(text);
  if (!any) return any;
  const auto paths = Automaton::intersection(any->automaton(), all().automaton());
  auto from_light = paths ? Automaton::reversal(*paths) : std::nullopt;
  if (!from_light)
    return usage_error("path expression '" + std::string(text) + "': it needs more than " +
                       std::to_string(Automaton::kMostStates) + " states; give a simpler one");
  if (paths->empty())
    return usage_error("path expression '" + std::string(text) +
                       "': no path matches; a path begins with E, the eye, ends with L, the light, and has neither in "
                       "between: E.*L is every path");
  return PathExpression(text, *paths, std::move(from_light));
}

const PathExpression& PathExpression::all() {
  static const PathExpression every = [] {
    PathExpression all = *parse("E.*L");
    all.from_light_ = Automaton::reversal(all.automaton_);
    return all;
  }();
  return every;
}

const PathExpression& PathExpression::without_volumes() {
  static const PathExpression surfaces = *parse_paths("E(D|G|S)*L");
  return surfaces;
}

}  // namespace etendue::transport
