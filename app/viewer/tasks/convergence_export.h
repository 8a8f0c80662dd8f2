// Files of a comparison of methods.
#pragma once
#include <span>
#include <string>

#include "base/result.h"
#include "bench/live_benchmark.h"
#include "metrics/pareto_chart.h"

namespace etendue::viewer {

// Writes the chart of the curves or of the Pareto front as .svg or .png, or the points of the curves as .csv. Returns the
// file name.
Result<std::string> write_convergence_chart(const std::string& file, const bench::LiveBenchmarkSnapshot& snapshot,
                                            std::span<const metrics::MethodCurves> curves,
                                            const metrics::ChartOptions& options, bool is_pareto);

}  // namespace etendue::viewer
