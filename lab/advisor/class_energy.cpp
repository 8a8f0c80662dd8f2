#include "advisor/class_energy.h"

#include <cmath>

namespace etendue::advisor {
namespace {

std::vector<float> half_buffer(const film::Film& film, size_t half) {
  std::vector<float> values;
  values.reserve(film.pixels().size() * 3);
  for (const auto& pixel : film.pixels())
    for (const double sum : pixel.sum[half])
      values.push_back(pixel.count[half] > 0 ? static_cast<float>(sum / pixel.count[half]) : 0.0f);
  return values;
}

double luminance_at(const std::vector<float>& rgb, size_t pixel) {
  return double{luminance(Rgb(rgb[3 * pixel], rgb[3 * pixel + 1], rgb[3 * pixel + 2]))};
}

ClassEnergy::HalfBuffers sum_of(std::span<const ClassEnergy> energies) {
  ClassEnergy::HalfBuffers sum;
  for (const ClassEnergy& energy : energies) {
    if (!energy.image) continue;
    sum.first.resize(energy.image->first.size());
    sum.second.resize(energy.image->second.size());
    for (size_t i = 0; i < sum.first.size(); ++i) {
      sum.first[i] += energy.image->first[i];
      sum.second[i] += energy.image->second[i];
    }
  }
  return sum;
}

}  // namespace

ClassEnergy class_energy(const film::Film& film) {
  auto buffers = std::make_shared<ClassEnergy::HalfBuffers>();
  buffers->first = half_buffer(film, 0);
  buffers->second = half_buffer(film, 1);
  const size_t pixels = film.pixels().size();
  double sum = 0, variance = 0;
  for (size_t i = 0; i < pixels; ++i) {
    const double a = luminance_at(buffers->first, i), b = luminance_at(buffers->second, i);
    sum += 0.5 * (a + b);
    variance += sqr(0.5 * (a - b));
  }
  const auto n = static_cast<double>(std::max<size_t>(pixels, 1));
  if (sum == 0) return {};
  return {sum / n, std::sqrt(variance) / n, std::move(buffers)};
}

double rms_of(std::span<const ClassEnergy> energies) {
  const auto sum = sum_of(energies);
  double squares = 0;
  for (size_t i = 0; i < sum.first.size(); ++i) squares += double{sum.first[i]} * double{sum.second[i]};
  return sum.first.empty() ? 0 : std::sqrt(std::max(0.0, squares / static_cast<double>(sum.first.size())));
}

double relative_square_of(std::span<const ClassEnergy> energies, const ClassEnergy& total) {
  const auto sum = sum_of(energies);
  if (sum.first.empty() || !total.image) return 0;
  double squares = 0;
  for (size_t i = 0; i < sum.first.size(); ++i) {
    const double radiance = 0.5 * (double{total.image->first[i]} + double{total.image->second[i]});
    squares += double{sum.first[i]} * double{sum.second[i]} / (radiance * radiance + 0.01);
  }
  return std::max(0.0, squares / static_cast<double>(sum.first.size()));
}

double displayed_square_of(std::span<const ClassEnergy> energies, const ClassEnergy& total,
                           const film::DisplayTransform& display) {
  const auto sum = sum_of(energies);
  if (sum.first.empty() || !total.image) return 0;
  // The change in one half-buffer; the product of both is free of noise in its expectation.
  const auto change = [&](const std::vector<float>& all, const std::vector<float>& missing, size_t i) {
    const Rgb complete(all[i], all[i + 1], all[i + 2]);
    return display(complete) - display(complete - Rgb(missing[i], missing[i + 1], missing[i + 2]));
  };
  double squares = 0;
  for (size_t i = 0; i + 2 < sum.first.size(); i += 3) {
    const Rgb a = change(total.image->first, sum.first, i), b = change(total.image->second, sum.second, i);
    for (int c = 0; c < 3; ++c) squares += double{a[c]} * double{b[c]};
  }
  return std::max(0.0, squares / static_cast<double>(sum.first.size()));
}

}  // namespace etendue::advisor
