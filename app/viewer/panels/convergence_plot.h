// The chart of the Convergence panel, with a cross-hair that reads the curves.
#pragma once
#include <cstddef>
#include <optional>

namespace etendue::viewer {

class ConvergenceTask;
struct UiContext;

// Fills the rest of the current ImGui window. Returns the index of the method in the result whose point of the Pareto
// front was clicked.
std::optional<size_t> draw_convergence_chart(UiContext& ui, const ConvergenceTask& task);

}  // namespace etendue::viewer
