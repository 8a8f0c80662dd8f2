// The estimated error of an image while samples are added: measured at growing sample counts, together with its
// reliability and a prediction of the error to come.
#pragma once
#include <functional>
#include <memory>

#include "render/reliability.h"
#include "render/thread_pool.h"
#include "render/time_estimate.h"

namespace etendue::render {

class ErrorMonitor {
 public:
  explicit ErrorMonitor(ThreadPool& workers) : workers_(workers) {}

  // Starts with an image without samples. `independent`: the sampler's samples are independent random numbers.
  void reset(bool independent);
  // Selects the measure of `measured` and `estimator`. A change makes the error due again.
  void set_measure(film::ErrorMeasure measure, const film::DisplayTransform& display);

  const film::ErrorEstimate& error() const { return error_; }
  // The error in the selected measure.
  const film::MeasuredError& measured() const { return measured_; }
  const TimeEstimator& estimator() const { return estimator_; }
  // Null before the first measurement.
  const std::shared_ptr<const Reliability>& reliability() const { return reliability_; }

  // Measuring costs as much as one sample per pixel of a simple scene, so it is due when the number of samples has
  // grown by an eighth; by a quarter for the relative error, which takes longer.
  bool is_error_due(uint32_t samples) const;
  bool is_error_current(uint32_t samples) const { return error_samples_ == samples; }
  // Measures the error after `seconds` of rendering, unless `keep_going` stops it. A second measurement at the same number
  // of samples does not affect the estimator.
  void measure_error(const film::Film& film, uint32_t samples, double seconds, const std::function<bool()>& keep_going);

  // Fitting the tails of all tiles takes some milliseconds, so it is due when the number of samples has grown by a
  // quarter.
  bool is_reliability_due(uint32_t samples) const;
  bool is_reliability_current(uint32_t samples) const { return reliability_samples_ == samples; }
  // Measures the reliability, unless `keep_going` stops it.
  void measure_reliability(const film::Film& film, const TailStatistics& tails, uint32_t samples,
                           const std::function<bool()>& keep_going);

 private:
  ThreadPool& workers_;
  bool independent_ = false;
  film::ErrorMeasure measure_ = film::ErrorMeasure::rmse;
  film::DisplayTransform display_;
  film::ErrorEstimate error_;
  film::MeasuredError measured_;
  uint32_t error_samples_ = 0;  // samples per pixel at the last measurement
  TimeEstimator estimator_;
  std::shared_ptr<const Reliability> reliability_;
  uint32_t reliability_samples_ = 0;
};

}  // namespace etendue::render
