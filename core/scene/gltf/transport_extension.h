// The glTF extension ETENDUE_transport: properties of light transport that glTF does not describe.
//                                                                              docs/ETENDUE_transport.schema.json
#pragma once
#include <string>
#include <string_view>

namespace etendue::scene::gltf {

inline constexpr const char* kTransport = "ETENDUE_transport";

// The value of the member `layering` of a material that selects Layering::energy_conserving.
inline constexpr const char* kEnergyConserving = "energy-conserving";

// The light parameters that KHR_lights_punctual has members for; ETENDUE_transport has the others.
inline constexpr const char* kPunctualParameters[] = {"intensity", "range", "inner-cone", "outer-cone"};

// The member of ETENDUE_transport for a light parameter: "two-sided" is "twoSided".
std::string member_name(std::string_view parameter);

}  // namespace etendue::scene::gltf
