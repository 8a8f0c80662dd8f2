// Vectors and rotations: three number fields in one line.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/parameter.h"

namespace etendue::render {
struct DocumentParameter;
}

namespace etendue::viewer {

struct AppState;

// The parameters NAME.x, NAME.y and NAME.z. `draw_first` draws a square item before the fields.
void vector_widget(AppState& state, std::span<const render::DocumentParameter> xyz,
                   const std::function<void()>& draw_first = {});

// The quaternion NAME.x, .y, .z, .w as three angles in degrees. Scripts use them as SECTION.euler.x, .y and .z.
void rotation_widget(AppState& state, std::span<const render::DocumentParameter> xyzw);

// The descriptions of the three angles.
std::vector<ParameterInfo> euler_parameters(const std::string& section, const Vec3& degrees);

}  // namespace etendue::viewer
