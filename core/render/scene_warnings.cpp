#include "render/scene_warnings.h"

#include <algorithm>

#include "integrator/integrator_info.h"
#include "render/default_light.h"

namespace etendue::render {

std::vector<std::string> current_warnings(const Document& document) {
  std::vector<std::string> warnings = document.scene->warnings;
  if (document.scene->environment.file != "studio") std::erase(warnings, kNoLightWarning);
  const bool has_portals = std::ranges::any_of(
      document.scene->nodes, [](const scene::Node& node) { return node.portal.x > 0 && node.portal.y > 0; });
  const integrator::IntegratorInfo* info = integrator::find_integrator(document.method.integrator);
  if (has_portals && info && info->ignores_portals)
    warnings.push_back("the integrator '" + info->name +
                       "' ignores environment portals, so that light through openings is noisier: use path or "
                       "distribution");
  return warnings;
}

}  // namespace etendue::render
