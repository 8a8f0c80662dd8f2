#include "bench/reference.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bench/reference_key.h"
#include "film/film_image.h"

namespace etendue::bench {
namespace {

namespace fs = std::filesystem;

// Errors from the variance of each number, taken as independent of each other.
void know_error(Reference& reference) {
  const image::Layer* variance = reference.picture.find("variance");
  const auto& r = reference.rgb();
  if (!variance || variance->pixels.size() != r.size() || r.empty()) return;
  metrics::ReferenceNoise noise;
  for (size_t i = 0; i < r.size(); ++i) {
    const double v = variance->pixels[i], x = r[i];
    noise.mse += v, noise.relmse += v / (x * x + 0.01);
  }
  const auto n = static_cast<double>(r.size());
  noise.mse /= n, noise.relmse /= n;
  if (!std::isfinite(noise.mse)) return;
  reference.noise = noise;
  reference.mean_error = std::sqrt(noise.mse / n);
}

std::string place(std::ptrdiff_t pixel, int width) {
  return "at " + std::to_string(pixel % width) + ", " + std::to_string(pixel / width);
}

// The means of blocks of times x times pixels. What is left over is not there: sides are multiples.
image::Layer block_means(const image::Layer& layer, int width, int times) {
  const size_t channels = layer.channels.size(), side = static_cast<size_t>(times), w = static_cast<size_t>(width);
  const size_t columns = w / side, rows = layer.pixels.size() / channels / w / side;
  image::Layer small{layer.name, layer.channels, {}};
  for (size_t y = 0; y < rows; ++y)
    for (size_t x = 0; x < columns; ++x)
      for (size_t c = 0; c < channels; ++c) {
        double sum = 0;
        for (size_t v = 0; v < side; ++v)
          for (size_t u = 0; u < side; ++u) sum += layer.pixels[((y * side + v) * w + x * side + u) * channels + c];
        small.pixels.push_back(static_cast<float>(sum / (times * times)));
      }
  return small;
}

// A seed that users' small numbers do not meet, the same every time.
uint64_t reference_seed(uint64_t key) { return (key & 0x3fffffff) | 0x40000000; }

fs::path cache_file(const fs::path& cache, uint64_t key) {
  char name[40];
  std::snprintf(name, sizeof name, "%016llx.reference", static_cast<unsigned long long>(key));
  return cache / "references" / name;
}

render::Document reference_document(const render::Document& base) {
  render::Document d = base;
  d.method.integrator = "path", d.method.sampler = "sobol", d.method.adaptive = render::Adaptive::off;
  d.limits = {}, d.seed = 0;
  return d;
}

uint32_t samples_of(const film::Film& film) {
  if (film.pixels().empty()) return 0;
  uint32_t least = UINT32_MAX;
  for (const auto& p : film.pixels()) least = std::min(least, p.count[0] + p.count[1]);
  return least;
}

bool enough(const render::Checkpoint& have, const Effort& effort) {
  if (samples_of(have.film) < film::kHalfBuffers) return false;
  return (effort.seconds > 0 && have.seconds >= effort.seconds) ||
         (effort.samples > 0 && samples_of(have.film) >= effort.samples);
}

// Goes on from what there is. Returns false if it was cut short.
bool extend(render::Session& session, render::Document d, const Effort& effort, const Progress& watch,
            render::Checkpoint& have) {
  const double before = have.seconds;
  d.limits = {effort.samples, effort.seconds > 0 ? effort.seconds - before : 0, 0};
  const bool begun = have.film.width() > 0;
  const uint64_t version = begun ? session.submit(d, std::move(have.film)) : session.submit(d);
  const bool whole = wait_for(session, version, [&](const render::Status& s) {
    return watch(s.progress, "reference, " + std::to_string(s.samples) + " spp");
  });
  have.film = session.film_copy();
  have.seconds = before + session.status().seconds;
  return whole;
}

}  // namespace

double Reference::standard_error() const { return noise ? std::sqrt(noise->mse) : NAN; }

Result<Reference> read_reference(const std::string& file) {
  auto picture = image::read_linear(file);
  if (!picture) return picture.error();
  Reference reference;
  reference.file = file;
  reference.picture = std::move(*picture);
  const auto& rgb = reference.rgb();
  const auto bad = std::ranges::find_if(rgb, [](float v) { return !std::isfinite(v); });
  if (bad != rgb.end())
    return input_error(file + ": has pixels that are not finite, the first " +
                       place((bad - rgb.begin()) / 3, reference.picture.width) + "; nothing can be measured on it");
  know_error(reference);
  return reference;
}

Result<Reference> fitted(Reference reference, int width, int height) {
  const int w = reference.picture.width, h = reference.picture.height, times = w / width;
  if (w == width && h == height) return reference;
  if (times < 2 || w != times * width || h != times * height)
    return input_error(reference.file + ": is " + std::to_string(w) + "x" + std::to_string(h) +
                       ", the methods render " + std::to_string(width) + "x" + std::to_string(height) +
                       "; give a --size that goes into it a whole number of times, or none");
  const image::Layer* variance = reference.picture.find("variance");
  std::vector<image::Layer> layers{block_means(*reference.picture.find(""), w, times)};
  if (variance) {
    layers.push_back(block_means(*variance, w, times));
    for (float& v : layers.back().pixels) v /= static_cast<float>(times * times);
  }
  reference.picture.width = width, reference.picture.height = height;
  reference.picture.layers = std::move(layers);
  reference.reduced = times;
  reference.noise = {}, reference.mean_error = 0;
  know_error(reference);
  return reference;
}

ReferenceStore::ReferenceStore(const render::Document& base, const fs::path& cache)
    : document_(reference_document(base)) {
  const uint64_t key = picture_key(document_);
  document_.seed = reference_seed(key);
  if (!cache.empty()) file_ = cache_file(cache, key);
}

render::Checkpoint ReferenceStore::take_up() const {
  if (file_.empty()) return {};
  auto found = render::read_checkpoint(file_);
  const auto& d = document_;
  if (!found || found->film.width() != d.width || found->film.height() != d.height) return {};
  return std::move(*found);
}

void ReferenceStore::keep(film::Film film, double seconds) const {
  if (file_.empty()) return;
  std::error_code code;
  fs::create_directories(file_.parent_path(), code);
  const std::string state = render::state_json(document_, samples_of(film));
  if (const auto kept = render::write_checkpoint(file_, {state, std::move(film), seconds}); !kept)
    std::fprintf(stderr, "etendue: %s; the reference is not kept\n", kept.error().message.c_str());
}

Reference ReferenceStore::reference_of(const film::Film& film, double seconds) const {
  Reference reference;
  reference.file = file_.string();
  reference.picture = film::layered_image_of(film);
  reference.samples = samples_of(film), reference.seconds = seconds;
  // One half alone says nothing of the error.
  if (reference.samples < film::kHalfBuffers) reference.picture.layers.resize(1);
  know_error(reference);
  return reference;
}

Reference made_reference(render::Session& session, const render::Document& base, const Effort& effort,
                         const fs::path& cache, const Progress& watch) {
  const ReferenceStore store(base, cache);
  render::Checkpoint have = store.take_up();
  if (!enough(have, effort)) {
    extend(session, store.document(), effort, watch, have);
    store.keep(have.film, have.seconds);
  }
  return store.reference_of(have.film, have.seconds);
}

fs::path cache_folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  // The specification has relative values ignored.
  if (cache && fs::path(cache).is_absolute()) return fs::path(cache) / "etendue";
  return home && *home ? fs::path(home) / ".cache" / "etendue" : fs::path();
}

}  // namespace etendue::bench
