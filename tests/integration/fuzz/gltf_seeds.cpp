#include "integration/fuzz/gltf_seeds.h"

#include "base/base64.h"
#include "image/image.h"
#include "integration/fuzz/target.h"
#include "unit/scene/gltf_document.h"

namespace etendue::fuzz {
namespace {

using nlohmann::json;
using test::Gltf;

std::string png_uri() {
  const std::vector<uint8_t> pixels{255, 0, 0, 0, 255, 0, 0, 0, 255, 90, 90, 90};
  const auto png = image::encode_png(2, 2, pixels);
  require(static_cast<bool>(png), "a seed cannot be encoded as PNG");
  return "data:image/png;base64," + base64(*png);
}

json materials() {
  return json::parse(R"([{
    "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.7, 0.6, 0.9], "metallicFactor": 0.3, "roughnessFactor": 0.4,
      "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform":
        {"offset": [0.1, 0.2], "rotation": 0.5, "scale": [2, 3], "texCoord": 0}}},
      "metallicRoughnessTexture": {"index": 0}},
    "normalTexture": {"index": 0, "scale": 0.5}, "occlusionTexture": {"index": 0, "strength": 0.5},
    "emissiveTexture": {"index": 0}, "emissiveFactor": [0.1, 0.2, 0.3], "alphaMode": "MASK", "alphaCutoff": 0.4,
    "doubleSided": true,
    "extensions": {
      "KHR_materials_emissive_strength": {"emissiveStrength": 3}, "KHR_materials_ior": {"ior": 1.4},
      "KHR_materials_transmission": {"transmissionFactor": 0.5, "transmissionTexture": {"index": 0}},
      "KHR_materials_volume": {"thicknessFactor": 0.1, "attenuationDistance": 0.5, "attenuationColor": [1, 0.9, 0.8]},
      "KHR_materials_specular": {"specularFactor": 0.7, "specularColorFactor": [1, 0.9, 0.8]},
      "KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": 1},
      "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.1},
      "KHR_materials_sheen": {"sheenColorFactor": [0.2, 0.2, 0.4], "sheenRoughnessFactor": 0.3},
      "KHR_materials_iridescence": {"iridescenceFactor": 0.5, "iridescenceIor": 1.3,
        "iridescenceThicknessMinimum": 100, "iridescenceThicknessMaximum": 400},
      "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.2,
        "diffuseTransmissionColorFactor": [1, 0.5, 0.5]}}},
    {"alphaMode": "BLEND", "extensions": {"KHR_materials_unlit": {}}},
    {"extensions": {"KHR_materials_pbrSpecularGlossiness":
      {"diffuseFactor": [0.5, 0.5, 0.5, 1], "specularFactor": [0.1, 0.1, 0.1], "glossinessFactor": 0.8}}}])");
}

void add_texture(Gltf& gltf) {
  gltf.root["images"] = json::array({{{"uri", png_uri()}, {"mimeType", "image/png"}}});
  gltf.root["samplers"] = json::array({{{"magFilter", 9728}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33648}}});
  gltf.root["textures"] = json::array({{{"source", 0}, {"sampler", 0}}});
}

void add_cameras_and_lights(Gltf& gltf) {
  gltf.root["cameras"] = json::parse(R"([
    {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "zfar": 100, "aspectRatio": 1.5}},
    {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "zfar": 10, "znear": 0.1}}])");
  gltf.root["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(R"([
    {"type": "point", "color": [1, 0.9, 0.8], "intensity": 10, "range": 50},
    {"type": "directional", "intensity": 3},
    {"type": "spot", "intensity": 20, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.5}}])");
  gltf.root["extensionsUsed"] = {"KHR_lights_punctual"};
}

json light_node(int light, const json& translation) {
  return {{"translation", translation}, {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}};
}

