#include "cluster/mpi_job.h"

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

#include "base/load_plugin.h"

namespace etendue::cluster {
namespace {

constexpr PluginDescription kMpiPluginDescription{"libetendue_mpi.so", "Open MPI", "openmpi-bin",
                                                  "the package libopenmpi-dev"};

// The value of the first environment variable that is a number; `otherwise` without one.
int number_from_environment(std::initializer_list<const char*> names, int otherwise) {
  for (const char* name : names) {
    const char* text = std::getenv(name);
    int value = 0;
    if (text && std::from_chars(text, text + std::strlen(text), value).ec == std::errc()) return value;
  }
  return otherwise;
}

constexpr const char* kSizeByOpenMpi = "OMPI_COMM_WORLD_SIZE";

}  // namespace

// Schedulers set the variable of MPICH for single processes too that are not part of a job of MPI.
bool is_mpi_job() { return launched_ranks() > 1 || number_from_environment({kSizeByOpenMpi}, 0) == 1; }
int launched_ranks() { return number_from_environment({kSizeByOpenMpi, "PMI_SIZE"}, 1); }
int launched_rank() { return is_mpi_job() ? number_from_environment({"OMPI_COMM_WORLD_RANK", "PMI_RANK"}, 0) : 0; }
int processes_on_machine() { return number_from_environment({"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"}, 1); }

Result<Communicator*> join_mpi_job() {
  const auto plugin = load_plugin(kMpiPluginDescription, plugin_folders(), kGetMpiPlugin, kMpiPluginVersion);
  if (!plugin) return input_error("mpirun: " + plugin.error().message);
  Communicator* const communicator = (*static_cast<const JoinJob*>(*plugin))();
  if (!communicator) return input_error("mpirun: the ranks of this job cannot be joined; see the message of MPI above");
  if (communicator->size() != launched_ranks())
    return input_error("mpirun: the launcher has started " + std::to_string(launched_ranks()) +
                       " ranks, but MPI has joined " + std::to_string(communicator->size()) +
                       "; use the mpirun of Open MPI");
  return communicator;
}

}  // namespace etendue::cluster
