// Every subcommand, in the order of the help text; one line each.
#include <cstdio>

#include "command.h"

// clang-format off
#define ETENDUE_COMMANDS(ENTRY) \
  ENTRY(render)                 \
  ENTRY(compare)                \
  ENTRY(bench)                  \
  ENTRY(advise)                 \
  ENTRY(certify)                \
  ENTRY(inspect)                \
  ENTRY(bsdf)                   \
  ENTRY(probe)                  \
  ENTRY(trace)                  \
  ENTRY(save)                   \
  ENTRY(list)                   \
  ENTRY(manual)                 \
  ENTRY(stress)                 \
  ENTRY(view)
// clang-format on

namespace etendue::cli {

#define ETENDUE_DECLARE(NAME) Command NAME##_command();
ETENDUE_COMMANDS(ETENDUE_DECLARE)

#define ETENDUE_CALL(NAME) NAME##_command(),
const std::vector<Command>& commands() {
  static const std::vector<Command> all{ETENDUE_COMMANDS(ETENDUE_CALL)};
  return all;
}

int fail(const Error& error) {
  std::fprintf(stderr, "etendue: %s\n", error.message.c_str());
  return static_cast<int>(error.fault);
}

}  // namespace etendue::cli
