#include "viewer/widgets/number_widget.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace etendue::viewer {
namespace {

// A slider over more than this is no help: its pixels would be too far apart.
constexpr double kWidestLinear = 1000, kWidestLogarithmic = 1e7;

// Distances of this size stand for ones without end.
constexpr double kEndless = 1e9;

bool wants_slider(const ParameterInfo& info) {
  if (info.logarithmic) return info.min > 0 && info.max / info.min <= kWidestLogarithmic;
  return info.max - info.min <= kWidestLinear;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

// Of limits, whose descriptions say what nought means.
bool means_no_limit(const std::string& doc) {
  return doc.find("0 goes on") != std::string::npos || doc.find("0 no limit") != std::string::npos;
}

// Digits that tell neighbouring values apart.
std::string format_of(const ParameterInfo& info, double value) {
  if (info.logarithmic && value >= kEndless) return "unlimited";
  std::string format = info.type == ParameterType::integer ? "%lld" : "%.4g";
  if (info.type == ParameterType::number && !info.logarithmic && info.max - info.min <= 10 && std::abs(value) < 1e3)
    format = "%.3f";
  if (!info.unit.empty()) format += " " + escaped(info.unit);
  if (value == 0 && means_no_limit(info.doc)) format += " (no limit)";
  return format;
}

// Shows the value as text to edit, in the place of the slider or drag field with this ID, which then keeps showing text
// until editing ends.
bool text_input(ImGuiID id, ImGuiDataType type, void* value, const char* format, const void* least, const void* most) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImRect box(corner, {corner.x + ImGui::CalcItemWidth(), corner.y + ImGui::GetFrameHeight()});
  ImGui::ItemSize(box, ImGui::GetStyle().FramePadding.y);
  return ImGui::ItemAdd(box, id, &box, ImGuiItemFlags_Inputable) &&
         ImGui::TempInputScalar(box, id, "##", type, value, format, least, most);
}

// Angles are radians everywhere but on screen.
constexpr double kDegrees = 180 / std::numbers::pi;

ParameterInfo in_degrees(ParameterInfo info) {
  info.unit = "\u00b0";
  info.min *= kDegrees, info.max *= kDegrees;
  if (auto* value = std::get_if<double>(&info.default_value)) *value *= kDegrees;
  return info;
}

NumberEdit angle_widget(const ParameterInfo& info) {
  NumberEdit edit = number_widget(in_degrees(info));
  if (edit.value)
    if (auto* value = std::get_if<double>(&*edit.value)) *value /= kDegrees;
  return edit;
}

// As much of the text as has room, with dots for the rest.
std::string shortened(std::string text, float room) {
  if (ImGui::CalcTextSize(text.c_str()).x <= room) return text;
  while (!text.empty() && ImGui::CalcTextSize((text + "...").c_str()).x > room) text.pop_back();
  return text + "...";
}

}  // namespace

float label_width() { return std::floor(ImGui::GetFontSize() * 8.9f); }

void label_column(const std::string& label) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(shortened(label, label_width() - ImGui::GetFontSize() * 0.4f).c_str());
  ImGui::SameLine(label_width());
  ImGui::SetNextItemWidth(-1);
}

std::string range_text(const ParameterInfo& info) {
  if (info.unit == "rad") return range_text(in_degrees(info));
  char text[96];
  std::snprintf(text, sizeof text, "%.4g to %.4g", info.min, info.max);
  return info.unit.empty() ? text : std::string(text) + " " + info.unit;
}

NumberEdit number_widget(const ParameterInfo& info, float drag) {
  if (info.unit == "rad") return angle_widget(info);
  NumberEdit edit;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 opposite{corner.x + ImGui::CalcItemWidth(), corner.y + ImGui::GetFrameHeight()};
  const bool over = ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(corner, opposite);
  const bool typing = over && ImGui::IsMouseDoubleClicked(0);
  edit.reset = over && ImGui::GetIO().KeyCtrl && ImGui::IsMouseClicked(0) && !typing;
  edit.starts_typing = typing;

  const bool whole = info.type == ParameterType::integer;
  int64_t i = 0;
  double d = 0;
  if (const auto* integer = std::get_if<int64_t>(&info.default_value)) i = *integer, d = static_cast<double>(i);
  if (const auto* number = std::get_if<double>(&info.default_value)) d = *number;
  const auto i_min = static_cast<int64_t>(info.min), i_max = static_cast<int64_t>(info.max);
  const std::string format = format_of(info, d);
  const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (info.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  const ImGuiDataType type = whole ? ImGuiDataType_S64 : ImGuiDataType_Double;
  void* value = whole ? static_cast<void*>(&i) : &d;
  const void* least = whole ? static_cast<const void*>(&i_min) : &info.min;
  const void* most = whole ? static_cast<const void*>(&i_max) : &info.max;

  // ImGui opens text input on Ctrl+click. Here a double click does, and Ctrl+click resets: the widget ignores that
  // click.
  ImGui::PushItemFlag(ImGuiItemFlags_Disabled, edit.reset);
  bool changed = false;
  if (typing) {
    changed = text_input(ImGui::GetID("##"), type, value, format.c_str(), least, most);
  } else if (drag <= 0 && wants_slider(info)) {
    changed = ImGui::SliderScalar("##", type, value, least, most, format.c_str(), flags);
  } else {
    // Dragging changes a number by its own size, so that it can be small or large.
    const float speed = drag > 0 ? drag
                        : whole  ? std::max(0.1f, 0.01f * std::abs(static_cast<float>(i)))
                                 : std::max(0.002f, 0.005f * std::abs(static_cast<float>(d)));
    changed = ImGui::DragScalar("##", type, value, speed, least, most, format.c_str(), ImGuiSliderFlags_AlwaysClamp);
  }
  ImGui::PopItemFlag();
  edit.ended = ImGui::IsItemDeactivated();
  if (changed && !edit.reset)
    edit.value = whole ? Value(std::clamp(i, i_min, i_max)) : Value(std::clamp(d, info.min, info.max));
  return edit;
}

}  // namespace etendue::viewer
