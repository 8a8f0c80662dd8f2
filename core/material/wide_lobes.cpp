#include "material/wide_lobes.h"

namespace etendue {

bool is_directed(const WideLobes<Rgb>& lobes) {
  const auto turned = [](const Vec3& w, float phi) {
    return Vec3(std::cos(phi) * w.x - std::sin(phi) * w.y, std::sin(phi) * w.x + std::cos(phi) * w.y, w.z);
  };
  const Vec3 o = glm::normalize(Vec3(0.5f, 0.1f, 0.7f));
  for (const Vec3& to : {Vec3(-0.5f, -0.1f, 0.7f), Vec3(-0.3f, -0.3f, 0.7f), Vec3(0.4f, 0.3f, 0.5f)})
    for (const float phi : {0.7f, 1.6f, 3.5f}) {
      const Vec3 i = glm::normalize(to);
      const float straight = average(lobes.eval(o, i, Transport::radiance));
      const float after = average(lobes.eval(turned(o, phi), turned(i, phi), Transport::radiance));
      if (std::abs(straight - after) > 1e-2f * std::max(straight, after) + 1e-4f) return true;
    }
  return false;
}

}  // namespace etendue
