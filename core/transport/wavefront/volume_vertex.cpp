#include "transport/wavefront/volume_vertex.h"

namespace etendue::transport {

void set_volume_point(const Collision& collision, const Vec3& wo, scene::SurfacePoint& point) {
  static const scene::InstanceData instance;
  static const SurfaceMaterial material = [] {
    Material black;
    black.name = "medium";
    black.base_color = Rgb(0);
    return SurfaceMaterial(black, {});
  }();
  point = {};
  point.position = collision.position;
  point.ng = wo;
  point.shading.build(wo);
  point.instance = &instance;
  point.material = &material;
  point.in_volume = true;
}

}  // namespace etendue::transport
