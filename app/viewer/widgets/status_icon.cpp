#include "viewer/widgets/status_icon.h"

#include <imgui.h>

#include "render/reliability.h"
#include "viewer/widgets/ui_context.h"

namespace etendue::viewer {

void status_icon(const UiContext& ui, Status status) {
  const float height = ImGui::GetTextLineHeight();
  const float r = height * 0.36f;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 c{corner.x + height / 2, corner.y + height / 2};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  // Colours from the palette of Okabe and Ito.
  switch (status) {
    case Status::unknown:
      draw->AddCircle(c, r, ImGui::GetColorU32(ui.theme.secondary_text), 0, 2);
      break;
    case Status::good:
      draw->AddCircleFilled(c, r, IM_COL32(0, 158, 115, 255));
      break;
    case Status::doubtful:
      draw->AddTriangleFilled({c.x, c.y - r * 1.1f}, {c.x + r * 1.1f, c.y + r}, {c.x - r * 1.1f, c.y + r},
                              IM_COL32(230, 159, 0, 255));
      break;
    case Status::bad:
      draw->AddRectFilled({c.x - r, c.y - r}, {c.x + r, c.y + r}, IM_COL32(213, 94, 0, 255));
      break;
  }
  ImGui::Dummy({height, height});
}

Status status_of(render::Verdict verdict) {
  switch (verdict) {
    case render::Verdict::healthy:
      return Status::good;
    case render::Verdict::doubtful:
      return Status::doubtful;
    case render::Verdict::unreliable:
      return Status::bad;
    case render::Verdict::unknown:
      break;
  }
  return Status::unknown;
}

const char* reliability_label(render::Verdict verdict) {
  constexpr const char* kLabels[] = {"unknown", "reliable", "uncertain", "unreliable"};
  return kLabels[static_cast<size_t>(status_of(verdict))];
}

}  // namespace etendue::viewer
