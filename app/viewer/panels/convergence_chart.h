// The chart of a contest as a panel, with a cross-hair that reads it.
#pragma once
#include "viewer/state/app_state.h"

namespace etendue::viewer {

// Fills what is left of the present window.
void draw_convergence_chart(Workbench& w);

}  // namespace etendue::viewer
