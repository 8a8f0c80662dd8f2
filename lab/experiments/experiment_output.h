// The result of an experiment as text, JSON, CSV and drawing.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "experiments/experiment.h"

namespace etendue::experiments {

// The drawing of one chart.
metrics::Drawing drawing_of(const Chart& chart, const metrics::ChartOptions& options = {});
// All charts, one below the other.
metrics::Drawing drawing_of(const ExperimentResult& result, const metrics::ChartOptions& options = {});
const std::string& title_of(const Chart& chart);

nlohmann::json to_json(const ExperimentResult& result);
// All points of all charts, one per row: chart, curve, repeat, x, y, low, high.
std::string to_csv(const ExperimentResult& result);
// Table, checks and notes for a terminal.
std::string to_text(const ExperimentResult& result);

// A number with this many significant digits, or a text of the table.
std::string cell_text(const Table::Cell& cell, int digits = 6);

// Writes .csv, .json, .png or .svg, by the extension of the file. A usage error names the extensions.
Result<void> write_result(const std::string& file, const ExperimentResult& result);

}  // namespace etendue::experiments
