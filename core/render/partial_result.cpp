#include "render/partial_result.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/error_free.h"
#include "base/hash.h"
#include "base/json_integer.h"
#include "base/json_text.h"
#include "film/film_image.h"
#include "image/image.h"
#include "render/image_output.h"
#include "render/tail_statistics.h"
#include "render/thread_pool.h"

namespace etendue::render {
namespace {

using nlohmann::json;

constexpr const char *kPartAttribute = "etendue:part", *kTailsAttribute = "etendue:tails";
// Increment when files of earlier versions cannot be read any more.
constexpr int kPartFormat = 1;
constexpr std::array<const char*, film::kHalfBuffers> kHalfNames{"A", "B"};
// Counts are stored as floats, which hold all integers up to here.
constexpr uint32_t kMostSamples = 1U << 24;

std::string layer_name(size_t half, const std::string& what) { return std::string(kHalfNames[half]) + "." + what; }
std::string sum_layer_name(size_t half, size_t digit) {
  return layer_name(half, digit == 0 ? "sum" : "sum" + std::to_string(digit));
}

Error damaged_part(const std::filesystem::path& path, const std::string& what) {
  return input_error(path.string() + ": " + what + "; render this part again");
}

// ---- Sums

// The layers of the sums of a half-buffer.
class SumLayers {
 public:
  SumLayers(const film::Film& film, uint32_t half) : film_(film), half_(half) {}

  // False if a sum is too large for a float.
  bool add_pixels() {
    for (int y = 0; y < film_.height(); ++y)
      for (int x = 0; x < film_.width(); ++x)
        for (size_t c = 0; c < 3; ++c)
          if (!add_value(x, y, c)) return false;
    return true;
  }
  std::vector<image::Layer> take() { return std::move(layers_); }

 private:
  bool add_value(int x, int y, size_t channel) {
    const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(film_.width()) + static_cast<size_t>(x);
    double rest = film_.pixels()[pixel].sum[half_][channel], error = 0;
    size_t levels = 0;
    film_.rounding_errors().for_each_level(x, y, half_, [&](const film::RoundingErrors::Channels& errors) {
      error = errors[channel];
      ++levels;
    });
    if (levels > 1) return add_terms(x, y, pixel, channel);
    // The exact sum is rest + error. A digit is the leading part of `rest`, so the difference has no rounding error.
    error = add_exactly(rest, error);
    for (size_t digit = 0; rest != 0; ++digit) {
      if (std::abs(rest) > double{std::numeric_limits<float>::max()}) return false;
      const auto value = static_cast<float>(rest);
      layer(digit).pixels[3 * pixel + channel] = value;
      rest -= double{value};
      error = add_exactly(rest, error);
    }
    return true;
  }

  // The same for any number of terms.
  bool add_terms(int x, int y, size_t pixel, size_t channel) {
    std::vector<double> terms = film_.rounding_errors().errors(x, y, half_, channel);
    terms.push_back(film_.pixels()[pixel].sum[half_][channel]);
    double rest = rounded_sum(terms);
    for (size_t digit = 0; rest != 0; ++digit) {
      if (std::abs(rest) > double{std::numeric_limits<float>::max()}) return false;
      const auto value = static_cast<float>(rest);
      layer(digit).pixels[3 * pixel + channel] = value;
      terms.push_back(-double{value});
      rest = rounded_sum(terms);
    }
    return true;
  }

  image::Layer& layer(size_t digit) {
    while (layers_.size() <= digit)
      layers_.push_back(
          {sum_layer_name(half_, layers_.size()), {"R", "G", "B"}, std::vector<float>(3 * film_.pixels().size())});
    return layers_[digit];
  }

