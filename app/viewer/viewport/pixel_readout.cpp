#include "viewer/viewport/pixel_readout.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <string_view>

#include "render/session.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/viewport/aov_layer.h"
#include "viewer/viewport/error_layer.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr Vec2 kUsualOffset(8);  // from the upper right corner of the viewport, units of the interface

PixelErrors errors_of(render::Session& session, uint64_t version) {
  const film::Film film = session.film_copy();
  PixelErrors result{.version = version,
                     .frame_samples = session.status().samples,
                     .width = film.width(),
                     .height = film.height(),
                     .samples = {},
                     .errors = {}};
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) result.samples.push_back(film.samples(x, y));
  for (const double error : pixel_errors(film)) result.errors.push_back(static_cast<float>(error));
  return result;
}

size_t index_of(Vec2i pixel, int width) {
  return static_cast<size_t>(pixel.y) * static_cast<size_t>(width) + static_cast<size_t>(pixel.x);
}

bool is_inside(Vec2i pixel, int width, int height) {
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x < width && pixel.y < height;
}

std::string rgb_text(const Rgb& c) { return formatted("%.3g %.3g %.3g", double{c.r}, double{c.g}, double{c.b}); }

std::string byte_text(const Rgb& c) {
  const auto byte = [](float v) { return static_cast<int>(std::lround(v * 255)); };
  return formatted("%d %d %d", byte(c.r), byte(c.g), byte(c.b));
}

struct Row {
  const char* label;
  std::string (*text)(const PixelValues&);
  const char* tooltip_text;
};

std::string error_text(const PixelValues& v) {
  if (!v.standard_error) return "?";
  const float mean = (v.radiance.r + v.radiance.g + v.radiance.b) / 3;
  const double error{*v.standard_error};
  if (mean <= 0) return formatted("%.3g", error);
  return formatted("%.3g (%.2g %%)", error, 100 * error / double{mean});
}

constexpr std::array<Row, 6> kRows{
    {{"Pixel", [](const PixelValues& v) { return formatted("%d, %d", v.pixel.x, v.pixel.y); },
      "Column and row, from the upper left corner"},
     {"Radiance", [](const PixelValues& v) { return rgb_text(v.radiance); },
      "Linear red, green and blue, in cd/m\u00b2. A preview is interpolated from coarse blocks"},
     {"Luminance", [](const PixelValues& v) { return formatted("%.4g", double{luminance(v.radiance)}); },
      "In cd/m\u00b2"},
     {"Displayed", [](const PixelValues& v) { return byte_text(v.displayed); },
      "Red, green and blue after exposure, tone curve and sRGB encoding, 0 to 255"},
     {"Samples",
      [](const PixelValues& v) {
        if (v.is_preview) return std::string("preview");
        return v.samples ? formatted("%u", *v.samples) : std::string("?");
      },
      "Samples of this pixel"},
     {"Std. error", error_text,
      "Standard error of the radiance, averaged over the channels and 5 x 5 pixels, and its share of the radiance. "
      "Estimated from the two half-buffers; it does not include bias"}}};

void draw_rows(const UiContext& ui, const std::optional<PixelValues>& pointer,
               const std::optional<PixelValues>& pinned) {
  const auto value_cell = [&](const std::optional<PixelValues>& values, const Row& row) {
    ImGui::TableNextColumn();
    ImGui::PushFont(ui.fonts.monospace);
    ImGui::TextUnformatted(values ? row.text(*values).c_str() : "-");
    ImGui::PopFont();
  };
  for (const Row& row : kRows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.label);
    if (ImGui::IsItemHovered()) tooltip(ui, row.tooltip_text);
    value_cell(pointer, row);
    if (pinned) value_cell(pinned, row);
  }
}

void draw_layer_row(const AppState& state, const std::optional<PixelValues>& pointer,
                    const std::optional<PixelValues>& pinned) {
  if (!state.shows_aov() || !state.viewport.aov->image().is_radiance) return;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted("Layer");
  if (ImGui::IsItemHovered())
    tooltip(state.ui, "Radiance of the layer that is shown instead of the image, in cd/m\u00b2");
  ImGui::PushFont(state.ui.fonts.monospace);
  for (const auto* values : {&pointer, &pinned}) {
    if (values == &pinned && !pinned) continue;
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(*values && (*values)->layer ? rgb_text(*(*values)->layer).c_str() : "-");
  }
  ImGui::PopFont();
}

// The heads are plain text, so that the window can be dragged by them.
void draw_heads(bool has_pinned) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (const char* head : {"Pixel values", "Pointer", "Pinned"}) {
    if (head == std::string_view("Pinned") && !has_pinned) continue;
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(head);
  }
}

