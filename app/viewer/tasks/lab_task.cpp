#include "viewer/tasks/lab_task.h"

#include "experiments/experiment_output.h"
#include "viewer/state/notices.h"

namespace etendue::viewer {
namespace {

LabOutcome run_experiment(const LabInput& input, const experiments::RunContext& context) {
  const experiments::Experiment& experiment = *experiments::find_experiment(input.experiment);
  std::vector<Setting> settings;
  for (size_t i = 0; i < input.values.size(); ++i) {
    const ParameterInfo& info = experiment.parameters[i];
    auto value = parse_value(info, input.values[i]);
    if (!value) return {.result = {}, .error = value.error().message};
    settings.push_back({info.name, std::move(*value)});
  }
  auto result = experiment.run(settings, context);
  if (!result) return {.result = {}, .error = result.error().message};
  return {.result = std::move(*result), .error = ""};
}

}  // namespace

void LabTask::update(const TaskContext& context, const LabInput& input) {
  task_.update();
  if (auto saved = export_.take_result()) {
    if (*saved)
      context.notices.add_message("Saved " + **saved);
    else
      context.notices.add_error(saved->error().message);
  }
  if (started_ == input) return;
  started_ = input;
  task_.start(
      [input](const ProgressiveTask<LabOutcome>::Publisher& publish, const bench::Progress& progress) {
        experiments::RunContext run{.seed = static_cast<uint64_t>(input.seed)};
        run.progress = [&](double share) { return progress(share, ""); };
        run.publish = [&](const experiments::ExperimentResult& part) { publish({.result = part, .error = ""}); };
        publish(run_experiment(input, run));
      },
      context.wake);
}

void LabTask::save(const TaskContext& context, const std::string& file) {
  if (!outcome() || !outcome()->error.empty()) return;
  export_.start(
      [file, shown = task_.result()]() -> Result<std::string> {
        if (auto written = experiments::write_result(file, shown->result); !written) return written.error();
        return file;
      },
      context.wake);
}

}  // namespace etendue::viewer
