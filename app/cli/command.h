// A subcommand: one file each, registered in main.cpp.
#pragma once
#include <functional>
#include <string>

#include "base/result.h"

namespace CLI {
class App;
}

namespace etendue::cli {

// Adds the options of a subcommand to the parser; the returned function runs it and gives the exit code.
using Command = std::function<int()>;

Command add_render(CLI::App& app);
Command add_compare(CLI::App& app);
Command add_bench(CLI::App& app);
Command add_inspect(CLI::App& app);
Command add_list(CLI::App& app);
Command add_save(CLI::App& app);
Command add_view(CLI::App& app);
Command add_stress(CLI::App& app);
Command add_advise(CLI::App& app);
Command add_certify(CLI::App& app);
Command add_bsdf(CLI::App& app);
Command add_probe(CLI::App& app);

// Prints "etendue: MESSAGE" on standard error and returns the exit code of the fault.
int fail(const Error& error);

}  // namespace etendue::cli
