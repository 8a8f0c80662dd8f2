// Sets of bidirectional techniques in text form: (s, t) has s vertices from the light and t from the camera.
//
//   "0,3"  one    "1,*"  all with s = 1    "0,* 2,2"  several    ""  none
#pragma once
#include <string_view>
#include <vector>

#include "base/result.h"

namespace etendue::integrator {

// A bidirectional technique: s vertices from the light, t from the camera. Or several: all with s vertices from the light
// and at least two from the camera, or all with t vertices from the camera.
struct Technique {
  static constexpr int kAny = -1;
  int s, t;

  bool includes(int light_vertices, int camera_vertices) const {
    return (s == kAny || s == light_vertices) && (t == kAny ? camera_vertices >= 2 : t == camera_vertices);
  }
  bool has_more_light_vertices_than(int count) const { return s == kAny || s > count; }
  bool has_more_camera_vertices_than(int count) const { return t == kAny || t > count; }
};

class Techniques {
 public:
  // Text that is not a list of pairs is a usage error that states the expected form.
  static Result<Techniques> parse(std::string_view text);

  bool empty() const { return pairs_.empty(); }
  bool contains(int s, int t) const {
    for (const Pair& p : pairs_)
      if ((p.s == kAny || p.s == s) && (p.t == kAny || p.t == t)) return true;
    return false;
  }

 private:
  static constexpr int kAny = -1;
  struct Pair {
    int s, t;
  };
  std::vector<Pair> pairs_;
};

}  // namespace etendue::integrator
