// Experiments: numerical mathematics of light transport in one or a few dimensions, with known results.
//
// An experiment is one .cpp file with a class like
//
//   struct Quadrature {
//     static constexpr ExperimentDescription kDescription{.name = "quadrature", ...};
//     Number<int> dimension{"dimension", "Dimension", 1, {1, 32}, "Number of variables of the integrand"};
//     auto parameters() { return std::tie(dimension); }
//     Result<ExperimentResult> run(const RunContext& context) const;
//   };
//   Experiment quadrature_experiment() { return make_experiment<Quadrature>(); }
//
// and one line in registry.cpp. `etendue lab`, the Lab panel, the manual and the tests read the registry. The comment at
// the top of the file is the text of its manual page.
#pragma once
#include <functional>
#include <limits>
#include <source_location>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/parameter.h"
#include "base/result.h"
#include "metrics/convergence.h"
#include "metrics/function_chart.h"
#include "metrics/matrix_chart.h"

namespace etendue::experiments {

// ---- Results

// Error over work, drawn by the chart that also shows the error of renderings. The work is stored in ErrorPoint::spp.
struct ErrorChart {
  std::string title;
  std::string work;            // what is counted: "evaluations", "paths"
  std::string error = "RMSE";  // which error is drawn
  std::vector<metrics::MethodCurves> curves;
};

using Chart = std::variant<ErrorChart, metrics::FunctionChart, metrics::MatrixChart>;

struct Table {
  using Cell = std::variant<double, std::string>;
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
};

// A number that has a known value.
struct Check {
  std::string name;
  double measured = 0, expected = 0;
  double tolerance = 0;  // largest permitted |measured - expected|
  bool holds() const;
};

struct ExperimentResult {
  std::vector<Chart> charts;
  Table table;
  std::vector<Check> checks;
  std::vector<std::string> notes;  // sentences for people: what diverges, what was left out
};

// ---- Running

struct RunContext {
  uint64_t seed = 0;
  // Called now and then with the share of the work that is done; the run ends soon after it has returned false.
  std::function<bool(double)> progress = {};
  // Receives intermediate results. May be empty.
  std::function<void(const ExperimentResult&)> publish = {};

  bool proceed(double share) const { return !progress || progress(share); }
};
// The result of a run that `progress` has ended.
Error interrupted();

// ---- Registry

// What an experiment class states about itself.
struct ExperimentDescription {
  const char* name;     // the argument of `etendue lab`
  const char* label;    // title of its page
  const char* summary;  // one sentence without a full stop: what it shows
  const char* source;   // section of the thesis, papers
  // The file that contains the description, for the manual.
  const char* file = std::source_location::current().file_name();
};

struct Experiment {
  ExperimentDescription description;
  std::vector<ParameterInfo> parameters;
  // The settings must have passed parse_value.
  std::function<Result<ExperimentResult>(const std::vector<Setting>&, const RunContext&)> run;
};

template <class T>
Experiment make_experiment() {
  T defaults;
  return {.description = T::kDescription,
          .parameters = describe_all(defaults.parameters()),
          .run = [](const std::vector<Setting>& settings, const RunContext& context) {
            T experiment;
            for (const Setting& s : settings) assign_by_name(experiment.parameters(), s.name, s.value);
            return experiment.run(context);
          }};
}

// All experiments in the order of the registry.
const std::vector<Experiment>& experiments();
// Null if there is no such experiment.
const Experiment* find_experiment(std::string_view name);

}  // namespace etendue::experiments
