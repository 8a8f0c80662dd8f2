#include "bench/reference.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bench/reference_key.h"
#include "film/film_image.h"
#include "render/with_integrator.h"

namespace etendue::bench {
namespace {

namespace fs = std::filesystem;

// Computes the error of the reference from the variance of each value; the values are assumed to be independent.
void estimate_noise(Reference& reference) {
  const image::Layer* variance = reference.image.find("variance");
  const auto& r = reference.rgb();
  if (!variance || variance->pixels.size() != r.size() || r.empty()) return;
  metrics::ReferenceNoise noise;
  double squares = 0, in_pixel = 0;  // the errors of the channels of a pixel are assumed fully correlated
  for (size_t i = 0; i < r.size(); ++i) {
    const double v = variance->pixels[i], x = r[i];
    noise.mse += v;
    noise.relmse += v / (x * x + 0.01);
    in_pixel += v;
    if (i % 3 != 2) continue;
    squares += in_pixel * in_pixel;
    in_pixel = 0;
  }
  const auto n = static_cast<double>(r.size());
  // A squared normal variable of variance s has the variance 2 s^2 and the second moment 3 s^2.
  noise.relative_error = noise.mse > 0 ? std::sqrt(2.0 / 3 * squares) / noise.mse : 0;
  noise.mse /= n;
  noise.relmse /= n;
  if (!std::isfinite(noise.mse)) return;
  reference.noise = noise;
  reference.mean_error = std::sqrt(noise.mse / n);
}

std::string pixel_text(std::ptrdiff_t pixel, int width) {
  return "at " + std::to_string(pixel % width) + ", " + std::to_string(pixel / width);
}

// The means of blocks of size x size pixels; width and height are multiples of the size.
image::Layer block_means(const image::Layer& layer, int width, int size) {
  const size_t channels = layer.channels.size(), side = static_cast<size_t>(size), w = static_cast<size_t>(width);
  const size_t columns = w / side, rows = layer.pixels.size() / channels / w / side;
  image::Layer small{layer.name, layer.channels, {}};
  for (size_t y = 0; y < rows; ++y)
    for (size_t x = 0; x < columns; ++x)
      for (size_t c = 0; c < channels; ++c) {
        double sum = 0;
        for (size_t v = 0; v < side; ++v)
          for (size_t u = 0; u < side; ++u) sum += layer.pixels[((y * side + v) * w + x * side + u) * channels + c];
        small.pixels.push_back(static_cast<float>(sum / (size * size)));
      }
  return small;
}

// A reproducible seed outside the range of repeat_seed and of typical user seeds.
uint64_t reference_seed(uint64_t key) { return (key & 0x3fffffff) | 0x40000000; }

fs::path cache_file(const fs::path& cache, uint64_t key) {
  char name[40];
  std::snprintf(name, sizeof name, "%016llx.reference", static_cast<unsigned long long>(key));
  return cache / "references" / name;
}

render::Document reference_document(const render::Document& base, const std::string& integrator) {
  render::Document d = base;
  d.method.integrator = "path";  // its limit on the path depth is that of the reference
  d = render::with_integrator(d, integrator);
  d.method.sampler = "sobol";
  d.method.adaptive = render::Adaptive::off;
  d.limits = {};
  d.seed = 0;
  return d;
}

uint32_t samples_of(const film::Film& film) {
  if (film.pixels().empty()) return 0;
  uint32_t minimum = UINT32_MAX;
  for (const auto& p : film.pixels()) minimum = std::min(minimum, p.count[0] + p.count[1]);
  return minimum;
}

bool is_sufficient(const render::Checkpoint& state, const ReferenceBudget& budget) {
  if (samples_of(state.film) < film::kHalfBuffers) return false;
  return (budget.seconds > 0 && state.seconds >= budget.seconds) ||
         (budget.samples > 0 && samples_of(state.film) >= budget.samples);
}

// Continues the rendering up to the budget or until `progress` returns false.
void extend(render::Session& session, render::Document d, const ReferenceBudget& budget, const Progress& progress,
            render::Checkpoint& state) {
  const double before = state.seconds;
  d.limits = {budget.samples, budget.seconds > 0 ? budget.seconds - before : 0, 0};
  const bool has_film = state.film.width() > 0;
  const uint64_t version = has_film ? session.submit(d, std::move(state.film)) : session.submit(d);
  wait_for(session, version, [&](const render::Status& s) {
    return progress(s.progress, "reference, " + std::to_string(s.samples) + " spp");
  });
  state.film = session.film_copy();
  state.seconds = before + session.status().seconds;
}

}  // namespace

void set_display(Reference& reference, const film::DisplayTransform& display) {
  reference.display = display;
  const image::Layer* variance = reference.image.find("variance");
  if (!reference.noise || !variance) return;
  const auto& r = reference.rgb();
  double sum = 0;
  for (size_t i = 0; i + 2 < r.size(); i += 3) {
    const Rgb mean(r[i], r[i + 1], r[i + 2]);
    const Rgb error(std::sqrt(variance->pixels[i]), std::sqrt(variance->pixels[i + 1]),
                    std::sqrt(variance->pixels[i + 2]));
    const Rgb above = display(mean + error), below = display(mean - error);
    for (int c = 0; c < 3; ++c) sum += sqr(0.5 * (double{above[c]} - double{below[c]}));
  }
  reference.noise->displayed_mse = sum / static_cast<double>(r.size());
}

double Reference::standard_error() const { return noise ? std::sqrt(noise->mse) : NAN; }

Result<Reference> read_reference(const std::string& file) {
  auto image = image::read_linear(file);
  if (!image) return image.error();
  Reference reference;
  reference.file = file;
  reference.image = std::move(*image);
  const auto& rgb = reference.rgb();
  const auto bad = std::ranges::find_if(rgb, [](float v) { return !std::isfinite(v); });
  if (bad != rgb.end())
    return input_error(file + ": contains pixels that are not finite, the first " +
                       pixel_text((bad - rgb.begin()) / 3, reference.image.width) +
                       "; a reference needs finite values");
  estimate_noise(reference);
  return reference;
}

Result<Reference> resized_reference(Reference reference, int width, int height) {
  const int w = reference.image.width, h = reference.image.height, reduction = w / width;
  if (w == width && h == height) return reference;
  if (reduction < 2 || w != reduction * width || h != reduction * height)
    return input_error(reference.file + ": the image has " + std::to_string(w) + "x" + std::to_string(h) +
                       " pixels, the methods render " + std::to_string(width) + "x" + std::to_string(height) +
                       "; give a --size of which it is a whole multiple, or no --size");
  const image::Layer* variance = reference.image.find("variance");
  std::vector<image::Layer> layers{block_means(*reference.image.find(""), w, reduction)};
  if (variance) {
    layers.push_back(block_means(*variance, w, reduction));
    for (float& v : layers.back().pixels) v /= static_cast<float>(reduction * reduction);
  }
  reference.image.width = width;
  reference.image.height = height;
  reference.image.layers = std::move(layers);
  reference.reduction = reduction;
  reference.noise = {};
  reference.mean_error = 0;
  estimate_noise(reference);
  return reference;
}

ReferenceStore::ReferenceStore(const render::Document& base, const fs::path& cache, const std::string& integrator)
    : document_(reference_document(base, integrator)) {
  const uint64_t key = image_key(document_);
  document_.seed = reference_seed(key);
  if (!cache.empty()) file_ = cache_file(cache, key);
}

render::Checkpoint ReferenceStore::load() const {
  if (file_.empty()) return {};
  auto state = render::read_checkpoint(file_);
  const auto& d = document_;
  if (!state || state->film.width() != d.width || state->film.height() != d.height) return {};
  return std::move(*state);
}

void ReferenceStore::save(film::Film film, double seconds) const {
  if (file_.empty()) return;
  std::error_code code;
  fs::create_directories(file_.parent_path(), code);
  const std::string state = render::state_json(document_, samples_of(film));
  if (const auto saved = render::write_checkpoint(file_, {state, std::move(film), seconds}); !saved)
    std::fprintf(stderr, "etendue: %s; the reference is not cached\n", saved.error().message.c_str());
}

Reference ReferenceStore::reference_of(const film::Film& film, double seconds) const {
  Reference reference;
  reference.file = file_.string();
  reference.image = film::layered_image_of(film);
  reference.integrator = document_.method.integrator;
  reference.samples = samples_of(film);
  reference.seconds = seconds;
  // The variance is estimated from both half-buffers; with samples in only one of them it is unknown.
  if (reference.samples < film::kHalfBuffers) reference.image.layers.resize(1);
  estimate_noise(reference);
  return reference;
}

Reference render_reference(render::Session& session, const render::Document& base, const ReferenceBudget& budget,
                           const fs::path& cache, const Progress& progress, const std::string& integrator) {
  const ReferenceStore store(base, cache, integrator);
  render::Checkpoint state = store.load();
  if (!is_sufficient(state, budget)) {
    extend(session, store.document(), budget, progress, state);
    store.save(state.film, state.seconds);
  }
  return store.reference_of(state.film, state.seconds);
}

}  // namespace etendue::bench
