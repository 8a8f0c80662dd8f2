// Classes of light paths that part all of them.
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
#include <span>
#include <string>
#include <vector>

#include "transport/path_expression/automaton.h"

namespace etendue::transport {

enum class Naming : uint8_t { words, runs };

class PathClass {
 public:
  static constexpr size_t kMostDetail = 12;

  // The class of the path with these scattering events, from the camera on. `detail` from 0 to kMostDetail.
  static PathClass of(std::span<const Event> scattering, Naming naming, size_t detail);

  std::string name() const;

  // The classes of one more detail that it falls into; none if it is a single one at any detail, or at kMostDetail.
  std::vector<PathClass> parts() const;

  friend auto operator<=>(const PathClass&, const PathClass&) = default;

 private:
  uint8_t size_ = 0;
  bool more_ = false;  // other letters follow
  Naming naming_ = Naming::words;
  std::array<Event, kMostDetail> letters_{};
};

}  // namespace etendue::transport
