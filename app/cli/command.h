// Subcommands and their options.
//
// A subcommand is one .cpp file with a function that describes it:
//
//   Command compare_command() {
//     const auto a = std::make_shared<CompareArguments>();
//     return {.name = "compare",
//             .summary = "Compare an image with a reference",
//             .options = {{.names = "image", .target = &a->image, .doc = "The image", .required = true}},
//             .run = [a] { return run_compare(*a); }};
//   }
//
// The second place is one line in commands.cpp. Only parser.cpp includes the library that parses the command line.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "base/result.h"

namespace etendue::cli {

// The values that a number may have.
struct Bounds {
  enum class Kind { none, positive, non_negative, range };
  Kind kind = Kind::none;
  double min = 0, max = 0;  // inclusive, of a range
};
inline constexpr Bounds kPositive{Bounds::Kind::positive};
inline constexpr Bounds kNonNegative{Bounds::Kind::non_negative};
constexpr Bounds between(double min, double max) { return {Bounds::Kind::range, min, max}; }

struct CommandOption {
  // The variable that receives the value. A bool is a flag without a value.
  using Target = std::variant<bool*, int*, uint32_t*, int64_t*, uint64_t*, double*, std::string*,
                              std::vector<std::string>*, std::vector<int>*, std::vector<float>*>;

  std::string names;  // "-o,--out", or "scene" for a positional argument
  Target target;
  std::string doc;
  bool required = false;
  Bounds bounds = {};
  std::vector<std::string> choices = {};  // the allowed texts; empty: any
  int count = 0;                          // number of values of a list; 0: one for each time the option is given
  std::string needs = {};                 // another option that must be given as well
};

struct Command {
  std::string name;
  std::string summary;
  std::vector<CommandOption> options;
  std::function<int()> run;  // returns the exit code
  // Whether the processes that mpirun starts share the work. Without it, a job of several ranks is refused.
  bool supports_ranks = false;
};

// All subcommands, in the order of the help text.
const std::vector<Command>& commands();

// Prints "etendue: MESSAGE" on standard error and returns the exit code of the error.
int fail(const Error& error);
// The same for an error that all ranks of a job of mpirun find. Rank 0 reports it, and mpirun then ends the others, which
// wait for that. If rank 0 has no such error, because its arguments differ, they report it after a while.
int fail_on_all_ranks(const Error& error);

}  // namespace etendue::cli
