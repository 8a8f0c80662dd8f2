#include "viewer/viewport/comparison.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "image/image.h"
#include "metrics/flip.h"
#include "spectrum/colormap.h"
#include "viewer/widgets/format.h"

namespace etendue::viewer {
namespace {

constexpr double kShiftDelay = 0.2;  // seconds
constexpr double kShare = 0.99;      // of the pixels lie within the colours

Rgb linear(const Rgb& encoded) {
  return {srgb_to_linear(encoded.r), srgb_to_linear(encoded.g), srgb_to_linear(encoded.b)};
}

// Rounded up to 1, 2 or 5 times a power of ten: a scale that holds still while the picture converges.
float round_number(float x) {
  if (!(x > 0)) return 0;
  const float power = std::pow(10.0f, std::floor(std::log10(x)));
  for (const float digit : {1.0f, 2.0f, 5.0f})
    if (x <= digit * power * 1.0001f) return digit * power;
  return 10 * power;
}

// The size that most of the values do not exceed; the largest one if most are zero.
float scale_of(const std::vector<float>& values) {
  std::vector<float> sizes(values.size());
  std::ranges::transform(values, sizes.begin(), [](float v) { return std::abs(v); });
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, at);
  return round_number(*at > 0 ? *at : *std::max_element(at, sizes.end()));
}

void make_difference(DifferenceMap& map) {
  const auto &left = *map.key.left, &right = *map.key.right;
  map.values.resize(left.size());
  for (size_t i = 0; i < left.size(); ++i) {
    const float d = luminance(left[i]) - luminance(right[i]);
    map.values[i] = std::isfinite(d) ? d : 0;
  }
  map.scale = scale_of(map.values);
  constexpr int kColors = 512;
  std::array<Rgb, kColors + 1> colors;
  for (int i = 0; i <= kColors; ++i)
    colors[static_cast<size_t>(i)] = linear(signed_colors(2.0f * static_cast<float>(i) / kColors - 1));
  const float slope = map.scale > 0 ? 0.5f / map.scale : 0;
  std::ranges::transform(map.values, map.painted.begin(), [&](float v) {
    return colors[static_cast<size_t>(std::clamp(v * slope + 0.5f, 0.0f, 1.0f) * kColors + 0.5f)];
  });
}

// What the screen shows of it, before the encoding.
std::vector<float> shown(const std::vector<Rgb>& radiance, const MapKey& key) {
  std::vector<float> numbers;
  numbers.reserve(3 * radiance.size());
  const float scale = std::exp2(key.exposure);
  for (const Rgb& r : radiance) {
    const Rgb c = image::tone_mapped(r * scale, key.curve);
    numbers.insert(numbers.end(), {c.r, c.g, c.b});
  }
  return numbers;
}

void make_flip(DifferenceMap& map, int width, int height) {
  map.values = metrics::flip_map(width, height, shown(*map.key.left, map.key), shown(*map.key.right, map.key));
  std::ranges::transform(map.values, map.painted.begin(), [](float v) { return linear(viridis(v)); });
}

Result<Side> read_side(const std::string& file) {
  const auto picture = image::read_linear(file);
  if (!picture) return picture.error();
  const image::Layer* layer = picture->find("");
  if (!layer || layer->channels.size() != 3) return input_error(file + ": has no R, G and B; give a picture");
  auto frame = std::make_shared<render::Frame>();
  frame->width = picture->width, frame->height = picture->height;
  auto pixels = std::make_shared<std::vector<Rgb>>(layer->pixels.size() / 3);
  for (size_t i = 0; i < pixels->size(); ++i)
    (*pixels)[i] = {layer->pixels[3 * i], layer->pixels[3 * i + 1], layer->pixels[3 * i + 2]};
  frame->pixels = std::move(pixels);
  return Side{std::filesystem::path(file).filename().string(), std::move(frame)};
}

bool same_size(const Side& a, const Side& b) {
  return a.frame->width == b.frame->width && a.frame->height == b.frame->height;
}

std::string size_text(const Side& side) {
  return std::to_string(side.frame->width) + " x " + std::to_string(side.frame->height);
}

}  // namespace