void draw_content(AppState& state, const std::optional<PixelValues>& pointer,
                  const std::optional<PixelValues>& pinned) {
  const float width = 11 * ImGui::GetFontSize();
  if (ImGui::BeginTable("##values", pinned ? 3 : 2, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableSetupColumn("##label", ImGuiTableColumnFlags_WidthFixed, 6.5f * ImGui::GetFontSize());
    ImGui::TableSetupColumn("Pointer", ImGuiTableColumnFlags_WidthFixed, width);
    if (pinned) ImGui::TableSetupColumn("Pinned", ImGuiTableColumnFlags_WidthFixed, width);
    draw_heads(pinned.has_value());
    draw_rows(state.ui, pointer, pinned);
    draw_layer_row(state, pointer, pinned);
    ImGui::EndTable();
  }
  action_button(state, "view.pin-pixel");
  ImGui::SameLine();
  action_button(state, "view.unpin-pixel");
}

// A square around the pinned pixel.
void draw_pin(const AppState& state, Vec2i pixel) {
  const Placement& image = state.viewport.image;
  const Vec2 pixel_size = image.size / Vec2(state.document().width, state.document().height);
  const Vec2 centre = image.corner + (Vec2(pixel) + 0.5f) * pixel_size;
  const float half = std::max(0.5f * pixel_size.x + 1, ImGui::GetFontSize() * 0.3f);
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const auto draw_square = [&](ImU32 color, float width) {
    draw->AddRect({centre.x - half, centre.y - half}, {centre.x + half, centre.y + half}, color, 0, 0, width);
  };
  draw_square(IM_COL32(0, 0, 0, 170), 3.5f);
  draw_square(IM_COL32(120, 220, 255, 255), 1.5f);
}

}  // namespace

bool PixelReadout::is_outdated() const {
  const render::Status status = session_.status();
  if (status.version != editor_.version() || status.samples == 0) return false;
  if (errors_.version != status.version) return true;
  const uint32_t known = errors_.frame_samples;
  return status.samples > known + known / 4 || (status.finished && status.samples > known);
}

void PixelReadout::update(bool visible) {
  if (auto errors = task_.take_result()) errors_ = std::move(*errors);
  if (!visible || task_.running() || !is_outdated()) return;
  const uint64_t version = editor_.version();
  task_.start([&session = session_, version] { return errors_of(session, version); }, wake_);
}

const PixelErrors* PixelReadout::errors() const {
  return errors_.width > 0 && errors_.version == editor_.version() ? &errors_ : nullptr;
}

std::optional<PixelValues> pixel_values(const AppState& state, Vec2i pixel) {
  const auto& frame = state.viewport.frame;
  if (!frame || !is_inside(pixel, frame->width, frame->height)) return std::nullopt;
  const auto& display = state.document().display;
  PixelValues values;
  values.pixel = pixel;
  values.radiance = (*frame->pixels)[index_of(pixel, frame->width)];
  values.is_preview = frame->preview_scale > 1;
  values.displayed = image::displayed(values.radiance, display.exposure, display.curve);
  const PixelErrors* errors = state.viewport.pixel_readout->errors();
  if (errors && is_inside(pixel, errors->width, errors->height)) {
    const size_t i = index_of(pixel, errors->width);
    values.samples = errors->samples[i];
    if (errors->samples[i] >= film::kHalfBuffers) values.standard_error = errors->errors[i];
  }
  if (state.shows_aov()) {
    const AovImage& layer = state.viewport.aov->image();
    if (layer.is_radiance && is_inside(pixel, layer.width, layer.height))
      values.layer = layer.pixels[index_of(pixel, layer.width)];
  }
  return values;
}

std::optional<Vec2i> pixel_under_pointer(const AppState& state) {
  const Placement& image = state.viewport.image;
  const Vec2 position = state.ui.input.mouse;
  if (ImGui::GetIO().WantCaptureMouse || !state.viewport.visible_image().contains(position)) return std::nullopt;
  return pixel_at(image, {state.document().width, state.document().height}, position);
}

void draw_pixel_readout(AppState& state) {
  const ViewportState& viewport = state.viewport;
  std::optional<PixelValues> pointer;
  std::optional<PixelValues> pinned;
  if (const auto pixel = pixel_under_pointer(state)) pointer = pixel_values(state, *pixel);
  if (viewport.pinned_pixel) pinned = pixel_values(state, *viewport.pinned_pixel);
  if (pinned) draw_pin(state, pinned->pixel);
  const float scale = state.ui.scale;
  MovableWindow& window = viewport.pixel_readout->window();
  Vec2 offset = state.settings.pixel_values_offset.value_or(kUsualOffset) * scale;
  const bool is_placed = window.draw("##pixel values", viewport.region, offset, kUsualOffset * scale,
                                     [&] { draw_content(state, pointer, pinned); });
  state.ui.items.add("pixel-values.window", window.placement());
  if (offset / scale != state.settings.pixel_values_offset.value_or(kUsualOffset))
    state.settings.pixel_values_offset = offset / scale;
  if (is_placed) state.store_settings();
}

}  // namespace etendue::viewer
