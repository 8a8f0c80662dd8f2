#include "viewer/widgets/number_widget.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

// With a wider range, the steps of a slider would be too coarse: max - min on a linear scale, max / min on a
// logarithmic one.
constexpr double kMaxSliderRange = 1000;
constexpr double kMaxSliderRatio = 1e7;

// Distances of this size are shown as unlimited.
constexpr double kUnlimited = 1e9;

bool is_slider(const ParameterInfo& info) {
  if (info.logarithmic) return info.min > 0 && info.max / info.min <= kMaxSliderRatio;
  return info.max - info.min <= kMaxSliderRange;
}

// Escapes a text for printf.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

// What 0 stands for according to the description of a parameter; empty if it is a number like others.
std::string meaning_of_zero(const std::string& doc) {
  const auto contains = [&](const char* text) { return doc.find(text) != std::string::npos; };
  if (contains("no limit") || contains("unlimited")) return " (no limit)";
  return contains("0: one per hardware thread") ? " (automatic)" : "";
}

// A printf format with enough digits for the range of the parameter.
std::string format_of(const ParameterInfo& info, double value) {
  if (info.logarithmic && info.unit == "m" && value >= kUnlimited) return "unlimited";
  std::string format = info.type == ParameterType::integer ? "%lld" : "%.4g";
  if (info.type == ParameterType::number && !info.logarithmic && info.max - info.min <= 10 && std::abs(value) < 1e3)
    format = "%.3f";
  // Shorter than with an exponent.
  if (info.type == ParameterType::number && std::abs(value) >= 1e4 && std::abs(value) < 1e6) format = "%.0f";
  if (!info.unit.empty()) format += " " + escaped(info.unit);
  if (value == 0) format += meaning_of_zero(info.doc);
  return format;
}

// Position of a value on its slider, from 0 to 1.
float slider_position(const ParameterInfo& info, double value) {
  const double position = info.logarithmic ? std::log(value / info.min) / std::log(info.max / info.min)
                                           : (value - info.min) / (info.max - info.min);
  return static_cast<float>(std::clamp(position, 0.0, 1.0));
}

// The frame of a slider, filled up to the position of its value, so that no grab covers the number in the middle.
void draw_filled_frame(ImVec2 corner, ImVec2 opposite, float position, bool is_hovered, bool is_active) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float rounding = ImGui::GetStyle().FrameRounding;
  const ImGuiCol frame = is_active ? ImGuiCol_FrameBgActive : is_hovered ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg;
  list.AddRectFilled(corner, opposite, ImGui::GetColorU32(frame), rounding);
  const ImVec2 end{std::round(corner.x + (opposite.x - corner.x) * position), opposite.y};
  if (end.x <= corner.x) return;
  list.PushClipRect(corner, end, true);  // keeps the rounded corners of the frame
  list.AddRectFilled(corner, opposite, ImGui::GetColorU32(ImGuiCol_SliderGrab), rounding);
  list.PopClipRect();
}

// A slider whose frame is filled instead of having a grab.
bool filled_slider(const ParameterInfo& info, double shown, ImGuiDataType type, void* value, const void* min,
                   const void* max, const char* format, bool is_hovered) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 opposite{corner.x + ImGui::CalcItemWidth(), corner.y + ImGui::GetFrameHeight()};
  const bool is_active = ImGui::GetActiveID() == ImGui::GetID("##");
  const bool is_typing = is_active && ImGui::TempInputIsActive(ImGui::GetID("##"));
  if (!is_typing) {
    draw_filled_frame(corner, opposite, slider_position(info, shown), is_hovered, is_active);
    const ImVec4 transparent{0, 0, 0, 0};
    for (const ImGuiCol color : {ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive, ImGuiCol_SliderGrab,
                                 ImGuiCol_SliderGrabActive})
      ImGui::PushStyleColor(color, transparent);
  }
  ImGui::PushStyleVar(ImGuiStyleVar_GrabMinSize, 1);
  const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (info.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  const bool changed = ImGui::SliderScalar("##", type, value, min, max, format, flags);
  ImGui::PopStyleVar();
  if (!is_typing) ImGui::PopStyleColor(5);
  return changed;
}

