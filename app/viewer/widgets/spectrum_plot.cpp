#include "viewer/widgets/spectrum_plot.h"

#include <algorithm>
#include <cmath>

#include "spectrum/observer.h"
#include "viewer/widgets/plot.h"
#include "viewer/widgets/ui_context.h"

namespace etendue::viewer {
namespace {

// The hue of a wavelength, without the components outside the gamut.
ImU32 color_of(double wavelength) {
  const auto rgb = rgb_of(observer_at(wavelength));
  double bytes[3];
  for (size_t c = 0; c < 3; ++c) bytes[c] = 255 * std::pow(std::clamp(rgb[c], 0.0, 1.0), 1 / 2.2);
  return IM_COL32(static_cast<int>(bytes[0]), static_cast<int>(bytes[1]), static_cast<int>(bytes[2]), 150);
}

}  // namespace

Wavelengths only_wavelength(double wavelength) {
  Wavelengths w;
  w.nm.fill(static_cast<float>(wavelength));
  return w;
}

double largest_value(const SpectrumFunction& value) {
  double largest = 0;
  for (size_t i = 0; i < kWavelengths; ++i) largest = std::max(largest, value(table_wavelength(i)));
  return largest;
}

Plot draw_spectrum_plot(const UiContext& ui, const Placement& frame, const char* title, double high,
                        const SpectrumFunction& value) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const Plot plot(ui, draw, frame, title, {.low = kFirstWavelength, .high = kLastWavelength}, {.low = 0, .high = high});
  plot.draw_axes();
  std::vector<ImVec2> curve;
  for (size_t i = 0; i < kWavelengths; ++i) {
    curve.push_back(plot.at(table_wavelength(i), std::min(value(table_wavelength(i)), high)));
    if (i == 0) continue;
    const float bottom = plot.at(kFirstWavelength, 0).y;
    draw->AddQuadFilled({curve[i - 1].x, bottom}, curve[i - 1], curve[i], {curve[i].x, bottom},
                        color_of(table_wavelength(i) - kWavelengthStep / 2));
  }
  plot.draw_curve(curve, ImGui::GetColorU32(ImGuiCol_Text), 1.5f);
  return plot;
}

void spectrum_plot(UiContext& ui, const char* item, const char* title, double at_least, const SpectrumFunction& value) {
  const float em = ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size{ImGui::GetContentRegionAvail().x, 9 * em};
  if (size.x < 6 * em) return;
  ImGui::InvisibleButton(item, size);
  ui.items.add(item);
  const double highest = std::max(at_least, largest_value(value));
  if (highest > 0)
    draw_spectrum_plot(ui, {Vec2(corner.x, corner.y), Vec2(size.x, size.y)}, title, 1.05 * highest, value);
}

}  // namespace etendue::viewer
