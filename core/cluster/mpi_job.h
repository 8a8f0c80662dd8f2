// Whether mpirun has started this process, and the ranks of its job.
#pragma once
#include "base/result.h"
#include "cluster/communicator.h"

namespace etendue::cluster {

// Whether this process is one of several that a launcher of MPI programs has started together. Only environment
// variables are read.
bool is_mpi_job();
// The rank as stated by the launcher; 0 without one.
int launched_rank();
// The number of processes of the job on this machine; 1 without a launcher.
int processes_on_machine();

// Loads the plugin and joins the job. The communicator exists until the process ends.
Result<Communicator*> join_mpi_job();

}  // namespace etendue::cluster