// A square with all of the materials' textures, seen by two cameras and lit by three lights.
Bytes surface() {
  Gltf gltf;
  gltf.square()["material"] = 0;
  json& copy = gltf.primitive(gltf.root["meshes"][0]["primitives"][0]["attributes"], 3);
  copy["material"] = 2;
  copy["mode"] = 5;
  gltf.root["materials"] = materials();
  add_texture(gltf);
  add_cameras_and_lights(gltf);
  gltf.root["nodes"] = {{{"mesh", 0}, {"children", {1, 2, 3, 4}}, {"scale", {1, 2, 1}}},
                        {{"camera", 0}, {"translation", {0.5, 0.5, 3}}},
                        light_node(0, {0, 0, 2}),
                        light_node(1, {0, 0, 1}),
                        light_node(2, {0.5, 0.5, 2})};
  return bytes_of(gltf.glb());
}

// A triangle with a skin and a morph target, both animated.
Bytes motion() {
  Gltf gltf;
  json& triangle = gltf.triangle();
  triangle["attributes"]["JOINTS_0"] =
      gltf.accessor(gltf.view(std::vector<uint8_t>{0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}), test::kUByte, "VEC4", 3);
  triangle["attributes"]["WEIGHTS_0"] = gltf.vec4(std::vector<Vec4>(3, Vec4(0.5f, 0.5f, 0, 0)));
  triangle["targets"] = {{{"POSITION", gltf.vec3(std::vector<Vec3>(3, Vec3(0, 0, 1)))}}};
  gltf.root["meshes"][0]["weights"] = {0.5};
  gltf.root["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", gltf.mat4(std::vector<Mat4>(2, Mat4(1)))}}};
  gltf.root["nodes"] = {
      {{"mesh", 0}, {"skin", 0}}, {{"children", {2}}, {"translation", {0, 0, 0.5}}}, {{"rotation", {0, 0, 0, 1}}}};
  gltf.root["scenes"][0]["nodes"] = {0, 1};
  const int times = gltf.floats({0, 0.5f, 1});
  gltf.root["animations"] = {{{"samplers",
                               {{{"input", times}, {"output", gltf.vec3({{0, 0, 0}, {0, 1, 0}, {1, 1, 0}})}},
                                {{"input", times}, {"output", gltf.floats({0, 1, 0})}, {"interpolation", "STEP"}},
                                {{"input", times},
                                 {"output", gltf.vec4(std::vector<Vec4>(9, Vec4(0, 0, 0, 1)))},
                                 {"interpolation", "CUBICSPLINE"}}}},
                              {"channels",
                               {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}},
                                {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}},
                                {{"sampler", 2}, {"target", {{"node", 2}, {"path", "rotation"}}}}}}}};
  return bytes_of(gltf.glb());
}

// Sparse and quantised accessors, instances and variants.
Bytes accessors() {
  Gltf gltf;
  const int positions = gltf.accessor(
      gltf.view(std::vector<int16_t>{0, 0, 0, 0, 100, 0, 0, 0, 0, 100, 0, 0}.data(), 24, 8), test::kShort, "VEC3", 3);
  const int places = gltf.view(std::vector<uint16_t>{1});
  const int values = gltf.view(std::vector<int16_t>{90, 10, 0, 0});
  gltf.root["accessors"][static_cast<size_t>(positions)]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", places}, {"componentType", test::kUShort}}},
      {"values", {{"bufferView", values}}}};
  json& primitive = gltf.primitive({{"POSITION", positions}});
  primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 0}, {"variants", {0}}}};
  gltf.root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}};
  gltf.root["materials"] = materials();
  gltf.root["materials"].erase(0);
  const json attributes = {{"TRANSLATION", gltf.vec3({{0, 0, 0}, {0, 0, 200}})},
                           {"ROTATION", gltf.vec4(std::vector<Vec4>(2, Vec4(0, 0, 0, 1)))}};
  gltf.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
  gltf.root["extensionsUsed"] = {"EXT_mesh_gpu_instancing", "KHR_mesh_quantization", "KHR_materials_variants"};
  return bytes_of(gltf.glb());
}

}  // namespace

std::vector<Bytes> gltf_seeds() { return {surface(), motion(), accessors()}; }

}  // namespace etendue::fuzz
