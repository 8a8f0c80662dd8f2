#include "radiosity/form_factors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace etendue::radiosity {

#define ETENDUE_METHOD_DECLARATION(ID, NAME, LABEL) FormFactorMethodInfo ID##_method();
ETENDUE_FORM_FACTOR_METHODS(ETENDUE_METHOD_DECLARATION)
#undef ETENDUE_METHOD_DECLARATION

const FormFactorMethodInfo& info_of(FormFactorMethod method) {
#define ETENDUE_METHOD_INFO(ID, NAME, LABEL) ID##_method(),
  static const std::array infos{ETENDUE_FORM_FACTOR_METHODS(ETENDUE_METHOD_INFO)};
#undef ETENDUE_METHOD_INFO
  return infos[static_cast<size_t>(method)];
}

void RowBuilder::begin(size_t elements) {
  sums_.assign(elements, 0);
  touched_.clear();
}

FormFactorRow RowBuilder::finish() {
  std::ranges::sort(touched_);
  FormFactorRow row;
  row.reserve(touched_.size());
  for (const uint32_t element : touched_)
    if (sums_[element] > 0) row.push_back({element, static_cast<float>(sums_[element])});
  return row;
}

namespace {

// A row has no more entries than elements, nor than rays if rays are cast per element. Its transpose doubles them, and
// the rows exist twice while they are combined.
size_t bytes_per_element(size_t elements, const FormFactorSettings& settings) {
  const size_t entries =
      info_of(settings.method).samples_pairs ? elements : std::min<size_t>(elements, settings.samples);
  return entries * (1 + 2) * sizeof(FormFactor) + sizeof(FormFactorRow);
}

}  // namespace

size_t largest_memory(size_t elements, const FormFactorSettings& settings) {
  return elements * bytes_per_element(elements, settings);
}

size_t most_elements(size_t bytes, const FormFactorSettings& settings) {
  size_t fits = 0, too_many = size_t{1} << 31;
  while (too_many - fits > 1) {
    const size_t middle = fits + (too_many - fits) / 2;
    (largest_memory(middle, settings) <= bytes ? fits : too_many) = middle;
  }
  return fits;
}

FormFactors::FormFactors(std::vector<FormFactorRow> rows, std::vector<double> areas) : areas_(std::move(areas)) {
  constexpr double kClosed = 1 - 1e-4;
  std::vector<bool> closed(size());
  for (size_t i = 0; i < size(); ++i) {
    double sum = 0;
    for (const FormFactor& f : rows[i]) sum += static_cast<double>(f.value);
    closed[i] = sum >= kClosed;
  }
  measure_rows(rows);
  symmetrize(rows);
  scale(closed);
}

void FormFactors::measure_rows(const std::vector<FormFactorRow>& rows) {
  double total = 0, weighted = 0;
  quality_.least_closure = HUGE_VAL;
  for (size_t i = 0; i < size(); ++i) {
    if (rows[i].empty()) continue;
    double sum = 0;
    for (const FormFactor& f : rows[i]) sum += static_cast<double>(f.value);
    weighted += areas_[i] * sum;
    total += areas_[i];
    quality_.least_closure = std::min(quality_.least_closure, sum);
    quality_.most_closure = std::max(quality_.most_closure, sum);
  }
  quality_.mean_closure = total > 0 ? weighted / total : 0;
  if (!(total > 0)) quality_.least_closure = 0;
}

