#include "advisor/minimised_error.h"

#include <algorithm>
#include <cmath>

#include "advisor/report_numbers.h"
#include "base/vec.h"
#include "film/film_image.h"
#include "metrics/flip.h"

namespace etendue::advisor {
namespace {

using render::MinimisedError;

// FLIP of an image with noise is proportional to the noise to this power.
constexpr double kFlipExponent = 0.7;
// Side in pixels of the blocks of a FLIP map whose means count as independent.
constexpr int kFlipBlock = 8;

double from_flip(double flip) { return std::pow(std::max(0.0, flip), 1 / kFlipExponent); }

// The measures other than FLIP.
film::ErrorMeasure measure_of(MinimisedError measure) { return static_cast<film::ErrorMeasure>(measure); }

image::LayeredImage image_of(int width, int height, std::vector<float> rgb) {
  image::LayeredImage image;
  image.width = width;
  image.height = height;
  image.layers.push_back({"", {"R", "G", "B"}, std::move(rgb)});
  return image;
}

std::vector<float> half_buffer_of(const film::Film& film, uint32_t half) {
  std::vector<float> rgb;
  rgb.reserve(3 * film.pixels().size());
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const Rgb mean = film.half_buffer_mean(x, y, half);
      rgb.insert(rgb.end(), {mean.r, mean.g, mean.b});
    }
  return rgb;
}

// The mean of FLIP and its standard error.
MeanSquare mean_flip(const image::LayeredImage& a, const image::LayeredImage& b,
                     const film::DisplayTransform& display) {
  const auto map = metrics::flip_map(a, b, {display.exposure, display.curve});
  if (!map) return {};
  double sum = 0, squares = 0, blocks = 0;
  for (int top = 0; top < a.height; top += kFlipBlock)
    for (int left = 0; left < a.width; left += kFlipBlock) {
      double block = 0, pixels = 0;
      for (int y = top; y < std::min(a.height, top + kFlipBlock); ++y)
        for (int x = left; x < std::min(a.width, left + kFlipBlock); ++x, ++pixels)
          block += double{(*map)[static_cast<size_t>(y) * static_cast<size_t>(a.width) + static_cast<size_t>(x)]};
      sum += block / pixels;
      squares += sqr(block / pixels);
      ++blocks;
    }
  const double mean = sum / blocks;
  return {mean, std::sqrt(std::max(0.0, squares / blocks - sqr(mean)) / blocks)};
}

bool has_both_half_buffers(const film::Film& film) {
  return std::ranges::all_of(film.pixels(), [](const auto& p) { return p.count[0] > 0 && p.count[1] > 0; });
}

// The half-buffers differ by twice the error of their mean.
film::MeasuredError measured_flip(const film::Film& film, const film::DisplayTransform& display) {
  constexpr double kTwoSided = 1.96;  // 95 % of the normal distribution
  if (!has_both_half_buffers(film)) return {};
  const int w = film.width(), h = film.height();
  const MeanSquare flip =
      mean_flip(image_of(w, h, half_buffer_of(film, 0)), image_of(w, h, half_buffer_of(film, 1)), display);
  const auto error = [](double value) { return 0.5 * from_flip(value); };
  const double margin = kTwoSided * flip.standard_error;
  return {.value = error(flip.value),
          .interval = {error(flip.value - margin), error(flip.value + margin)},
          .variation = 0,
          .known = flip.value > 0};
}

MeanSquare squared_flip_error(const film::Film& film, const film::Film& other, const film::DisplayTransform& display) {
  const int w = film.width(), h = film.height();
  const MeanSquare flip =
      mean_flip(image_of(w, h, film::radiance_of(film)), image_of(w, h, film::radiance_of(other)), display);
  const double difference = sqr(from_flip(flip.value)), noise = sqr(measured_flip(other, display).value);
  const double standard_error = 2 / kFlipExponent * difference * flip.standard_error / std::max(1e-12, flip.value);
  return {std::max(0.0, difference - noise), standard_error};
}

// The film with one sample per half-buffer, whose values are the displayed means of that half-buffer.
film::Film displayed_film(const film::Film& film, const film::DisplayTransform& display) {
  film::Film shown(film.width(), film.height());
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (uint32_t half = 0; half < film::kHalfBuffers; ++half) {
        const bool is_empty = film.half_buffer_samples(x, y, half) == 0;
        const Rgb value = display(is_empty ? Rgb(0) : film.half_buffer_mean(x, y, half));
        shown.add_sum(x, y, half, {double{value.r}, double{value.g}, double{value.b}}, 1);
      }
  return shown;
}

MeanSquare squared_displayed_error(const film::Film& film, const film::Film& other,
                                   const film::DisplayTransform& display) {
  std::vector<float> shown = film::radiance_of(film);
  for (size_t i = 0; i + 2 < shown.size(); i += 3) {
    const Rgb value = display(Rgb(shown[i], shown[i + 1], shown[i + 2]));
    shown[i] = value.r, shown[i + 1] = value.g, shown[i + 2] = value.b;
  }
  return true_error(shown, displayed_film(other, display)).absolute;
}

// FLIP of the complete image and the image without these paths, both with the same noise.
double missing_flip_square(const ClassEnergy& missing, const ClassEnergy& total, const render::Document& d) {
  std::vector<float> complete(total.image->first), rest(total.image->first);
  for (size_t i = 0; i < complete.size(); ++i) {
    complete[i] = 0.5f * (total.image->first[i] + total.image->second[i]);
    rest[i] = complete[i] - 0.5f * (missing.image->first[i] + missing.image->second[i]);
  }
  return sqr(from_flip(mean_flip(image_of(d.width, d.height, std::move(complete)),
                                 image_of(d.width, d.height, std::move(rest)), d.display.transform())
                           .value));
}

}  // namespace

double shown_error(MinimisedError measure, double error) {
  return measure == MinimisedError::flip ? std::pow(error, kFlipExponent) : error;
}

const char* minimised_label(MinimisedError measure) {
  return measure == MinimisedError::flip ? "FLIP" : film::measure_label(measure_of(measure));
}

std::string minimised_text(MinimisedError measure, double error) {
  return measure == MinimisedError::flip ? number(shown_error(measure, error))
                                         : error_number(measure_of(measure), error);
}

film::MeasuredError measured_error(const film::Film& film, MinimisedError measure,
                                   const film::DisplayTransform& display) {
  return measure == MinimisedError::flip ? measured_flip(film, display)
                                         : film::measured_error(film, measure_of(measure), display);
}

MeanSquare squared_error(const film::Film& film, const film::Film& other, MinimisedError measure,
                         const film::DisplayTransform& display) {
  if (measure == MinimisedError::flip) return squared_flip_error(film, other, display);
  if (measure == MinimisedError::displayed) return squared_displayed_error(film, other, display);
  const TrueError error = true_error(film::radiance_of(film), other);
  return measure == MinimisedError::rmse ? error.absolute : error.relative;
}

double missing_square(const ClassEnergy& missing, const ClassEnergy& total, const render::Document& document,
                      MinimisedError measure) {
  if (measure == MinimisedError::flip) return total.image ? missing_flip_square(missing, total, document) : 0;
  const std::span<const ClassEnergy> one(&missing, 1);
  if (measure == MinimisedError::rmse) return sqr(rms_of(one));
  return measure == MinimisedError::relative ? relative_square_of(one, total)
                                             : displayed_square_of(one, total, document.display.transform());
}

}  // namespace etendue::advisor
