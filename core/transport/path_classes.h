// Where a view's energy comes from: sums per class of light paths.
//
// A class is named by a path expression that matches the words of the class and no others, so that the name can be
// given back to render that class alone. Two ways of telling paths apart, each with a detail k:
//
//   words   every word with at most k scattering events is a class of its own, EDSL; longer ones share their first k:
//   EDS.+L runs    repetitions count as one, ED+S+L; words with more than k runs share their first k: ED+S+(D|G).*L
//
// Either way every path belongs to exactly one class.
#pragma once
#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/exact_sum.h"
#include "transport/automaton.h"

namespace etendue::transport {

enum class Naming : uint8_t { words, runs };

class PathClass {
 public:
  static constexpr size_t kMostDetail = 12;

  // The class of the path with these scattering events, from the camera on. `detail` from 0 to kMostDetail.
  static PathClass of(std::span<const Event> scattering, Naming naming, size_t detail);

  std::string name() const;

  friend auto operator<=>(const PathClass&, const PathClass&) = default;

 private:
  uint8_t size_ = 0;
  bool more_ = false;  // other letters follow
  Naming naming_ = Naming::words;
  std::array<Event, kMostDetail> letters_{};
};

// Means over samples of what each class carries. Tables that threads filled apart can be merged in any order: sums are
// exact, so the result has the same bits.
class ClassEnergies {
 public:
  ClassEnergies(Naming naming, size_t detail) : naming_(naming), detail_(detail) {}

  // A path of the present sample carries this much (luminance, or another number that is linear in radiance, finite).
  void add(std::span<const Event> scattering, double energy);
  // The present sample is complete. What it found in a class counts as one number: parts of it are not independent.
  void end_sample();

  // `other` must tell paths apart as this does, and be between samples.
  void merge(const ClassEnergies& other);

  uint64_t samples() const { return samples_; }
  struct Row {
    std::string name;
    double mean, standard_error;  // over all samples; they count as independent
    uint64_t found;               // samples that found something of the class
  };
  // The largest mean first; equal ones by class.
  std::vector<Row> rows() const;

 private:
  struct Sums {
    double pending = 0;
    uint64_t found = 0;
    ExactSum energy, squares;
  };

  Naming naming_;
  size_t detail_;
  uint64_t samples_ = 0;
  std::map<PathClass, Sums> sums_;
  std::vector<PathClass> touched_;  // by the present sample
};

}  // namespace etendue::transport
