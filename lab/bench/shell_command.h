// Running a program of the user's choice.
#pragma once
#include <functional>
#include <string>

#include "base/result.h"

namespace etendue::bench {

// Runs a command in a shell, with its output suppressed, and returns the wall time in seconds. Polls `keep_going`; if it
// returns false, ends the program and everything that it started (Fault::interrupted). Errors: the program cannot be
// started, or its exit code is not 0; the message has the last line of its standard error.
Result<double> run_shell_command(const std::string& command, const std::function<bool()>& keep_going);

// Quotes an argument for a shell if necessary.
std::string shell_quoted(const std::string& text);

}  // namespace etendue::bench
