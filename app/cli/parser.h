// Parsing the command line.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "command.h"

namespace etendue::cli {

// Parses the arguments, which begin with the name of a subcommand, and runs it. Returns the exit code. Prints the help
// text if it is asked for.
int parse_and_run(const std::vector<Command>& commands, std::vector<std::string> arguments);

// Whether it is an option that needs no subcommand: those that print help or the version.
bool is_option_without_command(std::string_view argument);

}  // namespace etendue::cli
