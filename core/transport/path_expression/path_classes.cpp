#include "transport/path_expression/path_classes.h"

#include <cassert>

namespace etendue::transport {
namespace {

std::span<const Event> scattering_events(bool volumes) {
  static constexpr std::array<Event, 4> kAll{Event::diffuse, Event::glossy, Event::specular, Event::volume};
  return {kAll.data(), volumes ? kAll.size() : kAll.size() - 1};
}

// The letters that can follow a run of a letter: "(D|G)" for S.
std::string others_than(Event letter, bool volumes) {
  std::string text;
  for (const Event e : scattering_events(volumes))
    if (e != letter) text += (text.empty() ? "(" : "|") + std::string(1, letter_of(e));
  return text + ")";
}

}  // namespace

PathClass PathClass::of(std::span<const Event> scattering, Naming naming, size_t detail, bool volumes) {
  assert(detail <= kMostDetail);
  PathClass c;
  c.naming_ = naming;
  c.volumes_ = volumes;
  for (size_t i = 0; i < scattering.size() && !c.more_; ++i) {
    if (naming == Naming::runs && i > 0 && scattering[i] == scattering[i - 1]) continue;
    if (c.size_ == detail)
      c.more_ = true;
    else
      c.letters_[c.size_++] = scattering[i];
  }
  return c;
}

std::string PathClass::name() const {
  std::string text = "E";
  for (size_t i = 0; i < size_; ++i) {
    text += letter_of(letters_[i]);
    if (naming_ == Naming::runs) text += '+';
  }
  if (more_) text += naming_ == Naming::runs && size_ > 0 ? others_than(letters_[size_ - 1U], volumes_) + ".*" : ".+";
  return text + "L";
}

std::vector<PathClass> PathClass::parts() const {
  std::vector<PathClass> list;
  if (!more_ || size_ == kMostDetail) return list;
  for (const Event e : scattering_events(volumes_)) {
    if (naming_ == Naming::runs && size_ > 0 && e == letters_[size_ - 1U]) continue;
    PathClass longer = *this;
    longer.letters_[longer.size_++] = e;
    longer.more_ = false;
    list.push_back(longer);
    longer.more_ = true;
    list.push_back(longer);
  }
  return list;
}

}  // namespace etendue::transport
