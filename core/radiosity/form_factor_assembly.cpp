#include "radiosity/form_factor_assembly.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace etendue::radiosity {
namespace {

constexpr double kClosed = 1 - 1e-4;  // the least sum of the estimates of a row in a closed room

// The parts of the estimates a F_ij and b F_ji in the exchange. The estimate from row i has a variance proportional to
// A_i if it counts rays, so it has the weight 1 / A_i. Symmetric in a and b, also in floating point.
double share(double a, double b) { return a * b / (a + b); }

size_t rows_per_task(size_t elements) {
  constexpr size_t kMostTasks = FormFactorAssembly::kMostTasks;
  return std::max<size_t>(32, (elements + kMostTasks - 1) / kMostTasks);
}

}  // namespace

size_t FormFactorAssembly::task_count(size_t elements) {
  return (elements + rows_per_task(elements) - 1) / rows_per_task(elements);
}

FormFactorAssembly::FormFactorAssembly(std::vector<FormFactorRow> rows, std::vector<double> areas)
    : rows_(std::move(rows)), rows_per_task_(rows_per_task(rows_.size())) {
  const size_t n = rows_.size();
  factors_.areas_ = std::move(areas);
  factors_.rows_.resize(n);
  factors_.row_quality_.resize(n);
  factors_.blocks_.resize(task_count(n));
  task_sums_.resize(factors_.blocks_.size());
  closed_.resize(n);
  scales_.assign(n, 1);
  sums_.resize(n);
}

bool FormFactorAssembly::run(int step, int task, const KeepGoing* keep_going) {
  const auto t = static_cast<size_t>(task);
  if (stops(keep_going)) return false;
  if (step == 0) return combine(t, keep_going);
  if (step == kSteps - 1)
    scale_rows(t);
  else if (!is_scaled_)
    sum_rows(t);
  return true;
}

void FormFactorAssembly::finish_step(int step) {
  if (step == 0) {
    rows_ = {};
    FormFactors::Quality& quality = factors_.quality_;
    Sums all;
    for (const Sums& s : task_sums_) {
      all.closure += s.closure;
      all.area += s.area;
      all.least = std::min(all.least, s.least);
      all.most = std::max(all.most, s.most);
      all.difference += s.difference;
      all.sum += s.sum;
    }
    if (!(all.area > 0)) return;
    quality.mean_closure = all.closure / all.area;
    quality.least_closure = all.least;
    quality.most_closure = all.most;
    quality.asymmetry = all.sum > 0 ? all.difference / all.sum : 0;
  } else if (step < kSteps - 1 && !is_scaled_) {
    factors_.quality_.scaling_error = 0;
    for (size_t i = 0; i < sums_.size(); ++i)
      if (differs(i))
        factors_.quality_.scaling_error = std::max(factors_.quality_.scaling_error, std::abs(sums_[i] - 1));
    // The factors are stored in single precision.
    is_scaled_ = factors_.quality_.scaling_error < 1e-7 || step == kIterations;
    if (!is_scaled_) update_scales();
  }
}

// Rows first_of(task) and following: gathers the column of each row from all rows.
bool FormFactorAssembly::combine(size_t task, const KeepGoing* keep_going) {
  const size_t first = first_of(task), last = first_of(task + 1), count = last - first;
  const auto for_each_entry = [&](auto&& visit) {
    for (size_t j = 0; j < rows_.size(); ++j) {
      if (j % 1024 == 0 && stops(keep_going)) return false;
      const FormFactorRow& row = rows_[j];
      auto f = std::ranges::lower_bound(row, static_cast<uint32_t>(first), {}, &FormFactor::element);
      for (; f != row.end() && f->element < last; ++f) visit(static_cast<uint32_t>(j), *f);
    }
    return true;
  };
  std::vector<size_t> ends(count + 1, 0);
  if (!for_each_entry([&](uint32_t, const FormFactor& f) { ++ends[f.element - first + 1]; })) return false;
  for (size_t k = 0; k < count; ++k) ends[k + 1] += ends[k];
  std::vector<FormFactor> columns(ends.back());
  std::vector<size_t> next(ends.begin(), ends.end() - 1);
  if (!for_each_entry([&](uint32_t j, const FormFactor& f) { columns[next[f.element - first]++] = {j, f.value}; }))
    return false;
  const auto column_of = [&](size_t i) {
    return std::span(columns).subspan(ends[i - first], ends[i - first + 1] - ends[i - first]);
  };
  // Both are sorted by element, so the number of different elements can be counted.
  size_t entries = 0;
  for (size_t i = first; i < last; ++i) {
    const auto column = column_of(i);
    entries += rows_[i].size() + column.size();
    auto c = column.begin();
    for (const FormFactor& f : rows_[i]) {
      while (c != column.end() && c->element < f.element) ++c;
      entries -= c != column.end() && c->element == f.element ? 1 : 0;
    }
  }
  std::vector<FormFactor>& block = factors_.blocks_[task];
  block.clear();
  block.reserve(entries);
  Sums sums;
  for (size_t i = first; i < last; ++i) combine_row(i, column_of(i), block, sums);
  task_sums_[task] = sums;
  return true;
}

