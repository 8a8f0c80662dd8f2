// The chart of the Convergence panel, with a cross-hair that reads the curves.
#pragma once
#include <cstddef>
#include <optional>

struct ImVec2;

namespace etendue::viewer {

class ConvergenceTask;
struct UiContext;

// Draws the chart with this size at the cursor. Returns the index of the method in the result whose point of the Pareto
// front was clicked.
std::optional<size_t> draw_convergence_chart(UiContext& ui, const ConvergenceTask& task, const ImVec2& size);

}  // namespace etendue::viewer
