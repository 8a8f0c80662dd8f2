#include "viewer/widgets/spectrum_editor.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "medium/medium.h"
#include "render/document.h"
#include "spectrum/emission_spectrum.h"
#include "spectrum/observer.h"
#include "spectrum/spectrum_points.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

using Points = std::vector<Spectrum::Sample>;

constexpr const char* kHelp =
    "Drag a point to move it. Double click adds a point; a right click on a point removes it. At least two remain";
constexpr float kReach = 0.6f;       // of the mouse around a point, in units of the font size
constexpr double kHeadroom = 1.3;    // of the axis above the largest value
constexpr double kTolerance = 0.01;  // of points that replace a spectrum, relative to the largest value

std::optional<render::DocumentParameter> parameter_of(const AppState& state, const std::string& name) {
  auto list = render::section_parameters(state.document(), name.substr(0, name.rfind('.')));
  const auto found = std::ranges::find_if(list, [&](const auto& p) { return p.info.name == name; });
  if (found == list.end() || !found->inactive_reason.empty()) return std::nullopt;
  return std::move(*found);
}

// Points that approximate a spectrum.
Points points_of(const SpectrumField& field) {
  const double largest = largest_value(field.value);
  const double scale = field.relative && largest > 0 ? 1 / largest : 1;
  Points points;
  for (size_t i = 0; i < kWavelengths; ++i)
    points.push_back({table_wavelength(i), scale * field.value(table_wavelength(i))});
  return simplified_points(points, kTolerance * scale * largest);
}

// Invalid points, such as a spectrum without visible light, do not change the document.
void apply(AppState& state, const render::DocumentParameter& parameter, const Points& points) {
  const std::string text = text_of_points(points);
  if (parameter.info.validate_text(text)) state.edit(parameter, text, parameter.info.name);
}

// The chart of a list of points, and what the mouse does to them in this frame.
class PointChart {
 public:
  PointChart(AppState& state, const render::DocumentParameter& parameter, const char* title, Points points)
      : state_(state), parameter_(parameter), points_(std::move(points)) {
    draw(title);
  }

  void edit() {
    if (!plot_) return;
    const std::optional<size_t> near = point_near_mouse();
    const bool hovered = ImGui::IsItemHovered();
    if (ImGui::IsItemActivated()) storage().SetInt(dragged_key(), near ? static_cast<int>(*near) : -1);
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) move_dragged();
    if (hovered && !near && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) insert();
    if (hovered && near && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) remove(*near);
    if (ImGui::IsItemDeactivated()) state_.editor->end_gesture();
    if (hovered && !ImGui::IsItemActive()) tooltip(state_.ui, near ? text_of(points_[*near]) : kHelp);
  }

 private:
  static ImGuiStorage& storage() { return *ImGui::GetStateStorage(); }
  static ImGuiID dragged_key() { return ImGui::GetID("dragged"); }
  static ImGuiID high_key() { return ImGui::GetID("high"); }

  static std::string text_of(const Spectrum::Sample& point) {
    return formatted("%.4g nm: %.4g", point.wavelength, point.value);
  }

  void draw(const char* title) {
    const float em = ImGui::GetFontSize();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, 9 * em};
    if (size.x < 6 * em) return;
    const std::string item = parameter_.info.name + ".points";
    ImGui::InvisibleButton(item.c_str(), size, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    state_.ui.items.add(item);
    const auto spectrum = Spectrum::piecewise_linear(points_);
    if (!spectrum) return;
    // The axis does not change during a drag.
    const auto fitted = static_cast<float>(kHeadroom * std::max(largest_value(*spectrum), 1e-6));
    if (!ImGui::IsItemActive()) storage().SetFloat(high_key(), fitted);
    high_ = static_cast<double>(storage().GetFloat(high_key(), fitted));
    plot_.emplace(
        draw_spectrum_plot(state_.ui, {Vec2(corner.x, corner.y), Vec2(size.x, size.y)}, title, high_, *spectrum));
    for (const Spectrum::Sample& point : points_)
      if (is_shown(point))
        ImGui::GetWindowDrawList()->AddCircleFilled(plot_->at(point.wavelength, point.value), 0.22f * em,
                                                    ImGui::GetColorU32(ImGuiCol_Text));
  }

  bool is_shown(const Spectrum::Sample& point) const {
    return point.wavelength >= kFirstWavelength && point.wavelength <= kLastWavelength && point.value <= high_;
  }

  std::optional<size_t> point_near_mouse() const {
    const ImVec2 mouse = ImGui::GetMousePos();
    std::optional<size_t> nearest;
    float distance = kReach * ImGui::GetFontSize();
    for (size_t i = 0; i < points_.size(); ++i) {
      if (!is_shown(points_[i])) continue;
      const ImVec2 at = plot_->at(points_[i].wavelength, points_[i].value);
      const float d = std::hypot(at.x - mouse.x, at.y - mouse.y);
      if (d >= distance) continue;
      distance = d;
      nearest = i;
    }
    return nearest;
  }

  // Wavelength and value at the mouse, in whole nanometres.
  Spectrum::Sample point_of_mouse() const {
    const ImVec2 mouse = ImGui::GetMousePos();
    const Vec2 relative = (Vec2(mouse.x, mouse.y) - plot_->area().corner) / plot_->area().size;
    const double x = std::clamp(static_cast<double>(relative.x), 0.0, 1.0);
    const double y = std::clamp(static_cast<double>(relative.y), 0.0, 1.0);
    return {std::round(std::lerp(kFirstWavelength, kLastWavelength, x)), (1 - y) * high_};
  }

  void move_dragged() {
    const int index = storage().GetInt(dragged_key(), -1);
    if (index < 0 || static_cast<size_t>(index) >= points_.size()) return;
    const auto i = static_cast<size_t>(index);
    Spectrum::Sample moved = point_of_mouse();
    // A point stays between its neighbours, if they leave space.
    if (i > 0) moved.wavelength = std::max(moved.wavelength, points_[i - 1].wavelength + 1);
    if (i + 1 < points_.size()) moved.wavelength = std::min(moved.wavelength, points_[i + 1].wavelength - 1);
    if (i > 0 && moved.wavelength <= points_[i - 1].wavelength) moved.wavelength = points_[i].wavelength;
    points_[i] = moved;
    apply(state_, parameter_, points_);
  }

  void insert() {
    const Spectrum::Sample added = point_of_mouse();
    const auto at = std::ranges::lower_bound(points_, added.wavelength, {}, &Spectrum::Sample::wavelength);
    if (at != points_.end() && at->wavelength == added.wavelength) return;
    points_.insert(at, added);
    apply(state_, parameter_, points_);
    state_.editor->end_gesture();
  }

  void remove(size_t index) {
    if (points_.size() <= 2) return;
    points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(index));
    apply(state_, parameter_, points_);
    state_.editor->end_gesture();
  }

  AppState& state_;
  const render::DocumentParameter& parameter_;
  Points points_;
  double high_ = 0;
  std::optional<Plot> plot_;
};

