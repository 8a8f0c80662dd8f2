// A furnace that is moved away from the origin.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void far_from_the_origin(Lab& lab) {
  for (const float far : {0.0f, 1e2f, 1e4f}) {
    scene::Scene scene;
    Mat4 place(1);
    place[3] = Vec4(far, -far, far, 1);
    scene::add(scene, scene::cube(1, true), scene::diffuse(Rgb(0.5f), Rgb(1)), place);
    const Vec3 middle(far, -far, far);
    const auto d = lab.document(std::move(scene), look_at(middle, middle + Vec3(0, 0, 1), {0, 1, 0}, 1));
    for (const auto& method : unbiased_methods())
      lab.expect_near(method, "at " + number(far) + " m", lab.mean(Lab::with_method(d, method), 64).value, 2, 0.01);
  }
}

inline constexpr Case kFarFromTheOrigin{"far-from-the-origin", Kind::geometry,
                                        "A room of two metres keeps its light while coordinates have a millimetre "
                                        "left; offsets grow with the coordinates, so it must not leak",
                                        far_from_the_origin};

}  // namespace etendue::stress
