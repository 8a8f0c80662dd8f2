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

// "etendue" and "etendue SCENE" stand for "etendue view" and "etendue view SCENE", with or without options before it.
bool omits_view(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return true;
  const std::string& first = arguments.front();
  return !is_option_without_command(first) &&
         std::ranges::none_of(commands(), [&](const Command& c) { return first == c.name; });
}

// The question which command was meant by the first argument, unless it is the name of a file; empty if none is similar.
std::string did_you_mean_command(const std::string& first) {
  std::error_code error;
  if (std::filesystem::exists(first, error)) return "";
  std::vector<std::string> names;
  for (const Command& command : commands()) names.push_back(command.name);
  return did_you_mean(first, names);
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
    const std::string question = arguments.empty() ? "" : did_you_mean_command(arguments.front());
    if (!question.empty())
      return fail(
          etendue::usage_error("there is no command '" + arguments.front() + "'" + question + " See etendue --help"));
    arguments.insert(arguments.begin(), "view");
  }
  return checked_output(parse_and_run(commands(), std::move(arguments)));
}
