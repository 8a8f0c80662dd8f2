// Section "camera".
#include "render/document_parameters.h"

template <>
struct etendue::Options<etendue::Projection> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"perspective", "Perspective"}, {"orthographic", "Orthographic"}}};
};

namespace etendue::render {
namespace {

const std::string kSection = "camera";

template <class Description, class Member>
DocumentParameter camera_parameter(const Description& description, Member Camera::*member) {
  return make_parameter(kSection, description, [member](Document& d, Member v) { d.camera.*member = v; });
}

// The columns of the camera's matrix: x to the right, y up, z backwards, and the position.
void add_matrix(DocumentParameters& list, const Camera& camera) {
  struct Column {
    const char* names[3];
    const char *label, *doc, *unit;
    float largest;
  };
  static constexpr Column kColumns[4] = {
      {{"right.x", "right.y", "right.z"}, "Right", "Unit vector to the right of the camera", "", 1.001f},
      {{"up.x", "up.y", "up.z"}, "Up", "Unit vector upwards from the camera", "", 1.001f},
      {{"back.x", "back.y", "back.z"}, "Back", "Unit vector opposite to the view direction", "", 1.001f},
      {{"eye.x", "eye.y", "eye.z"}, "Position", "Position of the camera", "m", kLargestLength}};
  for (int i = 0; i < 4; ++i) {
    const Column& column = kColumns[i];
    add_triple(list, kSection,
               {.names = {column.names[0], column.names[1], column.names[2]},
                .label = column.label,
                .value = Vec3(camera.to_world[i]),
                .range = {-column.largest, column.largest},
                .doc = column.doc,
                .unit = column.unit},
               [i](Document& d, int c, float v) { d.camera.to_world[i][c] = v; });
  }
}

}  // namespace

DocumentParameters camera_parameters(const Document& document) {
  const Camera& c = document.camera;
  DocumentParameters list{
      make_parameter(kSection,
                     Number<float>{"exposure",
                                   "Exposure",
                                   document.display.exposure,
                                   {-30, 30},
                                   "Exposure compensation; each step doubles the displayed brightness",
                                   "EV"},
                     [](Document& d, float v) { d.display.exposure = v; }),
      camera_parameter(
          Choice<Projection>{"projection", "Projection", c.projection, "Perspective or orthographic projection"},
          &Camera::projection),
      camera_parameter(
          Number<float>{"yfov", "Field of view", c.yfov, {1e-3f, 3.1f}, "Vertical field of view (perspective)", "rad"},
          &Camera::yfov),
      camera_parameter(Number<float>{"ymag",
                                     "Half height",
                                     c.ymag,
                                     {1e-9f, kLargestLength},
                                     "Half of the visible height (orthographic)",
                                     "m",
                                     Scale::logarithmic},
                       &Camera::ymag),
      camera_parameter(Number<float>{"near-clip",
                                     "Near plane",
                                     c.near_clip,
                                     {0, kLargestLength},
                                     "Distance along the view direction in front of which nothing is visible",
                                     "m",
                                     Scale::logarithmic},
                       &Camera::near_clip),
      camera_parameter(Number<float>{"lens-radius",
                                     "Lens radius",
                                     c.lens_radius,
                                     {0, 1e6f},
                                     "Larger lenses have a shallower depth of field; 0: pinhole",
                                     "m",
                                     Scale::logarithmic},
                       &Camera::lens_radius),
      camera_parameter(Number<float>{"focus-distance",
                                     "Focus distance",
                                     c.focus_distance,
                                     {1e-6f, kLargestLength},
                                     "Distance along the view direction at which objects are in focus",
                                     "m",
                                     Scale::logarithmic},
                       &Camera::focus_distance),
      camera_parameter(Number<float>{"shutter",
                                     "Shutter time",
                                     c.shutter,
                                     {0, 1e4f},
                                     "Exposure time, beginning at the scene's time. Longer blurs moving objects more; "
                                     "0: no motion blur",
                                     "s",
                                     Scale::logarithmic},
                       &Camera::shutter)};
  add_matrix(list, c);
  return list;
}

}  // namespace etendue::render
