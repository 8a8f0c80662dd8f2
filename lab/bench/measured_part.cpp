#include "bench/measured_part.h"

#include <algorithm>

#include "base/hash.h"
#include "job_part/part_file.h"

namespace etendue::bench {
namespace {

using job_part::read_text;
using job_part::write_text;

template <class T>
void write(StateWriter& out, const std::optional<T>& value) {
  out.value<uint8_t>(value.has_value());
  out.value(value.value_or(T{}));
}

template <class T>
bool read(StateReader& in, std::optional<T>& value) {
  uint8_t has_value = 0;
  T content{};
  if (!in.value(has_value) || !in.value(content)) return false;
  if (has_value != 0) value = content;
  return true;
}

void write(StateWriter& out, const image::Layer& layer) {
  write_text(out, layer.name);
  out.value<uint64_t>(layer.channels.size());
  for (const std::string& channel : layer.channels) write_text(out, channel);
  out.list(std::span<const float>(layer.pixels));
}

bool read(StateReader& in, image::Layer& layer) {
  uint64_t channels = 0;
  if (!read_text(in, layer.name) || !in.value(channels)) return false;
  for (uint64_t i = 0; i < channels; ++i)
    if (!read_text(in, layer.channels.emplace_back())) return false;
  return in.list(layer.pixels);
}

void write(StateWriter& out, const Reference& reference) {
  write_text(out, reference.file);
  write_text(out, reference.integrator);
  out.value(reference.image.width);
  out.value(reference.image.height);
  out.value<uint64_t>(reference.image.layers.size());
  for (const auto& layer : reference.image.layers) write(out, layer);
  write(out, reference.noise);
  out.value(reference.mean_error);
  out.value(reference.samples);
  out.value(reference.seconds);
  out.value(reference.reduction);
}

bool read(StateReader& in, Reference& reference) {
  uint64_t layers = 0;
  if (!read_text(in, reference.file) || !read_text(in, reference.integrator) || !in.value(reference.image.width) ||
      !in.value(reference.image.height) || !in.value(layers))
    return false;
  for (uint64_t i = 0; i < layers; ++i)
    if (!read(in, reference.image.layers.emplace_back())) return false;
  return read(in, reference.noise) && in.value(reference.mean_error) && in.value(reference.samples) &&
         in.value(reference.seconds) && in.value(reference.reduction);
}

void write(StateWriter& out, const RepeatResult& result) {
  out.value<uint64_t>(result.method);
  write_text(out, result.failure);
  write_text(out, result.choice);
  out.value(result.curve.repeat);
  out.list(std::span<const metrics::ErrorPoint>(result.curve.points));
  out.list(std::span<const float>(result.image));
  out.value(result.rays_per_second);
  write(out, result.startup_seconds);
  write(out, result.khat);
  out.value<uint8_t>(result.has_heavy_tail);
}

bool read(StateReader& in, RepeatResult& result) {
  uint64_t method = 0;
  uint8_t has_heavy_tail = 0;
  if (!in.value(method) || !read_text(in, result.failure) || !read_text(in, result.choice) ||
      !in.value(result.curve.repeat) || !in.list(result.curve.points) || !in.list(result.image) ||
      !in.value(result.rays_per_second) || !read(in, result.startup_seconds) || !read(in, result.khat) ||
      !in.value(has_heavy_tail))
    return false;
  result.method = method;
  result.has_heavy_tail = has_heavy_tail != 0;
  return true;
}

bool read(StateReader& in, PartOutcome& outcome) {
  uint64_t methods = 0, repeats = 0;
  if (!in.value(methods)) return false;
  for (uint64_t i = 0; i < methods; ++i)
    if (!read_text(in, outcome.incompatibilities.emplace_back())) return false;
  if (!in.value(repeats)) return false;
  for (uint64_t i = 0; i < repeats; ++i)
    if (!read(in, outcome.repeats.emplace_back())) return false;
  return true;
}

bool is_valid(const MeasuredPart& part, size_t methods, size_t pixels) {
  const image::Layer* beauty = part.reference.image.find("");
  if (!beauty || beauty->pixels.size() != 3 * pixels || part.outcome.incompatibilities.size() != methods) return false;
  return std::ranges::all_of(part.outcome.repeats, [&](const RepeatResult& r) {
    const bool is_measured = !r.curve.points.empty() && r.image.size() == 3 * pixels;
    return r.method < methods && (is_measured || !r.failure.empty());
  });
}

}  // namespace

std::vector<std::byte> bytes_of(const MeasuredPart& part) {
  StateWriter out;
  write(out, part.reference);
  out.value(part.threads);
  out.value<uint64_t>(part.outcome.incompatibilities.size());
  for (const std::string& text : part.outcome.incompatibilities) write_text(out, text);
  out.value<uint64_t>(part.outcome.repeats.size());
  for (const RepeatResult& result : part.outcome.repeats) write(out, result);
  return out.take();
}

std::optional<MeasuredPart> measured_part_from(std::span<const std::byte> bytes, size_t methods, int width,
                                               int height) {
  StateReader in(bytes);
  MeasuredPart part;
  if (!read(in, part.reference) || !in.value(part.threads) || !read(in, part.outcome) || !in.at_end())
    return std::nullopt;
  const auto& image = part.reference.image;
  if (image.width != width || image.height != height) return std::nullopt;
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  return is_valid(part, methods, pixels) ? std::optional(std::move(part)) : std::nullopt;
}

uint64_t hash_of(const Reference& reference) {
  const auto bytes = std::as_bytes(std::span(reference.rgb()));
  return hash_bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

}  // namespace etendue::bench