  const film::Film& film_;
  uint32_t half_;
  std::vector<image::Layer> layers_;
};

image::Layer count_layer(const film::Film& film, size_t half) {
  image::Layer layer{layer_name(half, "count"), {"V"}, {}};
  for (const auto& pixel : film.pixels()) layer.pixels.push_back(static_cast<float>(pixel.count[half]));
  return layer;
}

// ---- Attributes

uint64_t hash_of(const std::string& text, uint64_t seed) { return hash_bytes(text.data(), text.size(), seed); }

// The hash of the values of a layer, as pairs of floats.
uint64_t hash_of(const image::Layer& layer, uint64_t seed) {
  uint64_t h = hash_of(layer.name, seed);
  const size_t bytes = layer.pixels.size() * sizeof(float);
  for (size_t i = 0; i < bytes; i += sizeof(uint64_t)) {
    uint64_t word = 0;
    std::memcpy(&word, reinterpret_cast<const char*>(layer.pixels.data()) + i, std::min(sizeof word, bytes - i));
    h = mix_bits(h ^ (word + uint64_t{0x9e3779b97f4a7c15}));
  }
  return h;
}

// The layers that hold samples, in a fixed order.
std::vector<const image::Layer*> sample_layers(const image::LayeredImage& image) {
  std::vector<const image::Layer*> layers;
  for (size_t half = 0; half < film::kHalfBuffers; ++half) {
    layers.push_back(image.find(layer_name(half, "count")));
    for (size_t digit = 0; const image::Layer* layer = image.find(sum_layer_name(half, digit)); ++digit)
      layers.push_back(layer);
  }
  return layers;
}

json block_json(const SampleBox& b) {
  return {b.first, b.end, b.pixels.x, b.pixels.y, b.pixels.width, b.pixels.height};
}

json info_json(const PartInfo& info) {
  json blocks = json::array(), first = json::array();
  for (const SampleBox& b : info.blocks) blocks.push_back(block_json(b));
  for (const auto& s : info.invalid_samples.first) first.push_back({s.x, s.y, s.sample, static_cast<int>(s.reason)});
  return {{"format", kPartFormat},
          {"version", info.version},
          {"scene_hash", info.scene_hash},
          {"blocks", blocks},
          {"rays", info.rays},
          {"microseconds", info.microseconds},
          {"nan", info.invalid_samples.nan},
          {"infinite", info.invalid_samples.infinite},
          {"negative", info.invalid_samples.negative},
          {"first_invalid", first}};
}

uint64_t content_hash(const json& info, const image::LayeredImage& image) {
  uint64_t h = hash_of(json_text(info), 0);
  h = hash_of(image.attributes.at(kStateAttribute), h);
  h = hash_of(image.attributes.at(kTailsAttribute), h);
  for (const image::Layer* layer : sample_layers(image)) h = hash_of(*layer, h);
  return h;
}

bool is_count(const image::Layer& layer) { return layer.name.ends_with("count"); }

// Whether the file has the stated size, all its layers and attributes, and the content that was written.
bool is_intact(const image::LayeredImage& image, const PartInfo& info) {
  if (image.width != info.width || image.height != info.height || !image.attributes.contains(kStateAttribute) ||
      !image.attributes.contains(kTailsAttribute))
    return false;
  const auto has_channels = [](const image::Layer* layer) {
    return layer && layer->channels.size() == (is_count(*layer) ? 1U : 3U);
  };
  return std::ranges::all_of(sample_layers(image), has_channels) && content_hash(info_json(info), image) == info.hash;
}

// Adds the counts of a half-buffer, or one term of its sums.
void add_layer(const image::Layer& layer, film::Film& film) {
  const uint32_t half = layer.name.starts_with(kHalfNames[0]) ? 0 : 1;
  const bool counts = is_count(layer);
  const size_t row_length = layer.channels.size() * static_cast<size_t>(film.width());
  ThreadPool(0).run_ranges(film.height(), [&](int begin, int end) {
    const float* value = layer.pixels.data() + row_length * static_cast<size_t>(begin);
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < film.width(); ++x, value += layer.channels.size()) {
        if (counts)
          film.add_sum(x, y, half, {}, static_cast<uint32_t>(*value));
        else
          film.add_sum(x, y, half, {double{value[0]}, double{value[1]}, double{value[2]}}, 0);
      }
  });
}

// Throws json::exception if a member is missing or has another type.
PartInfo info_from(const json& j, int width, int height) {
  PartInfo info;
  info.width = width;
  info.height = height;
  info.version = j.at("version").get<std::string>();
  info.scene_hash = json_integer<uint64_t>(j.at("scene_hash"));
  for (const json& b : j.at("blocks")) {
    info.blocks.push_back({json_integer<uint32_t>(b.at(0)),
                           json_integer<uint32_t>(b.at(1)),
                           {json_integer<int>(b.at(2)), json_integer<int>(b.at(3)), json_integer<int>(b.at(4)),
                            json_integer<int>(b.at(5))}});
  }
  info.rays = json_integer<uint64_t>(j.at("rays"));
  info.microseconds = json_integer<uint64_t>(j.at("microseconds"));
  film::InvalidSamples& invalid = info.invalid_samples;
  invalid.nan = json_integer<uint64_t>(j.at("nan"));
  invalid.infinite = json_integer<uint64_t>(j.at("infinite"));
  invalid.negative = json_integer<uint64_t>(j.at("negative"));
  for (const json& s : j.at("first_invalid"))
    invalid.first.push_back({json_integer<int>(s.at(0)), json_integer<int>(s.at(1)), json_integer<uint32_t>(s.at(2)),
                             static_cast<film::InvalidReason>(json_integer<int>(s.at(3)))});
  info.hash = json_integer<uint64_t>(j.at("hash"));
  return info;
}

// The value of a setting as text; settings with their default values are not part of a state.
std::string setting_text(const json& settings, const std::string& name) {
  return settings.contains(name) ? settings[name].dump() : "the default";
}

// The first setting that differs between two states and determines samples.
std::string setting_difference(const json& a, const json& b) {
  json names = a;
  names.update(b);
  for (const auto& [name, value] : names.items()) {
    if (name.starts_with("display.") || name == "camera.exposure") continue;
    const std::string of_a = setting_text(a, name), of_b = setting_text(b, name);
    if (of_a != of_b) return name + " is " + of_a + ", not " + of_b;
  }
  return {};
}

std::string size_text(const PartInfo& info) { return std::to_string(info.width) + "x" + std::to_string(info.height); }

}  // namespace