void replace_by_points_button(AppState& state, const render::DocumentParameter& parameter, const SpectrumField& field) {
  const bool pressed = ImGui::Button("Edit as points");
  state.ui.items.add(parameter.info.name + ".edit");
  if (ImGui::IsItemHovered()) tooltip(state.ui, "Replaces the spectrum by points, which you can move in a chart");
  if (!pressed) return;
  apply(state, parameter, points_of(field));
  state.editor->end_gesture();
}

// The function of a spectrum of a medium.
template <class S>
SpectrumFunction function_of(const S& spectrum) {
  return [spectrum](double wavelength) { return static_cast<double>(spectrum.at(only_wavelength(wavelength))[0]); };
}

}  // namespace

void spectrum_editor(AppState& state, const SpectrumField& field) {
  const auto parameter = parameter_of(state, field.parameter);
  if (!parameter) return;
  const auto& text = std::get<std::string>(parameter->info.default_value);
  ImGui::PushID(field.parameter.c_str());
  if (!is_point_list(text))
    replace_by_points_button(state, *parameter, field);
  else if (auto points = parse_points(text))
    PointChart(state, *parameter, field.title, std::move(*points)).edit();
  ImGui::PopID();
}

void emission_spectrum_editor(AppState& state, const std::string& parameter, const EmissionSpectrum* spectrum) {
  spectrum_editor(
      state, {.parameter = parameter, .title = "Emission by wavelength, relative", .value = [=](double wavelength) {
                const double d65 = d65_at(wavelength);
                return spectrum ? d65 * static_cast<double>(spectrum->at(static_cast<float>(wavelength))) : d65;
              }});
}

void coefficient_editors(AppState& state, const std::string& section, const MediumDescription& medium) {
  if (medium.is_clear()) return;
  const MediumSpectra spectra = medium.spectra(Rgb(0));
  spectrum_editor(state, {.parameter = section + ".scattering-spectrum",
                          .title = "Scattering coefficient, 1/m",
                          .value = function_of(spectra.scattering),
                          .relative = false});
  spectrum_editor(state, {.parameter = section + ".absorption-spectrum",
                          .title = "Absorption coefficient, 1/m",
                          .value = function_of(spectra.absorption),
                          .relative = false});
}

}  // namespace etendue::viewer