// Opens text input for the slider or drag field with this ID. The widget then shows text input until editing ends.
bool text_input(ImGuiID id, ImGuiDataType type, void* value, const char* format, const void* min, const void* max) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImRect box(corner, {corner.x + ImGui::CalcItemWidth(), corner.y + ImGui::GetFrameHeight()});
  ImGui::ItemSize(box, ImGui::GetStyle().FramePadding.y);
  return ImGui::ItemAdd(box, id, &box, ImGuiItemFlags_Inputable) &&
         ImGui::TempInputScalar(box, id, "##", type, value, format, min, max);
}

// Angles are in radians and errors are fractions everywhere except on screen.
struct ScreenUnit {
  const char *unit, *shown;
  double factor;
};
constexpr ScreenUnit kScreenUnits[] = {{"rad", "\u00b0", 180 / std::numbers::pi}, {"fraction", "%", 100}};

// Null for units that are shown as they are.
const ScreenUnit* screen_unit(const ParameterInfo& info) {
  const auto* const found = std::ranges::find(kScreenUnits, info.unit, &ScreenUnit::unit);
  return found == std::end(kScreenUnits) ? nullptr : found;
}

ParameterInfo converted(ParameterInfo info, const ScreenUnit& unit) {
  info.unit = unit.shown;
  info.min *= unit.factor;
  info.max *= unit.factor;
  if (auto* value = std::get_if<double>(&info.default_value)) *value *= unit.factor;
  return info;
}

WidgetEdit converted_widget(const ParameterInfo& info, const ScreenUnit& unit) {
  WidgetEdit edit = number_widget(converted(info, unit));
  if (edit.value)
    if (auto* value = std::get_if<double>(&*edit.value)) *value /= unit.factor;
  return edit;
}

// The value of a widget before the last press of the button on it. The first click of a double click moves a slider; the
// text input starts from the value before.
struct BeforePress {
  ImGuiID widget = 0;
  Value value = false;
};

// Between a label and its widget, in font sizes.
constexpr float kLabelGap = 0.4f;
// The largest share of the line that a label takes from its widget.
constexpr float kLabelShare = 0.58f;

// The end of a label with the gap behind it, from the left border of the window or of the table column, as SameLine
// counts.
float label_end(float text_width) {
  return std::ceil(ImGui::GetStyle().WindowPadding.x + text_width + kLabelGap * ImGui::GetFontSize());
}

}  // namespace

float label_width() { return std::floor(ImGui::GetFontSize() * 8.9f); }

void continue_after_label(float text_width) { ImGui::SameLine(std::max(label_width(), label_end(text_width))); }

float label_column(const std::string& label, float least_width) {
  constexpr float kMargin = 1;  // pixels at the right end of the line
  const float left = ImGui::GetCursorPosX(), room = ImGui::GetContentRegionAvail().x, right = left + room - kMargin;
  const float text_width = ImGui::CalcTextSize(label.c_str()).x, text_end = label_end(text_width);
  const float longest_label = std::max(label_width(), room * kLabelShare) - kLabelGap * ImGui::GetFontSize();
  const bool is_beside = text_width <= longest_label && text_end + least_width <= right;
  // The item begins at the end of the column of labels, or before it if it is wide.
  const float start = std::max(is_beside ? text_end : left, std::min(label_width(), std::floor(right - least_width)));
  if (is_beside) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label.c_str());
    ImGui::SameLine(start);
  } else {
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(label.c_str());
    ImGui::PopTextWrapPos();
    ImGui::SetCursorPosX(start);
  }
  ImGui::SetNextItemWidth(-kMargin);
  return ImGui::GetItemRectSize().x > room ? 0 : right - left;
}

