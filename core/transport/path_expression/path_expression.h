// Classes of light paths in Heckbert's notation.                           [Heckbert 1990; Lang, sec. 8.1, Example 8.1]
//
// A path is a word, read from the camera to the light: E (the eye), one letter for each scattering event, L (the
// light).
//
//   D  ideal diffuse     G  glossy     S  ideal specular     reflected or transmitted: the lobe that scattered
//   V  scattered in a volume by a participating medium
//
// An expression stands for a set of words:
//
//   AB      A, then B                        A|B     A or B
//   (A)     A as a unit                      [A]     A or nothing, as in [Lang]: E[D|G]L includes EL
//   A*      zero or more A                   A+      one or more A      A?   A or nothing
//   .       any scattering, (D|G|S|V)        spaces  are ignored
//
// EL is directly visible emission, E(D|G)L direct light, EDS+L caustics, ES*[D|G]L the paths of Whitted's ray tracing,
// E.*L everything, E(D|G|S)*L everything in a scene without scattering media. Surfaces with several lobes belong to
// several classes at once (class_shares.h). The letters D_G and S_G of [Lang, sec. 9.5] are reported as not available.
// The arrows of [Lang], the direction of computation, belong to an integrator and not to a class.
#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "transport/path_expression/automaton.h"

namespace etendue::transport {

class PathExpression {
 public:
  // Limits of the number of characters and of nested brackets.
  static constexpr size_t kMaxLength = 256;
  static constexpr int kMaxNesting = 64;

  // Parses an expression. A usage error states the problem, its column (from 1), and the correction. It is also an
  // error if the expression needs more than Automaton::kMostStates states.
  static Result<PathExpression> parse(std::string_view text);

  // Parses an expression of paths: words from E over scattering to L. Other words are removed, and it is a usage error
  // if no path remains. The result can be evaluated from both ends.
  static Result<PathExpression> parse_paths(std::string_view text);

  // E.*L
  static const PathExpression& all();
  // E(D|G|S)*L: all paths of a scene without scattering media.
  static const PathExpression& without_volumes();
  // All paths of a scene.
  static const PathExpression& all_of(bool has_scattering_media) {
    return has_scattering_media ? all() : without_volumes();
  }

  const std::string& text() const { return text_; }
  const Automaton& automaton() const { return automaton_; }
  // Reads words from the light; only for expressions of paths.
  const std::optional<Automaton>& from_light() const { return from_light_; }
  bool matches(std::string_view word) const { return automaton_.accepts(word); }

 private:
  PathExpression(std::string_view text, Automaton automaton, std::optional<Automaton> from_light = {})
      : text_(text), automaton_(std::move(automaton)), from_light_(std::move(from_light)) {}

  std::string text_;
  Automaton automaton_;
  std::optional<Automaton> from_light_;
};

// An expression of the words of an automaton, which must accept at least one (state elimination [Brzozowski and
// McCluskey 1963]). For many states it can be longer than `parse` accepts. Without `volumes`, the automaton contains only
// paths of scenes without scattering media; the expression is exact among these, and '.' stands for D, G and S.
std::string expression_of(const Automaton& automaton, bool volumes = true);

}  // namespace etendue::transport
