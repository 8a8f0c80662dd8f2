// The program etendue. `etendue [SCENE]` opens the viewer; all other work is done by subcommands.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "base/similar_name.h"
#include "parser.h"

namespace etendue::cli {
namespace {

// "etendue" and "etendue SCENE" stand for "etendue view" and "etendue view SCENE".
bool omits_view(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return true;
  const std::string& first = arguments.front();
  return !first.starts_with("-") && std::ranges::none_of(commands(), [&](const Command& c) { return first == c.name; });
}

// The subcommand that an unknown first argument resembles, unless there is such a file; empty if there is none.
std::string similar_command(const std::string& first) {
  constexpr size_t kMostTypos = 2;
  std::error_code error;
  if (std::filesystem::exists(first, error)) return "";
  std::vector<std::string> names;
  for (const Command& command : commands()) names.push_back(command.name);
  const std::string similar = similar_name(first, names);
  return edit_distance(first, similar) <= std::min(kMostTypos, first.size() / 2) ? similar : "";
}

// An error if standard output is incomplete, for example because it goes to a full disk.
int checked_output(int code) {
  const bool complete = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.flush().good();
  if (complete || code != 0) return code;
  return fail(output_error("standard output could not be written completely; is the disk full?"));
}

}  // namespace
}  // namespace etendue::cli

int main(int argc, char** argv) {
  using namespace etendue::cli;
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (omits_view(arguments)) {
    const std::string similar = arguments.empty() ? "" : similar_command(arguments.front());
    if (!similar.empty())
      return fail(etendue::usage_error("there is no command '" + arguments.front() + "'; did you mean '" + similar +
                                       "'? See etendue --help"));
    arguments.insert(arguments.begin(), "view");
  }
  return checked_output(parse_and_run(commands(), std::move(arguments)));
}