const char* name_of(CompareMode mode) {
  constexpr const char* kNames[] = {"off", "wipe", "difference", "flip"};
  return kNames[static_cast<size_t>(mode)];
}

std::shared_ptr<const DifferenceMap> make_map(const MapKey& key, int width, int height) {
  const auto start = std::chrono::steady_clock::now();
  auto map = std::make_shared<DifferenceMap>();
  map->key = key;
  map->painted.resize(key.left->size());
  if (key.mode == CompareMode::flip)
    make_flip(*map, width, height);
  else
    make_difference(*map);
  map->mean = metrics::mean_of(map->values);
  map->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return map;
}

std::string Comparison::problem() const {
  if (!first().frame) return "There is no picture yet.";
  if (!b.frame) return "There is no B: keep a picture, or load one.";
  if (!same_size(first(), b))
    return "A is " + size_text(first()) + ", B is " + size_text(b) + ": only pictures of one size can be compared.";
  return "";
}

bool Comparison::reference_on_screen() const {
  return reference.frame && live.frame && same_size(reference, live) && (shows_reference || shift_ == Shift::shows);
}

void Comparison::load(const std::string& file, Target target) {
  loading_.start([file, target]() -> Result<Loaded> {
    auto side = read_side(file);
    if (!side) return side.error();
    return Loaded{target, std::move(*side)};
  });
}

std::optional<Result<std::string>> Comparison::take_loaded() {
  auto loaded = loading_.take();
  if (!loaded) return std::nullopt;
  if (!*loaded) return Result<std::string>(loaded->error());
  Side& side = (*loaded)->side;
  if (live.frame && !same_size(side, live))
    return Result<std::string>(input_error(side.name + ": is " + size_text(side) + ", the picture is " +
                                           size_text(live) + "; only pictures of one size can be compared"));
  const bool is_b = (*loaded)->target == Target::b;
  if (is_b && mode == CompareMode::off) mode = CompareMode::wipe;
  const std::string line = side.name + (is_b ? " is B now" : " is the reference now: hold Shift to see it");
  (is_b ? b : reference) = std::move(side);
  return Result<std::string>(line);
}

bool Comparison::advance(float exposure, image::ToneCurve curve) {
  if (job_.running() && making_ != mode) job_.abandon();
  bool fresh = false;
  if (auto made = job_.take()) map_ = std::move(*made), made_ = Clock::now(), fresh = true;
  const bool needs_map = mode == CompareMode::difference || mode == CompareMode::flip;
  settled_ = !needs_map || !active();
  if (settled_ || job_.running()) return fresh;
  MapKey key{mode, left().frame->pixels, right().frame->pixels, 0, image::ToneCurve::none};
  if (mode == CompareMode::flip) key.exposure = exposure, key.curve = curve;
  // At most half of a processor goes into it while the picture changes all the time.
  settled_ = map_ && map_->key == key;
  const bool resting = map() && std::chrono::duration<double>(Clock::now() - made_).count() < map_->seconds;
  if (settled_ || resting) return fresh;
  making_ = mode;
  job_.start(
      [key, width = left().frame->width, height = left().frame->height] { return make_map(key, width, height); });
  return fresh;
}

std::shared_ptr<const DifferenceMap> Comparison::map() const {
  const bool fits = map_ && active() && map_->key.mode == mode && map_->values.size() == left().frame->pixels->size();
  return fits ? map_ : nullptr;
}

bool Comparison::watch_shift(const Input& input, bool typing, Clock::time_point now) {
  const Shift before = shift_;
  const bool alone = input.keys.count() == 1 && !typing && !input.buttons[0] && !input.buttons[1] &&
                     !input.buttons[2] && input.wheel == 0;
  if (!input.shift())
    shift_ = Shift::up;
  else if (!alone)
    shift_ = Shift::spoilt;
  else if (shift_ == Shift::up)
    shift_ = Shift::held, shift_since_ = now;
  else if (shift_ == Shift::held && std::chrono::duration<double>(now - shift_since_).count() >= kShiftDelay)
    shift_ = Shift::shows;
  return (before == Shift::shows) != (shift_ == Shift::shows);
}

}  // namespace etendue::viewer
