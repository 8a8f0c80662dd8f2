// Parsing the command line.
#pragma once
#include <string>
#include <vector>

#include "command.h"

namespace etendue::cli {

// Parses the arguments, which begin with the name of a subcommand, and runs it. Returns the exit code. Prints the help
// text if it is asked for.
int parse_and_run(const std::vector<Command>& commands, std::vector<std::string> arguments);

}  // namespace etendue::cli
