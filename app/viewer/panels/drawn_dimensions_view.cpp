#include "viewer/panels/drawn_dimensions_view.h"

#include <imgui.h>

#include <array>
#include <span>

#include "sampling/sampler.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

// A random number of a block: one dimension, or two that belong together.
struct NumberOfBlock {
  const char* label;
  int index;
  const char *x, *y;  // names of the dimensions, without the vertex
};
constexpr std::array<NumberOfBlock, 3> kOfCamera{{{"pixel", camera_dimension::kPixel, "pixel-x", "pixel-y"},
                                                  {"lens", camera_dimension::kLens, "lens-u", "lens-v"},
                                                  {"time", camera_dimension::kTime, "time", "pixel-x"}}};
constexpr std::array<NumberOfBlock, 5> kOfVertex{
    {{"direction", vertex_dimension::kBsdfDirection, "direction-x", "direction-y"},
     {"light point", vertex_dimension::kLightPoint, "light-x", "light-y"},
     {"light choice", vertex_dimension::kLightChoice, "light-choice", "light-x"},
     {"lobe", vertex_dimension::kBsdfLobe, "lobe", "direction-x"},
     {"roulette", vertex_dimension::kRoulette, "roulette", "direction-x"}}};

}  // namespace

std::optional<std::pair<std::string, std::string>> drawn_dimensions_table(const UiContext& ui,
                                                                          const PixelStatistics& statistics,
                                                                          uint32_t vertices) {
  std::optional<std::pair<std::string, std::string>> chosen;
  const auto share_of = [&](uint32_t block, int index) {
    return statistics.drawn_dimensions.at(block, index) / static_cast<double>(statistics.counted_samples);
  };
  const auto row = [&](uint32_t block, const std::string& label, const std::string& prefix,
                       std::span<const NumberOfBlock> numbers) {
    ImGui::TextDisabled("%s", label.c_str());
    ImGui::PushID(static_cast<int>(block));
    for (const NumberOfBlock& number : numbers) {
      const double share = share_of(block, number.index);
      if (share == 0) continue;
      const std::string text = formatted("%s %.0f %%", number.label, 100 * share);
      same_line_if_fits(ImGui::CalcTextSize(text.c_str()).x + ImGui::GetStyle().FramePadding.x * 2);
      if (ImGui::SmallButton(text.c_str())) chosen = {prefix + number.x, prefix + number.y};
      if (ImGui::IsItemHovered())
        tooltip(ui, formatted("%.3g %% of the first %u samples draw it. A click shows its points", 100 * share,
                              statistics.counted_samples));
    }
    ImGui::PopID();
  };
  row(0, "Camera", "", kOfCamera);
  for (uint32_t k = 1; k <= vertices; ++k) {
    if (share_of(k, vertex_dimension::kBsdfDirection) == 0 && share_of(k, vertex_dimension::kLightPoint) == 0) break;
    row(k, "Vertex " + std::to_string(k), "vertex-" + std::to_string(k) + ".", kOfVertex);
  }
  return chosen;
}

}  // namespace etendue::viewer
