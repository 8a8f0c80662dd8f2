// etendue lab: experiments on integration, sampling and integral equations, with known results.
#include <cstdio>
#include <memory>

#include "command.h"
#include "experiments/experiment.h"
#include "experiments/experiment_output.h"
#include "interrupt.h"
#include "json.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

struct LabArguments {
  std::string experiment, out;
  std::vector<std::string> settings;
  uint64_t seed = 0;
  bool json = false;
};

std::string experiment_names() {
  std::string names;
  for (const auto& e : experiments::experiments())
    names += (names.empty() ? "" : ", ") + std::string(e.description.name);
  return names;
}

json experiment_list_json() {
  json list = json::array();
  for (const auto& e : experiments::experiments())
    list.push_back({{"name", e.description.name},
                    {"label", e.description.label},
                    {"doc", e.description.summary},
                    {"source", e.description.source}});
  return list;
}

int list_experiments(bool as_json) {
  if (as_json) {
    std::printf("%s\n", experiment_list_json().dump(2).c_str());
    return 0;
  }
  for (const auto& e : experiments::experiments()) std::printf("%-20s %s\n", e.description.name, e.description.summary);
  return 0;
}

int run_lab(const LabArguments& a) {
  if (a.experiment.empty()) return list_experiments(a.json);
  const experiments::Experiment* experiment = experiments::find_experiment(a.experiment);
  if (!experiment)
    return fail(usage_error("there is no experiment '" + a.experiment + "'; give one of " + experiment_names()));
  const auto settings = parse_settings(a.settings, experiment->parameters, "the experiment '" + a.experiment + "'",
                                       "etendue list experiments");
  if (!settings) return fail(settings.error());
  const std::atomic<bool>& interrupted = watch_interrupts();
  const auto result =
      experiment->run(*settings, {.seed = a.seed, .progress = [&](double) { return !interrupted; }, .publish = {}});
  if (!result) return fail(result.error());
  if (!a.out.empty())
    if (const auto written = experiments::write_result(a.out, *result); !written) return fail(written.error());
  if (a.json)
    std::printf("%s\n", experiments::to_json(*result).dump(2).c_str());
  else
    std::printf("%s\n%s", experiment->description.label, experiments::to_text(*result).c_str());
  return 0;
}

}  // namespace

Command lab_command() {
  const auto a = std::make_shared<LabArguments>();
  return {
      .name = "lab",
      .summary = "Run an experiment on integration, sampling or integral equations; without a name, list them",
      .options = {{.names = "experiment", .target = &a->experiment, .doc = "One of " + experiment_names()},
                  {.names = "--set", .target = &a->settings, .doc = "NAME=VALUE: sets a parameter; may be repeated"},
                  {.names = "-o,--out",
                   .target = &a->out,
                   .doc = "File for the result: charts as .svg or .png, all points as .csv, everything as .json"},
                  seed_option(a->seed),
                  json_flag(a->json)},
      .run = [a] { return run_lab(*a); }};
}

}  // namespace etendue::cli
