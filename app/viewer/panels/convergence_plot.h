// The chart of the Convergence panel, with a cross-hair that reads the curves.
#pragma once

namespace etendue::viewer {

class ConvergenceTask;
struct UiContext;

// Fills the rest of the current ImGui window.
void draw_convergence_chart(UiContext& ui, const ConvergenceTask& task);

}  // namespace etendue::viewer
