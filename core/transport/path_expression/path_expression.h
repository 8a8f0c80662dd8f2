// Classes of light paths in Heckbert's notation.                       thesis 8.1, Example 8.1; Heckbert 1990
//
// A path is a word, read from the camera to the light: E (the eye), one letter for each scattering event, L (the
// light).
//
//   D  ideal diffuse     G  glossy     S  ideal specular     reflected or transmitted: the lobe that scattered
//
// An expression stands for a set of words:
//
//   AB      A, then B                        A|B     one of the two
//   (A)     A as one thing                   [A]     A or nothing, as the thesis has it: E[D|G]L includes EL
//   A*      any number of A, none included   A+      one A or more      A?   A or nothing
//   .       any scattering, (D|G|S)          spaces  mean nothing
//
// EL is what emits in view, E(D|G)L direct light, EDS+L caustics, ES*[D|G]L what Whitted's ray tracing finds,
// E(D|G|S)*L everything. Surfaces with several lobes belong to several classes at once (see transport/class_shares.h).
// The thesis's D_G and S_G (photon maps, 9.5) and V (scattering in volumes) are known and refused: no method here
// tells them apart yet. Its arrows, the direction of computation, belong to a method and not to a class.
#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "transport/path_expression/automaton.h"

namespace etendue::transport {

class PathExpression {
 public:
  // Letters that an expression may be long, and brackets that may stand inside each other.
  static constexpr size_t kMaxLength = 256;
  static constexpr int kMaxNesting = 64;

  // A usage error says what is wrong, at which column (from 1), and what would be right. An expression that needs more
  // than Automaton::kMostStates states is one.
  static Result<PathExpression> parse(std::string_view text);

  // The same, and no path at all (a word from E over scattering to L) matching it is a usage error too. Words that are
  // no paths are left out of it, so that the dead state is reached as early as can be. It can be read from both ends.
  static Result<PathExpression> parse_paths(std::string_view text);

  // E(D|G|S)*L
  static const PathExpression& all();

  const std::string& text() const { return text_; }
  const Automaton& automaton() const { return automaton_; }
  // Reads words from the light; only expressions of paths have one.
  const std::optional<Automaton>& from_light() const { return from_light_; }
  bool matches(std::string_view word) const { return automaton_.accepts(word); }

 private:
  PathExpression(std::string_view text, Automaton automaton, std::optional<Automaton> from_light = {})
      : text_(text), automaton_(std::move(automaton)), from_light_(std::move(from_light)) {}

  std::string text_;
  Automaton automaton_;
  std::optional<Automaton> from_light_;
};

// Text that stands for the words of an automaton, which must accept one at least (states eliminated one by one:
// Brzozowski & McCluskey 1963). Of many states it may be longer than `parse` takes.
std::string expression_of(const Automaton& automaton);

}  // namespace etendue::transport
