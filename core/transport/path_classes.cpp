#include "transport/path_classes.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace etendue::transport {
namespace {

// "(D|G)" for S: what may follow a run of a letter.
std::string others_than(Event letter) {
  std::string text;
  for (const Event e : {Event::diffuse, Event::glossy, Event::specular})
    if (e != letter) text += (text.empty() ? "(" : "|") + std::string(1, letter_of(e));
  return text + ")";
}

}  // namespace

PathClass PathClass::of(std::span<const Event> scattering, Naming naming, size_t detail) {
  assert(detail <= kMostDetail);
  PathClass c;
  c.naming_ = naming;
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
  if (more_) text += naming_ == Naming::runs && size_ > 0 ? others_than(letters_[size_ - 1U]) + ".*" : ".+";
  return text + "L";
}

void ClassEnergies::add(std::span<const Event> scattering, double energy) {
  if (energy == 0) return;
  const PathClass path_class = PathClass::of(scattering, naming_, detail_);
  Sums& sums = sums_[path_class];
  if (sums.pending == 0) touched_.push_back(path_class);
  sums.pending += energy;
}

void ClassEnergies::end_sample() {
  ++samples_;
  for (const PathClass& path_class : touched_) {
    Sums& sums = sums_.at(path_class);
    // Twice here if its parts cancelled for a while: the second time nothing is left.
    if (sums.pending == 0) continue;
    ++sums.found;
    sums.energy.add(sums.pending);
    sums.squares.add(sums.pending * sums.pending);
    sums.pending = 0;
  }
  touched_.clear();
}

void ClassEnergies::merge(const ClassEnergies& other) {
  assert(naming_ == other.naming_ && detail_ == other.detail_ && other.touched_.empty());
  samples_ += other.samples_;
  for (const auto& [path_class, from] : other.sums_) {
    Sums& to = sums_[path_class];
    to.found += from.found;
    to.energy.add(from.energy);
    to.squares.add(from.squares);
  }
}

std::vector<ClassEnergies::Row> ClassEnergies::rows() const {
  std::vector<Row> rows;
  const auto n = static_cast<double>(samples_);
  for (const auto& [path_class, sums] : sums_) {
    const double mean = samples_ > 0 ? sums.energy.value() / n : 0;
    const double variance = samples_ > 1 ? (sums.squares.value() - n * mean * mean) / (n - 1) : 0;
    rows.push_back({path_class.name(), mean, std::sqrt(std::max(0.0, variance) / std::max(n, 1.0)), sums.found});
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.mean > b.mean; });
  return rows;
}

}  // namespace etendue::transport
