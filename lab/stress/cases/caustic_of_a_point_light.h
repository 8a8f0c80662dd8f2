// A point light above a glass sphere above a disk that lies completely in the shadow of the sphere. All light arrives
// on paths ESDL, read from the camera, from a light without extent.   [Lang, sec. 9.1.2]
#pragma once
#include "integrator/integrator_info.h"
#include "stress/case.h"

namespace etendue::stress {

// Whether paths from the camera are connected to point lights by way of glass.
inline bool finds_chains_to_points(const std::string& method) {
  const auto& info = *integrator::find_integrator(method);
  return info.group == integrator::Group::gathering && !info.point_paths.empty() &&
         integrator::finds_any(info.point_paths, "EDSSL");
}

inline void caustic_of_a_point_light(TestContext& test) {
  scene::Scene scene;
  scene::add(scene, scene::disk(0.2f, 64), scene::diffuse(Rgb(0.8f)));
  Mat4 transform(1);
  transform[3] = Vec4(0, 1, 0, 1);
  scene::add(scene, scene::sphere(0.5f, 48, false), scene::glass(), transform);
  add_point_light(scene, {0, 3, 0}, 10);
  const auto d = test.document(scene, narrow_camera({1.5f, 0.3f, 0}, {0, 0, 0}));
  // Beside the axis, where not all chains through a meridian of the sphere meet.
  const auto beside = test.document(scene, narrow_camera({1.5f, 0.3f, 0}, {0.05f, 0, 0.02f}));
  for (const auto& method : unbiased_integrators())
    if (finds_chains_to_points(method))
      test.expect_between(method, "beside the axis", test.mean(TestContext::with_method(beside, method), 16).value, 0.1,
                          10);
    else
      test.expect_zero(method, "", test.mean(TestContext::with_method(d, method), 64).value);
}

inline constexpr Case kCausticOfAPointLight{
    .name = "caustic-of-a-point-light",
    .kind = Kind::missing_paths,
    .theory =
        "A path from the camera never hits a point, and the connection to it is blocked by the glass, "
        "so the caustic is missing without any noise. Connections by way of the glass find it",
    .run = caustic_of_a_point_light};

}  // namespace etendue::stress
