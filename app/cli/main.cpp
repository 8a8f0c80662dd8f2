// The program etendue. `etendue [SCENE]` opens the viewer; all other work is done by subcommands.
#include <algorithm>
#include <string>
#include <vector>

#include "parser.h"

namespace etendue::cli {
namespace {

// "etendue" and "etendue SCENE" stand for "etendue view" and "etendue view SCENE".
bool omits_view(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return true;
  const std::string& first = arguments.front();
  return !first.starts_with("-") && std::ranges::none_of(commands(), [&](const Command& c) { return first == c.name; });
}

}  // namespace
}  // namespace etendue::cli

int main(int argc, char** argv) {
  using namespace etendue::cli;
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (omits_view(arguments)) arguments.insert(arguments.begin(), "view");
  return parse_and_run(commands(), std::move(arguments));
}