void FormFactorAssembly::combine_row(size_t i, std::span<const FormFactor> column, std::vector<FormFactor>& block,
                                     Sums& sums) {
  const std::vector<double>& areas = factors_.areas_;
  const FormFactorRow& row = rows_[i];
  const double a = areas[i];
  double closure = 0, difference = 0, sum = 0;
  const size_t start = block.size();
  auto r = row.begin();
  auto c = column.begin();
  while (r != row.end() || c != column.end()) {
    const uint32_t j = c == column.end() || (r != row.end() && r->element < c->element) ? r->element : c->element;
    const double b = areas[j];
    double by_row = 0, by_column = 0;
    if (r != row.end() && r->element == j) by_row = static_cast<double>((r++)->value);
    if (c != column.end() && c->element == j) by_column = static_cast<double>((c++)->value);
    block.push_back({j, static_cast<float>(share(a, b) * by_row + share(a, b) * by_column)});
    closure += by_row;
    difference += std::abs(a * by_row - b * by_column);
    sum += a * by_row + b * by_column;
  }
  factors_.rows_[i] = std::span(block).subspan(start);
  factors_.row_quality_[i] = {static_cast<float>(closure), static_cast<float>(sum > 0 ? difference / sum : 0)};
  closed_[i] = closure >= kClosed;
  sums.difference += difference;
  sums.sum += sum;
  if (row.empty()) return;
  sums.closure += a * closure;
  sums.area += a;
  sums.least = std::min(sums.least, closure);
  sums.most = std::max(sums.most, closure);
}

void FormFactorAssembly::sum_rows(size_t task) {
  for (size_t i = first_of(task); i < first_of(task + 1); ++i) {
    double sum = 0;
    for (const FormFactor& f : factors_.exchanges(i)) sum += static_cast<double>(f.value) * scales_[f.element];
    sums_[i] = scales_[i] * sum / factors_.areas_[i];
  }
}

void FormFactorAssembly::update_scales() {
  constexpr double kMostScale = 2;  // in an open scene no scaling may fit
  for (size_t i = 0; i < scales_.size(); ++i)
    if (differs(i)) scales_[i] = std::clamp(scales_[i] / std::sqrt(sums_[i]), 1 / kMostScale, kMostScale);
}

void FormFactorAssembly::scale_rows(size_t task) {
  for (size_t i = first_of(task); i < first_of(task + 1); ++i)
    for (FormFactor& f : factors_.rows_[i])
      f.value = static_cast<float>(static_cast<double>(f.value) * (scales_[i] * scales_[f.element]));
}

FormFactors::FormFactors(std::vector<FormFactorRow> rows, std::vector<double> areas) {
  FormFactorAssembly assembly(std::move(rows), std::move(areas));
  for (int step = 0; step < FormFactorAssembly::kSteps; ++step) {
    for (int task = 0; task < assembly.tasks(); ++task) assembly.run(step, task, nullptr);
    assembly.finish_step(step);
  }
  *this = assembly.take();
}

size_t FormFactorAssembly::memory() const {
  size_t bytes = factors_.memory() + rows_.capacity() * sizeof(rows_[0]) + closed_.capacity() +
                 task_sums_.capacity() * sizeof(Sums) + (scales_.capacity() + sums_.capacity()) * sizeof(double);
  for (const auto& row : rows_) bytes += row.capacity() * sizeof(FormFactor);
  return bytes;
}

namespace {

// Entries of the estimated row of an element: no more than there are elements, nor rays if rays are cast per element.
size_t most_estimates(size_t elements, const FormFactorSettings& settings) {
  return info_of(settings.method).samples_pairs ? elements : std::min<size_t>(elements, settings.samples);
}

}  // namespace

// The combined rows have at most twice as many entries as the estimates.
size_t stored_memory(size_t elements, const FormFactorSettings& settings) {
  const size_t entries = std::min(elements, 2 * most_estimates(elements, settings));
  const size_t blocks = FormFactorAssembly::kMostTasks * sizeof(std::vector<FormFactor>);
  return blocks + elements * (entries * sizeof(FormFactor) + sizeof(double) + sizeof(std::span<FormFactor>) +
                              sizeof(FormFactors::RowQuality));
}

// Besides the combined rows: the estimated rows, the columns of the tasks that run, and what tasks share.
size_t largest_memory(size_t elements, const FormFactorSettings& settings) {
  constexpr size_t kAllocation = 16;  // overhead of an allocation
  const size_t threads = std::max(1U, std::thread::hardware_concurrency());
  const size_t estimates = most_estimates(elements, settings) * sizeof(FormFactor);
  const size_t per_element = 2 * estimates + sizeof(FormFactorRow) + kAllocation + 2 * sizeof(size_t) +
                             2 * sizeof(double) + sizeof(char) + threads * RowBuilder::kBytesPerElement;
  return stored_memory(elements, settings) + elements * per_element;
}

}  // namespace etendue::radiosity
