#include "viewer/widgets/status_icon.h"

#include <imgui.h>

namespace etendue::viewer {

void traffic_light(const Workbench& w, render::Verdict verdict) {
  const float height = ImGui::GetTextLineHeight(), r = height * 0.36f;
  const ImVec2 corner = ImGui::GetCursorScreenPos(), c{corner.x + height / 2, corner.y + height / 2};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  // Okabe & Ito's palette: told apart without colour vision too.
  switch (verdict) {
    case render::Verdict::unknown:
      draw->AddCircle(c, r, ImGui::GetColorU32(w.theme.quiet), 0, 2);
      break;
    case render::Verdict::healthy:
      draw->AddCircleFilled(c, r, IM_COL32(0, 158, 115, 255));
      break;
    case render::Verdict::doubtful:
      draw->AddTriangleFilled({c.x, c.y - r * 1.1f}, {c.x + r * 1.1f, c.y + r}, {c.x - r * 1.1f, c.y + r},
                              IM_COL32(230, 159, 0, 255));
      break;
    case render::Verdict::unreliable:
      draw->AddRectFilled({c.x - r, c.y - r}, {c.x + r, c.y + r}, IM_COL32(213, 94, 0, 255));
      break;
  }
  ImGui::Dummy({height, height});
}

}  // namespace etendue::viewer
