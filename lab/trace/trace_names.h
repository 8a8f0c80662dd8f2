// Names of what the vertices of a traced path lie on, and of the values of a trace.
#pragma once
#include <string>
#include <vector>

#include "render/pixel_trace.h"

namespace etendue::trace {

// "Floor", or "node 3" for a node without a name.
std::string node_name(const scene::CompiledScene& scene, uint32_t node);
std::string material_name(const scene::CompiledScene& scene, const scene::SurfacePoint& point);
// The medium on one side of a surface: "vacuum", "atmosphere", or the name of the solid.
std::string medium_name(const scene::CompiledScene& scene, const scene::Solid* solid);
// The node of a surface, or the medium in which the point lies.
std::string place_name(const scene::CompiledScene& scene, const scene::SurfacePoint& point);
std::string light_name(const scene::CompiledScene& scene, const LightSample& sample);

// The types of the lobes at a vertex: "diffuse", "glossy", "specular", "volume".
std::vector<std::string> lobe_names(const transport::RecordedVertex& vertex);
// "diffuse reflection", "specular transmission"
std::string scattering_name(const LobeSample<Rgb>& sample);
// Why a path ends at this BSDF sample; empty if it continues.
std::string end_reason(const transport::RecordedScattering& scattering);
// Why a path ends at a vertex without BSDF samples.
inline constexpr const char* kNoScattering = "the integrator takes no BSDF sample here";

}  // namespace etendue::trace
