#include "render/session_film.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "film/film_sum.h"
#include "integrator/integrator_info.h"
#include "render/film_clearing.h"

namespace etendue::render {
namespace {

// Rows of shared samples that are added between two looks for edits.
constexpr int kRowsOfStep = 32;

// The cascades of brightness have no place for negative samples.
bool reweights_fireflies(const Document& document) {
  const auto* info = integrator::find_integrator(document.method.integrator);
  return document.fireflies == film::Fireflies::reweight && !(info && info->negative_samples);
}

size_t pixel_count(const Document& document) {
  return static_cast<size_t>(document.width) * static_cast<size_t>(document.height);
}

template <class Pixels>
bool has_size_of(const Pixels& pixels, const Document& document) {
  return pixels.width() == document.width && pixels.height() == document.height;
}

}  // namespace

bool SessionFilm::clear(const Document& document, const std::function<bool()>& keep_going) {
  added_rows_ = 0;
  if (!make_empty(film_, document.width, document.height, workers_, keep_going)) return false;
  clear_tails(document);
  return clear_cascades(document, keep_going);
}

void SessionFilm::resume(const Document& document, film::Film&& film, std::span<const film::TailState> tails) {
  film_ = std::move(film);
  clear_tails(document);
  if (!tails.empty()) tails_.restore(tails);
  reweighting_.reset();
  if (!reweights_fireflies(document)) return;
  reweighting_.emplace(document.width, document.height);
  for (int y = 0; y < film_.height(); ++y)
    for (int x = 0; x < film_.width(); ++x) reweighting_->add(x, y, film_.mean(x, y), film_.samples(x, y));
}

bool SessionFilm::add(const PartialSamples& samples, const std::function<bool()>& keep_going) {
  while (added_rows_ < film_.height()) {
    if (!keep_going()) return false;
    const int first = added_rows_, end = std::min(film_.height(), first + kRowsOfStep);
    const auto add_rows = [&](int a, int b) { film::add_rows(film_, samples.film, first + a, first + b); };
    workers_.run_ranges(end - first, add_rows);
    added_rows_ = end;
  }
  added_rows_ = 0;
  film::add_invalid_samples(film_, samples.film);
  film::merge(invalid_before_, samples.film.invalid_samples());
  if (shared_tails_.empty()) {
    shared_tails_ = samples.tails;
    return true;
  }
  const size_t capacity = TailStatistics::capacity(film_.width(), film_.height());
  for (size_t i = 0; i < shared_tails_.size(); ++i) film::merge(shared_tails_[i], samples.tails[i], capacity);
  return true;
}

std::vector<film::TailState> SessionFilm::tail_states() const {
  auto states = tails_.states();
  const size_t capacity = TailStatistics::capacity(film_.width(), film_.height());
  for (size_t i = 0; i < shared_tails_.size(); ++i) film::merge(states[i], shared_tails_[i], capacity);
  return states;
}

const TailStatistics& SessionFilm::tails() {
  if (shared_tails_.empty()) return tails_;
  all_tails_ = TailStatistics(film_.width(), film_.height());
  all_tails_.restore(tail_states());
  return all_tails_;
}

void SessionFilm::begin_sample(uint32_t number) {
  sample_ = number;
  invalid_before_ = film_.invalid_samples();
}

void SessionFilm::finish_sample() {
  film::InvalidSamples invalid = film_.invalid_samples();
  if (invalid.total() == invalid_before_.total()) return;
  for (film::InvalidSample& sample : invalid.first)
    if (std::ranges::find(invalid_before_.first, sample) == invalid_before_.first.end()) sample.sample = sample_;
  std::ranges::sort(invalid.first, {}, [](const film::InvalidSample& s) { return std::tuple(s.sample, s.y, s.x); });
  film_.set_invalid_samples(invalid);
}

void SessionFilm::clear_tails(const Document& document) {
  shared_tails_.clear();
  if (has_size_of(tails_, document))
    tails_.clear();
  else
    tails_ = TailStatistics(document.width, document.height);
}

bool SessionFilm::clear_cascades(const Document& document, const std::function<bool()>& keep_going) {
  if (!reweights_fireflies(document)) {
    reweighting_.reset();
    return true;
  }
  if (!reweighting_ || !has_size_of(*reweighting_, document)) {
    reweighting_.reset();  // frees the memory of the old ones first
    reweighting_.emplace(document.width, document.height);
    return true;
  }
  const auto clear_rows = [&](int first, int end) { reweighting_->clear_rows(first, end); };
  return workers_.run_ranges(document.height, clear_rows, keep_going);
}

std::optional<std::vector<float>> SessionFilm::reweighted() const {
  if (!reweighting_) return std::nullopt;
  std::vector<float> rgb;
  rgb.reserve(3 * film_.pixels().size());
  for (int y = 0; y < film_.height(); ++y)
    for (int x = 0; x < film_.width(); ++x) {
      const Rgb c = reweighting_->displayed(x, y, film_.samples(x, y));
      rgb.insert(rgb.end(), {c.r, c.g, c.b});
    }
  return rgb;
}

size_t SessionFilm::memory(const Document& document) {
  size_t bytes_per_pixel = sizeof(film::Film::Pixel);
  if (reweights_fireflies(document)) bytes_per_pixel += film::FireflyReweighting::kBytesPerPixel;
  return pixel_count(document) * bytes_per_pixel + TailStatistics::memory(document.width, document.height);
}

}  // namespace etendue::render
