// The registry of experiments: one line each.
#include <cmath>

#include "experiments/experiment.h"

// clang-format off
#define ETENDUE_EXPERIMENTS(ENTRY) \
  ENTRY(quadrature)                \
  ENTRY(series)                    \
  ENTRY(estimators)                \
  ENTRY(error_bounds)              \
  ENTRY(ratio_estimator)           \
  ENTRY(lebesgue_sums)             \
  ENTRY(sampling)                  \
  ENTRY(markov)                    \
  ENTRY(fredholm)                  \
  ENTRY(iterations)                \
  ENTRY(radiosity_elements)        \
  ENTRY(transport_operators)       \
  ENTRY(power_iteration)           \
  ENTRY(camera_response)           \
  ENTRY(random_walks)              \
  ENTRY(linear_walks)              \
  ENTRY(variance_reduction)        \
  ENTRY(mis)                       \
  ENTRY(sampler_rates)
// clang-format on

namespace etendue::experiments {

#define ETENDUE_DECLARE_EXPERIMENT(NAME) Experiment NAME##_experiment();
ETENDUE_EXPERIMENTS(ETENDUE_DECLARE_EXPERIMENT)
#undef ETENDUE_DECLARE_EXPERIMENT

const std::vector<Experiment>& experiments() {
#define ETENDUE_CALL_EXPERIMENT(NAME) NAME##_experiment(),
  static const std::vector<Experiment> all{ETENDUE_EXPERIMENTS(ETENDUE_CALL_EXPERIMENT)};
#undef ETENDUE_CALL_EXPERIMENT
  return all;
}

const Experiment* find_experiment(std::string_view name) {
  for (const Experiment& e : experiments())
    if (e.description.name == name) return &e;
  return nullptr;
}

bool Check::holds() const { return std::abs(measured - expected) <= tolerance; }

Error interrupted() { return {Fault::interrupted, "the experiment was interrupted"}; }

}  // namespace etendue::experiments
