// The form factors of a scene from the estimated rows of all elements, in parallel tasks.
//
//   step 0                  combines the two estimates of every pair
//   steps 1 .. kIterations  Sinkhorn-Knopp iterations: row sums with the current scales
//   the last step           multiplies by the scales
#pragma once
#include <cmath>

#include "radiosity/form_factors.h"
#include "radiosity/keep_going.h"

namespace etendue::radiosity {

class FormFactorAssembly {
 public:
  static constexpr int kIterations = 20, kSteps = kIterations + 2;

  FormFactorAssembly(std::vector<FormFactorRow> rows, std::vector<double> areas);

  // The tasks of a step may run in any order and in parallel; finish_step follows the last one. The result does not
  // depend on the number of threads.
  int tasks() const { return static_cast<int>(factors_.blocks_.size()); }
  static size_t task_count(size_t elements);
  // False if it was stopped: the task is to be repeated.
  bool run(int step, int task, const KeepGoing* keep_going);
  void finish_step(int step);
  // The form factors, after all steps.
  FormFactors take() { return std::move(factors_); }

  size_t memory() const;
  // The largest number of tasks.
  static constexpr size_t kMostTasks = 64;

 private:
  struct Sums {  // of the estimates of a task
    double closure = 0, area = 0, least = HUGE_VAL, most = 0;
    double difference = 0, sum = 0;
  };
  size_t first_of(size_t task) const { return std::min(task * rows_per_task_, factors_.size()); }
  bool differs(size_t i) const { return sums_[i] > 1 || (closed_[i] && sums_[i] > 0); }
  bool combine(size_t task, const KeepGoing* keep_going);
  void combine_row(size_t i, std::span<const FormFactor> column, std::vector<FormFactor>& block, Sums& sums);
  void sum_rows(size_t task);
  void update_scales();
  void scale_rows(size_t task);

  FormFactors factors_;
  std::vector<FormFactorRow> rows_;  // estimates
  size_t rows_per_task_;
  std::vector<char> closed_;  // whether the estimates of a row add up to 1
  std::vector<Sums> task_sums_;
  std::vector<double> scales_, sums_;
  bool is_scaled_ = false;
};

// Bytes that the form factors of so many elements need at most: afterwards, and while they are built.
size_t stored_memory(size_t elements, const FormFactorSettings& settings);
size_t largest_memory(size_t elements, const FormFactorSettings& settings);

}  // namespace etendue::radiosity
