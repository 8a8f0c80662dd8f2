// The glTF extension ETENDUE_transport: properties of light transport that glTF does not describe.
//                                                                              docs/ETENDUE_transport.schema.json
#pragma once

namespace etendue::scene::gltf {

inline constexpr const char* kTransport = "ETENDUE_transport";

// The extension's names of the enumerators of LightType, SpotProfile and the quantity of a light, in their order.
inline constexpr const char* kLightTypes[] = {"point", "spot", "directional", "quad", "disk", "sphere", "ambient"};
inline constexpr const char* kSpotProfiles[] = {"squared", "smoothstep", "quartic", "cosine"};
inline constexpr const char* kQuantities[] = {"radiance", "power"};

}  // namespace etendue::scene::gltf