std::string difference_of(const PartInfo& part, const PartInfo& other) {
  if (part.version != other.version) return "its version of etendue is " + part.version + ", not " + other.version;
  if (size_text(part) != size_text(other)) return "its size is " + size_text(part) + ", not " + size_text(other);
  const json a = json::parse(part.state, nullptr, false), b = json::parse(other.state, nullptr, false);
  if (!a.is_object() || !b.is_object() || !a.contains("settings") || !b.contains("settings"))
    return "its settings are damaged";
  if (const std::string text = setting_difference(a["settings"], b["settings"]); !text.empty()) return text;
  if (part.scene_hash == other.scene_hash) return {};
  for (const char* name : {"scene", "camera", "environment"})
    if (a.value(name, "") != b.value(name, ""))
      return std::string("its ") + name + " is '" + a.value(name, "") + "', not '" + b.value(name, "") + "'";
  return "the content of its scene is different";
}

Result<void> write_part(const std::filesystem::path& path, PartInfo info, const PartialSamples& samples) {
  const film::Film& film = samples.film;
  for (const auto& pixel : film.pixels())
    if (pixel.count[0] > kMostSamples || pixel.count[1] > kMostSamples)
      return output_error(path.string() + ": a partial result cannot hold more than " + std::to_string(kMostSamples) +
                          " samples per pixel and half-buffer; merge fewer parts");
  image::LayeredImage image{.width = film.width(), .height = film.height()};
  image.layers.push_back({"", {"R", "G", "B"}, film::radiance_of(film)});
  for (uint32_t half = 0; half < film::kHalfBuffers; ++half) {
    image.layers.push_back(count_layer(film, half));
    SumLayers sums(film, half);
    if (!sums.add_pixels())
      return output_error(path.string() +
                          ": the sum of a pixel's samples exceeds the range of OpenEXR; render fewer "
                          "samples per part");
    for (image::Layer& layer : sums.take()) image.layers.push_back(std::move(layer));
  }
  image.attributes[kStateAttribute] = info.state;
  image.attributes["software"] = "etendue";
  image.attributes[kTailsAttribute] = base64(film::bytes_of(samples.tails));
  info.invalid_samples = film.invalid_samples();
  json j = info_json(info);
  j["hash"] = content_hash(j, image);
  image.attributes[kPartAttribute] = json_text(j);
  return image::write_exr_quickly(path, image);
}

Result<PartInfo> read_part_info(const std::filesystem::path& path) {
  const auto header = image::read_exr_header(path);
  if (!header) return header.error();
  const auto& attributes = header->attributes;
  if (!attributes.contains(kPartAttribute) || !attributes.contains(kStateAttribute) ||
      !attributes.contains(kTailsAttribute))
    return input_error(path.string() +
                       ": is not a part of a rendering; give files that render --samples, --region or "
                       "merge --partial wrote");
  const json j = json::parse(attributes.at(kPartAttribute), nullptr, false);
  try {
    if (j.at("format").get<int>() != kPartFormat)
      return damaged_part(path,
                          "is a part of format " + j.at("format").dump() + ", not " + std::to_string(kPartFormat));
    PartInfo info = info_from(j, header->width, header->height);
    info.state = attributes.at(kStateAttribute);
    const auto is_valid = [&](const SampleBox& b) {
      return b.first < b.end && is_inside(b.pixels, info.width, info.height);
    };
    if (info.blocks.empty() || !std::ranges::all_of(info.blocks, is_valid) || find_overlap(info.blocks))
      return damaged_part(path, "the samples that it lists are impossible");
    return info;
  } catch (const json::exception&) {
    return damaged_part(path, "its description is damaged");
  }
}

Result<LoadedPart> load_part(const std::filesystem::path& path, const PartInfo& info) {
  auto image = image::read_exr(path);
  if (!image) return damaged_part(path, "it is truncated or damaged");
  if (!is_intact(*image, info)) return damaged_part(path, "it is damaged");
  const auto bytes = decode_base64(image->attributes.at(kTailsAttribute));
  auto tails = bytes ? film::tail_states_from(*bytes) : std::nullopt;
  if (!tails || tails->size() != TailStatistics::tile_count(info.width, info.height))
    return damaged_part(path, "its statistics are damaged");
  return LoadedPart{std::move(*image), std::move(*tails)};
}

void add_part(const LoadedPart& part, const PartInfo& info, PartialSamples& samples) {
  film::Film& film = samples.film;
  for (const image::Layer* layer : sample_layers(part.image)) add_layer(*layer, film);
  const size_t capacity = TailStatistics::capacity(film.width(), film.height());
  for (size_t i = 0; i < part.tails.size(); ++i) film::merge(samples.tails[i], part.tails[i], capacity);
  film::InvalidSamples invalid = film.invalid_samples();
  film::merge(invalid, info.invalid_samples);
  film.set_invalid_samples(invalid);
}

}  // namespace etendue::render
