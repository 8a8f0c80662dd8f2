// Whether mpirun has started this process, and the ranks of its job.
#pragma once
#include "base/result.h"
#include "cluster/communicator.h"

namespace etendue::cluster {

// Whether a launcher of MPI programs has started this process, as one of several or, by the mpirun of Open MPI, alone.
// Only environment variables are read.
bool is_mpi_job();
// The number of processes of the job, and the rank of this one, as stated by the launcher; 1 and 0 without one.
int launched_ranks();
int launched_rank();
// The number of processes of the job on this machine; 1 without a launcher.
int processes_on_machine();

// Loads the plugin and joins the job. The communicator exists until the process ends.
Result<Communicator*> join_mpi_job();

}  // namespace etendue::cluster
