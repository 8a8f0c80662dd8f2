// Audits of the light transport of a document: where the light of the scene goes, and where it matters for the camera.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "image/image.h"
#include "render/document.h"
#include "scene/forward.h"

namespace etendue::render {

// A mean over light paths and its standard error.
struct Measured {
  double value = 0, standard_error = 0;
};

// Luminous flux, lm.
struct ObjectEnergy {
  std::string name;
  uint32_t node = 0;
  Measured emitted, received, absorbed;
  // Scattered over received flux in the channel where it is largest.
  double largest_albedo = 0;
  bool creates_energy = false;  // it scatters more than it receives, by more than four standard errors
};

struct EnergyAudit {
  std::vector<ObjectEnergy> objects;                   // that emit or receive light, in the order of the nodes
  Measured emitted;                                    // by everything
  Measured by_media, by_environment, by_point_lights;  // parts of it
  Measured absorbed;                                   // by objects
  Measured absorbed_by_media, escaped, beyond_range;
  Measured missing;  // emitted - absorbed - escaped: 0 in expectation unless light stays in the scene
  uint64_t paths = 0;
  std::vector<std::string> warnings;
};

// Traces light paths from all emitters. The environment emits through the disks around the scene that light paths start
// on, most of whose light misses the objects and escapes. An input error if light paths do not support the scene or
// nothing emits.
Result<EnergyAudit> audit_energy(
    const Document& document, std::shared_ptr<const scene::CompiledScene> scene, uint64_t paths, int threads,
    const std::function<bool()>& continues = [] { return true; });

struct ObjectImportance {
  std::string name;
  uint32_t node = 0;
  Measured importance;  // mean radiance of the image if the object emitted unit radiance
};

struct ImportanceAudit {
  std::vector<ObjectImportance> objects;  // the largest first
  image::Layer picture;                   // w in 1/m^2 (integrator/audit/importance.h), one number per pixel
};

// The importance of the places of a scene for the camera of the document, seen by `view`. `samples` is the number of
// camera paths per pixel. `radius` of the density in metres; 0: chosen by the size of the scene.
Result<ImportanceAudit> audit_importance(
    const Document& document, std::shared_ptr<const scene::CompiledScene> scene, const Camera& view, uint32_t samples,
    float radius, int threads, const std::function<bool()>& continues = [] { return true; });

}  // namespace etendue::render