// Both rows estimate A_i F_ij. The estimate from row i has a variance proportional to A_i if it counts rays, so it has
// the weight 1 / A_i.
void FormFactors::symmetrize(std::vector<FormFactorRow>& rows) {
  std::vector<size_t> counts(size() + 1);
  for (size_t i = 0; i < size(); ++i)
    for (const FormFactor& f : rows[i]) {
      ++counts[i];
      ++counts[f.element];
    }
  starts_.assign(size() + 1, 0);
  for (size_t i = 0; i < size(); ++i) starts_[i + 1] = starts_[i] + counts[i];
  std::vector<FormFactor> both(starts_.back());  // the row and the column of every element
  std::vector<size_t> next(starts_.begin(), starts_.end() - 1);
  for (size_t i = 0; i < size(); ++i)
    for (const FormFactor& f : rows[i]) {
      const double a = areas_[i], b = areas_[f.element];
      // Of opposite sign in the column, to compare the two estimates.
      const auto share = static_cast<float>(a * b / (a + b) * static_cast<double>(f.value));
      both[next[i]++] = {f.element, share};
      both[next[f.element]++] = {static_cast<uint32_t>(i), -share};
    }
  rows = {};
  entries_.reserve(both.size());
  double difference = 0, sum = 0;
  size_t start = 0;
  for (size_t i = 0; i < size(); ++i) {
    const auto first = both.begin() + static_cast<std::ptrdiff_t>(start),
               last = both.begin() + static_cast<std::ptrdiff_t>(starts_[i + 1]);
    std::sort(first, last, [](const FormFactor& x, const FormFactor& y) {
      return x.element != y.element ? x.element < y.element : x.value < y.value;
    });
    start = starts_[i + 1];
    starts_[i] = entries_.size();
    for (auto f = first; f != last;) {
      const uint32_t j = f->element;
      double by_row = 0, by_column = 0;
      for (; f != last && f->element == j; ++f)
        (f->value < 0 ? by_column : by_row) += std::abs(static_cast<double>(f->value));
      entries_.push_back({j, static_cast<float>(by_row + by_column)});
      const double a = areas_[i], b = areas_[j];
      difference += std::abs(by_row * (a + b) / b - by_column * (a + b) / a);
      sum += by_row * (a + b) / b + by_column * (a + b) / a;
    }
  }
  starts_[size()] = entries_.size();
  entries_.shrink_to_fit();
  if (sum > 0) quality_.asymmetry = difference / sum;
}

// Symmetric Sinkhorn-Knopp iteration for the row sum 1 of closed rows and of those that exceed it.
void FormFactors::scale(const std::vector<bool>& closed) {
  constexpr int kIterations = 20;
  constexpr double kMostScale = 2;  // in an open scene no scaling may fit
  std::vector<double> scales(size(), 1), sums(size());
  const auto differs = [&](size_t i) { return sums[i] > 1 || (closed[i] && sums[i] > 0); };
  for (int n = 0; n <= kIterations; ++n) {
    for (size_t i = 0; i < size(); ++i) {
      double sum = 0;
      for (const FormFactor& f : exchanges(i)) sum += static_cast<double>(f.value) * scales[f.element];
      sums[i] = scales[i] * sum / areas_[i];
    }
    if (n == kIterations) break;
    for (size_t i = 0; i < size(); ++i)
      if (differs(i)) scales[i] = std::clamp(scales[i] / std::sqrt(sums[i]), 1 / kMostScale, kMostScale);
  }
  for (size_t i = 0; i < size(); ++i) {
    if (differs(i)) quality_.scaling_error = std::max(quality_.scaling_error, std::abs(sums[i] - 1));
    for (size_t k = starts_[i]; k < starts_[i + 1]; ++k)
      entries_[k].value =
          static_cast<float>(static_cast<double>(entries_[k].value) * (scales[i] * scales[entries_[k].element]));
  }
}

double FormFactors::factor(size_t i, size_t j) const {
  const auto row = exchanges(i);
  const auto found = std::ranges::lower_bound(row, static_cast<uint32_t>(j), {}, &FormFactor::element);
  return found != row.end() && found->element == j ? static_cast<double>(found->value) / areas_[i] : 0;
}

double FormFactors::closure(size_t i) const {
  double sum = 0;
  for (const FormFactor& f : exchanges(i)) sum += static_cast<double>(f.value);
  return sum / areas_[i];
}

size_t FormFactors::memory() const {
  return areas_.capacity() * sizeof(double) + starts_.capacity() * sizeof(size_t) +
         entries_.capacity() * sizeof(FormFactor);
}

std::vector<double> element_areas(const PatchMesh& mesh) {
  std::vector<double> areas;
  areas.reserve(mesh.element_count());
  for (const Patch& p : mesh.patches()) areas.insert(areas.end(), 2, static_cast<double>(p.area));
  return areas;
}

}  // namespace etendue::radiosity
