// Path expressions: an expression that is accepted must be equal to the one that its automaton gives.
#include "integration/fuzz/target.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::fuzz {
namespace {

using transport::PathExpression;

void parse(Input input) {
  const auto any = PathExpression::parse(text_of(input));
  const auto paths = PathExpression::parse_paths(text_of(input));
  if (!paths) return;
  require(static_cast<bool>(any), "an expression of paths is not an expression");
  const auto again = PathExpression::parse(expression_of(paths->automaton()));
  require(!again || again->automaton() == paths->automaton(), "the expression of an automaton has another automaton");
}

std::vector<Bytes> expressions() {
  std::vector<Bytes> seeds;
  for (const char* text : {"E(D|G|S)*L", "EDS+L", "ES*[D|G]L", "E.*L", "E D? (G|S)+ L", "EL", "E[[D]G]L", "E(D_G|V)L",
                           "((((E))))L", "E(S|D)*(G|S)*DL"})
    seeds.push_back(bytes_of(text));
  return seeds;
}

bool splice(Bytes& input, Mutator& mutator) {
  static constexpr std::string_view kLetters = "EDGSVL|*+?.()[] ";
  if (input.empty()) return false;
  const auto place = [&] { return input.begin() + mutator.below(static_cast<int>(input.size())); };
  const auto letter = static_cast<std::byte>(kLetters[static_cast<size_t>(mutator.below(kLetters.size()))]);
  if (mutator.below(2) == 0)
    *place() = letter;
  else
    input.insert(place(), letter);
  return true;
}

}  // namespace

const Target kTarget{.run = parse, .seeds = expressions, .mutate = splice};

}  // namespace etendue::fuzz
