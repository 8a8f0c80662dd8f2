#include "render/error_monitor.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace etendue::render {

void ErrorMonitor::reset(bool independent) {
  independent_ = independent;
  error_ = {};
  measured_ = {};
  error_samples_ = 0;
  estimator_ = TimeEstimator(independent);
  reliability_ = nullptr;
  reliability_samples_ = 0;
}

void ErrorMonitor::set_measure(film::ErrorMeasure measure, const film::DisplayTransform& display) {
  const bool depends_on_display = measure == film::ErrorMeasure::displayed;
  const bool changed = measure != measure_ || (depends_on_display && display != display_);
  measure_ = measure;
  display_ = display;
  if (!changed) return;
  measured_ = {};
  error_samples_ = 0;
  estimator_ = TimeEstimator(independent_);
}

bool ErrorMonitor::is_error_due(uint32_t samples) const {
  const uint32_t divisor = measure_ == film::ErrorMeasure::relative ? 4 : 8;
  return samples >= 2 && samples >= error_samples_ + std::max(1u, error_samples_ / divisor);
}

void ErrorMonitor::measure_error(const film::Film& film, uint32_t samples, double seconds,
                                 const std::function<bool()>& keep_going) {
  const film::RangeRunner run = [&](int count, const std::function<void(int, int)>& task) {
    return workers_.run_ranges(count, task, keep_going);
  };
  std::vector<film::RowError> rows(static_cast<size_t>(film.height()));
  const auto measure_rows = [&](int first, int end) {
    for (int y = first; y < end; ++y) rows[static_cast<size_t>(y)] = film.error_of_row(y);
  };
  if (!run(film.height(), measure_rows)) return;
  const film::ErrorEstimate error = film.error(rows);
  const film::MeasuredError measured = measure_ == film::ErrorMeasure::rmse
                                           ? film::measured_rmse(error)
                                           : film::measured_error(film, measure_, display_, run);
  if (error.known && !measured.known) return;  // interrupted
  error_ = error;
  measured_ = measured;
  if (samples > error_samples_) estimator_.add(samples, seconds, measured_);
  error_samples_ = samples;
}

bool ErrorMonitor::is_reliability_due(uint32_t samples) const {
  return samples >= 10 && samples >= reliability_samples_ + reliability_samples_ / 4;
}

void ErrorMonitor::measure_reliability(const film::Film& film, const TailStatistics& tails, uint32_t samples,
                                       const std::function<bool()>& keep_going) {
  std::vector<film::Tail> reports(tails.tails().size());
  const auto fit_tails = [&](int first, int end) {
    for (int i = first; i < end; ++i) reports[static_cast<size_t>(i)] = tails.tails()[static_cast<size_t>(i)].report();
  };
  if (!workers_.run_ranges(static_cast<int>(reports.size()), fit_tails, keep_going)) return;
  const uint64_t all_samples = samples * uint64_t{film.pixels().size()};
  auto reliability = reliability_of(tails, reports, film.invalid_samples(), all_samples, keep_going);
  if (!reliability) return;
  reliability_ = std::move(reliability);
  reliability_samples_ = samples;
}

}  // namespace etendue::render
