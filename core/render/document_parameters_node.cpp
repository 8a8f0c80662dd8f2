// Sections "node.N": visibility and transform of a scene node.
#include "render/document_parameters.h"
#include "scene/rotation.h"

namespace etendue::render {
namespace {

void add_translation(DocumentParameters& list, const std::string& section, size_t index,
                     const scene::Transform& transform) {
  add_triple(list, section,
             {.names = {"translation.x", "translation.y", "translation.z"},
              .label = "Translation",
              .value = transform.matrix ? Vec3((*transform.matrix)[3]) : transform.translation,
              .range = {-kLargestLength, kLargestLength},
              .doc = "Position relative to the parent node",
              .unit = "m"},
             [index](Document& d, int c, float v) {
               edit_scene(d, [&](scene::Scene& s) {
                 auto& t = s.nodes[index].transform;
                 if (t.matrix)
                   (*t.matrix)[3][c] = v;
                 else
                   t.translation[c] = v;
               });
             });
}

// Rotation and scale, if the transform can be decomposed into these parts. The first edit replaces the matrix of a
// transform by its parts.
void add_rotation_and_scale(DocumentParameters& list, const std::string& section, size_t index,
                            const scene::Transform& transform) {
  const auto parts = scene::decompose(transform);
  if (!parts) return;
  const auto edit = [index](Document& d, auto change) {
    edit_scene(d, [&](scene::Scene& s) {
      auto& t = s.nodes[index].transform;
      if (const auto decomposed = scene::decompose(t)) {
        t = *decomposed;
        change(t);
      }
    });
  };
  static constexpr const char* kRotation[4] = {"rotation.x", "rotation.y", "rotation.z", "rotation.w"};
  for (int c = 0; c < 4; ++c)
    list.push_back(make_parameter(section,
                                  Number<float>{kRotation[c],
                                                "Rotation",
                                                parts->rotation[c],
                                                {-1.001f, 1.001f},
                                                "Rotation relative to the parent node, as a quaternion of any length"},
                                  [edit, c](Document& d, float v) { edit(d, [&](auto& t) { t.rotation[c] = v; }); }));
  add_triple(list, section,
             {.names = {"scale.x", "scale.y", "scale.z"},
              .label = "Scale",
              .value = parts->scale,
              .range = {-1e6f, 1e6f},
              .doc = "Scale relative to the parent node; negative values mirror, 0 hides the object"},
             [edit](Document& d, int c, float v) { edit(d, [&](auto& t) { t.scale[c] = v; }); });
}

void add_portal(DocumentParameters& list, const std::string& section, size_t index, Vec2 size) {
  constexpr const char* kNames[] = {"portal.width", "portal.height"};
  constexpr const char* kLabels[] = {"Portal width", "Portal height"};
  constexpr const char* kDocs[] = {
      "Width along x of a rectangle at this node that guides sampling of the environment; receivers on its -z side "
      "send half of their shadow rays to the environment through it. It never changes the expected image. 0: no portal",
      "Height of the portal along y"};
  for (int c = 0; c < 2; ++c)
    list.push_back(make_parameter(
        section, Number<float>{kNames[c], kLabels[c], size[c], {0, kLargestLength}, kDocs[c], "m", Scale::logarithmic},
        [index, c](Document& d, float v) { edit_scene(d, [&](scene::Scene& s) { s.nodes[index].portal[c] = v; }); }));
}

}  // namespace

DocumentParameters node_parameters(const Document& document, size_t index, const std::string& section) {
  const scene::Node& n = document.scene->nodes[index];
  DocumentParameters list{make_parameter(
      section, Toggle{"visible", "Visible", n.visible, "Hidden objects are excluded from the scene"},
      [index](Document& d, bool v) { edit_scene(d, [&](scene::Scene& s) { s.nodes[index].visible = v; }); })};
  add_translation(list, section, index, n.transform);
  add_rotation_and_scale(list, section, index, n.transform);
  add_portal(list, section, index, n.portal);
  return list;
}

}  // namespace etendue::render
