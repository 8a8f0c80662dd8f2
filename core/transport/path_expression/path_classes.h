// Partitions of all light paths into classes.
//
// The name of a class is a path expression that matches exactly its words, so that the class can be rendered by its
// name. There are two partitions, each with a level of detail k:
//
//   words   every word with at most k scattering events is a class, EDSL; longer words are grouped by their first k
//           events: EDS.+L
//   runs    repetitions are merged, ED+S+L; words with more than k runs are grouped by their first k: ED+S+(D|G).*L
//
// Every path belongs to exactly one class.
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

  // The class of a path with these scattering events, from the camera on. `detail` is 0 to kMostDetail. Without
  // `volumes`, names and parts leave out V: they partition the paths of a scene without scattering media.
  static PathClass of(std::span<const Event> scattering, Naming naming, size_t detail, bool volumes = false);

  std::string name() const;

  // The classes of the next level of detail into which it is divided; none if it is a single word or at kMostDetail.
  std::vector<PathClass> parts() const;

  friend auto operator<=>(const PathClass&, const PathClass&) = default;

 private:
  uint8_t size_ = 0;
  bool more_ = false;  // further letters follow
  Naming naming_ = Naming::words;
  bool volumes_ = false;
  std::array<Event, kMostDetail> letters_{};
};

}  // namespace etendue::transport
