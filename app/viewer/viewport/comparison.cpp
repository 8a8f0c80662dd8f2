#include "viewer/viewport/comparison.h"

#include <utility>

#include "image/image.h"
#include "render/clock.h"
#include "viewer/files/file_names.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr double kShiftDelay = 0.2;  // seconds

Result<Side> read_side(const std::string& file) {
  const auto image = image::read_linear(file);
  if (!image) return image.error();
  const image::Layer* layer = image->find("");
  if (!layer || layer->channels.size() != 3)
    return input_error(file + ": has no channels R, G and B; load an RGB image");
  auto frame = std::make_shared<render::Frame>();
  frame->width = image->width;
  frame->height = image->height;
  frame->pixels = std::make_shared<const std::vector<Rgb>>(image::rgb_pixels(*layer));
  const std::string name = base_name(file);
  return Side{.name = name, .label = name, .frame = std::move(frame)};
}

bool same_size(const Side& a, const Side& b) {
  return a.frame->width == b.frame->width && a.frame->height == b.frame->height;
}

// Begins with the name of the integrator.
std::string reason_unavailable(const Side& side) {
  const std::string integrator = side.label.substr(0, side.label.find(','));
  return side.unavailable.starts_with(integrator + ": ") ? side.unavailable : side.label + ": " + side.unavailable;
}

std::string size_text(const Side& side) { return formatted("%d x %d", side.frame->width, side.frame->height); }

}  // namespace

std::string Comparison::problem() const {
  for (const auto& [letter, side] : {std::pair{"A", &first()}, {"B", &b}})
    if (!side->unavailable.empty()) return std::string(letter) + ": n/a. " + reason_unavailable(*side);
  if (!first().frame) return "There is no image yet.";
  if (!b.frame) return "There is no image B. Pin the current image or load one.";
  if (!same_size(first(), b))
    return "A is " + size_text(first()) + ", B is " + size_text(b) + ". Images of different size cannot be compared.";
  return "";
}

bool Comparison::reference_is_shown() const {
  const bool requested = shows_reference || shift_ == Shift::shows_reference;
  return requested && reference.frame && live.frame && same_size(reference, live);
}

void Comparison::load(const std::string& file, Target target) {
  const auto work = [file, target]() -> Result<LoadedImage> {
    auto side = read_side(file);
    if (!side) return side.error();
    return LoadedImage{target, std::move(*side), std::nullopt};
  };
  loading_.start(work, wake_);
}

void Comparison::load_both(const std::string& file_a, const std::string& file_b) {
  const auto work = [file_a, file_b]() -> Result<LoadedImage> {
    auto side_a = read_side(file_a), side_b = read_side(file_b);
    if (!side_a) return side_a.error();
    if (!side_b) return side_b.error();
    return LoadedImage{Target::a, std::move(*side_a), std::move(*side_b)};
  };
  loading_.start(work, wake_);
}

// Returns the message.
std::string Comparison::take_side(LoadedImage loaded) {
  const std::string name = loaded.side.name;
  if (loaded.target == Target::reference) {
    reference = std::move(loaded.side);
    return "Reference: " + name + ". Hold Shift to show it.";
  }
  if (mode == CompareMode::off) mode = CompareMode::wipe;
  const bool is_b = loaded.target == Target::b;
  (is_b ? b : a) = std::move(loaded.side);
  if (loaded.other) b = std::move(*loaded.other);
  if (is_b) return "Image B: " + name;
  return loaded.other ? "Image A: " + name + ", image B: " + b.name : "Image A: " + name;
}

std::optional<Result<std::string>> Comparison::take_load_result() {
  auto loaded = loading_.take_result();
  if (!loaded) return std::nullopt;
  if (!*loaded) return Result<std::string>(loaded->error());
  LoadedImage& image = **loaded;
  const Side& other = image.other                         ? *image.other
                      : image.target == Target::reference ? live
                      : image.target == Target::b         ? first()
                                                          : image.side;
  if (other.frame && !same_size(image.side, other))
    return Result<std::string>(input_error(image.side.name + ": is " + size_text(image.side) + ", " +
                                           (&other == &live ? "the image" : other.name) + " is " + size_text(other) +
                                           "; images of different size cannot be compared"));
  return take_side(std::move(image));
}

void Comparison::update(float exposure, image::ToneCurve curve) {
  if (map_task_.running() && computing_mode_ != mode) map_task_.abandon();
  if (auto map = map_task_.take_result()) {
    map_ = std::move(*map);
    map_time_ = Clock::now();
  }
  const bool needs_map = mode == CompareMode::difference || mode == CompareMode::flip;
  map_is_current_ = !needs_map || !is_active();
  if (map_is_current_ || map_task_.running()) return;
  DifferenceInput input{.mode = mode, .left = left().frame->pixels, .right = right().frame->pixels};
  if (mode == CompareMode::flip) {
    input.exposure = exposure;
    input.curve = curve;
  }
  map_is_current_ = map_ && map_->input == input;
  // While the image changes all the time, maps take at most half of the time of one core.
  const bool too_early = map() && render::seconds_between(map_time_, Clock::now()) < map_->seconds;
  if (map_is_current_ || too_early) return;
  computing_mode_ = mode;
  const auto work = [input, width = left().frame->width, height = left().frame->height] {
    return make_difference_map(input, width, height);
  };
  map_task_.start(work, wake_);
}

std::shared_ptr<const DifferenceMap> Comparison::map() const {
  const bool fits =
      map_ && is_active() && map_->input.mode == mode && map_->values.size() == left().frame->pixels->size();
  return fits ? map_ : nullptr;
}

bool Comparison::update_shift(const Input& input, bool typing, Clock::time_point now) {
  const Shift before = shift_;
  const bool any_button = input.buttons[0] || input.buttons[1] || input.buttons[2];
  const bool shift_alone = input.keys.count() == 1 && !typing && !any_button && input.wheel == 0;
  if (!input.shift()) {
    shift_ = Shift::up;
  } else if (!shift_alone) {
    shift_ = Shift::used;
  } else if (shift_ == Shift::up) {
    shift_ = Shift::held;
    shift_time_ = now;
  } else if (shift_ == Shift::held && render::seconds_between(shift_time_, now) >= kShiftDelay) {
    shift_ = Shift::shows_reference;
  }
  return (before == Shift::shows_reference) != (shift_ == Shift::shows_reference);
}

}  // namespace etendue::viewer
