// The viewer on several ranks of a job that mpirun has started.
#pragma once
#include "viewer/viewer.h"

namespace etendue::cli {

// Runs the viewer on rank 0, and renders for it on the other ranks. Returns the exit code.
int view_on_ranks(const viewer::ViewOptions& options);

}  // namespace etendue::cli
