// Every subcommand, in the order of the help text; one line each.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "cluster/mpi_job.h"
#include "command.h"
#include "scene_options.h"

// clang-format off
#define ETENDUE_COMMANDS(ENTRY) \
  ENTRY(render)                 \
  ENTRY(merge)                  \
  ENTRY(compare)                \
  ENTRY(bench)                  \
  ENTRY(advise)                 \
  ENTRY(certify)                \
  ENTRY(inspect)                \
  ENTRY(bsdf)                   \
  ENTRY(phase)                  \
  ENTRY(spectrum)               \
  ENTRY(radiosity)              \
  ENTRY(energy)                 \
  ENTRY(importance)             \
  ENTRY(probe)                  \
  ENTRY(trace)                  \
  ENTRY(save)                   \
  ENTRY(list)                   \
  ENTRY(manual)                 \
  ENTRY(stress)                 \
  ENTRY(lab)                    \
  ENTRY(pattern)                \
  ENTRY(figure)                 \
  ENTRY(completion)             \
  ENTRY(view)
// clang-format on

namespace etendue::cli {

#define ETENDUE_DECLARE(NAME) Command NAME##_command();
ETENDUE_COMMANDS(ETENDUE_DECLARE)

namespace {

// Adds --texture-memory to a command that opens scenes.
Command with_texture_memory(Command command) {
  const auto opens_scene = [](const CommandOption& option) { return option.names == "scene"; };
  if (std::ranges::none_of(command.options, opens_scene)) return command;
  const auto size = std::make_shared<std::string>();
  command.options.push_back(texture_memory_option(*size));
  command.run = [size, run = std::move(command.run)] {
    const auto set = set_texture_memory(*size);
    return set ? run() : fail(set.error());
  };
  return command;
}

}  // namespace

#define ETENDUE_CALL(NAME) with_texture_memory(NAME##_command()),
const std::vector<Command>& commands() {
  static const std::vector<Command> all{ETENDUE_COMMANDS(ETENDUE_CALL)};
  return all;
}

int fail(const Error& error) {
  std::fprintf(stderr, "etendue: %s\n", error.message.c_str());
  return static_cast<int>(error.fault);
}

int fail_on_all_ranks(const Error& error) {
  const int rank = cluster::launched_rank();
  if (rank == 0) return fail(error);
  std::this_thread::sleep_for(std::chrono::seconds(5));
  return fail({error.fault, "rank " + std::to_string(rank) + ": " + error.message});
}

}  // namespace etendue::cli