std::string number_label(const ParameterInfo& info) {
  if (const ScreenUnit* unit = screen_unit(info)) return number_label(converted(info, *unit));
  const auto* integer = std::get_if<int64_t>(&info.default_value);
  const double value = integer ? static_cast<double>(*integer) : std::get<double>(info.default_value);
  const std::string format = format_of(info, value);
  char text[128];
  if (integer)
    ImGui::DataTypeFormatString(text, IM_ARRAYSIZE(text), ImGuiDataType_S64, integer, format.c_str());
  else
    ImGui::DataTypeFormatString(text, IM_ARRAYSIZE(text), ImGuiDataType_Double, &value, format.c_str());
  return text;
}

std::string range_text(const ParameterInfo& info) {
  if (const ScreenUnit* unit = screen_unit(info)) return range_text(converted(info, *unit));
  const std::string range = formatted("%.7g to %.7g", info.min, info.max);
  return info.unit.empty() ? range : range + " " + info.unit;
}

WidgetEdit number_widget(const ParameterInfo& info, float drag_speed) {
  if (const ScreenUnit* unit = screen_unit(info)) return converted_widget(info, *unit);
  WidgetEdit edit;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 opposite{corner.x + ImGui::CalcItemWidth(), corner.y + ImGui::GetFrameHeight()};
  const bool enabled = !(ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled);
  const bool hovered = enabled && ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(corner, opposite);
  const bool starts_typing = hovered && ImGui::IsMouseDoubleClicked(0);
  edit.reset = hovered && ImGui::GetIO().KeyCtrl && ImGui::IsMouseClicked(0) && !starts_typing;
  edit.starts_typing = starts_typing;
  edit.pressed = hovered && ImGui::IsMouseClicked(0) && !starts_typing;

  const ImGuiID id = ImGui::GetID("##");
  static BeforePress before_press;
  if (edit.pressed) before_press = {id, info.default_value};
  const Value& shown = starts_typing && before_press.widget == id ? before_press.value : info.default_value;
  const bool is_integer = info.type == ParameterType::integer;
  int64_t i = 0;
  double d = 0;
  if (const auto* integer = std::get_if<int64_t>(&shown)) {
    i = *integer;
    d = static_cast<double>(i);
  }
  if (const auto* number = std::get_if<double>(&shown)) d = *number;
  const auto i_min = static_cast<int64_t>(info.min);
  const auto i_max = static_cast<int64_t>(info.max);
  const std::string format = format_of(info, d);
  const ImGuiDataType type = is_integer ? ImGuiDataType_S64 : ImGuiDataType_Double;
  void* value = is_integer ? static_cast<void*>(&i) : &d;
  const void* min = is_integer ? static_cast<const void*>(&i_min) : &info.min;
  const void* max = is_integer ? static_cast<const void*>(&i_max) : &info.max;

  // Dear ImGui opens text input on Ctrl+click. Here a double click does, and Ctrl+click resets, so the widget is
  // disabled for that click.
  ImGui::PushItemFlag(ImGuiItemFlags_Disabled, edit.reset || !enabled);
  bool changed = false;
  if (starts_typing) {
    changed = text_input(id, type, value, format.c_str(), min, max);
  } else if (drag_speed <= 0 && is_slider(info)) {
    changed = filled_slider(info, d, type, value, min, max, format.c_str(), hovered);
  } else {
    // The speed is proportional to the value, which suits small and large values.
    const float speed = drag_speed > 0 ? drag_speed
                        : is_integer   ? std::max(0.1f, 0.01f * std::abs(static_cast<float>(i)))
                                       : std::max(0.002f, 0.005f * std::abs(static_cast<float>(d)));
    changed = ImGui::DragScalar("##", type, value, speed, min, max, format.c_str(), ImGuiSliderFlags_AlwaysClamp);
  }
  ImGui::PopItemFlag();
  edit.ended = ImGui::IsItemDeactivated();
  if (!changed || edit.reset) return edit;
  if (is_integer)
    edit.value = std::clamp(i, i_min, i_max);
  else
    edit.value = std::clamp(d, info.min, info.max);
  return edit;
}

}  // namespace etendue::viewer
