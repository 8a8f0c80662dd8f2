#include <charconv>

#include "medium/phase_functions/tabulated_phase.h"

namespace etendue {
namespace {

constexpr size_t kMaxValues = 1024;

// The width in cosine of a piece.
double step_of(const std::vector<double>& values) { return 2.0 / static_cast<double>(values.size() - 1); }

}  // namespace

Result<std::vector<double>> parse_phase_table(std::string_view text) {
  std::vector<double> values;
  double sum = 0;
  for (size_t at = text.find_first_not_of(' '); at != std::string_view::npos; at = text.find_first_not_of(' ', at)) {
    const size_t end = std::min(text.find(' ', at), text.size());
    const std::string word(text.substr(at, end - at));
    double value = -1;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || stop != word.data() + word.size() || !(value >= 0 && value <= 1e30))
      return usage_error("value " + std::to_string(values.size() + 1) + " of the phase function, '" +
                         word.substr(0, 40) + "', has to be a number from 0 to 1e30");
    values.push_back(value);
    sum += value;
    at = end;
  }
  if (values.size() < 2 || values.size() > kMaxValues)
    return usage_error("a tabulated phase function has " + std::to_string(values.size()) + " values; give 2 to " +
                       std::to_string(kMaxValues));
  if (!(sum > 0)) return usage_error("all values of the phase function are 0; give at least one above 0");
  return values;
}

void TabulatedPhase::prepare() {
  const auto parsed = parse_phase_table(values.value);
  densities_ = parsed ? *parsed : std::vector<double>{1, 1};
  const double step = step_of(densities_);
  cumulative_.assign(1, 0);
  for (size_t i = 0; i + 1 < densities_.size(); ++i)
    cumulative_.push_back(cumulative_.back() + 0.5 * step * (densities_[i] + densities_[i + 1]));
  const double total = cumulative_.back();
  for (double& c : cumulative_) c /= total;
  for (double& d : densities_) d /= 2 * std::numbers::pi * total;
}

double TabulatedPhase::eval(double x) const {
  const double at = (std::clamp(x, -1.0, 1.0) + 1) / step_of(densities_);
  const size_t i = std::min(static_cast<size_t>(at), densities_.size() - 2);
  return std::lerp(densities_[i], densities_[i + 1], at - static_cast<double>(i));
}

double TabulatedPhase::sample(double u) const {
  const auto next = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, u);
  const auto i = static_cast<size_t>(std::max(next - cumulative_.begin(), std::ptrdiff_t{1}) - 1);
  const double step = step_of(densities_), a = 2 * std::numbers::pi * densities_[i],
               slope = 2 * std::numbers::pi * (densities_[i + 1] - densities_[i]) / step;
  // a t + slope t^2 / 2 = rest, in the form without cancellation.
  const double rest = std::max(u - cumulative_[i], 0.0);
  const double root = a + std::sqrt(std::max(a * a + 2 * slope * rest, 0.0));
  const double t = root > 0 ? 2 * rest / root : 0;
  return std::clamp(-1 + static_cast<double>(i) * step + std::clamp(t, 0.0, step), -1.0, 1.0);
}

double TabulatedPhase::mean_cosine() const {
  const double step = step_of(densities_);
  double sum = 0;
  for (size_t i = 0; i + 1 < densities_.size(); ++i) {
    const double x = -1 + static_cast<double>(i) * step, p = densities_[i], q = densities_[i + 1];
    // The integral of a product of two linear functions: Simpson's rule is exact.
    sum += step / 6 * (x * p + (2 * x + step) * (p + q) + (x + step) * q);
  }
  return 2 * std::numbers::pi * sum;
}

}  // namespace etendue
