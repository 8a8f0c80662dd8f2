#include "advisor/class_energy.h"

#include <cmath>

namespace etendue::advisor {
namespace {

using Numbers = std::vector<float>;

Numbers half_of(const film::Film& film, size_t half) {
  Numbers numbers;
  numbers.reserve(film.pixels().size() * 3);
  for (const auto& pixel : film.pixels())
    for (const double sum : pixel.sum[half])
      numbers.push_back(pixel.count[half] > 0 ? static_cast<float>(sum / pixel.count[half]) : 0.0f);
  return numbers;
}

double luminance_at(const Numbers& numbers, size_t pixel) {
  return double{luminance(Rgb(numbers[3 * pixel], numbers[3 * pixel + 1], numbers[3 * pixel + 2]))};
}

ClassEnergy::Halves sum_of(std::span<const ClassEnergy> energies) {
  ClassEnergy::Halves sum;
  for (const ClassEnergy& energy : energies) {
    if (!energy.picture) continue;
    sum.first.resize(energy.picture->first.size()), sum.second.resize(energy.picture->second.size());
    for (size_t i = 0; i < sum.first.size(); ++i)
      sum.first[i] += energy.picture->first[i], sum.second[i] += energy.picture->second[i];
  }
  return sum;
}

}  // namespace

ClassEnergy energy_of(const film::Film& film) {
  auto halves = std::make_shared<ClassEnergy::Halves>();
  halves->first = half_of(film, 0), halves->second = half_of(film, 1);
  const size_t pixels = film.pixels().size();
  double sum = 0, variance = 0;
  for (size_t i = 0; i < pixels; ++i) {
    const double a = luminance_at(halves->first, i), b = luminance_at(halves->second, i);
    sum += 0.5 * (a + b), variance += sqr(0.5 * (a - b));
  }
  const auto n = static_cast<double>(std::max<size_t>(pixels, 1));
  if (sum == 0) return {};
  return {sum / n, std::sqrt(variance) / n, std::move(halves)};
}

double rms_of(std::span<const ClassEnergy> energies) {
  const auto sum = sum_of(energies);
  double squares = 0;
  for (size_t i = 0; i < sum.first.size(); ++i) squares += double{sum.first[i]} * double{sum.second[i]};
  return sum.first.empty() ? 0 : std::sqrt(std::max(0.0, squares / static_cast<double>(sum.first.size())));
}

double relative_square_of(std::span<const ClassEnergy> energies, const ClassEnergy& all) {
  const auto sum = sum_of(energies);
  if (sum.first.empty() || !all.picture) return 0;
  double squares = 0;
  for (size_t i = 0; i < sum.first.size(); ++i) {
    const double whole = 0.5 * (double{all.picture->first[i]} + double{all.picture->second[i]});
    squares += double{sum.first[i]} * double{sum.second[i]} / (whole * whole + 0.01);
  }
  return std::max(0.0, squares / static_cast<double>(sum.first.size()));
}

}  // namespace etendue::advisor
