// A camera inside a cube that absorbs, emits or scatters, in a uniform sky: with and without a refracting surface.
//                                                                                     [Lang, sec. 4.1.2]
#pragma once
#include <cmath>

#include "integrator/integrator.h"
#include "stress/case.h"

namespace etendue::stress {

// The radiance at the centre of a cube with an edge of two metres, perpendicular to a face, under a sky of radiance one.
// `transmittance` is that of one metre, `source` the radiance of an infinitely deep medium, `index` that of the cube.
inline double radiance_in_a_cube(double transmittance, double source, double index) {
  const double reflected = std::pow((index - 1) / (index + 1), 2);
  const double arriving = (1 - reflected) * index * index;
  // Light that is reflected at a face crosses the whole cube before it meets the opposite one.
  const double crossing = transmittance * transmittance;
  const double after_crossing = (crossing * arriving + source * (1 - crossing)) / (1 - reflected * crossing);
  return source * (1 - transmittance) + transmittance * (arriving + reflected * after_crossing);
}

inline void camera_in_a_medium(TestContext& test) {
  struct Medium {
    const char* label;
    double absorption, scattering, source;  // per metre; radiance
    double transmittance;                   // of one metre; light that is scattered is not lost
  };
  const Camera camera = look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1e-4f);
  for (const Medium& m : {Medium{"absorbing", 1.5, 0, 0, std::exp(-1.5)}, Medium{"emitting", 1.5, 0, 2, std::exp(-1.5)},
                          Medium{"scattering", 0, 3, 0, 1}})
    for (const double index : {1.0, 1.5}) {
      // Scattering changes directions, and the face of a refracting cube does not reflect all directions alike.
      if (m.scattering > 0 && index > 1) continue;
      Material cube = scene::glass(static_cast<float>(index));
      cube.boundary_only = index == 1;
      cube.medium.absorption = Rgb(static_cast<float>(m.absorption));
      cube.medium.scattering = Rgb(static_cast<float>(m.scattering));
      cube.medium.emission = Rgb(static_cast<float>(m.source));
      scene::Scene scene = uniform_sky();
      scene::add(scene, scene::cube(1, false), cube);
      const auto d = test.document(std::move(scene), camera);
      for (const auto& method : unbiased_integrators()) {
        const auto& integrator = *integrator::find_integrator(method);
        if (m.scattering > 0 && !integrator.scattering_media) continue;
        if (m.source > 0 && !integrator.heterogeneous_media) continue;
        test.expect_mean(method, std::string(m.label) + (index > 1 ? ", in glass" : ", without a surface"),
                         test.mean(TestContext::with_method(d, method), 256),
                         radiance_in_a_cube(m.transmittance, m.source, index));
      }
    }
}

inline constexpr Case kCameraInAMedium{
    .name = "camera-in-a-medium",
    .kind = Kind::geometry,
    .theory =
        "Inside a medium a camera sees the source function of the medium and the attenuated sky; the "
        "boundary matters only if it refracts",
    .run = camera_in_a_medium};

}  // namespace etendue::stress
